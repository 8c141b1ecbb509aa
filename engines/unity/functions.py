"""Writes a material as a file for Custom Function nodes: ``engine.py`` has it in its row.

A node calls a function without a result, whose last argument is an output. Its textures come with
their samplers, as structures of Unity.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...support.unique import Names
from ...targets.emit.functions import EmittedArgument
from ...targets.emit.wrapping import wrapped
from ..node_graph import (
    Graph,
    file_text,
    node_name,
    node_type,
    nodes_of,
    port_lines,
    result_lines,
)
from ..surface import Given, Surface, UnfitError

UNPROVEN = "Never compiled by Unity's own compiler."
STRUCTURES = {
    "2d": "UnityTexture2D", "2d_array": "UnityTexture2DArray", "3d": "UnityTexture3D",
    "cube": "UnityTextureCube",
}  # fmt: skip
"""What Unity has for a texture and its sampler."""

TOLD = """\
// Unity's coordinates are left-handed, and those of the functions right-handed: x has another sign,
// as in imported files of glTF and FBX. The functions of the nodes turn places, directions and
// normals, so nodes give and take Unity's own.
#ifndef BURNISH_IN_UNITY
#define BURNISH_IN_UNITY

float3 burnish_turned(float3 v) {
    return float3(-v.x, v.y, v.z);
}

float3x3 burnish_turned(float3x3 m) {
    return m * float3x3(1, -1, -1, -1, 1, 1, -1, 1, 1);
}

float4x4 burnish_turned(float4x4 m) {
    return m * float4x4(1, -1, -1, -1, -1, 1, 1, 1, -1, 1, 1, 1, 1, 1, 1, 1);
}

float4 burnish_turned_tangent(float4 t) {
    return float4(-t.x, t.y, t.z, -t.w);
}

float4x4 burnish_object_to_world(float4x4 model, float3 place) {
    model._m03_m13_m23 = place;
    return burnish_turned(model);
}

#endif"""
"""The matrices are turned on both sides: the row and the column of x change their sign."""

BOTH = ("burnish_turned({0})", "burnish_turned({0})")
GRAPH = Graph(
    title="Unity",
    product="Unity",
    told=TOLD,
    nodes={
        ("surface", "uv"): "the node UV",
        ("surface", "position"): "the node Position, in the space Absolute World",
        ("surface", "normal"): "the node Normal Vector, in the space World",
        ("surface", "tangent"): "the node Tangent Vector, in the space World",
        ("attribute", "vertex_position"): "the node Position, in the space Object",
        ("attribute", "vertex_normal"): "the node Normal Vector, in the space Object",
        ("attribute", "vertex_tangent"): "the node Tangent Vector, in the space Object; its w is 1 "
        "where the Bitangent Vector is cross(normal, tangent), and -1 elsewhere",
        ("attribute", "vertex_uv"): "the node UV",
        ("attribute", "vertex_uv2"): "the node UV, of the channel UV1",
        ("attribute", "vertex_color"): "the node Vertex Color",
        ("pipeline", "front_facing"): "the node Is Front Face",
        ("pipeline", "frag_coord"): "the node Screen Position, in the mode Pixel; the functions "
        "count y from the upper edge",
        ("role", "object_to_world"): "the node Transformation Matrix, Model",
        ("role", "eye"): "the node Camera, its output Position",
    },
    outputs={
        "base_color": "Base Color",
        "color": "Base Color of an Unlit graph",
        "metallic": "Metallic",
        "roughness": "Smoothness, behind the node One Minus",
        "squared_roughness": "Smoothness, behind the nodes Square Root and One Minus",
        "clearcoat": "Coat Mask",
        "clearcoat_roughness": "Coat Smoothness, behind the node One Minus",
        "emissive": "Emission",
        "occlusion": "Ambient Occlusion",
        "normal": "Normal, with Fragment Normal Space: World in the Graph Settings",
        "alpha": "Alpha",
        "is_hidden": "Alpha, as 0 where it is true, with Alpha Clipping in the Graph Settings",
        "object_position": "Position of the Vertex context",
        "object_normal": "Normal of the Vertex context",
        "position": "Position of the Vertex context, behind the node Transform from Absolute World "
        "to Object, of the type Position",
    },
    turned={
        **dict.fromkeys(("point", "vector", "direction", "normal", "transform", "basis"), BOTH),
        "tangent": ("burnish_turned_tangent({0})", "burnish_turned_tangent({0})"),
    },
    lanes=((0, -1), (1, 1), (2, 1)),
    metre=1,
    data="without sRGB, and not as a normal map: the functions read its lanes as they are",
    interpolated="a Custom Interpolator",
    parts={"object_to_world": (("place", "the node Object, its output Position"),)},
    joined={"object_to_world": "burnish_object_to_world({0}, {place})"},
    has_matrices=True,
)
"""The place of an object is an input of its own, as matrices are relative to the camera in HDRP."""


def functions(surface: Surface) -> str:
    """The text of a file. Raises ``UnfitError``."""
    return file_text(GRAPH, surface, UNPROVEN, _node)


def _node(surface: Surface, given: Given) -> Iterator[str]:
    """The function that a node calls, named ``<name>_float`` for its precision."""
    name = node_name(surface, given)
    textures = list(_textures(surface, given))
    names = Names(each.split()[-1] for each in textures)
    ports, call = nodes_of(GRAPH, surface, given, _of_texture, names)
    result = names.new(f"{given.slot}_out")
    yield f"// The node's name is {name}, and its precision Single."
    yield from result_lines(GRAPH, surface, given)
    yield from port_lines(GRAPH, surface, given, ports)
    output = f"out {node_type(given.signature.returns)} {result}"
    inputs = [f"{port.type} {port.name}" for port in ports]
    head = f"void {name}_float({', '.join([*inputs, *textures, output])}) {{"
    body = f"    {result} = {call};"
    yield from wrapped("\n".join([head, body, "}"]))[0].split("\n")


def _textures(surface: Surface, given: Given) -> Iterator[str]:
    for argument in given.signature.arguments:
        if argument.kind == "texture":
            row = surface.textures[argument.given]
            if row.dimension not in STRUCTURES or row.sample != "float":
                raise UnfitError(row.name, f"it is a {row.type}, and Unity has no such node")
            yield f"{STRUCTURES[row.dimension]} {argument.name}"


def _of_texture(argument: EmittedArgument, texture: str) -> str:
    """A texture or a sampler, of Unity's structure of both."""
    return f"{texture}.tex" if argument.kind == "texture" else f"{texture}.samplerstate"
