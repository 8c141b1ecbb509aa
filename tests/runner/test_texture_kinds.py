"""Reads of arrays, volumes, cubes, integers and depths by every driver: known by hand."""

from __future__ import annotations

import re

import numpy as np
import pytest

from burnish.compiler.ir.render_state import Compare
from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.slots import Sampling
from burnish.targets.runner.drivers.texels import TextureFormat

from .kinds_kit import DRIVERS, faces, picture_of, read, read_all, slot_for

pytestmark = pytest.mark.parametrize("driver", DRIVERS)

LAYERS = np.arange(3 * 2 * 2 * 4, dtype=float).reshape(3, 2, 2, 4)


def test_layers_of_an_array(driver: str) -> None:
    image = picture_of("2d_array", "rgba32float", LAYERS)
    shown = read(
        driver, slot_for(image), image,
        "texture(image, vec3(at, 2.0))", "textureSample(image, reader, at, 2)",
    )  # fmt: skip
    assert (shown[::4, ::4] == LAYERS[2]).all()


def test_levels_of_an_array(driver: str) -> None:
    levels = [np.full((2, 4 >> n, 2 >> n, 4), 10.0 * n) for n in range(2)]
    for level in levels:
        level[1] += 1
    image = picture_of("2d_array", "rgba32float", *levels)
    shown = read(
        driver, slot_for(image), image,
        "textureLod(image, vec3(at, 1.0), 1.0)", "textureSampleLevel(image, reader, at, 1, 1.0)",
    )  # fmt: skip
    assert (shown == 11).all()


def test_slices_of_a_volume(driver: str) -> None:
    """The third coordinate goes from slice to slice, filtered like the others."""
    image = picture_of("3d", "rgba32float", LAYERS[:2])
    shown = read(
        driver, slot_for(image, filter="linear"), image,
        "texture(image, vec3(0.25, 0.25, at.x))",
        "textureSample(image, reader, vec3f(0.25, 0.25, at.x))",
    )  # fmt: skip
    share = np.clip((np.arange(8) + 0.5) / 8 * 2 - 0.5, 0, 1)
    np.testing.assert_allclose(shown[0, :, 0], 16 * share, atol=16 / 256)


def test_a_volume_shrinks_in_all_directions(driver: str) -> None:
    levels = [np.full((8 >> n, 4 >> n, max(2 >> n, 1), 4), float(n)) for n in range(3)]
    image = picture_of("3d", "rgba32float", *levels)
    shown = read(
        driver, slot_for(image), image,
        "textureLod(image, vec3(at, 0.5), 2.0)",
        "textureSampleLevel(image, reader, vec3f(at, 0.5), 2.0)",
    )  # fmt: skip
    assert (shown == 2).all()


DIRECTIONS = ("1, -y, -x", "-1, -y, x", "x, 1, y", "x, -1, -y", "x, -y, 1", "-x, -y, -1")
"""Towards a face's column x and row y, both from -1 to 1."""


@pytest.mark.parametrize("face", range(6))
def test_faces_of_a_cube(driver: str, face: int) -> None:
    image = picture_of("cube", "rgba32float", faces(2))
    places = {"x": "(2.0 * at.x - 1.0)", "y": "(2.0 * at.y - 1.0)"}
    direction = re.sub("[xy]", lambda found: places[found[0]], DIRECTIONS[face])
    shown = read(
        driver, slot_for(image), image,
        f"texture(image, vec3({direction}))", f"textureSample(image, reader, vec3f({direction}))",
    )  # fmt: skip
    assert (shown[::4, ::4, :3] == faces(2)[face, :, :, :3]).all()


def test_filtering_goes_on_across_the_edges_of_a_cube(driver: str) -> None:
    """Halfway between +z and +x at the same height."""
    image = picture_of("cube", "rgba32float", faces(4))
    shown = read(
        driver, slot_for(image, filter="linear"), image,
        "texture(image, vec3(1.0, 0.25, 1.0))",
        "textureSample(image, reader, vec3f(1.0, 0.25, 1.0))",
    )  # fmt: skip
    np.testing.assert_allclose(shown[0, 0, :3], [2, 1.5, 1], atol=0.02)


