"""Where Filament has the values that functions take, and which it takes itself: its tables.

Filament moves its world to the camera, so that numbers stay small. Functions take places of the
user's world, from which it is shifted: ``getWorldOffset()`` leads back there, in old versions of
Filament as well.
"""

from __future__ import annotations

from ..values import Between, Output, Tables

PREPARE = "prepareMaterial(material);"
"""The statement behind that of the normal, and before all others."""

PREMULTIPLY = "material.baseColor.rgb *= material.baseColor.a;"
"""The statement behind all others where a surface is blended: Filament blends such colours."""

NORMAL = Output("normal", "vec3", "material.normal = normalize({value} * getWorldTangentFrame());")
COORDINATES = {"vec2": "getUV0()"}

OFFSET = "getWorldOffset()"
EYE = f"(getWorldCameraPosition() + {OFFSET})"
USER_FROM_OBJECT = "object_to_user_world()"
TANGENT = "object_tangent()"
"""The tangent of the mesh, which Filament has as a part of a quaternion."""
FROM_OBJECT = "getWorldFromModelMatrix()"
OBJECT_NORMAL = f"normalize(material.worldNormal * mat3({FROM_OBJECT}))"
FRAME = "getWorldTangentFrame()"

TABLES = Tables(
    title="Filament",
    lit=(
        NORMAL,
        Output("base_color", "vec3", "material.baseColor.rgb = {value};"),
        Output("metallic", "float", "material.metallic = {value};"),
        Output("squared_roughness", "float", "material.roughness = sqrt({value});"),
        Output("roughness", "float", "material.roughness = {value};"),
        Output("clearcoat", "float", "material.clearCoat = {value};"),
        Output("clearcoat_roughness", "float", "material.clearCoatRoughness = {value};"),
        Output(
            "emissive",
            "vec3",
            "material.emissive = vec4({value}, 0.0);",
            factor="emissive_strength",
        ),
        Output("occlusion", "float", "material.ambientOcclusion = {value};"),
        Output("alpha", "float", "material.baseColor.a = {value};"),
        Output("is_hidden", "bool", "if ({value}) {{ material.baseColor.a = 0.0; }}"),
    ),
    unlit=(
        Output("color", "vec3", "material.baseColor.rgb = {value};"),
        Output("alpha", "float", "material.baseColor.a = {value};"),
        Output("is_hidden", "bool", "if ({value}) {{ material.baseColor.a = 0.0; }}"),
    ),
    moved=(
        Output(
            "object_position",
            "vec3",
            f"material.worldPosition = {FROM_OBJECT} * vec4({{value}}, 1.0);",
        ),
        Output("position", "vec3", f"material.worldPosition.xyz = {{value}} - {OFFSET};"),
    ),
    at_vertices={
        ("surface", "uv"): "material.uv0",
        ("surface", "position"): f"(material.worldPosition.xyz + {OFFSET})",
        ("surface", "normal"): "material.worldNormal",
        ("attribute", "vertex_position"): "getPosition().xyz",
        ("attribute", "vertex_normal"): OBJECT_NORMAL,
        ("attribute", "vertex_tangent"): TANGENT,
        ("attribute", "vertex_uv"): "material.uv0",
        ("attribute", "vertex_uv2"): "material.uv1",
        ("attribute", "vertex_color"): "material.color",
        ("pipeline", "vertex_index"): "uint(gl_VertexID)",
        ("pipeline", "instance_index"): "uint(gl_InstanceID)",
    },
    at_pixels={
        ("surface", "uv"): "getUV0()",
        ("surface", "position"): f"(getWorldPosition() + {OFFSET})",
        ("surface", "normal"): f"{FRAME}[2]",
        ("surface", "tangent"): f"{FRAME}[0]",
        ("attribute", "vertex_position"): Between("vec3", "object_position", "getPosition().xyz"),
        ("attribute", "vertex_normal"): Between("vec3", "object_normal", OBJECT_NORMAL),
        ("attribute", "vertex_tangent"): Between("vec4", "object_tangent", TANGENT),
        ("attribute", "vertex_uv"): "getUV0()",
        ("attribute", "vertex_uv2"): "getUV1()",
        ("attribute", "vertex_color"): "getColor()",
        ("pipeline", "frag_coord"): "gl_FragCoord",
        ("pipeline", "front_facing"): "gl_FrontFacing",
    },
    vertex_roles={"object_to_world": USER_FROM_OBJECT, "eye": EYE},
    pixel_roles={"eye": EYE},
    own_inputs=tuple(f"getCustom{number}()" for number in range(8)),
    interpolated=frozenset({"float", "vec2", "vec3", "vec4"}),
    lanes={"float": ".x", "vec2": ".xy", "vec3": ".xyz", "vec4": ""},
    parameter="materialParams.{name}",
    texture="materialParams_{name}",
    between="variable_{name}{lanes}",
    hand_over="material.{name}{lanes} = {value};",
)

HELPERS = {
    USER_FROM_OBJECT: f"""\
mat4 {USER_FROM_OBJECT} {{
    mat4 found = {FROM_OBJECT};
    found[3].xyz += {OFFSET};
    return found;
}}""",
    TANGENT: f"""\
/// The sign of a mesh's quaternion is that of the bitangent.
vec4 {TANGENT} {{
    vec3 normal, tangent;
    toTangentFrame(mesh_tangents, normal, tangent);
    return vec4(tangent, mesh_tangents.w < 0.0 ? -1.0 : 1.0);
}}""",
}
"""Functions of a vertex shader, by the calls for which it has them."""

REQUIRED = {
    "getUV0()": "uv0", "material.uv0": "uv0", "getUV1()": "uv1", "material.uv1": "uv1",
    "getColor()": "color", "material.color": "color",
    "getWorldTangentFrame()": "tangents", TANGENT: "tangents", "material.worldNormal": "tangents",
    "getPosition()": "position",
    **{f"getCustom{number}()": f"custom{number}" for number in range(8)},
}  # fmt: skip
"""The vertex inputs that a definition requires, by what reads them."""
VARIABLES = 4
"""The values that vertices can hand to pixels."""
