"""A few hostile requests to the server of ``burnish view``; ``make fuzz`` asks others."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from .hostile.requests import Asked, asked


@pytest.fixture(scope="module")
def server() -> Iterator[Asked]:
    with asked() as server:
        yield server


@pytest.mark.parametrize("part", range(8))
def test_hostile_requests(server: Asked, part: int) -> None:
    """Each is answered, and none of them with what nobody may see."""
    for number in range(100 * part, 100 * part + 100):
        seed = f"test:{number}"
        assert server.problem(seed) is None, seed
