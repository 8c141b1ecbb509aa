"""The fields of a class in TypeScript: how they lie in its bytes, and what setting them checks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from ..fields import Field, Numbers, Structure
from ..printer import single
from ..spelling import Spelling

_VIEWS = {"float": "f32", "int": "i32", "uint": "u32"}
_ARRAYS = {"float": "Float32Array", "int": "Int32Array", "uint": "Uint32Array"}
_BOUNDS = {"int": (-(2**31), 2**31 - 1), "uint": (0, 2**32 - 1)}


def is_scalar(field: Field) -> bool:
    """True for a number or a truth, which needs no view of its own."""
    return not field.capacity and isinstance(field.type, Numbers) and _room(field.type) == 1


def is_optional(field: Field) -> bool:
    """True if a host may leave the field out."""
    return field.default is not None or bool(field.counts or field.capacity)


def is_computed(structure: Structure) -> bool:
    """True if no host sets a field of the structure."""
    return all(field.computed for field in structure.fields)


def in_order(structure: Structure) -> Sequence[Field]:
    """The fields in the order in which they are set: an array sets its count, which may follow."""
    return sorted(structure.fields, key=lambda field: bool(field.counts))


class Fields:
    """Lines and types of fields, which need the names of the binding."""

    def __init__(self, spelling: Spelling) -> None:
        self._spelling = spelling

    def values_type(self, structure: Structure) -> str:
        """The interface of the values of a structure."""
        return self._spelling.type(f"{structure.name}.values")

    def given_type(self, field: Field) -> str:
        """The type of what a host gives."""
        if isinstance(field.type, Structure):
            one = self.values_type(field.type)
        elif _room(field.type) > 1:
            one = "Lanes"
        else:
            one = self._scalar_type(field, field.type)
            if field.capacity:
                return f"readonly ({one} | Lanes)[]"
        return f"readonly {one}[]" if field.capacity else one

    def read_type(self, field: Field) -> str:
        """The type of what a host reads: views of the bytes, except for single numbers."""
        if is_scalar(field):
            assert isinstance(field.type, Numbers)
            return self._scalar_type(field, field.type)
        is_part = isinstance(field.type, Structure)
        one = self._spelling.type(field.type.name) if is_part else _ARRAYS[field.type.kind]  # type: ignore[union-attr]
        return f"readonly {one}[]" if field.capacity else one

    def _scalar_type(self, field: Field, type_: Numbers) -> str:
        if field.enumeration is not None:
            return self._spelling.enumeration(field.enumeration.name)
        return "boolean" if type_.truth else "number"

    def view(self, field: Field) -> str:
        """The view of a field that is no single number, or those of its elements."""
        scale = 1 if isinstance(field.type, Structure) else 4
        if not field.capacity:
            return self._view(field.type, field.offset // scale)
        first, stride = field.offset // scale, field.stride // scale
        return f"elements({field.capacity}, {first}, {stride}, (at) => {self._view(field.type)})"

    def _view(self, type_: Numbers | Structure, at: int | None = None) -> str:
        start = "at" if at is None else str(at)
        count = type_.size if isinstance(type_, Structure) else _room(type_)
        span = f"{start}, {f'at + {count}' if at is None else at + count}"
        if not isinstance(type_, Structure):
            return f"this.{_VIEWS[type_.kind]}.subarray({span})"
        bytes_ = f"this.bytes.subarray({span})"
        given = bytes_ if is_computed(type_) else f"{{}}, {bytes_}"
        return f"new {self._spelling.type(type_.name)}({given})"

    def reading(self, field: Field) -> str:
        """What a field is read by."""
        if not is_scalar(field):
            return f"this.#{self._spelling.member(field.word)}"
        assert isinstance(field.type, Numbers)
        kept = " !== 0" if field.type.truth else "!"
        kind = "" if field.enumeration is None else f" as {self.read_type(field)}"
        return f"{_place(field, field.type)}{kept}{kind}"

    def storing(self, field: Field) -> list[str]:
        """The statements that set a field to ``value``; none where only its elements are set."""
        if isinstance(field.type, Structure):
            return [] if field.computed else list(self._storing_parts(field, field.type))
        if not field.capacity:
            return list(self._storing_numbers(field, field.type))
        return [] if field.computed else list(self._storing_elements(field, field.type))

    def _storing_parts(self, field: Field, type_: Structure) -> Iterator[str]:
        own = f"this.#{self._spelling.member(field.word)}"
        name = self._spelling.type(type_.name)
        called = f'"{self._spelling.member(field.word)}"'
        needed = ", ".join(
            f'"{self._spelling.member(each.word)}"'
            for each in type_.fields
            if not is_optional(each)
        )
        if not field.capacity:
            part = f"new {name}(complete({called}, value, [{needed}]))"
            yield f"const part = value instanceof {name} ? value : {part};"
            yield f"{own}.bytes.set(part.bytes);"
            return
        yield self._counted(field)
        yield (
            f"const parts = Array.from(value, (each) => each instanceof {name} ? each : "
            f"new {name}(complete({called}, each, [{needed}])));"
        )
        yield "const found = parts.map((each) => each.bytes.slice());"
        yield f"found.forEach((bytes, number) => {own}[number]!.bytes.set(bytes));"
        yield from self._counting(field)

    def _storing_numbers(self, field: Field, type_: Numbers) -> Iterator[str]:
        own = f"this.#{self._spelling.member(field.word)}"
        if is_scalar(field):
            checked = "Number(value)" if type_.truth else self._check(field, type_, "value")
            yield f"{_place(field, type_)} = {'value' if _is_plain(field, type_) else checked};"
        elif field.computed:
            yield f"store({own}, value);"
        else:
            yield f"store({own}, {self._checked(field, type_, 'value')});"

    def _storing_elements(self, field: Field, type_: Numbers) -> Iterator[str]:
        own = f"this.#{self._spelling.member(field.word)}"
        yield self._counted(field)
        lanes = "each" if _room(type_) > 1 else 'typeof each === "object" ? each : [each]'
        yield (f"const found = Array.from(value, (each) => {self._checked(field, type_, lanes)});")
        yield f"found.forEach((lanes, number) => store({own}[number]!, lanes));"
        yield from self._counting(field)

    def _counted(self, field: Field) -> str:
        is_whole = "false" if field.counter else "true"
        name = self._spelling.member(field.word)
        return f'counted("{name}", value.length, {field.capacity}, {is_whole});'

    def _counting(self, field: Field) -> Iterator[str]:
        if field.counter:
            yield f"this.{self._spelling.member(field.counter)} = value.length;"

    def _checked(self, field: Field, type_: Numbers, lanes: str) -> str:
        """The lanes that a host has given, once they are checked."""
        name = self._spelling.member(field.word)
        count = type_.lanes * (type_.columns or 1)
        check = "lane" if type_.truth else self._check(field, type_, "lane")
        unit = ", true" if field.is_unit else ""
        return f'checked("{name}", {lanes}, {count}, {_room(type_)}, (lane) => {check}{unit})'

    def _check(self, field: Field, type_: Numbers, value: str) -> str:
        name = f'"{self._spelling.member(field.word)}"'
        if type_.kind != "float":
            low, high = field.range or _BOUNDS[type_.kind]
            if field.choices:
                low, high = 0, len(field.choices) - 1
            return f"integer({name}, {value}, {int(low)}, {int(high)})"
        if field.range is None or type_.columns:
            return f"finite({name}, {value})"
        low_text, high_text = (single(bound).removesuffix(".0") for bound in field.range)
        return f"finite({name}, {value}, {low_text}, {high_text})"

    def resets(self, structure: Structure) -> Iterator[str]:
        """The statements that set the fields to their defaults, after all bytes are zero."""
        for field in structure.fields:
            name = self._spelling.member(field.word)
            if isinstance(field.type, Structure):
                is_many = bool(field.capacity)
                yield (
                    f"for (const each of this.#{name}) each.reset();"
                    if is_many
                    else f"this.#{name}.reset();"
                )
            if field.default is not None:
                yield f"this.{name} = {self._value(field, field.default)};"

    def _value(self, field: Field, value: Any) -> str:
        if field.capacity:
            return f"[{', '.join(self._one(field.type, each) for each in value)}]"
        return self._one(field.type, value)

    def _one(self, type_: Numbers | Structure, value: Any) -> str:
        if isinstance(type_, Structure):
            members = zip(type_.fields, value, strict=True)
            return self._members((each, one) for each, one in members if one is not None)
        if type_.columns:
            return f"[{', '.join(_number(type_, lane) for column in value for lane in column)}]"
        if type_.lanes > 1:
            return f"[{', '.join(_number(type_, lane) for lane in value)}]"
        return _number(type_, value)

    def _members(self, members: Iterator[tuple[Field, Any]]) -> str:
        texts = (
            f"{self._spelling.member(field.word)}: {self._value(field, value)}"
            for field, value in members
        )
        return f"{{ {', '.join(texts)} }}"


def _room(type_: Numbers) -> int:
    """The numbers of a view: columns have room for four."""
    return 4 * type_.columns if type_.columns else type_.lanes


def _place(field: Field, type_: Numbers) -> str:
    return f"this.{_VIEWS[type_.kind]}[{field.offset // 4}]"


def _is_plain(field: Field, type_: Numbers) -> bool:
    """True if a number is stored as it is computed."""
    return field.computed and not type_.truth


def _number(type_: Numbers, value: Any) -> str:
    if type_.kind == "float":
        return single(value).removesuffix(".0")
    return ("true" if value else "false") if type_.truth else str(int(value))
