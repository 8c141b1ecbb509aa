"""Creates a job's textures with the state of their samplers, through OpenGL's own functions.

moderngl does not have all types of textures with mip levels, nor all of a sampler's state.
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager

from .....compiler.ir.render_state import Compare
from .....compiler.ir.types import Border, Wrap
from ..checks import level_size
from ..slots import Filter, Mip, TextureSlot
from ..texels import Dimension, Image, TextureFormat
from .context import Functions

GL_TEXTURE0 = 0x84C0
GL_UNPACK_ALIGNMENT = 0x0CF5
GL_TEXTURE_CUBE_MAP_SEAMLESS = 0x884F
GL_TEXTURE_CUBE_MAP_POSITIVE_X = 0x8515

TARGETS: dict[Dimension, int] = {
    "2d": 0x0DE1, "2d_array": 0x8C1A, "3d": 0x806F, "cube": 0x8513, "cube_array": 0x9009,
}  # fmt: skip

GL_UNSIGNED_BYTE, GL_INT, GL_UNSIGNED_INT, GL_FLOAT = 0x1401, 0x1404, 0x1405, 0x1406
GL_DEPTH_COMPONENT, GL_RED_INTEGER, GL_RGBA, GL_RGBA_INTEGER = 0x1902, 0x8D94, 0x1908, 0x8D99
STORAGE: dict[TextureFormat, tuple[int, int, int]] = {
    "rgba8unorm": (0x8058, GL_RGBA, GL_UNSIGNED_BYTE),
    "rgba8unorm-srgb": (0x8C43, GL_RGBA, GL_UNSIGNED_BYTE),
    "rgba32float": (0x8814, GL_RGBA, GL_FLOAT),
    "depth32float": (0x8CAC, GL_DEPTH_COMPONENT, GL_FLOAT),
    "r8uint": (0x8232, GL_RED_INTEGER, GL_UNSIGNED_BYTE),
    "rgba8uint": (0x8D7C, GL_RGBA_INTEGER, GL_UNSIGNED_BYTE),
    "r32uint": (0x8236, GL_RED_INTEGER, GL_UNSIGNED_INT),
    "rgba32uint": (0x8D70, GL_RGBA_INTEGER, GL_UNSIGNED_INT),
    "r32sint": (0x8235, GL_RED_INTEGER, GL_INT),
    "rgba32sint": (0x8D82, GL_RGBA_INTEGER, GL_INT),
}
"""The internal format, and the lanes and their type in the uploaded bytes."""

GL_TEXTURE_MAG_FILTER, GL_TEXTURE_MIN_FILTER = 0x2800, 0x2801
GL_TEXTURE_MAX_LOD, GL_TEXTURE_MAX_LEVEL, MOST_LEVELS = 0x813B, 0x813D, 1000
GL_TEXTURE_WRAPS = 0x2802, 0x2803, 0x8072
"""The parameters of the axes: S, T and R."""
GL_TEXTURE_COMPARE_MODE, GL_TEXTURE_COMPARE_FUNC = 0x884C, 0x884D
GL_COMPARE_REF_TO_TEXTURE, GL_NONE = 0x884E, 0
WRAPS: dict[Wrap, int] = {"repeat": 0x2901, "clamp": 0x812F, "mirror": 0x8370, "border": 0x812D}
GL_TEXTURE_BORDER_COLOR = 0x1004
BORDERS: dict[Border, tuple[int, int, int, int]] = {
    "transparent": (0, 0, 0, 0), "black": (0, 0, 0, 1), "white": (1, 1, 1, 1),
}  # fmt: skip
MAGNIFY: dict[Filter, int] = {"linear": 0x2601, "nearest": 0x2600}
MINIFY: dict[tuple[Filter, Mip], int] = {
    ("linear", "none"): 0x2701,
    ("linear", "nearest"): 0x2701,
    ("linear", "linear"): 0x2703,
    ("nearest", "none"): 0x2700,
    ("nearest", "nearest"): 0x2700,
    ("nearest", "linear"): 0x2702,
}
"""The filters for minification. Without mip levels the sampler uses only the first level, but
texels of others can be loaded."""
COMPARES: dict[Compare, int] = {
    "never": 0x0200, "less": 0x0201, "equal": 0x0202, "less_equal": 0x0203,
    "greater": 0x0204, "not_equal": 0x0205, "greater_equal": 0x0206, "always": 0x0207,
}  # fmt: skip


@contextmanager
def bound_texture(
    functions: Functions, slot: TextureSlot, image: Image, unit: int
) -> Iterator[None]:
    """A texture with all levels of an image, with the slot's state, bound to a unit.

    OpenGL counts rows from v = 0, as Burnish does, so the rows are uploaded in their order.
    """
    target, name = TARGETS[slot.dimension], ctypes.c_uint()
    functions.glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS)
    functions.glGenTextures(1, ctypes.byref(name))
    functions.glActiveTexture(GL_TEXTURE0 + unit)
    functions.glBindTexture(target, name)
    functions.glPixelStorei(GL_UNPACK_ALIGNMENT, 1)
    for level in range(len(image.levels)):
        _upload(functions, image, level)
    set_state(functions, target, slot, len(image.levels))
    try:
        yield
    finally:
        functions.glDeleteTextures(1, ctypes.byref(name))


def _upload(functions: Functions, image: Image, level: int) -> None:
    internal_format, lanes, kind = STORAGE[image.format]
    width, height, depth = level_size(image, level)
    data = image.levels[level]
    if image.dimension in ("2d", "cube"):
        first = TARGETS["2d"] if image.dimension == "2d" else GL_TEXTURE_CUBE_MAP_POSITIVE_X
        size = len(data) // depth
        for face in range(depth):
            functions.glTexImage2D(
                first + face, level, internal_format, width, height, 0,
                lanes, kind, data[face * size : (face + 1) * size],
            )  # fmt: skip
    else:
        functions.glTexImage3D(
            TARGETS[image.dimension], level, internal_format, width, height, depth, 0,
            lanes, kind, data,
        )  # fmt: skip


def set_state(functions: Functions, target: int, slot: TextureSlot, levels: int) -> None:
    """Set the state of a slot's sampler for the texture of so many levels that is bound there."""
    for key, value in state_of(slot, levels).items():
        functions.glTexParameteri(target, key, value)
    border = slot.border_color or (BORDERS[slot.border] if slot.border is not None else None)
    if border is not None:
        color = (ctypes.c_float * 4)(*border)
        functions.glTexParameterfv(target, GL_TEXTURE_BORDER_COLOR, color)


def state_of(slot: TextureSlot, levels: int) -> dict[int, int]:
    """The parameters of the texture; one without a sampler must not use any filter."""
    minify: tuple[Filter, Mip] = (
        ("nearest", "nearest") if slot.sampling is None else (slot.filter, slot.mip)
    )
    state = {
        GL_TEXTURE_MAX_LOD: 0 if minify[1] == "none" else MOST_LEVELS,
        GL_TEXTURE_MAX_LEVEL: levels - 1,
        GL_TEXTURE_MIN_FILTER: MINIFY[minify],
        GL_TEXTURE_MAG_FILTER: MAGNIFY[minify[0]],
        **{axis: WRAPS[wrap] for axis, wrap in zip(GL_TEXTURE_WRAPS, slot.wraps, strict=True)},
    }
    state[GL_TEXTURE_COMPARE_MODE] = GL_NONE
    if slot.compare is not None:
        state[GL_TEXTURE_COMPARE_MODE] = GL_COMPARE_REF_TO_TEXTURE
        state[GL_TEXTURE_COMPARE_FUNC] = COMPARES[slot.compare]
    return state
