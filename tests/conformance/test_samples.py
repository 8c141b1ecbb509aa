"""Passes with several samples for each pixel, on every route, against values worked out by hand.

The places of the samples are Direct3D's, which Vulkan and WebGPU have as well, and llvmpipe.
"""

from __future__ import annotations

import numpy as np
import pytest

from .kit import REFERENCE, Floats, Studio
from .test_frames import EVERYWHERE, SIZE, outputs

PLACES = np.array(((0.375, 0.125), (0.875, 0.375), (0.125, 0.625), (0.625, 0.875)))
"""From the left and from the first row."""

BOXES = """
pass Box {
    param corner : vec2
    param depth_there : float = 0.5
    param color : vec4 = vec4(1.0)
    raster { samples = 4 }
    along = if vertex_index mod 2u == 0u then -1.0 else corner.x
    down = if vertex_index == 0u or vertex_index == 1u or vertex_index == 3u
        then 1.0 else corner.y
    clip_position = vec4(along, down, depth_there, 1.0)
    target value : rgba16f = color
}
"""
"""Draws all that is to the left of a corner and above it, in clip space."""


def covered(right: float, bottom: float) -> Floats:
    """The share of each pixel's samples to the left of a corner and above it, (height, width)."""
    width, height = SIZE
    pixels = np.stack(np.meshgrid(np.arange(width), np.arange(height)), axis=-1)
    places = pixels[:, :, None] + PLACES
    found: Floats = (places < (right, bottom)).all(axis=-1).mean(axis=-1)
    return found


def box(right: float, bottom: float) -> str:
    """A corner in pixels, as what a frame gives the pass."""
    return f"vec2({2 * right / SIZE[0] - 1}, {1 - 2 * bottom / SIZE[1]})"


CORNERS = [(2.25, 1.5), (2.5, 2.25), (5.75, 0.5), (3.0, 2.0), (7.5, 3.75)]


@EVERYWHERE
@pytest.mark.parametrize("corner", CORNERS)
def test_a_pixel_is_the_mean_of_the_samples_that_are_covered(
    studio: Studio, where: str, corner: tuple[float, float]
) -> None:
    text = f"""{BOXES}
    frame F {{
        drawn = Box(vertices(6)) with {{ corner = {box(*corner)} }}
        output shown = drawn.value
    }}"""
    (found,) = outputs(text, where, studio)
    assert where != REFERENCE or found["shown"].shape == (SIZE[1], SIZE[0], 4)
    np.testing.assert_allclose(
        found["shown"].reshape(SIZE[1], SIZE[0], 4)[..., 0], covered(*corner)
    )
