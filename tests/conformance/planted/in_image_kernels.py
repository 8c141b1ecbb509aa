"""Planted errors in kernels over images: full-screen passes, texts that write images, jobs."""

from __future__ import annotations

from dataclasses import replace
from typing import Any
from unittest.mock import patch as patched

from burnish.compiler.ir import build, full_screen
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.types import IVEC2
from burnish.compiler.passes import pipeline
from burnish.support.frozen import changed
from burnish.targets.runner import kernels
from burnish.targets.runner.drivers.draws import Dispatch, Draw, Sides
from burnish.targets.runner.frames import by_route

from .planting import Plant, Planted, form, framebuffer, replaced, skeleton, supplied

texel, groups, dispatch_of = full_screen._texel, Dispatch.groups, kernels.image_dispatch
drawn = full_screen.full_screen

DRAWN, WRITTEN = "Few", "Stored"
"""The kernels that show them: one that profiles draw, and one that they write if they can."""


def drawing(**names: Any) -> Plant:
    """Make full-screen passes wrong, but not those that the reference draws."""

    def wrong(shader: Shader) -> Shader:
        with patched.multiple(full_screen, **names):
            return drawn(shader)

    return replaced(pipeline, "full_screen", wrong)


def _turned(shader: Shader) -> Node:
    """Rows for columns."""
    return build.swizzle(shader.graph, texel(shader), (1, 0))


def _from_one(shader: Shader) -> Node:
    """Places that are counted from 1."""
    one = build.constant(shader.graph, IVEC2, (1, 1))
    return shader.graph.node("native", IVEC2, (texel(shader), one), "add")


def _exchanged(shader: Shader) -> Shader:
    """The first image's texels in the third one, and the other way round."""
    made = drawn(shader)
    position, first, second, third, fourth = made.results
    first, third = changed(first, value=third.value), changed(third, value=first.value)
    return changed(made, results=(position, first, second, third, fourth))


def _too_few_groups(dispatch: Dispatch, _work_group: Sides) -> Sides:
    """A host that takes work groups for larger than they are."""
    return groups(dispatch, (16, 8, 1))


def _without_values(draw: Draw) -> Dispatch:
    dispatch = dispatch_of(draw)
    return replace(dispatch, blocks=tuple(bytes(len(block)) for block in dispatch.blocks))


GLSL, HLSL, WGSL = "lavapipe:glsl", "lavapipe:hlsl-dxc", "lavapipe:wgsl-naga"
OPENGL = "llvmpipe:gl330"

PLANTED = [
    Planted("a triangle that covers half of the picture", DRAWN, OPENGL, drawing(_FAR=1.0)),
    Planted("rows for columns", DRAWN, OPENGL, drawing(_texel=_turned)),
    Planted("places from one", DRAWN, WGSL, drawing(_texel=_from_one)),
    Planted("rows from below", DRAWN, OPENGL, framebuffer("glsl", "gl330", inputs={})),
    Planted("an image's texels in another", DRAWN, GLSL,
            replaced(pipeline, "full_screen", _exchanged)),
    Planted("a texel in another place", WRITTEN, HLSL,
            form("hlsl", store_texel="{name}[{place}.yx] = {value};")),
    Planted("lanes in another order", WRITTEN, WGSL,
            form("wgsl", store_texel="textureStore({name}, {place}, ({value}).zyxw);")),
    Planted("invocations that stand in columns", WRITTEN, WGSL,
            supplied("wgsl", "texel", "input.{name}.yx")),
    Planted("a third number of invocations", WRITTEN, GLSL,
            supplied("glsl", "texel", "gl_GlobalInvocationID.xz")),
    Planted("a format of another size", WRITTEN, "swiftshader:glsl",
            skeleton("glsl", ("{{ image.format }}", "rgba8"))),
    Planted("no format for glslang", "Alone", "swiftshader:hlsl-glslang",
            skeleton("hlsl", ("[[spv::format_{{ image.format }}]]", ""))),
    Planted("smaller work groups than a host is told of", WRITTEN, WGSL,
            skeleton("wgsl", ("({{ entry.work_group", "(4, 4) // ({{"))),
    Planted("too few work groups", WRITTEN, GLSL, replaced(Dispatch, "groups", _too_few_groups)),
    Planted("no values", WRITTEN, GLSL, replaced(by_route, "image_dispatch", _without_values)),
]  # fmt: skip
