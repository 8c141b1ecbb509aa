"""The toolchain that all tests of this folder share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from burnish.targets.toolchain import Toolchain


@pytest.fixture(scope="package")
def toolchain() -> Iterator[Toolchain]:
    """The real tools. ``make test`` installs them, so a missing tool fails the test."""
    with Toolchain() as tools:
        yield tools
