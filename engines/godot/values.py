"""Where Godot has the values that functions take: tables of rows.

A vertex shader works in the space of the object, a fragment shader in that of the camera. Values
of the world come from the vertices, as varyings, so that they are what Burnish means by them.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...support.frozen import frozen


@frozen
class Between:
    """A value that vertices hand to pixels."""

    type: str
    name: str
    value: str
    """What a vertex has of it."""


WORLD_POSITION = Between("vec3", "world_position", "(MODEL_MATRIX * vec4(VERTEX, 1.0)).xyz")
WORLD_NORMAL = Between("vec3", "world_normal", "MODEL_NORMAL_MATRIX * NORMAL")
WORLD_TANGENT = Between("vec3", "world_tangent", "(MODEL_MATRIX * vec4(TANGENT, 0.0)).xyz")

TANGENT_WITH_SIGN = "vec4(TANGENT, sign(dot(cross(NORMAL, TANGENT), BINORMAL)))"

AT_VERTICES: Mapping[tuple[str, str], str] = {
    ("surface", "uv"): "UV",
    ("surface", "position"): WORLD_POSITION.value,
    ("surface", "normal"): WORLD_NORMAL.value,
    ("surface", "tangent"): WORLD_TANGENT.value,
    ("attribute", "vertex_position"): "VERTEX",
    ("attribute", "vertex_normal"): "NORMAL",
    ("attribute", "vertex_tangent"): TANGENT_WITH_SIGN,
    ("attribute", "vertex_uv"): "UV",
    ("attribute", "vertex_uv2"): "UV2",
    ("attribute", "vertex_color"): "COLOR",
    ("pipeline", "vertex_index"): "uint(VERTEX_ID)",
    ("pipeline", "instance_index"): "uint(INSTANCE_ID)",
    ("pipeline", "view_index"): "uint(VIEW_INDEX)",
}
"""What a vertex has, by the source of an argument and what that calls it."""

AT_PIXELS: Mapping[tuple[str, str], str | Between] = {
    ("surface", "uv"): "UV",
    ("surface", "position"): WORLD_POSITION,
    ("surface", "normal"): WORLD_NORMAL,
    ("surface", "tangent"): WORLD_TANGENT,
    ("attribute", "vertex_position"): Between("vec3", "object_position", "VERTEX"),
    ("attribute", "vertex_normal"): Between("vec3", "object_normal", "NORMAL"),
    ("attribute", "vertex_tangent"): Between("vec4", "object_tangent", TANGENT_WITH_SIGN),
    ("attribute", "vertex_uv"): "UV",
    ("attribute", "vertex_uv2"): "UV2",
    ("attribute", "vertex_color"): "COLOR",
    ("pipeline", "frag_coord"): "FRAGCOORD",
    ("pipeline", "front_facing"): "FRONT_FACING",
    ("pipeline", "view_index"): "uint(VIEW_INDEX)",
}
"""What a pixel has, likewise."""

ROLES: Mapping[str, str] = {
    "object_to_world": "MODEL_MATRIX",
    "eye": "CAMERA_POSITION_WORLD",
    "size": "ivec2(VIEWPORT_SIZE)",
}
"""Parameters that Godot sets itself, by their role in a scene."""


@frozen
class Output:
    """A value of a surface that Godot takes."""

    input: str
    """The row of the table of all engines."""
    type: str
    """The type that Godot takes."""
    statement: str
    factor: str = ""
    """Another row, by which the value is multiplied if the material gives it."""


OUTPUTS = (
    Output("is_hidden", "bool", "if ({value}) {{\n        discard;\n    }}"),
    Output("base_color", "vec3", "ALBEDO = {value};"),
    Output("metallic", "float", "METALLIC = {value};"),
    Output("squared_roughness", "float", "ROUGHNESS = sqrt({value});"),
    Output("roughness", "float", "ROUGHNESS = {value};"),
    Output("clearcoat", "float", "CLEARCOAT = {value};"),
    Output("clearcoat_roughness", "float", "CLEARCOAT_ROUGHNESS = {value};"),
    Output("emissive", "vec3", "EMISSION = {value};", factor="emissive_strength"),
    Output("occlusion", "float", "AO = {value};"),
    Output("normal", "vec3", "NORMAL = normalize((VIEW_MATRIX * vec4({value}, 0.0)).xyz);"),
    Output("alpha", "float", "ALPHA = {value};"),
)
"""What a pixel of a surface that Godot lights is."""

UNLIT = (
    OUTPUTS[0],
    Output("color", "vec3", "ALBEDO = {value};"),
    Output("alpha", "float", "ALPHA = {value};"),
)
"""What a pixel of a surface is that needs no light."""

MOVED = (
    Output("object_position", "vec3", "VERTEX = {value};"),
    Output("object_normal", "vec3", "NORMAL = {value};"),
    Output("position", "vec3", "VERTEX = (inverse(MODEL_MATRIX) * vec4({value}, 1.0)).xyz;"),
)
"""Where a vertex is."""
