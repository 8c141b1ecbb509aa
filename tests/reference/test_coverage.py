"""The pixels that triangles cover: the top-left rule, snapping, clipping, culling."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from burnish.compiler.ir.render_state import Cull, RenderState
from burnish.compiler.reference.picture import RasterRules
from burnish.compiler.reference.picture.assembly import faces_of
from burnish.compiler.reference.picture.coverage import Fragments, coverage_of
from burnish.compiler.reference.picture.scene import Bools, Floats


def clip_positions(window: Any, rules: RasterRules, z: float = 0.5) -> Floats:
    """Clip positions with w = 1 of places in the window, in pixels."""
    places = np.asarray(window, dtype=np.float64)
    x = places[:, 0] / rules.width * 2 - 1
    y = 1 - places[:, 1] / rules.height * 2
    return np.stack([x, y, np.full_like(x, z), np.ones_like(x)], axis=1)


def drawn(window: Any, triangles: Any, rules: RasterRules) -> tuple[Fragments, Bools]:
    """The fragments of triangles between places in the window, and the undecided pixels."""
    return covered(clip_positions(window, rules), triangles, rules)


def covered(
    positions: Floats, triangles: Any, rules: RasterRules, cull: Cull = "none"
) -> tuple[Fragments, Bools]:
    """The fragments of triangles between clip positions, and the undecided pixels."""
    with np.errstate(all="ignore"):
        faces = faces_of(positions, np.asarray(triangles), rules, state=RenderState(cull=cull))
        found = coverage_of(faces, rules)
    unsure = np.zeros(rules.width * rules.height, dtype=np.bool_)
    unsure[found.doubtful.sample] = True
    return found.fragments, unsure


def counts(window: Any, triangles: Any, rules: RasterRules) -> Any:
    """The number of times that each pixel is covered, as rows."""
    fragments, _ = drawn(window, triangles, rules)
    found = np.bincount(fragments.sample, minlength=rules.width * rules.height)
    return found.reshape(rules.height, rules.width).tolist()


FOUR = RasterRules(4, 4, subpixel_bits=8)


def test_a_triangle_through_pixel_centres_owns_its_top_and_left_edges() -> None:
    # The upper edge runs through the centres of row 0, the left one through those of column 0;
    # the diagonal, a right edge, through (2.5, 0.5), (1.5, 1.5) and (0.5, 2.5).
    corners = [(0.5, 0.5), (2.5, 0.5), (0.5, 2.5)]
    expected = [[1, 1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]
    assert counts(corners, [(0, 1, 2)], FOUR) == expected
    assert counts(corners, [(0, 2, 1)], FOUR) == expected


def test_a_triangle_does_not_own_its_bottom_and_right_edges() -> None:
    corners = [(2.5, 0.5), (2.5, 2.5), (0.5, 2.5)]
    # The diagonal is a left edge here.
    expected = [[0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]
    assert counts(corners, [(0, 1, 2)], FOUR) == expected


WHOLE = np.array([(-1.0, 1.0, 0.5, 1.0), (3.0, 1.0, 0.5, 1.0), (-1.0, -3.0, 0.5, 1.0)])
"""A triangle over the whole clip volume, and far beyond it."""


def test_a_viewport_holds_the_clip_volume_and_nothing_is_drawn_outside() -> None:
    rules = RasterRules(6, 4, subpixel_bits=8, viewport=(2, 1, 4, 2), scissor=(-1, 0, 5, 9))
    fragments, unsure = covered(WHOLE, [(0, 1, 2)], rules)
    rows = np.bincount(fragments.sample, minlength=24).reshape(4, 6).tolist()
    assert rows == [[0] * 6, [0, 0, 1, 1, 0, 0], [0, 0, 1, 1, 0, 0], [0] * 6]
    assert not unsure.any()


@pytest.mark.parametrize("scissor", [(6, 0, 2, 2), (0, 0, 0, 4), (2, -4, 2, 4)])
def test_a_scissor_beside_everything_leaves_nothing(scissor: Any) -> None:
    rules = RasterRules(6, 4, subpixel_bits=8, scissor=scissor)
    fragments, _ = covered(WHOLE, [(0, 1, 2)], rules)
    assert not len(fragments.sample)


def test_a_viewport_scales_and_moves() -> None:
    """A square over a quarter of the clip volume: from the middle to the upper right."""
    places = [
        (0.0, 0.0, 0.5, 1.0),
        (1.0, 0.0, 0.5, 1.0),
        (1.0, 1.0, 0.5, 1.0),
        (0.0, 1.0, 0.5, 1.0),
    ]
    rules = RasterRules(8, 8, subpixel_bits=8, viewport=(1, 3, 4, 4))
    fragments, _ = covered(np.array(places), [(0, 1, 2), (0, 2, 3)], rules)
    columns, rows = fragments.sample % 8, fragments.sample // 8
    assert sorted(zip(rows.tolist(), columns.tolist(), strict=True)) == [
        (3, 3), (3, 4), (4, 3), (4, 4),
    ]  # fmt: skip


def test_a_square_of_two_triangles_is_covered_once() -> None:
    corners = [(0.5, 0.5), (3.5, 0.5), (3.5, 3.5), (0.5, 3.5)]
    expected = [[1, 1, 1, 0], [1, 1, 1, 0], [1, 1, 1, 0], [0, 0, 0, 0]]
    assert counts(corners, [(0, 1, 2), (0, 2, 3)], FOUR) == expected
    assert counts(corners, [(1, 2, 3), (3, 0, 1)], FOUR) == expected


COORDINATE = st.one_of(
    st.integers(-8, 40).map(lambda n: n / 4), st.floats(-3, 11, allow_nan=False, width=32)
)


POINT = st.tuples(COORDINATE, COORDINATE)


@settings(max_examples=200)
@given(st.lists(POINT, min_size=3, max_size=9), POINT, POINT, st.sampled_from([None, 4, 8]))
def test_inner_edges_are_not_seen(rim: Any, one: Any, other: Any, bits: int | None) -> None:
    """A closed line's winding number around a pixel does not depend on the centre of its fan."""
    rules = RasterRules(8, 8, subpixel_bits=bits)
    fan = [(i, (i + 1) % len(rim), len(rim)) for i in range(len(rim))]

    def winding(centre: Any) -> Any:
        with np.errstate(all="ignore"):
            faces = faces_of(clip_positions([*rim, centre], rules), np.asarray(fan), rules)
            fragments = coverage_of(faces, rules).fragments
        signs = np.where(faces.front[fragments.face], 1, -1)
        return np.bincount(fragments.sample, signs, 64).tolist()

    assert winding(one) == winding(other)


