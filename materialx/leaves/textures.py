"""Nodes that read textures."""

from __future__ import annotations

from ..expressions import Call, Expression, Member, Name
from .application import Application, Row


def _image(node: Application) -> Expression:
    texture = node.texture("file")
    if texture is None:
        return node.input("default")
    return _lanes(Call(_name(texture), (upright(node, node.input("texcoord")),)), node.type)


def upright(node: Application, st: Expression) -> Expression:
    """A coordinate as Burnish reads textures: v downwards."""
    if st == Name("st"):
        return Name("uv")
    return Call(node.library("upright"), (st,))


def _name(texture: Expression) -> str:
    assert isinstance(texture, Name)
    return texture.text


def _lanes(texel: Expression, kind: str) -> Expression:
    lanes = {"float": "r", "vector2": "xy", "vector3": "xyz", "color3": "rgb"}
    return Member(texel, lanes[kind]) if kind in lanes else texel


_HEXAGONS = (
    "texcoord", "tiling", "rotation", "rotationrange", "scale", "scalerange", "offset", "offsetrange", "falloff",
)  # fmt: skip


def _hexagonal(node: Application) -> Expression:
    texture = node.texture("file")
    if texture is None:
        return node.input("default")
    inputs = node.inputs(*_HEXAGONS, "falloffcontrast", "lumacoeffs")
    read = Call(node.library("hextiledimage"), (texture, *inputs))
    return _lanes(read, node.type)


def _hexagonal_normals(node: Application) -> Expression:
    texture = node.texture("file")
    inputs = node.inputs(*_HEXAGONS, "strength", "flip_g", "normal", "tangent", "bitangent")
    if texture is None:
        return node.input("normal")
    return Call(node.library("hextilednormalmap"), (texture, *inputs))


ROWS: dict[str, Row] = {
    "image": _image,
    "hextiledimage": _hexagonal,
    "hextilednormalmap": _hexagonal_normals,
}
