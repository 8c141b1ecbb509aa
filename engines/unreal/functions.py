"""Writes a material as a file that Custom nodes include: ``engine.py`` has it in its row.

A node's inputs are its arguments. A texture input called ``X`` brings ``XSampler`` along.
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
    texture_name,
)
from ..surface import Given, Surface, UnfitError

UNPROVEN = "Never compiled by Unreal's own compiler."
DIMENSIONS = ("2d", "2d_array", "3d", "cube")

TOLD = """\
// Unreal's z runs upwards, and its lengths are centimetres. The functions have y upwards, and
// metres: y and z change places, as in imported files of glTF. The functions of the nodes turn
// places, directions and normals, so nodes give and take Unreal's own.
#ifndef BURNISH_IN_UNREAL
#define BURNISH_IN_UNREAL

float3 burnish_place(float3 p) {
    return p.xzy / 100;
}

float3 burnish_unreal_place(float3 p) {
    return p.xzy * 100;
}

float3 burnish_turned(float3 v) {
    return v.xzy;
}

float4 burnish_turned_tangent(float4 t) {
    return float4(t.xzy, -t.w);
}

float4x4 burnish_object_to_world(float3 x, float3 y, float3 z, float3 place) {
    return transpose(float4x4(
        float4(x.xzy, 0), float4(z.xzy, 0), float4(y.xzy, 0), float4(burnish_place(place), 1)
    ));
}

#endif"""

PLACES = ("burnish_place({0})", "burnish_unreal_place({0})")
WAYS = ("burnish_turned({0})", "burnish_turned({0})")
_AXIS = "TransformVector of {0}, from Local Space to World Space"
GRAPH = Graph(
    title="Unreal",
    product="Unreal Engine",
    told=TOLD,
    nodes={
        ("surface", "uv"): "TexCoord",
        ("surface", "position"): "Absolute World Position",
        ("surface", "normal"): "VertexNormalWS",
        ("surface", "tangent"): "VertexTangentWS",
        ("attribute", "vertex_position"): "PreSkinnedPosition",
        ("attribute", "vertex_normal"): "PreSkinnedNormal",
        ("attribute", "vertex_tangent"): "TransformVector of VertexTangentWS, from World Space to "
        "Local Space; its w is 1 where the bitangent is cross(normal, tangent), and -1 elsewhere",
        ("attribute", "vertex_uv"): "TexCoord",
        ("attribute", "vertex_uv2"): "TexCoord, of the index 1",
        ("attribute", "vertex_color"): "Vertex Color",
        ("pipeline", "front_facing"): "TwoSidedSign, which is 1 or -1",
        ("pipeline", "frag_coord"): "a Custom node whose code is `return Parameters.SvPosition;`",
        ("role", "eye"): "Camera Position",
    },
    outputs={
        "base_color": "Base Color",
        "color": "Emissive Color, with the shading model Unlit",
        "metallic": "Metallic",
        "roughness": "Roughness",
        "squared_roughness": "Roughness, behind SquareRoot",
        "clearcoat": "Clear Coat, with the shading model Clear Coat",
        "clearcoat_roughness": "Clear Coat Roughness",
        "emissive": "Emissive Color",
        "occlusion": "Ambient Occlusion",
        "normal": "Normal, with Tangent Space Normal off in the material's details",
        "alpha": "Opacity",
        "is_hidden": "Opacity Mask, behind OneMinus, with the blend mode Masked",
        "object_normal": "Normal, behind VertexInterpolator and TransformVector from Local Space "
        "to World Space, with Tangent Space Normal off in the material's details",
        "position": "World Position Offset, less Absolute World Position (Excluding Material "
        "Shader Offsets)",
        "object_position": "World Position Offset, behind TransformPosition from Local Space to "
        "Absolute World Space, less Absolute World Position (Excluding Material Shader Offsets)",
    },
    turned={
        **dict.fromkeys(("point", "vector"), PLACES),
        **dict.fromkeys(("direction", "normal"), WAYS),
        "tangent": ("burnish_turned_tangent({0})", "burnish_turned_tangent({0})"),
    },
    lanes=((0, 1), (2, 1), (1, 1)),
    metre=100,
    data="without sRGB, with the compression VectorDisplacementmap or Masks: the functions read "
    "its lanes as they are, and unpack normals themselves",
    interpolated="the node VertexInterpolator",
    parts={
        "object_to_world": (
            ("x", _AXIS.format("(1, 0, 0)")),
            ("y", _AXIS.format("(0, 1, 0)")),
            ("z", _AXIS.format("(0, 0, 1)")),
            ("place", "TransformPosition of (0, 0, 0), from Local Space to Absolute World Space"),
        )
    },
    joined={"object_to_world": "burnish_object_to_world({x}, {y}, {z}, {place})"},
    has_matrices=False,
    ports={("pipeline", "front_facing"): ("float", "{0} > 0")},
)


def functions(surface: Surface) -> str:
    """The text of a file. Raises ``UnfitError``."""
    return file_text(GRAPH, surface, UNPROVEN, _node)


def _node(surface: Surface, given: Given) -> Iterator[str]:
    """The function that the code of a Custom node calls."""
    name = node_name(surface, given)
    returns = node_type(given.signature.returns)
    if "x" in returns:  # A matrix, such as float3x3.
        yield f"// No node returns {given.slot}, which is a {given.type}."
        return
    textures = list(_textures(surface, given))
    of_textures = [each.split()[-1] for each in textures]
    ports, call = nodes_of(GRAPH, surface, given, _of_texture, Names(of_textures))
    names = [*(port.name for port in ports), *of_textures]
    yield f"// {given.slot}, of the type {returns}. The code of the Custom node:"
    yield f"//     return {name}({', '.join(names)});"
    yield from result_lines(GRAPH, surface, given)
    yield from port_lines(GRAPH, surface, given, ports)
    inputs = [f"{port.type} {port.name}" for port in ports]
    head = f"{returns} {name}({', '.join([*inputs, *textures])}) {{"
    body = f"    return {call};"
    yield from wrapped("\n".join([head, body, "}"]))[0].split("\n")


def _textures(surface: Surface, given: Given) -> Iterator[str]:
    """The textures and samplers of a function; the editor names samplers."""
    for argument in given.signature.arguments:
        if argument.kind == "texture":
            row = surface.textures[argument.given]
            if row.dimension not in DIMENSIONS or row.sample != "float":
                raise UnfitError(row.name, f"it is a {row.type}, and no input of a node is one")
        if argument.kind != "value":
            yield f"{argument.type} {_of_texture(argument, texture_name(given, argument))}"


def _of_texture(argument: EmittedArgument, texture: str) -> str:
    """A texture or a sampler, by the name that the editor gives it."""
    return texture if argument.kind == "texture" else f"{texture}Sampler"
