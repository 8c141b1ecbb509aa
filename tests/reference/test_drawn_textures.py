"""Reads of textures that an earlier step of a frame has drawn, whose texels have bounds.

Devices are made up: their texels lie anywhere within the bounds, and they read these exactly. What
they read has to lie within the bounds of the read.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.compiler.ir.leaves import Texture
from burnish.compiler.ir.types import TextureType
from burnish.compiler.reference.bounds import Bounded, exact
from burnish.compiler.reference.picture.sampler import TextureReader
from burnish.compiler.reference.picture.scene import Texels
from burnish.compiler.reference.picture.texels import Image

from .reads import DEFAULTS, DEVICE, RULES

Array = NDArray[np.float64]

SIZE = 4
TRIES = 40
ANYWHERE = Bounded(np.full((1, 1, 1), 0.5), np.full((1, 1, 1), -3.0), np.full((1, 1, 1), 3.0))
"""A coordinate of which so little is known that no place of the texture is ruled out."""
PLACE = exact(np.full((1, 1, 1), 0.4))


def reader(texels: Texels, rules: Any, **state: str) -> TextureReader:
    """A texture of colours as shaders read it."""
    whole = tuple(sorted({**DEFAULTS, **state}.items()))
    resource = Texture("t", TextureType("2d", "float"), "material", state=whole)
    return TextureReader(Image(texels, resource, rules))


@pytest.mark.parametrize("filtered", ["nearest", "linear"])
@pytest.mark.parametrize("coordinate", [PLACE, ANYWHERE], ids=["known", "anywhere"])
def test_a_device_may_have_drawn_any_texel_within_its_bounds(
    filtered: str, coordinate: Bounded
) -> None:
    random = np.random.default_rng(13)
    value = random.uniform(0, 1, (SIZE, SIZE, 4))
    low, high = value - random.uniform(0, 0.5, value.shape), value + random.uniform(0, 0.5)
    drawn = reader(Texels((value,), False, (low,), (high,)), DEVICE, filter=filtered)
    found = drawn.read("sample_level", ((coordinate, coordinate), (0,)))
    for _ in range(TRIES):
        # Often one of the ends, which are what a device may just have.
        share = np.clip(random.uniform(-0.5, 1.5, value.shape), 0, 1)
        device = reader(Texels((low + share * (high - low),)), RULES, filter=filtered)
        at = tuple(exact(random.uniform(x.low, x.high)) for x in (coordinate, coordinate))
        read = device.read("sample_level", (at, (0,)))
        for lane, allowed in zip(read, found, strict=True):
            assert allowed.low <= lane.value <= allowed.high


def test_a_load_of_any_texel_is_within_the_bounds_of_all() -> None:
    """The reference does not look at each of so many texels."""
    size = 64
    value = np.arange(size * size, dtype=np.float64).reshape(size, size, 1).repeat(4, axis=2)
    drawn = reader(Texels((value,), False, (value - 0.25,), (value + 0.25,)), DEVICE)
    anywhere = Bounded(
        np.ones((1, 1, 1), np.int64), np.zeros((1, 1, 1), np.int64), np.full((1, 1, 1), size)
    )
    red = drawn.read("load", ((anywhere, anywhere), (0,)))[0]
    assert (red.low.item(), red.high.item()) == (-0.25, 64 * 64 - 0.75)


def test_what_was_drawn_in_srgb_is_decoded_once_more_when_it_is_read() -> None:
    """A device may be off by half a step of 8 bits, as for a picture from a file (Direct3D 11.3
    functional specification, 3.2.3.7): by 0.5 / 255, with the slope of IEC 61966-2-1 at 1, 2.4 /
    1.055. Alpha is not encoded."""
    white = np.ones((SIZE, SIZE, 4))
    drawn = reader(Texels((white,), True, (white,), (white,)), DEVICE)
    red, *_, alpha = drawn.read("sample_level", ((PLACE, PLACE), (0,)))
    assert 1 - red.low.item() == pytest.approx(0.5 / 255 * 2.4 / 1.055, rel=0.06)
    assert alpha.low.item() == 1
