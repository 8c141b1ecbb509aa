"""What three.js gives for the arguments of functions: expressions of its shading language (TSL)."""

from __future__ import annotations

from collections.abc import Mapping

from ...compiler.documents.functions import ArgumentRow

SURFACE: Mapping[str, str] = {
    "uv": "uv()",
    "position": "positionWorld",
    "normal": "varying(modelNormalMatrix.mul(normalLocal))",
    "tangent": "varying(modelWorldMatrix.mul(vec4(tangentLocal, 0)).xyz)",
}
"""Values of the surface at each pixel, by the library's word.

Normals and tangents are interpolated as Burnish has them: moved, but not of length one.
"""

PIPELINE: Mapping[str, str] = {
    "front_facing": "frontFacing",
    "vertex_index": "vertexIndex",
    "instance_index": "instanceIndex",
}
"""Values of the pipeline, by Burnish's name."""

ROLES: Mapping[str, str] = {
    "eye": "cameraPosition",
    "object_to_world": "modelWorldMatrix",
    "world_to_clip": "cameraProjectionMatrix.mul(cameraViewMatrix)",
}
"""Parameters of the library that the renderer sets, by their role in a scene."""


def of_renderer(row: ArgumentRow) -> bool:
    """True for a value that the renderer sets; a user's own may have a role, too, by its type."""
    return row.source == "parameter" and row.library is not None and row.role in ROLES


ATTRIBUTES: Mapping[str, str] = {
    "vertex_position": "position",
    "vertex_normal": "normal",
    "vertex_tangent": "tangent",
    "vertex_uv": "uv",
    "vertex_uv2": "uv1",
    "vertex_color": "color",
    "vertex_joints": "skinIndex",
    "vertex_weights": "skinWeight",
}
"""The names of a geometry's attributes, by those of vertex inputs; others keep their names."""


def attribute_name(name: str) -> str:
    """The name of a geometry's attribute; one for each column of a matrix, with its number."""
    return ATTRIBUTES.get(name, name.replace(".", "_"))


AS_PLACED: Mapping[str, str] = {
    "vertex_position": "positionLocal",
    "vertex_normal": "normalLocal",
    "vertex_tangent": 'vec4(tangentLocal, attribute("tangent", "vec4").w)',
}
"""Vertex inputs as functions for vertices read them: bones and instances have moved them."""

VALUES: Mapping[str, str] = {
    "float": "uniform({0})",
    "int": 'uniform({0}, "int")',
    "uint": 'uniform({0}, "uint")',
    "bool": "switched({0})",
    "vec2": "uniform(new Vector2({0}))",
    "vec3": "uniform(new Vector3({0}))",
    "vec4": "uniform(new Vector4({0}))",
    "rgb": "uniform(new Color().setRGB({0}))",
    "ivec2": 'uniform(new Vector2({0}), "ivec2")',
    "ivec3": 'uniform(new Vector3({0}), "ivec3")',
    "ivec4": 'uniform(new Vector4({0}), "ivec4")',
    "uvec2": 'uniform(new Vector2({0}), "uvec2")',
    "uvec3": 'uniform(new Vector3({0}), "uvec3")',
    "uvec4": 'uniform(new Vector4({0}), "uvec4")',
    "mat3": "uniform(new Matrix3().fromArray([{0}]))",
    "mat4": "uniform(new Matrix4().fromArray([{0}]))",
}
"""Uniforms by the type of a parameter; ``{0}`` are the numbers of its default."""

TYPES: Mapping[str, str] = {
    "float": "number", "int": "number", "uint": "number", "bool": "boolean",
    "vec2": "Vector2", "vec3": "Vector3", "vec4": "Vector4", "rgb": "Color",
    "ivec2": "Vector2", "ivec3": "Vector3", "ivec4": "Vector4",
    "uvec2": "Vector2", "uvec3": "Vector3", "uvec4": "Vector4",
    "mat3": "Matrix3", "mat4": "Matrix4",
}  # fmt: skip
"""The types of values in TypeScript."""

TEXTURES: Mapping[str, str] = {
    "texture2d": "texture(texel({0}))",
    "texture2d_array": "texture(layeredTexel({0}))",
    "texture3d": "texture3D(volumeTexel({0}))",
    "texture_cube": "cubeTexture(cubeTexel({0}))",
}
"""Nodes of textures by their type; ``{0}`` are the numbers of the default's only texel."""

TEXTURE_TYPES: Mapping[str, str] = {
    "texture2d": "Texture",
    "texture2d_array": "DataArrayTexture",
    "texture3d": "Data3DTexture",
    "texture_cube": "CubeTexture",
}
"""The types of textures in TypeScript."""

LANES: Mapping[str, int] = {"mat3": 9, "mat4": 16}
"""The numbers of a value, by types whose name does not begin its number of lanes."""


def uniform_type(row: ArgumentRow) -> str:
    """The key of a parameter in ``VALUES`` and ``TYPES``."""
    return "rgb" if row.type == "rgb" else row.representation
