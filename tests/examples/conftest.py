"""One toolchain for all tests of this folder."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from burnish.targets.toolchain import Toolchain


@pytest.fixture(scope="package")
def toolchain() -> Iterator[Toolchain]:
    """The real tools; ``make test`` has installed them, so a missing one is a failure."""
    with Toolchain() as tools:
        yield tools
