"""Where Godot has the values that functions take, and which it takes itself: its tables.

A vertex shader works in the space of the object, a fragment shader in that of the camera. Values
of the world come from the vertices, as varyings, so that they are what Burnish means by them.
"""

from __future__ import annotations

from ..values import Between, Output, Tables
from .uniforms import TYPES

WORLD_POSITION = "(MODEL_MATRIX * vec4(VERTEX, 1.0)).xyz"
WORLD_NORMAL = "MODEL_NORMAL_MATRIX * NORMAL"
WORLD_TANGENT = "(MODEL_MATRIX * vec4(TANGENT, 0.0)).xyz"
TANGENT_WITH_SIGN = "vec4(TANGENT, sign(dot(cross(NORMAL, TANGENT), BINORMAL)))"

TO_CLIP = (
    "mat4(vec4(1.0, 0.0, 0.0, 0.0), vec4(0.0, sign(PROJECTION_MATRIX[1][1]), 0.0, 0.0), "
    "vec4(0.0, 0.0, -1.0, 0.0), vec4(0.0, 0.0, 1.0, 1.0))"
)
"""Turns depths from 0 to 1 around, as Godot's near plane is at 1, and rows as its camera does."""

HIDDEN = Output("is_hidden", "bool", "if ({value}) {{ discard; }}")
ALPHA = Output("alpha", "float", "ALPHA = {value};")

ROLES = {
    "object_to_world": "MODEL_MATRIX",
    "eye": "CAMERA_POSITION_WORLD",
    "size": "ivec2(VIEWPORT_SIZE)",
}

TABLES = Tables(
    title="Godot",
    lit=(
        HIDDEN,
        Output("base_color", "vec3", "ALBEDO = {value};"),
        Output("metallic", "float", "METALLIC = {value};"),
        Output("squared_roughness", "float", "ROUGHNESS = sqrt({value});"),
        Output("roughness", "float", "ROUGHNESS = {value};"),
        Output("clearcoat", "float", "CLEARCOAT = {value};"),
        Output("clearcoat_roughness", "float", "CLEARCOAT_ROUGHNESS = {value};"),
        Output("emissive", "vec3", "EMISSION = {value};", factor="emissive_strength"),
        Output("occlusion", "float", "AO = {value};"),
        Output("normal", "vec3", "NORMAL = normalize((VIEW_MATRIX * vec4({value}, 0.0)).xyz);"),
        ALPHA,
    ),
    unlit=(HIDDEN, Output("color", "vec3", "ALBEDO = {value};"), ALPHA),
    moved=(
        Output("object_position", "vec3", "VERTEX = {value};"),
        Output("object_normal", "vec3", "NORMAL = {value};"),
        Output("clip_position", "vec4", f"POSITION = {TO_CLIP} * {{value}};"),
        Output("position", "vec3", "VERTEX = (inverse(MODEL_MATRIX) * vec4({value}, 1.0)).xyz;"),
    ),
    at_vertices={
        ("surface", "uv"): "UV",
        ("surface", "position"): WORLD_POSITION,
        ("surface", "normal"): WORLD_NORMAL,
        ("surface", "tangent"): WORLD_TANGENT,
        ("attribute", "vertex_position"): "VERTEX",
        ("attribute", "vertex_normal"): "NORMAL",
        ("attribute", "vertex_tangent"): TANGENT_WITH_SIGN,
        ("attribute", "vertex_uv"): "UV",
        ("attribute", "vertex_uv2"): "UV2",
        ("attribute", "vertex_color"): "COLOR",
        ("pipeline", "vertex_index"): "uint(VERTEX_ID)",
        ("pipeline", "instance_index"): "uint(INSTANCE_ID)",
        ("pipeline", "view_index"): "uint(VIEW_INDEX)",
    },
    at_pixels={
        ("surface", "uv"): "UV",
        ("surface", "position"): Between("vec3", "world_position", WORLD_POSITION, is_moved=True),
        ("surface", "normal"): Between("vec3", "world_normal", WORLD_NORMAL, is_moved=True),
        ("surface", "tangent"): Between("vec3", "world_tangent", WORLD_TANGENT, is_moved=True),
        ("attribute", "vertex_position"): Between("vec3", "object_position", "VERTEX"),
        ("attribute", "vertex_normal"): Between("vec3", "object_normal", "NORMAL"),
        ("attribute", "vertex_tangent"): Between("vec4", "object_tangent", TANGENT_WITH_SIGN),
        ("attribute", "vertex_uv"): "UV",
        ("attribute", "vertex_uv2"): "UV2",
        ("attribute", "vertex_color"): "COLOR",
        ("pipeline", "frag_coord"): "FRAGCOORD",
        ("pipeline", "front_facing"): "FRONT_FACING",
        ("pipeline", "view_index"): "uint(VIEW_INDEX)",
    },
    vertex_roles=ROLES,
    pixel_roles=ROLES,
    own_inputs=("CUSTOM0", "CUSTOM1", "CUSTOM2", "CUSTOM3"),
    interpolated=TYPES,
)
