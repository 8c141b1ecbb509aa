"""The fields of a material in Rust: parameters with their types, defaults and doc comments."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from ...compiler.documents.functions import ArgumentRow
from ...compiler.documents.values import ChoiceRow
from ...support.frozen import frozen
from ...targets.description.reserved import read_reserved

TYPES = {
    "float": "f32", "int": "i32", "uint": "u32", "bool": "bool",
    **{f"{prefix}vec{lanes}": f"{kind}{lanes}"
       for prefix, kind in (("", "Vec"), ("i", "IVec"), ("u", "UVec")) for lanes in (2, 3, 4)},
    **{f"mat{lanes}": f"Mat{lanes}" for lanes in (2, 3, 4)},
}  # fmt: skip
"""Bevy's types, by those of the machine."""
COLORS = ("rgb", "rgba")
"""The written types whose values are colours, in linear light."""
OWN_TYPES = ("Material", "Parameters", "Plugin")
"""What the names of a module's own types end with."""
NEVER_RAW = ("self", "super", "crate", "Self")
_WIDTH = 92


@frozen
class Field:
    """A member of a structure in Rust, as the template prints it."""

    name: str
    type: str
    default: str
    doc: tuple[str, ...]
    attributes: tuple[str, ...] = ()
    stored: str = ""
    """The type in the block of parameters; empty for textures."""
    conversion: str = ""
    """The value that is stored there."""


@frozen
class Member:
    """A value of an enumeration."""

    name: str
    number: int
    doc: tuple[str, ...]


@frozen
class Choice:
    """An enumeration."""

    name: str
    field: str
    members: tuple[Member, ...]


def parameter(material: str, row: ArgumentRow) -> Field:
    """The field of a parameter."""
    element, _, count = row.representation.partition("[")
    size = int(count.removesuffix("]")) if count else 0
    name = identifier(row.name)
    kind = "LinearRgba" if row.type in COLORS else TYPES[element]
    place = f"material.{name}"
    if row.choices is not None and not count:
        kind = choice_name(material, row.name)
        number = int(_lanes(row.default)[0]) if row.default is not None else 0
        default = f"{kind}::{member_name(row.choices[number])}"
        return Field(name, kind, default, _doc(row), (), "i32", f"{place} as i32")
    stored, conversion = _stored(row.type if row.type in COLORS else element, place, size)
    if not count:
        default = _value(row.type, element, row.default)
        return Field(name, kind, default, _doc(row), (), stored, conversion)
    values = row.default if isinstance(row.default, Sequence) else [None] * size
    default = f"[{', '.join(_value(row.type, element, value) for value in values)}]"
    return Field(name, f"[{kind}; {size}]", default, _doc(row), (), stored, conversion)


def choice(material: str, row: ArgumentRow) -> Choice | None:
    """The enumeration of a parameter, if it is one."""
    if row.choices is None or "[" in row.representation:
        return None
    members = (
        Member(member_name(each), number, told(each.doc)) for number, each in enumerate(row.choices)
    )
    return Choice(choice_name(material, row.name), row.name, tuple(members))


def choice_name(material: str, name: str) -> str:
    """The name of the enumeration of a parameter."""
    word = _pascal(name)
    return f"{material}{word}Choice" if word in OWN_TYPES else f"{material}{word}"


def member_name(row: ChoiceRow) -> str:
    """The name of a member of an enumeration."""
    name = _pascal(row.name)
    return f"{name}_" if name in NEVER_RAW or name[0].isdigit() else name


def identifier(name: str) -> str:
    """A name as Rust takes it."""
    if name in NEVER_RAW:
        return f"{name}_"
    words = read_reserved(Path(__file__).with_name("keywords.txt")).words
    return f"r#{name}" if name in words else name


def told(text: str) -> tuple[str, ...]:
    """Lines of a doc comment."""
    import textwrap

    return tuple(textwrap.wrap(" ".join(text.split()), _WIDTH))


def number(value: float, kind: str = "float") -> str:
    """A number in Rust."""
    if kind == "bool":
        return "true" if value else "false"
    if kind != "float":
        return str(int(value))
    text = f"{value:.9g}"
    return text if any(mark in text for mark in ".en") else f"{text}.0"


def _pascal(name: str) -> str:
    return "".join(word[:1].upper() + word[1:] for word in re.split("_+", name) if word) or "One"


def sentences(*parts: str) -> tuple[str, ...]:
    """Lines of a doc comment of several sentences; a user's own may have no full stop."""
    ended = (f"{part}." if part[-1].isalnum() else part for part in parts if part)
    return told(" ".join(ended) if len(parts) > 1 else parts[0])


def _doc(row: ArgumentRow) -> tuple[str, ...]:
    found = [row.doc]
    if row.range is not None and row.choices is None:
        found.append(f"From {row.range[0]:g} to {row.range[1]:g}.")
    if row.type in COLORS:
        found.append("In linear light.")
    return sentences(*found)


def _stored(kind: str, place: str, size: int) -> tuple[str, str]:
    """The type in the block, and the conversion: elements of arrays have 16 bytes there."""
    if not size:
        plain = TYPES.get(kind, "")
        return {
            "rgb": ("Vec3", f"{place}.to_vec3()"),
            "rgba": ("Vec4", f"{place}.to_vec4()"),
            "bool": ("u32", f"{place}.into()"),
        }.get(kind, (plain, place))
    wide = {
        "float": ("Vec4", "Vec4::splat"), "int": ("IVec4", "IVec4::splat"),
        "uint": ("UVec4", "UVec4::splat"), "vec2": ("Vec4", "|x| x.extend(0.0).extend(0.0)"),
        "rgb": ("Vec3", "|x| x.to_vec3()"), "rgba": ("Vec4", "|x| x.to_vec4()"),
    }  # fmt: skip
    if kind not in wide:
        return f"[{TYPES[kind]}; {size}]", place
    element, conversion = wide[kind]
    return f"[{element}; {size}]", f"{place}.map({conversion})"


def _value(written: str, element: str, value: object) -> str:
    lanes = _lanes(value)
    if written in COLORS:
        lanes = lanes or [0.0] * len(written)
        alpha = lanes[3:] or [1.0]
        return f"LinearRgba::new({', '.join(number(lane) for lane in [*lanes[:3], *alpha])})"
    kind = {"i": "int", "u": "uint", "b": "bool"}.get(element[0], "float")
    if element in ("float", "int", "uint", "bool"):
        return number(lanes[0] if lanes else 0, kind)
    if not lanes:
        return f"{TYPES[element]}::{'IDENTITY' if element.startswith('mat') else 'ZERO'}"
    if element.startswith("mat"):
        array = ", ".join(map(number, lanes))
        return f"{TYPES[element]}::from_cols_array(&[{array}])"
    return f"{TYPES[element]}::new({', '.join(number(lane, kind) for lane in lanes)})"


def _lanes(value: object) -> list[float]:
    """All lanes of a value in order; none where there is none."""
    if value is None:
        return []
    if isinstance(value, Sequence):
        return [lane for part in value for lane in _lanes(part)]
    assert isinstance(value, int | float)
    return [value]
