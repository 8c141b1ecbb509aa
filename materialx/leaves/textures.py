"""Nodes that read textures."""

from __future__ import annotations

from ..expressions import Call, Expression, Member, Name, Number
from ..networks import Application, Row
from ..values import LANES, literal
from .catalogue import application


def _image(node: Application) -> Expression:
    texture = node.texture("file")
    assert isinstance(texture, Name)
    tiles = node.network.files.tiles(node.node, "file", node.scope)
    if tiles:
        numbers = Name(f"[{', '.join(map(str, tiles))}]")
        given = (texture, node.input("texcoord"), numbers, _beyond(node))
        return _lanes(Call(node.library("udim_set"), given), node.type)
    place = upright(node, node.input("texcoord"))
    axes = node.network.files.borders(node.node, "file", node.scope)
    if not any(axes):
        return _lanes(node.texts.read(texture.text, place), node.type)
    is_filtered = node.static("filtertype") != "closest"
    function = node.library("bordered" if is_filtered else "bordered_nearest")
    sides = literal(", ".join("1" if is_bordered else "0" for is_bordered in axes), "vector2")
    return _lanes(Call(function, (texture, place, sides, _beyond(node))), node.type)


def _beyond(node: Application) -> Expression:
    """The colour beyond the borders of an image, with four lanes. It is encoded as the file is."""
    color = node.input("default")
    if color == literal("0", node.type):
        return Call("vec4", (Number(0.0),))
    if node.network.files.is_encoded(node.node, "file", node.scope):
        color = Call(node.library("from_srgb_texture"), (color,))
    lanes = LANES[node.type]
    if lanes == 1:
        return Call("vec4", (color,))
    missing = tuple(Number(0.0) for _ in range(4 - lanes))
    return Call("vec4", (color, *missing)) if missing else color


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
