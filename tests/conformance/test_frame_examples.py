"""Every example of a frame, on a route of each API and on some of the others, against reference.

Drawing a frame takes long, and most of what routes of one API do for it is the same. So each frame
is drawn by one route of each API, and by two of the others in turn.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

import burnish
from burnish.targets.conformance.conform import Tried, rows_of, trials_of
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import ROUTES

from ..frames.kit import EXAMPLES, LACKING
from .kit import Studio, keeping_the_last

ALWAYS = ("lavapipe:glsl", "llvmpipe:gl450", "chromium:webgpu", "chromium:webgl2")
OTHERS = [name for name in ROUTES if name not in ALWAYS]
IN_TURN = 2
SIZE = (48, 40)
"""Not square, so that an exchange of x and y is visible."""


def routes_of(path: Path) -> Iterator[str]:
    """The names of the routes that draw an example."""
    yield from ALWAYS
    first = IN_TURN * EXAMPLES.index(path)
    for number in range(first, first + IN_TURN):
        yield OTHERS[number % len(OTHERS)]


CASES = [
    # One process draws all of an example, if processes are given groups.
    pytest.param(
        path, route, id=f"{path.stem}-{route}", marks=pytest.mark.xdist_group(f"frames/{path.stem}")
    )
    for path in EXAMPLES
    for route in routes_of(path)
]


@pytest.fixture(scope="module")
def trials() -> Callable[[Path], list[Tried]]:
    """The trials of an example, which remember the reference's pictures for all routes."""

    @keeping_the_last
    def found(path: Path) -> list[Tried]:
        profiles = tuple(dict.fromkeys(ROUTES[name].profile for name in routes_of(path)))
        (frame,) = burnish.compile(path, profiles, partial=True).frames
        return trials_of([(path.stem, frame)], size=SIZE)

    return found


@pytest.mark.parametrize(("path", "route"), CASES)
def test_it_agrees(
    studio: Studio, trials: Callable[[Path], list[Tried]], path: Path, route: str
) -> None:
    (row,) = rows_of(trials(path), [ROUTES[route]], studio.runner, studio.toolchain)
    if ROUTES[route].profile in LACKING.get(path.stem, ()):
        assert row.status == "not run", row.status
        return
    assert row.status == "agrees", "\n".join(details(row)) or row.problem
    assert all(np.isfinite(target).all() for result in row.results for target in result.got)
    # A frame that shows the same everywhere would agree whatever went wrong.
    assert any(np.ptp(target[..., :3]) > 0.1 for result in row.results for target in result.got)


def test_every_route_of_frames_has_its_turn() -> None:
    drawn = {route for path in EXAMPLES for route in routes_of(path)}
    assert drawn == {*ALWAYS, *OTHERS}
