"""The bench that measures what guards cost really leaves them out, and only there."""

from __future__ import annotations

import burnish

from .guard_cost import local_shading, no_guards

GUARDED = "material M { param x : float  color = vec3(sqrt(uv.x), 1 / uv.y, x / 2) }"


def _texts() -> str:
    return burnish.compile(GUARDED, ("glsl",))["M"].text("glsl", "fragment")


def test_guards_are_left_out_only_inside() -> None:
    before = _texts()
    with no_guards():
        bare = _texts()
    assert "max(v_uv.x, 0.0)" in before and "sqrt(v_uv.x)" in bare
    assert _texts() == before


def test_the_examples_of_local_shading_are_found() -> None:
    found = local_shading()
    assert len(found) > 15 and all(path.is_file() for path in found)
