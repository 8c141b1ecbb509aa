"""Sets how the targets of the bound framebuffer are blended, and which lanes are written."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence

from .....compiler.ir.blending import Factor, Operation
from ..render_state import RenderTarget
from .context import GL_BLEND, Functions

FACTORS: Mapping[Factor, int] = {
    "zero": 0,
    "one": 1,
    "src": 0x0300,
    "one_minus_src": 0x0301,
    "src_alpha": 0x0302,
    "one_minus_src_alpha": 0x0303,
    "dst_alpha": 0x0304,
    "one_minus_dst_alpha": 0x0305,
    "dst": 0x0306,
    "one_minus_dst": 0x0307,
    "src_alpha_saturated": 0x0308,
    "constant": 0x8001,
    "one_minus_constant": 0x8002,
}
"""OpenGL's blend factors. In the equation of alpha, a factor with a colour means the colour's
alpha."""

OPERATIONS: Mapping[Operation, int] = {
    "add": 0x8006,
    "min": 0x8007,
    "max": 0x8008,
    "subtract": 0x800A,
    "reverse_subtract": 0x800B,
}


def set_blending(
    functions: Functions, targets: Sequence[RenderTarget], constant: Sequence[float]
) -> None:
    """Set the state of each target, and the colour of the blend factor ``constant``."""
    functions.glBlendColor(*(ctypes.c_float(lane) for lane in constant))
    for number, target in enumerate(targets):
        functions.glColorMaski(number, *(target.writes(lane) for lane in "rgba"))
        blend = target.blend
        if blend is None:
            functions.glDisablei(GL_BLEND, number)
            continue
        color, alpha = blend.color, blend.alpha
        functions.glEnablei(GL_BLEND, number)
        functions.glBlendEquationSeparatei(
            number, OPERATIONS[color.operation], OPERATIONS[alpha.operation]
        )
        factors = (color.source, color.destination, alpha.source, alpha.destination)
        functions.glBlendFuncSeparatei(number, *(FACTORS[factor] for factor in factors))


def write_all_lanes(functions: Functions, targets: int) -> None:
    """Let all lanes of all targets be written: clearing obeys the masks."""
    for number in range(targets):
        functions.glColorMaski(number, 1, 1, 1, 1)
