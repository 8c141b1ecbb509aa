"""Textures from a job, each with the state of its sampler."""

from __future__ import annotations

import moderngl

from ..checks import level_size
from ..draw import Filter, Image, Mip, TextureSlot, Wrap
from .context import Functions

GL_TEXTURE_2D = 0x0DE1
GL_TEXTURE_WRAP_S = 0x2802
GL_TEXTURE_WRAP_T = 0x2803
WRAPS: dict[Wrap, int] = {"repeat": 0x2901, "clamp": 0x812F, "mirror": 0x8370}

MAGNIFY: dict[Filter, int] = {"linear": moderngl.LINEAR, "nearest": moderngl.NEAREST}
MINIFY: dict[tuple[Filter, Mip], int] = {
    ("linear", "none"): moderngl.LINEAR,
    ("linear", "nearest"): moderngl.LINEAR_MIPMAP_NEAREST,
    ("linear", "linear"): moderngl.LINEAR_MIPMAP_LINEAR,
    ("nearest", "none"): moderngl.NEAREST,
    ("nearest", "nearest"): moderngl.NEAREST_MIPMAP_NEAREST,
    ("nearest", "linear"): moderngl.NEAREST_MIPMAP_LINEAR,
}

STORAGE = {
    "rgba8unorm": ("f1", 0x8058),
    "rgba8unorm-srgb": ("f1", 0x8C43),
    "rgba32float": ("f4", 0x8814),
}
"""moderngl's type of a lane, and OpenGL's internal format."""


def bind_texture(
    context: moderngl.Context, functions: Functions, slot: TextureSlot, image: Image, unit: int
) -> moderngl.Texture:
    """A texture with all levels of an image, read as the slot wants it, bound to a unit.

    OpenGL counts rows from v = 0, and so does Burnish: the rows go up as they are.
    """
    kind, internal_format = STORAGE[image.format]
    texture = context.texture(
        (image.width, image.height), 4, dtype=kind, internal_format=internal_format
    )
    # Makes room for the levels, and says how many there are.
    texture.build_mipmaps(max_level=len(image.levels) - 1)
    for level, texels in enumerate(image.levels):
        texture.write(texels, (0, 0, *level_size(image, level)), level)
    texture.filter = MINIFY[slot.filter, slot.mip], MAGNIFY[slot.filter]
    texture.use(unit)
    for wrap in (GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T):  # moderngl does not mirror
        functions.glTexParameteri(GL_TEXTURE_2D, wrap, WRAPS[slot.wrap])
    return texture
