"""Textures of an instance: what is stored of arrays and colours, and the levels below."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import burnish
from burnish import PictureError, Texture
from burnish.compiler.ir import types
from burnish.compiler.semantics.declarations.textures import kind_of
from burnish.compiler.srgb import linear
from burnish.targets.runner.drivers.checks import level_size
from burnish.targets.runner.textures.texture import default_texture

from .texture_kit import first, texel

SOURCE = """
material M {
    map a : texture2d
    map b : texture2d = flat_normal
    color = a(uv).rgb + b(uv).rgb
}
"""


# --- textures of an instance ---------------------------------------------------------------------


def test_defaults_are_made_and_given_ones_are_kept() -> None:
    instance = burnish.compile(SOURCE, ("wgsl",))["M"].instance()
    assert {name: texel(t) for name, t in instance.textures().items()} == {
        "a": (255, 255, 255, 255),
        "b": (128, 128, 255, 255),
    }
    instance.a = Texture.solid("#102030")
    assert texel(instance.textures()["a"]) == (16, 32, 48, 255)
    assert instance.a is instance.textures()["a"]


@pytest.mark.parametrize("type_", types.TEXTURES, ids=str)
def test_every_default_of_the_language_is_a_texture(type_: types.TextureType) -> None:
    for name in kind_of(type_).defaults:
        texture = default_texture(name, type_.dimension, type_.sample)
        assert (texture.dimension, texture.sample) == (type_.dimension, type_.sample)
        assert (texture.width, texture.height, len(texture.levels)) == (1, 1, 1)
        assert texture.depth == (6 if type_.is_cube else 1)


def test_what_defaults_hold() -> None:
    assert texel(default_texture("gray")) == (128, 128, 128, 255)
    assert texel(default_texture("black")) == (0, 0, 0, 255)
    assert texel(default_texture("transparent")) == (0, 0, 0, 0)
    assert texel(default_texture("gray", "cube")) == (128, 128, 128, 255) * 6
    assert default_texture("far", sample="depth").linear()[0].tolist() == [[[1.0]]]
    assert default_texture("near", "cube", "depth").linear()[0].ravel().tolist() == [0.0] * 6
    assert default_texture("zero", "3d", "int").linear()[0].ravel().tolist() == [0] * 4


def test_an_instance_takes_what_its_map_declares() -> None:
    source = "material M { map sky : texture_cube\n map m : utexture2d\n"
    source += " color = sky(normal).rgb * float(m.load(ivec2(0), 0).x) }"
    instance = burnish.compile(source, ("wgsl",))["M"].instance()
    instance.sky = Texture.of_array(np.zeros((6, 2, 2), np.uint8), dimension="cube")
    for name, value, message in [
        ("sky", Texture.solid("#102030"), "`sky` takes a cube of colours, and was given a flat "
         "texture of colours"),
        ("m", Texture.of_array([[1]], sample="int"), "`m` takes a flat texture of unsigned "
         "integers, and was given a flat texture of integers"),
        ("sky", 3, "`sky` takes a Texture, and was given a value of type int"),
    ]:  # fmt: skip
        with pytest.raises(burnish.ParameterError) as caught:
            instance.set(name, value)
        assert str(caught.value) == message


# --- colours -------------------------------------------------------------------------------------


def test_a_literal_is_srgb_and_numbers_are_linear() -> None:
    literal = Texture.solid("#b5651d80")
    assert (literal.format, texel(literal)) == ("rgba8unorm-srgb", (0xB5, 0x65, 0x1D, 0x80))
    (level,) = literal.linear()
    expected = [*map(linear, (0xB5, 0x65, 0x1D)), 0x80 / 255]
    assert level[0, 0].tolist() == pytest.approx(expected, rel=1e-15)
    numbers = Texture.solid((0.25, 0.5, 1))
    assert (numbers.format, texel(numbers)) == ("rgba8unorm", (64, 128, 255, 255))


@pytest.mark.parametrize("color", ["#12", "red", (1, 2), (0, 0, 1.5), (0, 0, float("nan"))])
def test_what_is_no_colour(color: Any) -> None:
    with pytest.raises(PictureError, match="colour"):
        Texture.solid(color)


# --- levels --------------------------------------------------------------------------------------


def test_levels_halve_rounding_down() -> None:
    texture = Texture.of_array(np.zeros((5, 12, 3), np.uint8))
    sizes = [level.shape[:2] for level in texture.linear()]
    assert sizes == [(5, 12), (2, 6), (1, 3), (1, 1)]
    image = texture.image()
    assert [level_size(image, n)[1::-1] for n in range(len(image.levels))] == sizes
    assert [len(level) for level in image.levels] == [4 * h * w for h, w in sizes]
    assert (image.width, image.height, image.format) == (12, 5, "rgba8unorm")


def test_a_level_is_the_mean_of_what_it_covers() -> None:
    texture = Texture.of_array(np.array([[0, 100], [50, 10]], np.uint8))
    assert tuple(texture.levels[1]) == (40, 40, 40, 255)


def test_of_three_the_middle_counts_no_less() -> None:
    texture = Texture.of_array(np.array([[0.0, 3.0, 9.0]]))
    assert texture.linear()[1][0, 0].tolist() == [4.0, 4.0, 4.0, 1.0]
    five = Texture.of_array(np.array([[1.0, 0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0, 0.0]]))
    assert five.linear()[1][0, :, 0].tolist() == pytest.approx([0.5 * 0.6, 0.5 * 0.2], rel=1e-7)


def test_colours_are_averaged_as_light_and_alpha_as_it_is() -> None:
    array = np.array([[[0, 0, 0, 0], [255, 255, 255, 255]]], np.uint8)
    assert tuple(Texture.of_array(array).levels[1]) == (128, 128, 128, 128)
    assert tuple(Texture.of_array(array, srgb=True).levels[1]) == (188, 188, 188, 128)


def mean_over(lanes: np.ndarray[Any, Any], axis: int) -> np.ndarray[Any, Any]:
    """Half the length by areas, on a grid fine enough for every border."""
    size = lanes.shape[axis]
    half = max(size // 2, 1)
    fine = np.repeat(lanes, half, axis)
    parts = np.split(fine, half, axis)
    return np.concatenate([part.mean(axis, keepdims=True) for part in parts], axis)


@settings(max_examples=30)
@given(st.integers(1, 40), st.integers(1, 40), st.integers(0, 2**32 - 1))
def test_all_levels_are_means_by_area(height: int, width: int, seed: int) -> None:
    array = np.random.default_rng(seed).random((height, width, 4), np.float32)
    expected = array.astype(np.float64)
    for level in Texture.of_array(array).linear():
        assert level == pytest.approx(expected, abs=1e-6)
        expected = mean_over(mean_over(expected, 0), 1)
    assert expected.shape[:2] == (1, 1)


def test_bands_leave_no_seam() -> None:
    array = np.random.default_rng(1).integers(0, 256, (1027, 3, 4)).astype(np.uint8)
    lanes = Texture.of_array(array).linear()
    expected = mean_over(mean_over(lanes[0], 1), 0)
    assert np.abs(lanes[1] - expected).max() <= 0.5 / 255 + 1e-12


def test_all_bytes_decode_to_themselves() -> None:
    array = np.arange(256, dtype=np.uint8).reshape(16, 16)
    for srgb in (False, True):
        texture = Texture.of_array(array, srgb=srgb)
        assert (first(texture)[..., 0] == array).all()
        expected = [linear(c) if srgb else c / 255 for c in range(256)]
        assert texture.linear()[0][..., 1].ravel().tolist() == pytest.approx(expected, rel=1e-15)
        constant = Texture.of_array(np.repeat(np.repeat(array, 2, 0), 2, 1), srgb=srgb)
        assert constant.levels[1] == texture.levels[0]


def test_layers_are_halved_on_their_own_and_volumes_in_all_directions() -> None:
    array = np.zeros((4, 2, 4), np.float32)
    array[0], array[1] = 8, 16
    layers = Texture.of_array(array, dimension="2d_array")
    assert [level.shape for level in layers.linear()] == [(4, 2, 4, 4), (4, 1, 2, 4), (4, 1, 1, 4)]
    assert layers.linear()[2][:, 0, 0, 0].tolist() == [8, 16, 0, 0]
    volume = Texture.of_array(array, dimension="3d")
    assert [level.shape for level in volume.linear()] == [(4, 2, 4, 4), (2, 1, 2, 4), (1, 1, 1, 4)]
    assert [level[0, 0, 0, 0] for level in volume.linear()] == [8, 12, 6]
    image = volume.image()
    sizes = [level_size(image, n) for n in range(3)]
    assert [len(data) for data in image.levels] == [16 * w * h * d for w, h, d in sizes]


def test_depths_and_integers_have_one_level_unless_more_are_given() -> None:
    depths = Texture.of_array(np.full((4, 4), 0.5), sample="depth")
    assert (depths.format, len(depths.levels)) == ("depth32float", 1)
    steps = [np.full((4 >> n, 4 >> n), n) for n in range(3)]
    numbers = Texture.of_array(steps[0], sample="int", levels=steps[1:])
    assert [level[0, 0].tolist() for level in numbers.linear()] == [[n, 0, 0, 1] for n in range(3)]
    given = Texture.of_array(np.zeros((2, 2)), levels=[np.ones((1, 1))])
    assert given.linear()[1][0, 0].tolist() == [1, 1, 1, 1]


# --- arrays --------------------------------------------------------------------------------------


def test_sixteen_bits_are_rounded_to_eight() -> None:
    array = np.array([[0, 128, 129, 65535]], np.uint16)
    assert first(Texture.of_array(array))[0, :, 0].tolist() == [0, 0, 1, 255]


@pytest.mark.parametrize(
    ("array", "message"),
    [
        (np.zeros((2, 2, 2), np.uint8), "a texture has the shape (height, width) or (height, "
         "width, 1, 3 or 4), not (2, 2, 2)"),
        (np.zeros(4, np.uint8), "a texture has the shape (height, width) or (height, width, 1, 3 "
         "or 4), not (4,)"),
        (np.zeros((0, 2, 3), np.uint8), "a texture has the shape (height, width) or (height, "
         "width, 1, 3 or 4), not (0, 2, 3)"),
        (np.zeros((2, 2), np.int32), "texels are uint8, uint16 or floats, not int32"),
        (np.full((2, 2), np.nan), "texels are finite float32 numbers, and some of these are not"),
        (np.full((2, 2), 1e39), "texels are finite float32 numbers, and some of these are not"),
        (np.zeros((1, 8193), np.uint8), "the array has 8193 x 1 texels, and no side may have more "
         "than 8192"),
    ],
    ids=lambda value: str(value)[:20].replace("\n", " "),
)  # fmt: skip
def test_arrays_that_are_no_texture(array: Any, message: str) -> None:
    with pytest.raises(PictureError) as caught:
        Texture.of_array(array)
    assert str(caught.value) == message


def test_floats_are_not_srgb() -> None:
    with pytest.raises(PictureError, match="floats are linear: only those of 8 bits can be sRGB"):
        Texture.of_array(np.zeros((2, 2)), srgb=True)


@pytest.mark.parametrize(
    ("dtype", "lanes", "sample", "form"),
    [
        ("u1", 1, "uint", "r8uint"), ("u1", 4, "uint", "rgba8uint"), ("u1", 3, "uint", "rgba8uint"),
        ("u2", 1, "uint", "r32uint"), ("i8", 4, "uint", "rgba32uint"), ("i4", 1, "int", "r32sint"),
        ("u1", 4, "int", "rgba32sint"),
    ],
)  # fmt: skip
def test_integers_stay_what_they_are(dtype: str, lanes: int, sample: Any, form: str) -> None:
    array = np.arange(6 * lanes).reshape(2, 3, lanes).astype(dtype)
    texture = Texture.of_array(array, sample=sample)
    assert texture.format == form
    assert (texture.linear()[0][..., :lanes] == array).all()


@pytest.mark.parametrize(
    ("array", "about", "message"),
    [
        (np.zeros((6, 2, 3), np.uint8), {"dimension": "cube"},
         "a cube has six square faces, and not 3 x 2 x 6 texels"),
        (np.zeros((5, 2, 2), np.uint8), {"dimension": "cube"},
         "a cube has six square faces, and not 2 x 2 x 5 texels"),
        (np.zeros((7, 2, 2), np.uint8), {"dimension": "cube_array"},
         "each cube has six square faces, and these are 2 x 2 x 7 texels"),
        (np.zeros((258, 1, 1), np.uint8), {"dimension": "cube_array"},
         "the array has 258 faces, and may have 256"),
        (np.zeros((2, 2), np.uint8), {"dimension": "3d"},
         "a texture has the shape (layers, height, width) or (layers, height, width, 1, 3 or 4), "
         "not (2, 2)"),
        (np.zeros((257, 1, 1), np.uint8), {"dimension": "2d_array"},
         "the array has 257 layers, and may have 256"),
        (np.zeros((2049, 1, 1), np.uint8), {"dimension": "3d"},
         "the volume has 1 x 1 x 2049 texels, and no side may have more than 2048"),
        (np.array([[1.5]]), {"sample": "depth"}, "depths lie in 0..1, and some of these do not"),
        (np.array([[1]]), {"sample": "depth"}, "depths are floats, uint8 or uint16, not int64"),
        (np.array([[1.0]]), {"sample": "int"}, "the texture holds integers, not float64"),
        (np.array([[-1]]), {"sample": "uint"}, "a texel of integers lies in 0..4294967295"),
        (np.array([[1]]), {"sample": "int", "srgb": True}, "only colours can be sRGB"),
        (np.zeros((4, 4)), {"levels": [np.zeros((1, 2))]},
         "level 1 has 2 x 1 x 1 of float32, and half of the one before is 2 x 2 x 1 of float32"),
    ],
    ids=lambda value: str(value)[:30].replace("\n", " "),
)  # fmt: skip
def test_arrays_that_are_no_texture_of_a_kind(
    array: Any, about: dict[str, Any], message: str
) -> None:
    with pytest.raises(PictureError) as caught:
        Texture.of_array(array, **about)
    assert str(caught.value) == message
