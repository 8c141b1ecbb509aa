"""What the hosts' pictures are judged by: the same scenes, drawn by Burnish's own host."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from burnish.targets.toolchain import Toolchain

from .expecting import ROUTE, Picture, runner, whole_scene


@pytest.fixture(scope="session")
def expected() -> Iterator[Callable[[str], Picture]]:
    """Call it with the name of a scene: the picture that a host has to draw."""
    made: dict[str, Picture] = {}
    with runner() as drawing, Toolchain() as toolchain:
        assert drawing.problem(ROUTE) is None, drawing.problem(ROUTE)

        def find(name: str) -> Picture:
            if name not in made:
                made[name] = whole_scene(name, drawing, toolchain)
            return made[name]

        yield find
