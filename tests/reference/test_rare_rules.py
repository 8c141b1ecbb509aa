"""Few pictures hang on the rules that are called rare: those of which a picture says so."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from burnish.compiler.reference.picture import Expected, Geometry, RasterRules
from burnish.compiler.reference.picture.scene import LEVEL_EDGES, LINES, RARE, ROWS
from burnish.targets.conformance.known_values import Known

from .kit import picture, shader

TEXT = """
material M {
    attribute place : vec2
    clip_position : point<clip> = vec4(place, 0.5, 1)
    value = %s
}
pass P { target value : rgba32f = vec4(material.value, 0.5, 1) }
"""
PLAIN, NEIGHBOURLY = (
    shader(TEXT % value, "P") for value in ("place", "vec2(ddx(place.x), ddy(place.y))")
)
SIZE = 4
RULES = RasterRules(SIZE, SIZE, subpixel_bits=1)
OTHERS: dict[str, Any] = {
    "owns_bottom": True,
    "lines": "diamonds",
    "snaps_line_ends": True,
    "bottom_up": True,
}
"""Another value of each rare rule."""

Places = list[tuple[float, float]]


def mesh(places: Places, corners: int = 3) -> Geometry:
    """Faces between places in the window, in pixels."""
    place = np.array([(2 * x / SIZE - 1, 1 - 2 * y / SIZE) for x, y in places])
    return Geometry({"place": place}, np.arange(len(places)).reshape(-1, corners))


def names(drawn: Expected) -> set[str]:
    return {name for name, _ in drawn.counted}


LEVEL = [(0.5, 0.5), (2.5, 0.5), (0.5, 2.5)]
"""A face whose upper edge goes through the middles of pixels."""
SHORT = [(0.75, 0.5), (1.25, 0.5), (0.5, 2.5)]
"""A face whose upper edge is in the same row, but between the middles of two pixels."""
SLOPING = [(0.0, 0.0), (3.0, 1.0), (1.0, 4.0)]


def test_a_level_edge_through_the_middles_of_pixels_is_told() -> None:
    assert names(picture(PLAIN, mesh(LEVEL), RULES)) == LEVEL_EDGES
    assert names(picture(PLAIN, mesh(SLOPING), RULES)) == set()
    assert names(picture(PLAIN, mesh(SHORT), replace(RULES, subpixel_bits=8))) == set()


def test_lines_and_neighbours_are_told() -> None:
    assert names(picture(PLAIN, mesh(SLOPING[:2], 2), RULES)) >= LINES
    assert names(picture(NEIGHBOURLY, mesh(SLOPING), RULES)) == ROWS


def test_every_rare_rule_is_tried() -> None:
    assert OTHERS.keys() == RARE
    assert all(getattr(RULES, name) != other for name, other in OTHERS.items())


HALVES = st.integers(0, 2 * SIZE).map(lambda number: number / 2)


@settings(max_examples=40)
@given(st.lists(st.tuples(HALVES, HALVES), min_size=6, max_size=6), st.sampled_from(sorted(RARE)))
def test_a_picture_is_the_same_by_rules_that_it_does_not_tell(places: Places, name: str) -> None:
    other = replace(RULES, **{name: OTHERS[name]})
    one, another = (picture(PLAIN, mesh(places), rules) for rules in (RULES, other))
    assert names(one) == names(another)
    if other.agree_with(one.counted):
        assert np.array_equal(one.targets[0], another.targets[0])
        assert np.array_equal(one.layers, another.layers)
        assert np.array_equal(one.undecided, another.undecided)


def test_a_picture_holds_for_rules_that_agree_where_it_tells_them() -> None:
    below = replace(RULES, owns_bottom=True)
    level, sloping = (picture(PLAIN, mesh(places), RULES) for places in (LEVEL, SLOPING))
    assert [RULES.agree_with(drawn.counted) for drawn in (level, sloping)] == [True, True]
    assert [below.agree_with(drawn.counted) for drawn in (level, sloping)] == [False, True]
    assert below.common == RULES.common
    assert replace(RULES, subpixel_bits=8).common != RULES.common


@pytest.mark.parametrize(("fits", "wanted"), [(True, ["one"]), (False, ["one", "two"])])
def test_what_fits_is_made_once(fits: bool, wanted: list[str]) -> None:
    known, made = Known[str](), []

    def asked(name: str) -> str:
        def make() -> str:
            made.append(name)
            return name

        return known.shared("common", name, make, lambda found: fits or found == name)

    assert asked("one") == "one"
    for _ in range(2):
        assert asked("two") == wanted[-1]
        assert asked("one") == "one"
    assert made == wanted
