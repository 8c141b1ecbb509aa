"""One set of workers for all tests of this folder."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from .kit import Studio


@pytest.fixture(scope="session")
def studio() -> Iterator[Studio]:
    """Every route and the reference."""
    with Studio() as studio:
        yield studio
