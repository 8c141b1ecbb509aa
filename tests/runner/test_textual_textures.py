"""Reads of textures by OpenGL, WebGPU and WebGL 2."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from burnish.compiler.ir.types import Wrap
from burnish.targets.runner.drivers.slots import Mip
from burnish.targets.runner.drivers.texels import TextureFormat

from . import textual_kit as kit
from .textual_kit import (
    NEAREST,
    SIZE,
    TEXELS,
    image,
    read,
)

APIS = tuple(kit.COMMANDS)

pytestmark = pytest.mark.parametrize("api", APIS)


def test_texture_origin_is_the_top_left(api: str) -> None:
    picture = read(api, NEAREST, image(TEXELS), (0, 1))
    assert (picture == TEXELS.repeat(SIZE // 2, 0).repeat(SIZE // 2, 1)).all()


@pytest.mark.parametrize(
    ("wrap", "expected"),
    [("repeat", [2, 1, 2, 1, 2, 1]), ("clamp", [1, 1, 2, 2, 2, 2]), ("mirror", [1, 1, 2, 2, 1, 1])],
)
def test_wrapping(api: str, wrap: Wrap, expected: list[int]) -> None:
    """Two texels, looked at from half a texture before to one behind."""
    row = np.array([[[1, 0, 0, 1], [2, 0, 0, 1]]], "<f4").repeat(2, 0)
    shown = read(api, replace(NEAREST, wrap=wrap), image(row), (-0.5, 3.5))[0, :6, 0]
    assert shown.tolist() == expected
    down = read(api, replace(NEAREST, wrap=wrap), image(row.transpose(1, 0, 2)), (-0.5, 3.5))
    assert down[:6, 0, 0].tolist() == expected


def test_linear_filter(api: str) -> None:
    row = np.array([[[0, 0, 0, 1], [1, 0, 0, 1]]], "<f4").repeat(2, 0)
    shown = read(api, replace(NEAREST, filter="linear"), image(row), (0, 1))[0, :, 0]
    expected = np.clip((np.arange(SIZE) + 0.5) / SIZE * 2 - 0.5, 0, 1)
    np.testing.assert_allclose(shown, expected, atol=1 / 256)


def levels(count: int) -> list[np.ndarray]:
    """Mip levels of 2^count texels and fewer, each filled with its own number."""
    return [np.full((2 ** (count - n), 2 ** (count - n), 4), n, "<f4") for n in range(count + 1)]


@pytest.mark.parametrize(("mip", "expected"), [("linear", 1.5), ("nearest", 2.0), ("none", 0.0)])
def test_mip_levels(api: str, mip: Mip, expected: float) -> None:
    """A step of 2^1.5 texels a pixel lies in the midst of levels 1 and 2, 2^1.75 nearer to 2."""
    step = 1.5 if mip == "linear" else 1.75
    slot = replace(NEAREST, mip=mip, wrap="repeat")
    span = SIZE * 2**step / 64
    shown = read(api, slot, image(*levels(6)), (0, span))
    np.testing.assert_allclose(shown, expected, atol=0.02)


def test_last_level_is_the_last(api: str) -> None:
    """The texture has fewer levels than it could have."""
    shown = read(api, replace(NEAREST, mip="linear", wrap="repeat"), image(*levels(6)[:3]), (0, 64))
    assert (shown == 2).all()


@pytest.mark.parametrize("format", ["rgba8unorm", "rgba8unorm-srgb"])
def test_texture_formats(api: str, format: TextureFormat) -> None:
    texels = np.array([[[0, 51, 128, 255]]], np.uint8)
    picture = replace(image(texels), format=format)
    red, green, blue, alpha = read(api, NEAREST, picture, (0, 1))[0, 0].tolist()
    expected = [0, 51 / 255, 128 / 255, 1]
    if format.endswith("srgb"):
        expected = [0, 0.0331048, 0.2158605, 1]
    # llvmpipe has a polynomial for sRGB, which is up to 8e-4 off.
    tolerance = 1e-3 if api == "opengl" else 1e-5
    np.testing.assert_allclose([red, green, blue, alpha], expected, atol=tolerance)
