"""The formats of render targets and depths, and the functions that clear depths."""

from __future__ import annotations

import ctypes

from ..render_state import DepthFormat, TargetFormat
from .context import (
    GL_DEPTH,
    GL_DEPTH32F_STENCIL8,
    GL_DEPTH_ATTACHMENT,
    GL_DEPTH_COMPONENT32F,
    GL_DEPTH_STENCIL_ATTACHMENT,
    GL_STENCIL,
    Functions,
)

STORAGE: dict[TargetFormat, int] = {
    "r8unorm": 0x8229,
    "rg8unorm": 0x822B,
    "rgba8unorm": 0x8058,
    "rgba8unorm-srgb": 0x8C43,
    "r16float": 0x822D,
    "rg16float": 0x822F,
    "rgba16float": 0x881A,
    "r32float": 0x822E,
    "rg32float": 0x8230,
    "rgba32float": 0x8814,
}
"""OpenGL's internal formats."""

DEPTHS: dict[DepthFormat, tuple[int, int]] = {
    "depth32float": (GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT),
    "depth32float-stencil8": (GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT),
}
"""OpenGL's internal format of depths, and their attachment point."""
STENCIL_BITS = 0xFF


def clear_depths(functions: Functions, depth: float, attachment: int) -> None:
    """Clear the depths of the framebuffer that is bound, and stencil values to 0 if it has any."""
    functions.glDepthMask(1)
    functions.glStencilMask(STENCIL_BITS)
    functions.glClearBufferfv(GL_DEPTH, 0, (ctypes.c_float * 1)(depth))
    if attachment == GL_DEPTH_STENCIL_ATTACHMENT:
        functions.glClearBufferiv(GL_STENCIL, 0, (ctypes.c_int * 1)(0))


def widened_format(encoded: TargetFormat) -> TargetFormat:
    """The format of four lanes in which a target is read back."""
    if encoded.endswith("unorm"):
        return "rgba8unorm"
    return "rgba8unorm-srgb" if encoded.endswith("srgb") else "rgba32float"
