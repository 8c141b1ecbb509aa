"""Values of the nodes of a graph that is written: constants, and links to nodes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

from ...compiler.syntax import ast
from ..expressions import number_text
from ..values import LANES, TYPES

SAME_LANES = MappingProxyType(
    {"color3": "vector3", "vector3": "color3", "color4": "vector4", "vector4": "color4"}
)
"""Types that differ by their meaning alone."""
_OWN = MappingProxyType({
    other: own for own, other in TYPES.items() if own not in ("EDF", "VDF")
})  # fmt: skip
"""The types of MaterialX by those of Burnish."""
_MEANT = ("point", "vector", "direction", "normal", "covector", "offset")
_MATRICES = MappingProxyType({"matrix33": 9, "matrix44": 16})


@dataclass(frozen=True)
class Constant:
    """A value that is the same everywhere. ``is_whole`` is true for an ``int`` as it is written,
    which also stands for a ``float``."""

    type: str
    numbers: tuple[float, ...]
    is_whole: bool = False
    space: str = ""
    """The colour space in which it is written."""

    @property
    def text(self) -> str:
        """The value as documents have it."""
        if self.type == "boolean":
            return "true" if self.numbers[0] else "false"
        return ", ".join(number_text(float(f"{number:.9g}")) for number in self.numbers)


@dataclass(frozen=True)
class Linked:
    """An output of a node, or an input of the graph."""

    type: str
    node: str = ""
    output: str = ""
    """Empty for the only output."""
    interface: str = ""


@dataclass(frozen=True)
class Several:
    """The members of a structure."""

    members: Mapping[str, Value]


@dataclass(frozen=True)
class Picture:
    """A texture: its file, and how it is read."""

    name: str
    file: str
    space: str = ""
    """The colour space of the file; empty for numbers, and for linear light."""
    settings: Mapping[str, str] = field(default_factory=dict)
    """The texts of inputs, such as ``uaddressmode``, that differ from their defaults."""

    @property
    def is_color(self) -> bool:
        """True if the file is decoded."""
        return bool(self.space)


Value = Constant | Linked | Several | Picture


def type_named(written: ast.TypeName) -> str:
    """The type of MaterialX for one that is written; empty if there is none."""
    name = written.name.text
    if written.count is not None or written.unsized:
        return ""
    if name in _MEANT:
        return "vector3"
    return type_of_constructor(name)


def type_of_constructor(name: str) -> str:
    """The type of what a constructor makes; empty if MaterialX has none."""
    return _OWN.get(name, "")


def lanes_of(kind: str) -> int:
    """The number of lanes of a type; 0 for what is no number or vector."""
    return LANES.get(kind, 1 if kind in ("integer", "boolean") else 0)


def size_of(kind: str) -> int:
    """The number of numbers in a constant of a type."""
    return _MATRICES.get(kind) or lanes_of(kind)


def vector(numbers: Sequence[float], kind: str) -> Constant:
    """A constant of some type."""
    return Constant(kind, tuple(map(float, numbers)))


def retyped(value: Constant, kind: str) -> Constant | None:
    """A constant as another type: one number stands for all lanes. Nothing if it cannot be one."""
    if value.type == kind:
        return value
    if value.type in _MATRICES or kind in _MATRICES or "boolean" in (value.type, kind):
        return None
    if kind == "integer":
        return None
    if len(value.numbers) == 1 and (value.type == "float" or value.is_whole):
        return Constant(kind, value.numbers * lanes_of(kind))
    same = len(value.numbers) == lanes_of(kind) and value.type != "integer"
    return Constant(kind, value.numbers, space=value.space) if same else None
