"""The uniforms of a material: how each one begins in JavaScript, and its type in TypeScript.

A uniform that a user sets holds what three.js has for such numbers, and one that is computed holds
an array of numbers, which three.js takes as well.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ...bindings.describing import about_field
from ...bindings.fields import Field, Numbers, Structure
from ...bindings.model import Block, Material
from ...compiler.documents.backends import BackendRow
from ...support.frozen import changed, frozen

ARRAYS = {"float": "Float32Array", "int": "Int32Array", "uint": "Uint32Array"}


@frozen
class Uniform:
    """A uniform, or a value from which others are computed."""

    name: str
    """Its name in the text, by which users set it; a value that no text has has its own."""
    block: Block
    field: Field

    @property
    def begins(self) -> str:
        """The value before somebody sets one, in JavaScript."""
        field = self.field
        if not field.capacity:
            return value(field, field.default)
        if field.type != whole_array(field):
            element = _element(field)
            if field.default is None:
                return f"Array.from({{ length: {field.capacity} }}, () => ({element}))"
            listed = ", ".join(value(field, each) for each in field.default)
            return f"[{listed}]"
        assert isinstance(field.type, Numbers)
        count = field.capacity * room_of(field.type)
        given = field.default
        numbers = "" if given is None else f"[{', '.join(map(number, _flat(given)))}]"
        return f"new {ARRAYS[field.type.kind]}({numbers or count})"

    @property
    def type(self) -> str:
        """The type of the value, in TypeScript."""
        one = value_type(self.field)
        is_array = bool(self.field.capacity) and self.field.type != whole_array(self.field)
        return f"{one}[]" if is_array else one

    @property
    def given(self) -> str:
        """The type of what a user gives, in TypeScript: of structures only some members."""
        if isinstance(self.field.type, Structure) and self.field.capacity:
            return f"Partial<{value_type(self.field)}>[]"
        return self.type

    @property
    def comment(self) -> str:
        """What it means, for a comment on one line."""
        return about_field(self.field).replace("*/", "* /")


def uniforms_of(material: Material, backend: BackendRow) -> Iterator[Uniform]:
    """The uniforms of a material, and the values that only computed ones need."""
    for block in material.blocks:
        row = backend.blocks.get(block.plain_name)
        names: Mapping[str, str] = {} if row is None else row.members
        for field in block.structure.fields:
            yield Uniform(names.get(field.word, field.word), block, _as_in_text(field, names))


def _as_in_text(field: Field, names: Mapping[str, str]) -> Field:
    """The field, whose members of structures are called as in the text: three.js sets them so."""
    type_ = field.type
    if not isinstance(type_, Structure):
        return field
    members = [
        changed(_as_in_text(each, names), word=names.get(f"{type_.name}.{each.word}", each.word))
        for each in type_.fields
    ]
    return changed(field, type=changed(type_, fields=tuple(members)))


def whole_array(field: Field) -> Numbers | Structure | None:
    """The type of an array's elements if one array of numbers holds all; ``None`` if none does.

    three.js takes such an array for computed values and for vectors of integers. In the texts, an
    array of matrices is one of their columns.
    """
    if not isinstance(field.type, Numbers) or not field.capacity:
        return None
    type_ = field.type
    is_vector = lanes_of(type_) > 1 and type_.kind == "float" and not type_.columns
    return None if is_vector and not field.computed else type_


def lanes_of(type_: Numbers) -> int:
    """The numbers of a value."""
    return type_.lanes * (type_.columns or 1)


def room_of(type_: Numbers) -> int:
    """The numbers that an element of an array takes up: each column of a matrix has four."""
    return 4 * type_.columns if type_.columns else type_.lanes


def is_color(field: Field) -> bool:
    """True if three.js has the value as a colour."""
    return field.meaning.partition("[")[0] == "rgb" and not field.computed


def value_type(field: Field) -> str:
    """The type of a value, or of an element, in TypeScript."""
    type_ = field.type
    if isinstance(type_, Structure):
        return f"{{ {'; '.join(f'{each.word}: {value_type(each)}' for each in type_.fields)} }}"
    if lanes_of(type_) == 1 and not field.capacity:
        return "boolean" if type_.truth else "number"
    if field.computed or whole_array(field) is not None:
        return ARRAYS[type_.kind]
    if is_color(field):
        return "Color"
    return f"Matrix{type_.columns}" if type_.columns else f"Vector{type_.lanes}"


def value(field: Field, default: Any) -> str:
    """A value, or an element, in JavaScript."""
    type_ = field.type
    if isinstance(type_, Structure):
        given = [each.default for each in type_.fields] if default is None else default
        parts = zip(type_.fields, given, strict=True)
        return f"{{ {', '.join(f'{each.word}: {value(each, one)}' for each, one in parts)} }}"
    name = value_type(field)
    count = lanes_of(type_)
    if count == 1:
        return _scalar(type_, default)
    if name in ARRAYS.values():
        return f"new {name}({count})"
    if default is None:
        return f"new {name}()"
    numbers = ", ".join(map(number, _flat(default)))
    if name == "Color":
        return f"new Color().setRGB({numbers})"
    return f"new {name}().fromArray([{numbers}])" if type_.columns else f"new {name}({numbers})"


def number(given: float) -> str:
    """A number in JavaScript."""
    if isinstance(given, bool):
        return str(int(given))
    return repr(float(given)).removesuffix(".0")


def _element(field: Field) -> str:
    return value(field, None)


def _scalar(type_: Numbers, default: Any) -> str:
    if type_.truth:
        return "true" if default else "false"
    return "0" if default is None else number(default)


def _flat(given: Any) -> Iterator[float]:
    if isinstance(given, Sequence):
        for each in given:
            yield from _flat(each)
    else:
        yield given
