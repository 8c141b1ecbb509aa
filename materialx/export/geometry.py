"""Slots and vertex inputs of the library as nodes that read the mesh."""

from __future__ import annotations

import re

from ...compiler.syntax import ast
from ..leaves.geometry import SLOTS
from .lanes import upright
from .nodes import Nodes
from .unsayable import UnsayableError
from .values import Constant, Value, type_named, vector

_OF_SURFACE = {
    "position": "position_world",
    "normal": "normal_world",
    "tangent": "tangent_world",
    "bitangent": "bitangent_world",
}
"""Slots of all surfaces, and those of ``std.mtlx.surface`` that have the same values."""
_SEEN = {
    ("position", "object"): "position_object", ("position", "world"): "position_world",
    ("normal", "object"): "normal_object", ("normal", "world"): "normal_world",
    ("tangent", "object"): "tangent_object", ("tangent", "world"): "tangent_world",
    ("object_position", "object"): "position_object",
    ("object_normal", "object"): "normal_object",
}  # fmt: skip
_COORDINATES = re.compile(r"vertex_uv(\d+)")
_COLORS = re.compile(r"vertex_color(?:_(\d+))?")
_NAMED = re.compile(r"`(\w+)` of the mesh")


def property_of(nodes: Nodes, owner: str, name: str) -> Value | None:
    """The node for a slot of a record of the library; nothing if it has none of its own."""
    if owner == "MaterialXSurface" and name in SLOTS:
        return _slot(nodes, name)
    if owner in ("Surface", "Tangents"):
        if name in _OF_SURFACE:
            return _slot(nodes, _OF_SURFACE[name])
        if name in ("uv", "vertex_uv"):
            return upright(nodes, _slot(nodes, "st"))
        if name == "to_eye":
            return nodes.node(
                "multiply", {"in1": _slot(nodes, "view_world"), "in2": vector((-1,), "float")}
            )
    return None


def seen_from(nodes: Nodes, name: str, space: str) -> Value | None:
    """A place or a direction of the mesh as it is seen from a space."""
    slot = _SEEN.get((name, space))
    return None if slot is None else _slot(nodes, slot)


def _slot(nodes: Nodes, name: str) -> Value:
    category, texts = SLOTS[name]
    kind = {"st": "vector2", "time": "float", "frame": "float"}.get(name, "vector3")
    return nodes.node(category, texts, kind)


def attribute(nodes: Nodes, member: ast.Attribute) -> Value:
    """The node for a vertex input of a material."""
    name, kind = member.name.text, type_named(member.type)
    found = _COORDINATES.fullmatch(name)
    if found is not None and kind == "vector2":
        index = Constant("integer", (float(int(found[1]) - 1),))
        return upright(nodes, nodes.node("texcoord", {"index": index}, "vector2"))
    found = _COLORS.fullmatch(name)
    if found is not None and kind == "vector4":
        index = Constant("integer", (float(found[1] or 0),))
        return nodes.node("geomcolor", {"index": index}, "color4")
    if not kind or member.rate is not None:
        raise UnsayableError(f"MaterialX reads no `{member.type.span.text}` of a mesh")
    told = _NAMED.search(member.doc)
    return nodes.node("geompropvalue", {"geomprop": told[1] if told else name}, kind, must=True)
