"""Formats of targets, images, depths and vertex inputs, with WebGPU's names for them.

Semantics looks up what programs name, and documents have WebGPU's name, which all hosts know.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from ...support.frozen import frozen
from ..constraints import Spelling
from .types import FLOAT, VEC2, VEC4, Type


@frozen
class TexelFormat:
    """A format of render targets and images."""

    type: Type
    """The type of the value that is written to a texel."""
    webgpu: str
    """WebGPU's name, a ``GPUTextureFormat``."""


TARGET_FORMATS: Mapping[str, TexelFormat] = {
    "r8": TexelFormat(FLOAT, "r8unorm"),
    "r16f": TexelFormat(FLOAT, "r16float"),
    "r32f": TexelFormat(FLOAT, "r32float"),
    "rg8": TexelFormat(VEC2, "rg8unorm"),
    "rg16f": TexelFormat(VEC2, "rg16float"),
    "rg32f": TexelFormat(VEC2, "rg32float"),
    "rgba8": TexelFormat(VEC4, "rgba8unorm"),
    "rgba8_srgb": TexelFormat(VEC4, "rgba8unorm-srgb"),
    "bgra8": TexelFormat(VEC4, "bgra8unorm"),
    "bgra8_srgb": TexelFormat(VEC4, "bgra8unorm-srgb"),
    "rgb10a2": TexelFormat(VEC4, "rgb10a2unorm"),
    "rgba16f": TexelFormat(VEC4, "rgba16float"),
    "rgba32f": TexelFormat(VEC4, "rgba32float"),
}
"""The formats by their names in the language."""

TARGET_WORDS: Spelling = {name: format_.webgpu for name, format_ in TARGET_FORMATS.items()}
DEPTH_WORDS: Spelling = {
    "depth32f": "depth32float", "depth32f_stencil8": "depth32float-stencil8",
}  # fmt: skip
"""Formats of depths, without and with stencil values beside them; programs do not name them."""

VertexFormat = Literal[
    "float32", "float32x2", "float32x3", "float32x4",
    "sint32", "sint32x2", "sint32x3", "sint32x4",
    "uint32", "uint32x2", "uint32x3", "uint32x4",
]  # fmt: skip
"""WebGPU's names, ``GPUVertexFormat``: the type of a lane, and the number of lanes."""
VERTEX_FORMATS: Mapping[str, VertexFormat] = {
    "float": "float32", "vec2": "float32x2", "vec3": "float32x3", "vec4": "float32x4",
    "int": "sint32", "ivec2": "sint32x2", "ivec3": "sint32x3", "ivec4": "sint32x4",
    "uint": "uint32", "uvec2": "uint32x2", "uvec3": "uint32x3", "uvec4": "uint32x4",
}  # fmt: skip
"""The format of a vertex input, by its representation."""
