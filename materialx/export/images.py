"""Textures as nodes that read files, with their colour spaces and how they are sampled."""

from __future__ import annotations

from typing import NamedTuple

from ...compiler.syntax import ast
from .lanes import picked
from .nodes import Input, Nodes
from .unsayable import UnsayableError
from .values import Constant, Linked, Picture, Value, lanes_of, vector

_TYPES = {"r": "float", "x": "float", "xy": "vector2", "xyz": "vector3", "rgb": "color3"}
"""The types of images whose lanes are read."""
_WRAPS = {"repeat": "periodic", "clamp": "clamp", "mirror": "mirror"}
_FILTERS = {"linear": "linear", "nearest": "closest"}


def picture_of(member: ast.Texture, file: str, is_color: bool) -> Picture:
    """A texture with its file."""
    state = {name.text: word.text for name, word in member.state}
    settings = {}
    for axis, input_name in (("wrap_u", "uaddressmode"), ("wrap_v", "vaddressmode")):
        word = state.get(axis, state.get("wrap", "repeat"))
        if word not in _WRAPS:
            raise UnsayableError(f"MaterialX has no `{word}` of textures", "", member.span)
        if word != "repeat":
            settings[input_name] = _WRAPS[word]
    kind = state.get("filter", "linear")
    if kind != "linear":
        settings["filtertype"] = _FILTERS[kind]
    return Picture(member.name.text, file, "srgb_texture" if is_color else "", settings)


class Border(NamedTuple):
    """The colour beyond an image, and the axes at which it ends."""

    beyond: Value
    axes: Value

    def inputs(self, kind: str) -> dict[str, Input]:
        """The inputs of an image of a type."""
        if not isinstance(self.axes, Constant) or not isinstance(self.beyond, Constant):
            raise UnsayableError("borders and colours beyond them are constants in MaterialX", "")
        sides = zip(("uaddressmode", "vaddressmode"), self.axes.numbers * 2, strict=False)
        numbers = self.beyond.numbers[: lanes_of(kind)]
        return {
            **{name: "constant" for name, is_bordered in sides if is_bordered},
            "default": vector(numbers, kind),
        }


def read(
    nodes: Nodes,
    picture: Picture,
    coordinate: Value | None,
    lanes: str,
    border: Border | None = None,
) -> Value:
    """The node that reads a texture; ``lanes`` are those that are picked, or empty for all.

    ``coordinate`` has v upwards, and is nothing for the first coordinates of the mesh. Colours are
    decoded by nodes that give colours only.
    """
    kind = _TYPES.get(lanes, "color4" if picture.is_color or not lanes else "vector4")
    if picture.is_color and not kind.startswith("color"):
        kind = "color4" if "w" in lanes or "a" in lanes else "color3"
    inputs: dict[str, Input] = {"file": picture, **picture.settings}
    place = {} if coordinate is None else {"texcoord": coordinate}
    if border is not None:
        inputs |= border.inputs(kind)
    found = nodes.node("image", {**inputs, **place}, kind, must=True)
    if isinstance(found, Linked) and (not lanes or _TYPES.get(lanes) == found.type):
        return found
    return picked(nodes, found, lanes)


def with_space(nodes: Nodes, value: Value, space: str) -> Value | None:
    """A colour of some colour space; nothing if a function has to decode it.

    A constant keeps its numbers, and an image tells of its file.
    """
    if isinstance(value, Constant):
        kind = "color4" if len(value.numbers) == 4 else "color3"
        found = nodes.converted(value, kind)
        assert isinstance(found, Constant)
        return nodes.plain("constant", kind, {"value": Constant(kind, found.numbers, space=space)})
    if isinstance(value, Linked) and value.type in ("color3", "color4"):
        return nodes.decoded(value, space)
    return None
