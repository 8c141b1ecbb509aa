"""Arrays, volumes, cubes, depths and integers as the reference reads them, worked out by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from burnish.compiler.reference.bounds import Bounded, exact
from burnish.compiler.reference.picture.cube import across_edges, met
from burnish.compiler.reference.picture.scene import RasterRules

from .reads import DEVICE, Read, near, numbered, steps

ROUGH = RasterRules(1, 1, subtexel_bits=4, mip_bits=4)
"""A device with few bits."""

# --- layers and volumes --------------------------------------------------------------------------


@pytest.mark.parametrize(("layer", "first"), [(0, 0), (2, 8), (7, 8), (-3, 0)])
def test_layers_are_limited_to_those_there_are(layer: int, first: int) -> None:
    array = Read("2d_array", "float", numbered(3, 2, 2))
    assert array("sample_level", (0.25, 0.25), layer, 0.0)[0] == first
    assert array("load", (0, 0), layer, 0)[0] == first


def test_slices_are_mixed() -> None:
    volume = Read("3d", "float", numbered(2, 1, 2), filter="linear")
    assert volume("sample_level", (0.5, 0.5, 0.5), 0.0)[0] == 1.5
    assert volume("sample_level", (0.25, 0.5, 0.75), 0.0)[0] == 2
    assert volume("sample_level", (0.25, 0.5, 0.375), 0.0)[0] == 0.5


def test_a_filter_is_off_along_all_three_axes() -> None:
    volume = Read("3d", "float", numbered(2, 2, 2), filter="linear", rules=ROUGH)
    low, high = volume.hull("sample_level", (0.5, 0.5, 0.5), 0.0)
    assert (low, high) == pytest.approx((3.5 - 7 / 16, 3.5 + 7 / 16), abs=1e-5)


# --- cubes ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("direction", "face", "across", "down"),
    [
        ((1, -0.5, 0.25), 0, -0.25, 0.5),
        ((-2, 1, -1), 1, -0.5, -0.5),
        ((0.5, 1, 0.25), 2, 0.5, 0.25),
        ((0.5, -1, 0.25), 3, 0.5, -0.25),
        ((-0.5, 0.25, 1), 4, -0.5, -0.25),
        ((-1, 0.5, -2), 5, 0.5, -0.25),
    ],
)
def test_faces(direction: tuple[float, ...], face: int, across: float, down: float) -> None:
    assert _met(direction) == (face, across, down)


def _met(direction: tuple[float, ...]) -> tuple[int, float, float]:
    """The face that a direction meets, and where: right and down from its middle, -1 to 1."""
    (_, found), *others = met([exact(np.array([float(lane)])) for lane in direction], True)
    assert not others
    across, down = (2 * float(lane.value[0]) - 1 for lane in (found.across, found.down))
    return int(found.face[0]), across, down


def direction_of(face: int, across: float, down: float) -> tuple[float, ...]:
    x, y = across, down
    return [(1, -y, -x), (-1, -y, x), (x, 1, y), (x, -1, -y), (x, -y, 1), (-x, -y, -1)][face]


@given(st.integers(0, 5), st.floats(-0.99, 0.99), st.floats(-0.99, 0.99))
def test_every_place_of_every_face_is_met(face: int, across: float, down: float) -> None:
    other, *place = _met(direction_of(face, across, down))
    assert other == face
    assert place == pytest.approx((across, down))


@given(st.integers(0, 5), st.integers(1, 9), st.integers(0, 8), st.integers(0, 3))
def test_texels_beyond_an_edge_are_neighbours_whose_neighbours_they_are(
    face: int, size: int, along: int, side: int
) -> None:
    """Over an edge and back again is where one came from."""
    along %= size
    out = [(-1, along), (size, along), (along, -1), (along, size)][side]
    inside = [(0, along), (size - 1, along), (along, 0), (along, size - 1)][side]
    place, other = _across(out, face, size)
    assert other != face
    assert all(0 <= i < size for i in place)
    steps = [(-1, 0), (1, 0), (0, -1), (0, 1)]
    around = [
        _across((place[0] + dx, place[1] + dy), other, size)
        for dx, dy in steps
        if not (0 <= place[0] + dx < size and 0 <= place[1] + dy < size)
    ]
    assert (inside, face) in around


def _across(place: tuple[int, int], face: int, size: int) -> tuple[tuple[int, int], int]:
    numbers = [np.array(i) for i in place]
    found, other = across_edges(numbers, np.array(face), np.array(size))
    return (int(found[0]), int(found[1])), int(other)


@given(st.floats(-0.9, 0.9), st.integers(0, 5), st.integers(0, 1))
def test_a_filtered_cube_has_no_seams(along: float, face: int, side: int) -> None:
    """Just before and just behind an edge it is nearly the same."""
    sky = Read("cube", "float", numbered(6, 4, 4), filter="linear")
    edge = (1.0, along) if side else (along, 1.0)
    values = [
        sky("sample_level", direction_of(face, *(lane * k for lane in edge)), 0.0)[0]
        for k in (1 - 1e-9, 1 + 1e-9)
    ]
    assert values[0] == pytest.approx(values[1], abs=1e-5)


@pytest.mark.parametrize(("layer", "cube"), [(0, 0), (1, 1), (7, 1), (-3, 0)])
def test_each_layer_of_an_array_of_cubes_is_a_cube(layer: int, cube: int) -> None:
    """Also where a filter goes on across the edges of its faces."""
    texels = numbered(12, 4, 4)
    array = Read("cube_array", "float", texels, filter="linear")
    alone = Read("cube", "float", texels[6 * cube : 6 * cube + 6], filter="linear")
    for direction in ((1, -0.5, 0.25), (-1, 1, 1), (0.5, -1, 0.99), (0.1, 0.99, -1)):
        assert array("sample_level", direction, layer, 0.0) == alone("sample_level", direction, 0.0)
        assert array("gather", direction, layer, 1) == alone("gather", direction, 1)
    assert array("texture_layers") == [2]
    assert array("texture_size", 0) == [4, 4]


def test_a_layer_that_is_not_certain_may_be_any_of_its_cubes() -> None:
    array = Read("cube_array", "float", numbered(18, 1, 1))
    layer = Bounded(np.int64(1), np.int64(0), np.int64(2))
    assert array.hull("sample_level", (1.0, 0.0, 0.0), (layer,), 0.0) == (0, 12)


def test_beyond_a_corner_is_the_mean_of_the_three_texels_around_it() -> None:
    faces = np.zeros((6, 1, 1, 4))
    faces[0], faces[2], faces[4] = 3, 6, 30
    sky = Read("cube", "float", faces, filter="linear")
    assert sky("sample_level", (1, 1, 1), 0.0)[0] == pytest.approx((3 + 6 + 30 + 13) / 4)
    sky = Read("cube", "float", faces, filter="linear", rules=DEVICE)
    low, high = sky.hull("sample_level", (1, 1, 1), 0.0)
    assert low == pytest.approx((39 + 3) / 4, abs=0.2)
    assert high == pytest.approx((39 + 30) / 4, abs=0.2)


def test_a_device_may_be_known_to_read_means_at_corners() -> None:
    faces = np.zeros((6, 1, 1, 4))
    faces[0], faces[2], faces[4] = 3, 6, 30
    # Exactly so many bits that a step does not matter.
    rules = RasterRules(1, 1, subtexel_bits=20, corner_bits=20)
    sky = Read("cube", "float", faces, filter="linear", rules=rules)
    assert sky.hull("sample_level", (1, 1, 1), 0.0) == pytest.approx((13, 13), abs=1e-3)


def test_between_two_faces_there_may_be_a_texel_of_either() -> None:
    sky = Read("cube", "float", numbered(6, 1, 1), rules=DEVICE)
    assert sky.hull("sample_level", (1, 0.3, 0.9), 0.0) == (0, 0)
    assert sky.hull("sample_level", (1, 0.3, 1 + 1e-7), 0.0) == (0, 4)
    assert sky.hull("sample_level", (near(1, 0.2), 0.3, 0.9), 0.0) == (0, 4)
    assert sky.hull("sample_level", (near(0, 0.01), 0.0, near(0, 0.01)), 0.0) == (0, 5)


# --- levels --------------------------------------------------------------------------------------


@pytest.mark.parametrize(("level", "expected"), [(-1, 0), (0.25, 0.25), (1.5, 1.5), (9, 3)])
def test_a_level_by_its_number(level: float, expected: float) -> None:
    flat = Read("2d", "float", *steps(), mip="linear")
    assert flat("sample_level", (0.5, 0.5), level)[0] == expected


def test_a_sampler_without_levels_stays_on_the_first() -> None:
    flat = Read("2d", "float", *steps(), mip="none")
    assert flat("sample_level", (0.5, 0.5), 2.0)[0] == 0
    assert flat("load", (0, 0), 2)[0] == 2


@pytest.mark.parametrize(
    ("across", "down", "level"),
    [
        ((0.25, 0), (0, 0.125), 1),
        ((0, 0.125), (0.5, 0), 2),
        ((0.3, 0.4), (0, 0), 2),
        ((0, 0), (0, 0), 0),
    ],
)
def test_a_level_by_gradients(across: Any, down: Any, level: float) -> None:
    flat = Read("2d", "float", *steps(), mip="linear")
    assert flat("sample_grad", (0.5, 0.5), across, down)[0] == pytest.approx(level)


def test_gradients_of_a_cube_are_projected() -> None:
    """Half a face is four texels of eight; and along the direction itself nothing changes."""
    sky = Read("cube", "float", *steps((6,)), mip="linear")
    assert sky("sample_grad", (0, 0, 2), (2, 0, 0), (0, 0.1, 0))[0] == pytest.approx(2)
    assert sky("sample_grad", (0, 0.5, 2), (0, 1, 4), (0, 0, 0))[0] == 0


def test_a_level_that_is_read_off_bits() -> None:
    """The logarithm of 2.25, the square, is taken for 1 + 0.125."""
    flat = Read("2d", "float", *steps(), mip="linear", rules=RasterRules(1, 1, level_power=2))
    assert flat("sample_grad", (0.5, 0.5), (1.5 / 8, 0), (0, 0))[0] == pytest.approx(1.125 / 2)
    assert flat("sample_grad", (0.5, 0.5), (4 / 8, 0), (0, 0))[0] == pytest.approx(2)


def test_means_of_levels_have_so_many_bits() -> None:
    rules = RasterRules(1, 1, subtexel_bits=8, mixing_bits=4)
    found = [
        Read("2d", "float", *steps(), mip="linear", rules=rules, filter=filter_).hull(
            "sample_level", (0.5, 0.5), 0.5
        )
        for filter_ in ("nearest", "linear")
    ]
    expected = [(0.4375, 0.5625), (0.5, 0.5)]
    assert [pytest.approx(each, abs=1e-5) for each in expected] == found
    # A device may weigh a single level, too, and even the only texel that there is.
    for levels in (steps(), [np.ones((1, 1, 4))]):
        single = Read("2d", "float", *levels, mip="linear", rules=rules)
        low, high = single.hull("sample_level", (0.5, 0.5), 0.0)
        assert high - low == pytest.approx(2 / 16, abs=1e-5)


def test_gradients_of_a_cube_on_a_device_that_does_not_project_them() -> None:
    """The two axes along which it changes most are added up, be they the direction's own."""
    sky = Read("cube", "float", *steps((6,)), mip="linear", rules=RasterRules(
        1, 1, projects_cubes=False
    ))  # fmt: skip
    assert sky("sample_grad", (0, 0.5, 2), (0.1, 0.5, 1.5), (0, 0, 0))[0] == pytest.approx(2)