def test_snapping_moves_vertices() -> None:
    # Half a pixel centre's distance away, seen only without snapping to whole pixels.
    corners = [(0.4, 0.4), (0.6, 0.4), (0.4, 0.7)]
    fine, coarse = RasterRules(1, 1), RasterRules(1, 1, subpixel_bits=0)
    assert counts(corners, [(0, 1, 2)], fine) == [[1]]
    assert counts(corners, [(0, 1, 2)], coarse) == [[0]]
    large = [(0.6, -0.4), (3.4, -0.4), (0.6, 3.4)]
    assert counts(large, [(0, 1, 2)], fine) == [[0]]
    assert counts(large, [(0, 1, 2)], RasterRules(1, 1, subpixel_bits=1)) == [[1]]
    assert counts(large, [(0, 1, 2)], coarse) == [[0]]


def test_coverage_is_undecided_where_a_vertex_may_be_snapped_to_either_side() -> None:
    rules = RasterRules(8, 8, subpixel_bits=4)
    between = 0.5 + 0.5 / 16
    # The left edge is at 0.5 or one unit to the right of it, beside the centres of column 0.
    corners = [(between, -1.0), (20.0, -1.0), (between, 20.0)]
    _, unsure = drawn(corners, [(0, 1, 2)], rules)
    assert unsure.reshape(8, 8)[:, 0].all()
    assert not unsure.reshape(8, 8)[:, 1:].any()
    surely = [(0.5, -1.0), (20.0, -1.0), (0.5, 20.0)]
    assert not drawn(surely, [(0, 1, 2)], rules)[1].any()


