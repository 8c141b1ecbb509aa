"""Depths of two draws: equal on every device if both place their faces in the same way, with the
same numbers, and have invariant positions; else rounding decides."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from burnish.compiler.reference.picture import (
    Canvas,
    Geometry,
    RasterRules,
    Texels,
    draw_onto,
    expected_on,
    written_by,
)
from burnish.compiler.reference.storage_buffers import Contents

from .kit import few_ulps, shader
from .test_drawing import at, triangles

PROGRAM = """
material M {{
    attribute place : vec4
    param wide  : float = 1
    param scale : float = 1
    param other : float = 1
    map lift : texture2d with {{ mip = none }}
    buffer heights : float[]
    clip_position : point<clip> = {placed}
    color = vec3(scale * other, 0, 0)
}}
pass P {{
    {state}
    target t : rgba32f = vec4(material.{shown}, 1)
}}
"""
SCALED = "(vec4(wide * place.xy, scale * place.z, place.w) as point<clip>)"
LIFTED = "(vec4(place.xy, place.z * lift.load(ivec2(0)).x, place.w) as point<clip>)"
RAISED = "(vec4(place.xy, place.z * heights[0], place.w) as point<clip>)"
EARLY = "raster { invariant = true }"
EQUAL = "depth { compare = equal, write = false }"
BACK, FRONT = (
    [(-9.0, -9.0, depth, 1.0), (20.0, -9.0, depth, 1.0), (-9.0, 20.0, depth, 1.0)]
    for depth in (0.7, 0.3)
)
BOTH = triangles(BACK, FRONT)
TURNED = triangles(BACK[::-1], FRONT)
"""The two faces, of which the first one shows its back."""
HALVES = (np.full((1, 1, 4), 0.5),)
EXACT = Texels(HALVES)
"""A texture of the host's."""
HALF = np.float32(0.5).tobytes()
VALUES: dict[str, Any] = {"wide": (1.0,), "scale": (0.9,), "other": (0.5,)}


def undecided(
    early: str = EARLY,
    late: str = EQUAL,
    *,
    mesh: Geometry = BOTH,
    second: Geometry | None = None,
    rules: RasterRules | None = None,
    lift: Texels = EXACT,
    placed: str = SCALED,
    shown: str = "color",
    heights: Contents | None = None,
    again: Contents | None = None,
    **values: Any,
) -> bool:
    """True if rounding may change any pixel after two draws of the same faces.

    Both read the same ``lift``, and ``heights`` unless the second one finds others ``again``. All
    other arguments are different in the second one.
    """
    first, last = (
        shader(PROGRAM.format(placed=placed, state=state, shown=show), "P")
        for state, show in ((early, "color"), (late, shown))
    )
    usual = at(2)
    canvas = Canvas(4, [(0.0, 0.0, 0.0, 1.0)], written_by(first), rounds=True)
    held = VALUES | {"heights": heights or Contents(HALF), "heights.count": (1,)}
    draw_onto(canvas, first, held, {"lift": lift}, mesh, usual, few_ulps)
    assert not expected_on(canvas, usual).undecided.any()
    there = {"lift": lift}
    if again is not None:
        held |= {"heights": again}
    draw_onto(canvas, last, held | values, there, second or mesh, rules or usual, few_ulps)
    picture = expected_on(canvas, usual)
    if not picture.undecided.any():
        assert picture.layers.tolist() == [[2, 2], [2, 2]]
    return bool(picture.undecided.any())


def test_what_is_placed_alike_is_found_again() -> None:
    assert not undecided()
    assert not undecided(late="depth { compare = less_equal, write = false }")
    assert not undecided(shown="place.xyz")


def test_what_does_not_place_faces_may_be_different() -> None:
    assert not undecided(other=(0.75,))


def test_without_invariant_positions_rounding_decides() -> None:
    assert undecided(early="")
    assert undecided(late=EQUAL + " raster { invariant = false }")


def test_other_numbers_give_other_places() -> None:
    # The face lies at one depth, but no device promises to find just this for other corners.
    assert undecided(wide=(0.75,))
    moved = triangles(BACK, [(x + 0.5, y, z, w) for x, y, z, w in FRONT])
    assert undecided(second=moved)


def test_faces_that_are_drawn_elsewhere_or_moved_away_are_others() -> None:
    assert undecided(rules=at(2, viewport=(0, 0, 2, 1)))
    assert undecided(late=EQUAL + " depth { bias = 1 }")


def test_faces_that_are_not_drawn_count() -> None:
    """Numbers of faces do not hang on which of them are culled."""
    assert not undecided(late=EQUAL + " raster { cull = back }", mesh=TURNED)


@pytest.mark.parametrize("is_drawn", [False, True])
def test_textures_that_a_device_has_drawn_may_be_others(is_drawn: bool) -> None:
    lift = Texels(HALVES, False, HALVES, HALVES) if is_drawn else EXACT
    assert undecided(placed=LIFTED, lift=lift) == is_drawn


def test_elements_that_a_kernel_has_written_are_the_same_for_all_who_read_them() -> None:
    """Another kernel may have written others on a device, though here they are equal."""
    one, other = (Contents(HALF, np.array([[0.5], [0.49], [0.51]])) for _ in range(2))
    assert not undecided(placed=RAISED, heights=one)
    assert undecided(placed=RAISED, heights=one, again=other)


def test_elements_of_the_host_are_told_by_their_numbers() -> None:
    assert not undecided(placed=RAISED, heights=Contents(HALF), again=Contents(HALF))


HIDDEN = triangles([(0.5, 20.0, 0.7, 1.0), (-20.0, 0.0, 0.7, 1.0), (0.5, -20.0, 0.7, 1.0)])
"""A face behind both, of which an edge goes through the middles of the right pixels: rounding tips
whether it covers these."""


@pytest.mark.parametrize(
    ("state", "unsure"), [("", False), ("stencil { depth_fail = increment_wrap }", True)]
)
def test_edges_of_what_is_hidden_matter_to_stencil_values_alone(state: str, unsure: bool) -> None:
    first, behind = (
        shader(PROGRAM.format(placed=SCALED, state=each, shown="color"), "P")
        for each in ("", f"depth {{ compare = less_equal, write = false }} {state}")
    )
    canvas = Canvas(4, [(0.0, 0.0, 0.0, 1.0)], written_by(first), rounds=True)
    rules = at(2, edge_slack=2.0**-10)
    draw_onto(canvas, first, VALUES, {"lift": EXACT}, triangles(FRONT), rules, few_ulps)
    draw_onto(canvas, behind, VALUES, {"lift": EXACT}, HIDDEN, rules, few_ulps)
    assert canvas.stencil.unsure.tolist() == [False, unsure, False, unsure]
    if not unsure:
        assert not expected_on(canvas, rules).undecided.any()