# --- comparisons ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("compare", "outcomes"),
    [("less", [1, 0, 0]), ("less_equal", [1, 1, 0]), ("greater", [0, 0, 1]),
     ("greater_equal", [0, 1, 1])],
)  # fmt: skip
def test_the_reference_stands_on_the_left(compare: str, outcomes: list[int]) -> None:
    depths = Read("2d", "depth", np.full((1, 1, 1), 0.5), compare=compare, mip="none")
    assert [depths("compare", (0.5, 0.5), r)[0] for r in (0.25, 0.5, 0.75)] == outcomes


def test_references_are_limited_to_what_depths_can_be() -> None:
    depths = Read("2d", "depth", np.full((1, 1, 1), 1.0), compare="less_equal", mip="none")
    assert depths("compare", (0.5, 0.5), 1.5) == [1]


def test_comparisons_are_filtered_and_not_depths() -> None:
    whole = np.array([[0.1, 0.9], [0.4, 0.45]])[..., None]
    depths = Read("2d", "depth", whole, compare="less", filter="linear", mip="none")
    assert depths("compare", (0.5, 0.5), 0.5) == [0.25]
    assert depths("compare", (0.625, 0.25), 0.5) == [0.75]
    assert depths("gather_compare", (0.5, 0.5), 0.42) == [0, 1, 1, 0]


