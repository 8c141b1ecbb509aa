"""The worker processes that all tests of this folder share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from .kit import Studio


@pytest.fixture(scope="session")
def studio() -> Iterator[Studio]:
    """Draws with every route and with the reference."""
    with Studio() as studio:
        yield studio
