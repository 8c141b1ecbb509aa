"""The fixed-function state of a pipeline."""

from __future__ import annotations

import moderngl

from ..draw import Pipeline
from .context import CLIP_CONTROL, Functions
from .texture_units import COMPARES

OWN_CLIP_CONTROL = ("GL_LOWER_LEFT", "GL_NEGATIVE_ONE_TO_ONE")
"""OpenGL's own clip space, which texts have that are for older versions, too."""


def set_state(
    context: moderngl.Context, functions: Functions, pipeline: Pipeline, *, has_depth: bool = True
) -> None:
    """Set all state but blending; without depths, nothing is hidden."""
    culling = 0 if pipeline.cull == "none" else context.CULL_FACE
    context.enable_only((context.DEPTH_TEST if has_depth else 0) | culling)
    functions.glDepthFunc(COMPARES[pipeline.depth_compare])
    functions.glDepthMask(pipeline.depth_write)
    context.front_face = pipeline.front_face
    context.cull_face = "front" if pipeline.cull == "front" else "back"
    context.provoking_vertex = context.FIRST_VERTEX_CONVENTION
    if pipeline.patch_points:
        context.patch_vertices = pipeline.patch_points
    names = pipeline.clip_control or OWN_CLIP_CONTROL
    functions.glClipControl(*(CLIP_CONTROL[name] for name in names))
