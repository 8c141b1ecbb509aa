"""The pixels that lines cover by each of the rules that APIs allow, and the values there.

``tests/conformance/test_lines.py`` shows which driver has which rule.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import Any, get_args

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from burnish.compiler.ir.render_state import Cull, RenderState
from burnish.compiler.reference.picture import RasterRules
from burnish.compiler.reference.picture.assembly import faces_of
from burnish.compiler.reference.picture.coverage import coverage_of
from burnish.compiler.reference.picture.quads import Barycentric, Quads
from burnish.compiler.reference.picture.scene import Bools, Floats, Lines

from .test_coverage import clip_positions, covered

SIZE = 12
RULES: tuple[Lines, ...] = ("rectangle", "parallelogram", "diamonds")
EXACT = RasterRules(SIZE, SIZE, subpixel_bits=8)
LINE = np.array([[0, 1]])


def by(rule: Lines, **others: Any) -> RasterRules:
    """The rules of a device that draws lines so."""
    return replace(EXACT, lines=rule, **others)


def pixels(begin: Any, end: Any, rules: RasterRules) -> tuple[Bools, Bools]:
    """The pixels that a line covers, as rows; and the undecided ones."""
    fragments, unsure = covered(clip_positions([begin, end], rules), LINE, rules)
    found = np.zeros(rules.width * rules.height, dtype=np.bool_)
    found[fragments.sample] = True
    return found.reshape(rules.height, -1), unsure.reshape(rules.height, -1)


def places(begin: Any, end: Any, rule: Lines) -> set[tuple[int, int]]:
    """The columns and rows of the pixels that a line covers."""
    rows, columns = np.nonzero(pixels(begin, end, by(rule))[0])
    return set(zip(columns.tolist(), rows.tolist(), strict=True))


def row(*columns: int) -> set[tuple[int, int]]:
    return {(column, 2) for column in columns}


@pytest.mark.parametrize(
    ("rule", "forth", "back"),
    [
        ("rectangle", row(2, 3), row(2, 3)),
        ("parallelogram", row(2, 3), row(2, 3)),
        # A line that begins in a diamond leaves it, and one that ends there does not.
        ("diamonds", row(1, 2, 3), row(4, 3, 2)),
    ],
)
def test_the_ends_of_a_flat_line(rule: Lines, forth: Any, back: Any) -> None:
    begin, end = (1.9, 2.5), (4.1, 2.5)
    assert (places(begin, end, rule), places(end, begin, rule)) == (forth, back)


@pytest.mark.parametrize("rule", RULES)
def test_an_upright_line_is_a_flat_one_turned(rule: Lines) -> None:
    flat = places((1.9, 2.5), (7.2, 3.75), rule)
    upright = places((2.5, 1.9), (3.75, 7.2), rule)
    assert upright == {(row, column) for column, row in flat}


def test_lines_that_follow_each_other_share_no_pixel_by_diamonds() -> None:
    ends = [(1.2, 1.9), (4.6, 3.1), (9.7, 2.0)]
    one, other = (places(*pair, "diamonds") for pair in pairwise(ends))
    assert one.isdisjoint(other)
    assert {column for column, _ in one | other} == set(range(1, 10))


def test_a_rectangle_is_wider_than_a_parallelogram_where_lines_are_steep() -> None:
    """The middle of this pixel is 0.6 below the line, and 0.6 / sqrt(2) away from it."""
    begin, end, at = (1.5, 1.9), (8.5, 8.9), (4, 5)
    assert at in places(begin, end, "rectangle")
    assert at not in places(begin, end, "parallelogram")
    assert at not in places(begin, end, "diamonds")


@pytest.mark.parametrize("rule", [*RULES, "any"])
def test_a_picture_in_front_of_which_all_lines_lie(rule: Lines) -> None:
    """Nothing is left of a line that lies before the near plane."""
    ends = np.array([[0.0, 0.0, -1.0, 1.0], [0.5, 0.5, -1.0, 1.0]])
    fragments, unsure = covered(ends, LINE, by(rule))
    assert len(fragments.sample) == 0
    assert not unsure.any()


def test_lines_without_a_length_cover_nothing() -> None:
    for rule in RULES:
        assert places((3.2, 3.4), (3.2, 3.4), rule) == set()


coordinates = st.floats(0.5, SIZE - 0.5)
points = st.tuples(coordinates, coordinates)


@settings(max_examples=150)
@given(points, points)
def test_what_any_rule_decides_all_rules_agree_on(
    begin: tuple[float, float], end: tuple[float, float]
) -> None:
    found, undecided = pixels(begin, end, by("any"))
    for rule in RULES:
        drawn, unsure = pixels(begin, end, by(rule))
        assert ((drawn == found) | undecided | unsure).all()


def test_something_is_decided_by_any_rule() -> None:
    found, undecided = pixels((1.2, 2.6), (10.8, 2.4), by("any"))
    assert (found & ~undecided).sum() == 8
    assert undecided.sum() == 4


def test_the_border_of_the_picture_is_undecided_where_a_line_leaves_it() -> None:
    found, undecided = pixels((-3.0, 2.0), (6.0, 6.5), by("rectangle"))
    assert undecided[:, 0].any() and not undecided[:, 1:-1].any()
    assert found[:, 1:].any()


def test_lines_are_cut_at_the_near_plane() -> None:
    """Half of this line lies before it, in clip space."""
    positions = np.array([[-0.5, 0.0, -1.0, 1.0], [0.5, 0.0, 1.0, 1.0]])
    fragments, _ = covered(positions, LINE, EXACT)
    assert sorted(set((fragments.sample % SIZE).tolist())) == [6, 7, 8]


def interpolated(begin: Any, end: Any, at: tuple[int, int], rules: RasterRules) -> float:
    """A value in the middle of a pixel that is 0 where a line begins and 1 where it ends."""
    with np.errstate(all="ignore"):
        faces = faces_of(clip_positions([begin, end], rules), LINE, rules)
        quads = Quads(np.array([0]), np.array([at[0]]), np.array([at[1]]), 1)
        (lane,) = Barycentric(faces, quads, rules).perspective((np.array([0.0, 1.0]),))
    return float(lane.value[0, 0, 0])


def test_values_are_those_of_the_nearest_place_on_a_line() -> None:
    """Vulkan: (p - a) · (b - a) / |b - a|². By diamonds only the longer direction counts."""
    begin, end, at = (1.0, 2.0), (9.0, 6.0), (4, 3)
    expected = ((4.5 - 1) * 8 + (3.5 - 2) * 4) / (8**2 + 4**2)
    for rule in ("rectangle", "parallelogram"):
        assert interpolated(begin, end, at, by(rule)) == pytest.approx(expected)
    assert interpolated(begin, end, at, by("diamonds")) == pytest.approx((4.5 - 1) / 8)
    assert interpolated(begin, end, at, by("rectangle", interpolates_snapped=True)) == (
        pytest.approx(expected)
    )


def test_a_line_has_no_back() -> None:
    for begin, end in (((1, 2), (9, 6)), ((9, 6), (1, 2)), ((3, 8), (4, 1))):
        for rule in RULES:
            faces = faces_of(clip_positions([begin, end], EXACT), LINE, by(rule))
            assert faces.front.all()


def test_all_of_a_line_is_drawn_by_a_pipeline_that_culls() -> None:
    rules = by("rectangle")
    for cull in get_args(Cull):
        faces = faces_of(
            clip_positions([(1, 2), (9, 6)], rules), LINE, rules, state=RenderState(cull=cull)
        )
        assert len(coverage_of(faces, rules).fragments.sample) > 5


def test_snapped_ends_and_snapped_corners_differ_by_less_than_a_step() -> None:
    """Drivers snap one or the other; both are compared with what is covered without snapping."""
    chance = np.random.default_rng(5)
    ends: Floats = chance.uniform(1, SIZE - 1, (40, 2, 2))
    for begin, end in ends:
        exactly, _ = pixels(begin, end, by("rectangle", subpixel_bits=None))
        for snaps in (False, True):
            found, _ = pixels(begin, end, by("rectangle", snaps_line_ends=snaps))
            assert (found != exactly).sum() <= 1


@settings(max_examples=100)
@given(points, points)
def test_what_is_decided_whatever_is_snapped_is_drawn_so_by_both(
    begin: tuple[float, float], end: tuple[float, float]
) -> None:
    for rule in ("rectangle", "parallelogram"):
        found, undecided = pixels(begin, end, by(rule, snaps_line_ends=None))
        for snaps in (False, True):
            drawn, unsure = pixels(begin, end, by(rule, snaps_line_ends=snaps))
            assert ((drawn == found) | undecided | unsure).all()


def test_most_is_decided_if_only_the_rule_is_known() -> None:
    found, undecided = pixels((1.2, 2.6), (10.8, 2.4), by("rectangle", snaps_line_ends=None))
    assert (found & ~undecided).sum() == 10
    assert not undecided.any()
