"""From a reflection to a pipeline: what a driver has to know of a material, and by which names."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .codes import Codes
from .drivers.draw import (
    BlockSlot,
    Cull,
    Pipeline,
    Place,
    Target,
    TargetFormat,
    TextureSlot,
    VertexFormat,
)
from .drivers.draw import VertexInput as Input
from .routes import DRIVERS, Route

FORMATS: Mapping[str, TargetFormat] = {
    "r8": "r8unorm",
    "r16f": "r16float",
    "r32f": "r32float",
    "rg8": "rg8unorm",
    "rg16f": "rg16float",
    "rg32f": "rg32float",
    "rgba8": "rgba8unorm",
    "rgba8_srgb": "rgba8unorm-srgb",
    # Nobody sees the order of lanes in memory.
    "bgra8": "rgba8unorm",
    "bgra8_srgb": "rgba8unorm-srgb",
    # Drivers need not draw to ten bits a lane; eight are clamped and blended alike.
    "rgb10a2": "rgba8unorm",
    "rgba16f": "rgba16float",
    "rgba32f": "rgba32float",
}
"""What is drawn to for each target format of the language."""

EXACT: Mapping[str, TargetFormat] = {
    "float": "r32float",
    "vec2": "rg32float",
    "vec4": "rgba32float",
}
"""By what is written to a target, the format that keeps every value of it."""

VERTEX_FORMATS: Mapping[str, VertexFormat] = {
    "float": "float32", "vec2": "float32x2", "vec3": "float32x3", "vec4": "float32x4",
    "int": "sint32", "ivec2": "sint32x2", "ivec3": "sint32x3", "ivec4": "sint32x4",
    "uint": "uint32", "uvec2": "uint32x2", "uvec3": "uint32x3", "uvec4": "uint32x4",
}  # fmt: skip
"""By a vertex input's representation."""


def pipeline(
    reflection: Mapping[str, Any],
    route: Route,
    codes: Codes,
    *,
    exact: bool = False,
    cull: Cull = "none",
) -> Pipeline:
    """The pipeline of one material on one route.

    Inputs, blocks, textures and targets stand in the order of the reflection; textures that no
    stage reads have no slot. With ``exact`` the targets keep what the shader writes, neither
    rounded to the format that the pass asks for nor blended. Raises ``KeyError`` if the reflection
    does not have the route's profile.
    """
    backend = reflection["backends"][route.profile]
    on_vulkan = DRIVERS[route.driver].module == "vulkan"
    return Pipeline(
        stages=codes.stages,
        inputs=tuple(_input(row, backend) for row in reflection["vertex_inputs"]),
        blocks=tuple(
            BlockSlot(_place(backend["blocks"][row["name"]]), row["size"])
            for row in reflection["blocks"]
        ),
        textures=_textures(reflection, backend),
        targets=tuple(
            Target(target_format(row, exact=exact), "none" if exact else row["blend"])
            for row in reflection["targets"]
        ),
        cull=cull,
        flip_y=backend["flip_y"],
        # Vulkan's viewport shows all texts the right way round, also those for other APIs.
        front_face="ccw" if on_vulkan else backend["front_face"],
        first_row="top" if on_vulkan else backend["first_row"],
        host_uniforms=tuple(backend["host_uniforms"]),
    )


def target_format(row: Mapping[str, Any], *, exact: bool) -> TargetFormat:
    """What is drawn to for one of the reflection's targets; see ``FORMATS`` and ``EXACT``."""
    return EXACT[row["representation"]] if exact else FORMATS[row["format"]]


def _input(row: Mapping[str, Any], backend: Mapping[str, Any]) -> Input:
    identifier = backend["vertex_inputs"][row["name"]]["identifier"]
    return Input(identifier, row["location"], VERTEX_FORMATS[row["representation"]], row["step"])


def _place(row: Mapping[str, Any]) -> Place:
    return Place(row["identifier"], row["group"], row["binding"])


def _textures(reflection: Mapping[str, Any], backend: Mapping[str, Any]) -> tuple[TextureSlot, ...]:
    states = {row["texture"]: row["state"] for row in reflection["samplers"]}
    samplers = backend["samplers"]
    return tuple(
        TextureSlot(
            texture=_place(backend["textures"][row["name"]]),
            sampler=_place(samplers[row["name"]]) if row["name"] in samplers else None,
            dimension=row["dimension"],
            sample=row["layout"]["sampleType"],
            sampling=row["layout"]["sampler"],
            **states.get(row["name"], {}),
        )
        for row in reflection["textures"]
        if row["stages"]
    )
