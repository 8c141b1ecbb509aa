"""The fixed-function state of a pipeline."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping

import moderngl

from .....compiler.ir.render_state import Fill, StencilOperation
from ..pipeline import Pipeline
from .context import CLIP_CONTROL, Functions
from .texture_units import COMPARES

OWN_CLIP_CONTROL = ("GL_LOWER_LEFT", "GL_NEGATIVE_ONE_TO_ONE")
"""OpenGL's own clip space, which texts for older versions use, too."""

GL_FRONT, GL_BACK, GL_FRONT_AND_BACK = 0x0404, 0x0405, 0x0408
GL_STENCIL_TEST = 0x0B90
OFFSETS = (0x8037, 0x2A02)
"""``GL_POLYGON_OFFSET_FILL`` and ``GL_POLYGON_OFFSET_LINE``."""
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
