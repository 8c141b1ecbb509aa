"""The fixed-function state of a pipeline."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence

import moderngl

from .....compiler.ir.blending import Factor, Operation
from .....compiler.ir.render_state import Fill, StencilOperation
from ..pipeline import Pipeline
from ..render_state import RenderTarget
from .context import CLIP_CONTROL, GL_BLEND, Functions
from .texture_units import COMPARES

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

BLEND_OPERATIONS: Mapping[Operation, int] = {
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
            number, BLEND_OPERATIONS[color.operation], BLEND_OPERATIONS[alpha.operation]
        )
        factors = (color.source, color.destination, alpha.source, alpha.destination)
        functions.glBlendFuncSeparatei(number, *(FACTORS[factor] for factor in factors))


def write_all_lanes(functions: Functions, targets: int) -> None:
    """Let all lanes of all targets be written: clearing obeys the masks."""
    for number in range(targets):
        functions.glColorMaski(number, 1, 1, 1, 1)


OWN_CLIP_CONTROL = ("GL_LOWER_LEFT", "GL_NEGATIVE_ONE_TO_ONE")
"""OpenGL's own clip space, which texts for older versions use, too."""

GL_FRONT, GL_BACK, GL_FRONT_AND_BACK = 0x0404, 0x0405, 0x0408
GL_STENCIL_TEST = 0x0B90
OFFSETS = (0x8037, 0x2A02)
"""``GL_POLYGON_OFFSET_FILL`` and ``GL_POLYGON_OFFSET_LINE``."""
SAMPLE_ALPHA_TO_COVERAGE = 0x809E
FILLS: Mapping[Fill, int] = {"faces": 0x1B02, "lines": 0x1B01}
OPERATIONS: Mapping[StencilOperation, int] = {
    "keep": 0x1E00, "zero": 0, "replace": 0x1E01, "invert": 0x150A,
    "increment_clamp": 0x1E02, "decrement_clamp": 0x1E03,
    "increment_wrap": 0x8507, "decrement_wrap": 0x8508,
}  # fmt: skip


def set_state(
    context: moderngl.Context, functions: Functions, pipeline: Pipeline, *, has_depth: bool = True
) -> None:
    """Set all state but blending; without depths, nothing is hidden."""
    culling = 0 if pipeline.cull == "none" else context.CULL_FACE
    context.enable_only((context.DEPTH_TEST if has_depth else 0) | culling)
    functions.glDepthFunc(COMPARES[pipeline.depth.compare])
    functions.glDepthMask(pipeline.depth.write)
    _set_bias(functions, pipeline)
    _set_stencil(functions, pipeline)
    covers = functions.glEnable if pipeline.alpha_to_coverage else functions.glDisable
    covers(SAMPLE_ALPHA_TO_COVERAGE)
    functions.glPolygonMode(GL_FRONT_AND_BACK, FILLS[pipeline.fill])
    context.front_face = pipeline.front_face
    context.cull_face = "front" if pipeline.cull == "front" else "back"
    context.provoking_vertex = context.FIRST_VERTEX_CONVENTION
    if pipeline.patch_points:
        context.patch_vertices = pipeline.patch_points
    names = pipeline.clip_control or OWN_CLIP_CONTROL
    functions.glClipControl(*(CLIP_CONTROL[name] for name in names))


def _set_bias(functions: Functions, pipeline: Pipeline) -> None:
    """Set the bias of the depths of triangles, or of their edges."""
    depth = pipeline.depth
    for offset in OFFSETS:
        (functions.glEnable if pipeline.has_bias else functions.glDisable)(offset)
    if not pipeline.has_bias:
        return
    numbers = (depth.slope_bias, depth.bias, depth.bias_clamp)
    slope, constant, clamp = map(ctypes.c_float, numbers)
    if depth.bias_clamp:
        functions.glPolygonOffsetClampEXT(slope, constant, clamp)
    else:
        functions.glPolygonOffset(slope, constant)


def _set_stencil(functions: Functions, pipeline: Pipeline) -> None:
    stencil = pipeline.stencil
    if stencil is None:
        functions.glDisable(GL_STENCIL_TEST)
        return
    functions.glEnable(GL_STENCIL_TEST)
    functions.glStencilMask(stencil.write_mask)
    for face, side in ((GL_FRONT, stencil.front), (GL_BACK, stencil.back)):
        compare = COMPARES[side.compare]
        functions.glStencilFuncSeparate(face, compare, stencil.reference, stencil.read_mask)
        operations = (side.fail_op, side.depth_fail_op, side.pass_op)
        functions.glStencilOpSeparate(face, *(OPERATIONS[each] for each in operations))
