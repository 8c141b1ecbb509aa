"""The processes that draw for all tests of this folder."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from burnish.materialx.fidelity.checker import Checker


@pytest.fixture(scope="session")
def checker() -> Iterator[Checker]:
    """One pair of processes: MaterialX's library is parsed once, and OpenGL starts once."""
    with Checker() as made:
        yield made