def test_a_reference_that_may_be_on_either_side_of_a_depth() -> None:
    depths = Read("2d", "depth", np.full((1, 1, 1), 0.5), compare="less", mip="none", rules=DEVICE)
    assert depths.hull("compare", (0.5, 0.5), near(0.5001, 1e-5)) == (0, 0)
    assert depths.hull("compare", (0.5, 0.5), near(0.5001, 1e-3)) == (0, 1)
    assert depths.hull("compare", (0.5, 0.5), near(0.4, 1e-3)) == (1, 1)


# --- texels --------------------------------------------------------------------------------------


def test_gathered_texels_go_round_from_the_lower_left() -> None:
    flat = Read("2d", "float", numbered(3, 3), wrap="repeat")
    assert flat("gather", (0.45, 0.45), 0) == [3, 4, 1, 0]
    assert flat("gather", (0.1, 0.45), 2) == [2005, 2003, 2000, 2002]


def test_between_four_and_four_either_may_be_gathered() -> None:
    flat = Read("2d", "float", numbered(4, 4), rules=DEVICE)
    assert flat.hull("gather", (0.6, 0.6), 0) == (9, 9)
    assert flat.hull("gather", (0.625 + 1e-6, 0.6), 0) == (9, 10)


@pytest.mark.parametrize(
    ("place", "level", "expected"),
    [((1, 1), 0, 5), ((-4, 9), 0, 12), ((9, -1), 0, 3), ((1, 1), 1, 103), ((1, 1), 7, 103)],
)
def test_loads_beyond_the_texture_take_the_nearest_texel(
    place: Any, level: int, expected: int
) -> None:
    levels = [np.arange(16).reshape(4, 4, 1) + [0] * 4, np.arange(4).reshape(2, 2, 1) + [100] * 4]
    numbers = Read("2d", "int", *levels)
    assert numbers("load", place, level)[0] == expected
    assert isinstance(numbers("load", place, level)[0], int)


def test_a_load_by_an_uncertain_index() -> None:
    numbers = Read("2d", "int", np.arange(16).reshape(4, 4, 1) + [0] * 4)
    index = Bounded(np.int64(1), np.int64(0), np.int64(2))
    assert numbers.hull("load", (index, np.int64(1)), 0) == (4, 6)
    anywhere = Bounded(np.int64(1), np.int64(-(2**31)), np.int64(2**31))
    assert numbers.hull("load", (anywhere, anywhere), 0) == (0, 15)


def test_sizes() -> None:
    volume = Read("3d", "uint", np.zeros((8, 2, 4, 4), int), np.zeros((4, 1, 2, 4), int))
    assert volume("texture_size", 0) == [4, 2, 8]
    assert volume("texture_size", 1) == volume("texture_size", 5) == [2, 1, 4]
    assert volume("texture_levels") == [2]
    assert Read("2d_array", "depth", np.zeros((5, 1, 1, 1)))("texture_layers") == [5]
