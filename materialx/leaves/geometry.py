"""Nodes that read the surface: its place, its axes, what the mesh and the host bring along."""

from __future__ import annotations

from collections.abc import Mapping

from ..constants import PROPERTIES
from ..expressions import Binary, Call, Expression, Member, Name, Number
from ..names import slot_name
from ..networks import Application, Row
from ..problems import UnsupportedError
from ..values import BARE, LANES, TYPES


def _in_space(name: str) -> Row:
    def row(node: Application) -> Expression:
        space = node.static("space") or "object"
        # MaterialX's generators know model space as that of the object.
        space = {"model": "object"}.get(space, space)
        if space not in ("object", "world"):
            raise UnsupportedError(f"there is no space '{space}'")
        if node.has("index") and _index(node):
            raise UnsupportedError("only the first tangents of a mesh are read")
        return node.texts.surface(f"{name}_{space}")

    return row


def _index(node: Application) -> int:
    index = node.input("index")
    if not isinstance(index, Name) or not index.text.isdigit():
        raise UnsupportedError("the index of a set has to be a number")
    return int(index.text)


def _view_direction(node: Application) -> Expression:
    space = node.static("space") or "world"
    if space not in ("world", "object", "model"):
        raise UnsupportedError(f"there is no space '{space}'")
    return node.texts.surface("view_world" if space == "world" else "view_object")


def _coordinates(node: Application) -> Expression:
    index = _index(node)
    if index == 0:
        found = node.texts.surface("st")
    else:
        # Meshes have v downwards, as the first coordinates do.
        name = node.texts.attribute(f"vertex_uv{index + 1}", "vec2", "Further texture coordinates")
        found = Call(node.library("upright"), (Name(name),))
    return Call("vec3", (found, Number(0.0))) if LANES[node.type] == 3 else found


def _vertex_color(node: Application) -> Expression:
    index = _index(node)
    name = f"vertex_color_{index}" if index else "vertex_color"
    found = Name(node.texts.attribute(name, "vec4", "Painted on the mesh"))
    lanes = {"float": "x", "color3": "rgb"}
    return Member(found, lanes[node.type]) if node.type in lanes else found


def _property(node: Application) -> Expression:
    name = node.static("geomprop")
    if not name:
        raise UnsupportedError("a geometric property has to have a name")
    if name in PROPERTIES and BARE[node.type] in ("vec2", "vec3"):
        return node.texts.surface(PROPERTIES[name])
    if node.type not in LANES and node.type not in ("integer", "boolean"):
        raise UnsupportedError(f"a property of the type {node.type} cannot be read from a mesh")
    kind = {"boolean": "int"}.get(TYPES[node.type], TYPES[node.type])
    kind = BARE.get(node.type, kind) if node.type != "boolean" else "int"
    found = Name(node.texts.attribute(slot_name(name), kind, f"`{name}` of the mesh"))
    return Binary("!=", found, Name("0")) if node.type == "boolean" else found


def _of_file(_node: Application) -> Expression:
    raise UnsupportedError("texts of the mesh are known to no shader")


def _time(node: Application) -> Expression:
    return node.texts.surface("time")


def _frame(node: Application) -> Expression:
    return node.texts.surface("frame")


def _transformed(kind: str) -> Row:
    def row(node: Application) -> Expression:
        value = node.input("in")
        spaces = [
            {"model": "object"}.get(space, space)
            for space in (node.static("fromspace"), node.static("tospace"))
        ]
        if spaces[0] == spaces[1]:
            return Call("normalize", (value,)) if kind == "normal" else value
        if sorted(spaces) != ["object", "world"]:
            raise UnsupportedError(f"there is no way from the space '{spaces[0]}' to '{spaces[1]}'")
        name = node.library(f"{kind}_to_{spaces[1]}")
        return Call(name, (value,))

    return row


PLACED = ("position", "normal", "tangent", "bitangent")
"""Nodes that are slots of ``std.mtlx.surface`` in two spaces, such as ``normal_world``."""
SLOTS: Mapping[str, tuple[str, Mapping[str, str]]] = {
    **{
        f"{name}_{space}": (name, {"space": space})
        for name in PLACED
        for space in ("object", "world")
    },
    "view_world": ("viewdirection", {"space": "world"}),
    "view_object": ("viewdirection", {"space": "object"}),
    "st": ("texcoord", {}),
    "time": ("time", {}),
    "frame": ("frame", {}),
}
"""The slots of ``std.mtlx.surface`` as nodes with their texts: the converse of the rows."""
MOVED = {
    f"{kind}_to_{space}": (f"transform{kind}", {"fromspace": other, "tospace": space})
    for kind in ("point", "vector", "normal")
    for space, other in (("world", "object"), ("object", "world"))
}
"""The functions of ``std.mtlx.surface`` that move something from space to space, as nodes."""

ROWS: dict[str, Row] = {
    **{name: _in_space(name) for name in PLACED},
    "viewdirection": _view_direction,
    "texcoord": _coordinates,
    "geomcolor": _vertex_color,
    "geompropvalue": _property,
    "geompropvalueuniform": _of_file,
    "time": _time,
    "frame": _frame,
    "transformpoint": _transformed("point"),
    "transformvector": _transformed("vector"),
    "transformnormal": _transformed("normal"),
}
