"""Nodes that read textures."""

from __future__ import annotations

from ..expressions import Call, Expression, Member, Name
from ..networks import Application, Row
from .catalogue import application


def _image(node: Application) -> Expression:
    texture = node.texture("file")
    assert isinstance(texture, Name)
    return _lanes(Call(texture.text, (upright(node, node.input("texcoord")),)), node.type)


def upright(node: Application, st: Expression) -> Expression:
    """A coordinate as Burnish reads textures: v downwards."""
    if st == Name("st"):
        return Name("uv")
    return Call(node.library("upright"), (st,))


def _lanes(texel: Expression, kind: str) -> Expression:
    lanes = {"float": "r", "vector2": "xy", "vector3": "xyz", "color3": "rgb"}
    return Member(texel, lanes[kind]) if kind in lanes else texel


def _hexagonal(node: Application) -> Expression:
    return _lanes(application(node), node.type)


ROWS: dict[str, Row] = {
    "image": _image,
    "hextiledimage": _hexagonal,
}