@pytest.mark.parametrize(
    ("form", "texels"),
    [
        ("r8uint", [[0, 200], [255, 7]]),
        ("r32uint", [[0, 2**32 - 2**20], [2**31, 7]]),
        ("r32sint", [[-(2**31), 2**30], [-1, 7]]),
        ("rgba8uint", [[[0, 200, 3, 4], [255, 7, 8, 9]]]),
        ("rgba32uint", [[[0, 2**31, 3, 4], [2**32 - 2**20, 7, 8, 9]]]),
        ("rgba32sint", [[[0, -(2**31), 3, 4], [-5, 7, 8, 9]]]),
    ],
)
def test_integers(driver: str, form: TextureFormat, texels: list[object]) -> None:
    lanes = np.array(texels, dtype=np.int64).reshape(len(texels), 2, -1)
    image = picture_of("2d", form, lanes)
    height = len(texels)
    shown = read(
        driver, slot_for(image), image,
        f"vec4(texelFetch(image, ivec2(at * vec2(2, {height})), 0))",
        f"vec4f(textureLoad(image, vec2i(at * vec2f(2, {height})), 0))",
    )  # fmt: skip
    expected = np.zeros((height, 2, 4))
    expected[..., 3] = 1
    expected[..., : lanes.shape[2]] = lanes
    assert (shown[:: 8 // height, ::4] == expected).all()


OUTCOMES: dict[Compare, list[int]] = {
    "never": [0, 0, 0],
    "less": [1, 0, 0],
    "equal": [0, 1, 0],
    "less_equal": [1, 1, 0],
    "greater": [0, 0, 1],
    "not_equal": [1, 0, 1],
    "greater_equal": [0, 1, 1],
    "always": [1, 1, 1],
}
"""The results of each comparison for references of 0.25, 0.5 and 0.75 with a depth of 0.5."""


@pytest.mark.parametrize("compare", OUTCOMES)
def test_depths_are_compared(driver: str, compare: Compare) -> None:
    image = picture_of("2d", "depth32float", np.full((1, 1, 1), 0.5))
    found = [
        read(
            driver, slot_for(image, compare=compare), image,
            f"vec4(texture(image, vec3(at, {reference})))",
            f"vec4f(textureSampleCompare(image, reader, at, {reference}))",
        )[0, 0, 0].item()
        for reference in (0.25, 0.5, 0.75)
    ]  # fmt: skip
    assert found == OUTCOMES[compare]


def test_depths_are_compared_before_they_are_filtered(driver: str) -> None:
    depths = np.array([[0.4, 0.9], [0.1, 0.8]])[:, :, np.newaxis]
    image = picture_of("2d", "depth32float", depths)
    shown = read(
        driver, slot_for(image, compare="less", filter="linear"), image,
        "vec4(texture(image, vec3(at, 0.5)))",
        "vec4f(textureSampleCompare(image, reader, at, 0.5))",
    )  # fmt: skip
    share = np.clip((np.arange(8) + 0.5) / 8 * 2 - 0.5, 0, 1)
    np.testing.assert_allclose(shown[3, :, 0], share, atol=1 / 256)


def test_depths_of_layers_and_faces(driver: str) -> None:
    layers = np.array([0.1, 0.6]).reshape(2, 1, 1, 1)
    image = picture_of("2d_array", "depth32float", layers)
    shown = read(
        driver, slot_for(image, compare="less"), image,
        "vec4(texture(image, vec4(at, 0.0, 0.5)), texture(image, vec4(at, 1.0, 0.5)), 0.0, 0.0)",
        "vec4f(textureSampleCompare(image, reader, at, 0, 0.5),"
        " textureSampleCompare(image, reader, at, 1, 0.5), 0, 0)",
    )  # fmt: skip
    assert shown[0, 0].tolist() == [0, 1, 0, 0]
    cube = picture_of("cube", "depth32float", np.arange(6).reshape(6, 1, 1, 1) / 8)
    shown = read(
        driver, slot_for(cube, compare="greater"), cube,
        "vec4(texture(image, vec4(0.0, -1.0, 0.0, 0.4)), texture(image, vec4(0.0, 0.0, 1.0, 0.4)),"
        " 0.0, 0.0)",
        "vec4f(textureSampleCompare(image, reader, vec3f(0.0, -1.0, 0.0), 0.4),"
        " textureSampleCompare(image, reader, vec3f(0.0, 0.0, 1.0), 0.4), 0, 0)",
    )  # fmt: skip
    assert shown[0, 0].tolist() == [1, 0, 0, 0]


def test_several_depths_at_once(driver: str) -> None:
    """Each kind of sampler is told which texture it reads; they cannot all have the first."""
    whole = [
        picture_of("2d", "depth32float", np.full((1, 1, 1), 0.2)),
        picture_of("2d_array", "depth32float", np.full((2, 1, 1, 1), 0.6)),
        picture_of("cube", "depth32float", np.full((6, 1, 1, 1), 0.6)),
    ]
    shown = read_all(
        driver, [slot_for(each, compare="less") for each in whole], whole,
        "vec4(texture(image0, vec3(at, 0.5)), texture(image1, vec4(at, 1.0, 0.5)),"
        " texture(image2, vec4(at, 1.0, 0.5)), 1.0)",
        "vec4f(textureSampleCompare(image0, reader0, at, 0.5),"
        " textureSampleCompare(image1, reader1, at, 1, 0.5),"
        " textureSampleCompare(image2, reader2, vec3f(at, 1.0), 0.5), 1)",
    )  # fmt: skip
    assert shown[0, 0].tolist() == [0, 1, 1, 1]


def test_depths_have_levels(driver: str) -> None:
    levels = [np.full((4 >> n, 4 >> n, 1), (n + 1) / 4) for n in range(3)]
    image = picture_of("2d", "depth32float", *levels)
    shown = read(
        driver, slot_for(image, compare="less", mip="nearest", wrap="repeat"), image,
        "vec4(texture(image, vec3(at * 8.0, 0.6)), texture(image, vec3(at, 0.6)), 0.0, 0.0)",
        "vec4f(textureSampleCompare(image, reader, at * 8.0, 0.6),"
        " textureSampleCompare(image, reader, at, 0.6), 0, 0)",
    )  # fmt: skip
    assert shown[0, 0].tolist() == [1, 0, 0, 0]


@pytest.mark.parametrize("sampling", ["filtering", None])
def test_texels_of_all_levels_can_be_loaded(driver: str, sampling: Sampling | None) -> None:
    """This holds also if the sampler stays on the first level, or if there is no sampler."""
    levels = [np.full((4 >> n, 4 >> n, 4), float(n)) for n in range(3)]
    image = picture_of("2d", "rgba32float", *levels)
    sampled = ("texture(image, at * 16.0)", "textureSample(image, reader, at * 16.0)")
    glsl, wgsl = sampled if sampling else ("vec4(0)", "vec4f(0)")
    shown = read(
        driver, slot_for(image, mip="none", sampling=sampling), image,
        f"vec4(texelFetch(image, ivec2(0), 2).x, ({glsl}).yzw)",
        f"vec4f(textureLoad(image, vec2i(0), 2).x, ({wgsl}).yzw)",
    )  # fmt: skip
    assert shown[0, 0].tolist() == [2, 0, 0, 0]


def test_a_picture_of_another_kind_is_refused(driver: str) -> None:
    image = picture_of("2d_array", "rgba32float", LAYERS)
    slot = slot_for(image, dimension="3d")
    with pytest.raises(DriverError, match="2d_array picture of rgba32float, and is 3d of float"):
        read(
            driver, slot, image,
            "texture(image, vec3(at, 2.0))", "textureSample(image, reader, vec3f(at, 2.0))",
        )  # fmt: skip
