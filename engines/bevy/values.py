"""Where Bevy has the values that functions take, and which it takes itself: its tables.

``pixel`` is what a fragment shader of Bevy gets, ``given`` what a vertex shader gets, and
``vertex`` what the material makes of that.
"""

from __future__ import annotations

from ..values import Between, Output, Tables

MODULES = (
    "clustered", "mesh_functions", "mesh_view_bindings", "pbr_bindings", "pbr_deferred_functions",
    "pbr_fragment", "pbr_functions", "pbr_prepass_functions", "pbr_types", "skinning",
    "view_transformations",
)  # fmt: skip
"""Modules of Bevy's shaders that files import by these names."""

HIDDEN = Output("is_hidden", "bool", "if ({value}) {{ discard; }}")
ALPHA = Output("alpha", "float", "pbr_input.material.base_color.a = {value};")
NORMAL = "normalize({value})"
EYE = "mesh_view_bindings::view.world_position"
SIZE = "vec2<i32>(mesh_view_bindings::view.viewport.zw)"

TYPES = {
    "float": "f32", "int": "i32", "uint": "u32",
    **{f"{prefix}vec{lanes}": f"vec{lanes}<{lane}>"
       for prefix, lane in (("", "f32"), ("i", "i32"), ("u", "u32")) for lanes in (2, 3, 4)},
    **{f"mat{lanes}": f"mat{lanes}x{lanes}<f32>" for lanes in (2, 3, 4)},
}  # fmt: skip
"""Types that uniforms have, in WGSL."""

FIRST_LOCATION = 10
"""The first location between vertices and pixels that Bevy leaves free."""
LOCATIONS = 6
"""Locations that are left then, of the 16 that WebGPU promises."""

ATTRIBUTES = {
    "position": "POSITION", "normal": "NORMAL", "tangent": "TANGENT", "uv": "UV_0", "uv_b": "UV_1",
    "color": "COLOR",
}  # fmt: skip
"""Bevy's constants of vertex inputs, by the members that shaders read."""

TABLES = Tables(
    title="Bevy",
    lit=(
        HIDDEN,
        Output(
            "base_color",
            "vec3",
            "pbr_input.material.base_color = vec4<f32>({value}, pbr_input.material.base_color.a);",
        ),
        Output("metallic", "float", "pbr_input.material.metallic = {value};"),
        Output(
            "squared_roughness", "float", "pbr_input.material.perceptual_roughness = sqrt({value});"
        ),
        Output("roughness", "float", "pbr_input.material.perceptual_roughness = {value};"),
        Output(
            "ior",
            "float",
            "pbr_input.material.ior = {value};\n"
            "pbr_input.material.reflectance = vec3<f32>(\n"
            "    2.5 * abs(pbr_input.material.ior - 1.0) / (pbr_input.material.ior + 1.0)\n"
            ");",
        ),
        Output("transmission", "float", "pbr_input.material.specular_transmission = {value};"),
        Output("thickness", "float", "pbr_input.material.thickness = {value};"),
        Output("clearcoat", "float", "pbr_input.material.clearcoat = {value};"),
        Output(
            "clearcoat_roughness",
            "float",
            "pbr_input.material.clearcoat_perceptual_roughness = {value};",
        ),
        Output(
            "emissive",
            "vec3",
            "pbr_input.material.emissive = vec4<f32>({value}, pbr_input.material.emissive.a);",
            factor="emissive_strength",
        ),
        Output("occlusion", "vec3", "pbr_input.diffuse_occlusion *= {value};"),
        Output("normal", "vec3", f"pbr_input.N = {NORMAL};"),
        ALPHA,
    ),
    unlit=(
        HIDDEN,
        Output(
            "color",
            "vec3",
            "pbr_input.material.base_color = vec4<f32>({value}, pbr_input.material.base_color.a);",
        ),
        ALPHA,
    ),
    moved=(
        Output("object_position", "vec3", "vertex.position = {value};"),
        Output("object_normal", "vec3", "vertex.normal = {value};"),
        Output("position", "vec3", "world_position = vec4<f32>({value}, 1.0);"),
    ),
    at_vertices={
        ("surface", "uv"): "given.uv",
        ("surface", "position"): "world_position.xyz",
        ("surface", "normal"): "world_normal",
        ("attribute", "vertex_position"): "given.position",
        ("attribute", "vertex_normal"): "given.normal",
        ("attribute", "vertex_tangent"): "given.tangent",
        ("attribute", "vertex_uv"): "given.uv",
        ("attribute", "vertex_uv2"): "given.uv_b",
        ("attribute", "vertex_color"): "given.color",
        ("pipeline", "instance_index"): "given.instance_index",
    },
    at_pixels={
        ("surface", "uv"): "pixel.uv",
        ("surface", "position"): "pixel.world_position.xyz",
        ("surface", "normal"): "pixel.world_normal",
        ("surface", "tangent"): "pixel.world_tangent.xyz",
        ("attribute", "vertex_position"): Between("vec3", "object_position", "given.position"),
        ("attribute", "vertex_normal"): Between("vec3", "object_normal", "given.normal"),
        ("attribute", "vertex_tangent"): Between("vec4", "object_tangent", "given.tangent"),
        ("attribute", "vertex_uv"): "pixel.uv",
        ("attribute", "vertex_uv2"): "pixel.uv_b",
        ("attribute", "vertex_color"): "pixel.color",
        ("pipeline", "frag_coord"): "pixel.position",
        ("pipeline", "front_facing"): "front_facing",
    },
    vertex_roles={"object_to_world": "world_from_local", "eye": EYE, "size": SIZE},
    pixel_roles={
        "object_to_world": "mesh_functions::get_world_from_local(pixel.instance_index)",
        "eye": EYE,
        "size": SIZE,
    },
    interpolated=frozenset(TYPES) - {"mat2", "mat3", "mat4"},
    parameter="parameters.{name}",
    hand_over="out.{name} = {value};",
)

DEPTHS = (
    HIDDEN,
    Output("alpha", "float", "let coverage = {value};"),
)
"""What a pixel is of which only the depth is drawn: what decides if it is there."""
NORMALS = (Output("normal", "vec3", f"out.normal = vec4<f32>({NORMAL} * 0.5 + 0.5, 1.0);"),)
"""What is drawn of a pixel beside its depth."""