def test_without_snapping_edges_through_centres_are_undecided() -> None:
    corners = [(2.5, -1.0), (20.0, -1.0), (2.5, 30.0)]
    _, unsure = drawn(corners, [(0, 1, 2)], RasterRules(8, 8))
    assert unsure.reshape(8, 8).sum(axis=0).tolist() == [0, 0, 8, 0, 0, 0, 0, 0]


@pytest.mark.parametrize(
    ("cull", "winding", "seen"),
    [
        ("none", (0, 1, 2), True),
        ("none", (0, 2, 1), True),
        ("back", (0, 1, 2), True),
        ("back", (0, 2, 1), False),
        ("front", (0, 1, 2), False),
        ("front", (0, 2, 1), True),
    ],
)
def test_counter_clockwise_is_the_front(cull: Cull, winding: Any, seen: bool) -> None:
    rules = RasterRules(4, 4)
    corners = np.array([[-1, -1, 0, 1], [3, -1, 0, 1], [-1, 3, 0, 1]], dtype=np.float64)
    fragments, _ = covered(corners, [winding], rules, cull)
    assert len(fragments.sample) == (16 if seen else 0)


@pytest.mark.parametrize("cull", ["back", "front"])
def test_a_sliver_that_snapping_may_turn_over_is_undecided(cull: Cull) -> None:
    """All three corners may be snapped to the left or to the right, by more than it is wide."""
    rules = RasterRules(8, 8, subpixel_bits=4)
    between = 0.5 + 0.5 / 16
    window = [(between, -1.0), (between, 20.0), (between + 1e-9, 8.0)]
    for turned in ([0, 1, 2], [0, 2, 1]):
        fragments, unsure = covered(clip_positions(window, rules), [turned], rules, cull)
        assert unsure.reshape(8, 8)[:, 0].any()
        assert unsure[fragments.sample].all()


@pytest.mark.parametrize("cull", ["back", "front"])
def test_a_face_that_is_surely_culled_leaves_no_pixel_undecided(cull: Cull) -> None:
    corners = [(0.3, 0.3), (7.3, 0.7), (0.6, 7.1)]
    winding = [0, 1, 2] if cull == "back" else [0, 2, 1]
    rules = RasterRules(8, 8, subpixel_bits=4)
    fragments, unsure = covered(clip_positions(corners, rules), [winding], rules, cull)
    assert not len(fragments.sample) and not unsure.any()


def test_a_floor_behind_the_eye_ends_at_the_horizon() -> None:
    """A plane below the eye covers exactly the rows whose rays meet it beyond the near plane."""
    near, far, size = 0.5, 100.0, 16
    rules = RasterRules(size, size)
    # The eye is at the origin and looks along -z; the floor y = -1 reaches far behind it.
    world = np.array([[-900, -1, 900], [900, -1, 900], [0, -1, -900]], dtype=np.float64)
    z = -world[:, 2]
    positions = np.stack([world[:, 0], world[:, 1], (z - near) * far / (far - near), z], axis=1)
    fragments, _ = covered(positions, [[0, 1, 2]], rules)
    rows = np.unique(fragments.sample // size)
    # The ray of a row has the slope y = 1 - 2 (row + .5) / size, and meets the floor at -1 / y.
    slope = 1 - 2 * (np.arange(size) + 0.5) / size
    distance = np.where(slope < 0, -1 / slope, np.inf)
    assert rows.tolist() == np.flatnonzero((distance >= near) & (distance <= far)).tolist()


def test_what_is_not_finite_or_flat_covers_nothing() -> None:
    rules = RasterRules(4, 4, subpixel_bits=8)
    good = [[-1, -1, 0, 1], [3, -1, 0, 1], [-1, 3, 0, 1]]
    bad = [[np.nan, 0, 0, 1], [np.inf, 0, 0, 1], [0, 0, 0, np.nan], [0, 0, 0, 0]]
    positions = np.array([*good, *bad], dtype=np.float64)
    triangles = np.array([[0, 1, 3], [0, 4, 2], [5, 1, 2], [0, 0, 1], [6, 6, 6]])
    fragments, unsure = covered(positions, triangles, rules)
    assert len(fragments.sample) == 0
    assert not unsure.any()
