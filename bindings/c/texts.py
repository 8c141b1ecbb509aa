"""The parts of a binding in C that its skeleton asks for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from typing import Any

from ..c_family.lines import Lines, number, string
from ..c_family.tables import Tables, chunks, enumerated, identity, layouts, plain, rows
from ..c_family.words import WORDS
from ..describing import about_block, about_field, in_one_line, sources
from ..fields import Enumeration, Field, Numbers, Pad, Structure
from ..model import Binding
from ..naming import words
from ..spelling import Spelling
from ..writing import blocks_of, drawing, table_of
from .frames import CFrame

_STORED = {"float": "float", "int": "int32_t", "uint": "uint32_t"}
_LONGEST = 4000
"""Bytes of a literal; compilers have to take no more than 4095."""


def texts(binding: Binding, spelling: Spelling) -> Mapping[str, Any]:
    """What the skeleton reads besides the binding."""
    parts = _Parts(spelling)
    return {
        "enums": [_words(each.name, each.constants) for each in WORDS],
        "choices": [parts.choices(each) for each in binding.enumerations],
        "plain": plain,
        "member": parts.member,
        "asserts": parts.asserts,
        "faults": parts.faults,
        "defaults": parts.defaults,
        "later_defaults": parts.later_defaults,
        "lane_type": parts.lane_type,
        "doubles": lambda kind: {"float": "double", "int": "int64_t", "bool": "bool"}[kind],
        "block_doc": partial(about_block, binding),
        "sources_text": sources,
        "tables": Tables(_enumerator, spelling.type, _literal, "{0}"),
        "partial": partial,
        "layouts": layouts,
        "identity": identity,
        "rows": rows,
        "list_of": lambda rows, name: f"{name}, {len(rows)}" if rows else "NULL, 0",
        "prefix": spelling.prefix,
        "string": string,
        "roles": parts.roles,
        "blocks_of": blocks_of,
        "drawing": drawing,
        "table_of": table_of,
        "CFrame": CFrame,
    }  # fmt: skip


class _Parts(Lines):
    """Lines that need the names of the binding."""

    def lane_type(self, field: Field) -> str:
        """The type of a field's lanes, or of the structures that it has."""
        if field.enumeration is not None:
            return self._spelling.enumeration(field.enumeration.name)
        if isinstance(field.type, Structure):
            return self._spelling.type(field.type.name)
        return _STORED[field.type.kind]

    def choices(self, enumeration: Enumeration) -> list[str]:
        """The lines that declare an enumeration of the language, whose size is fixed by this."""
        name = self._spelling.enumeration(enumeration.name)
        members = [
            f"{name}_{self._spelling.choice(enumeration.name, each.name)}"
            for each in enumeration.members
        ]
        docs = [in_one_line(each.doc) for each in enumeration.members]
        return [f"typedef int32_t {name};", *enumerated("enum", members, "};", docs)]

    def member(self, part: Field | Pad) -> Iterator[str]:
        """The lines of a member, with its comment."""
        if isinstance(part, Pad):
            yield f"uint32_t _pad{part.number}[{part.lanes}];"
            return
        if about := _about(part):
            yield f"/// {about}"
        counts = [part.capacity] if part.capacity else []
        if isinstance(part.type, Numbers):
            counts += [part.type.columns] if part.type.columns else []
            counts += [part.type.stored_lanes] if part.type.stored_lanes > 1 else []
        shape = "".join(f"[{count}]" for count in counts)
        yield f"{self.lane_type(part)} {self._spelling.member(part.word)}{shape};"

    def defaults(self, structure: Structure) -> list[str]:
        """The defaults of members, by their names; those without one are left out."""
        return [
            f".{self._spelling.member(field.word)} = {self._value_of(field)}"
            for field in structure.fields
            if field.default is not None
        ]

    def later_defaults(self, structure: Structure, place: str) -> Iterator[str]:
        """The statements that set members whose own members have defaults."""
        for field in structure.fields:
            if field.default is None and isinstance(field.type, Structure):
                target = f"{place}.{self._spelling.member(field.word)}"
                made = f"{self._spelling.function(f'default.{field.type.name}')}()"
                if field.capacity:
                    loop = f"for (int i = 0; i < {field.capacity}; ++i)"
                    yield f"{loop} {target}[i] = {made};"
                else:
                    yield f"{target} = {made};"

    def _value_of(self, field: Field) -> str:
        if not field.capacity:
            return self._value(field, field.default)
        return f"{{{', '.join(self._value(field, each) for each in field.default)}}}"

    def _value(self, field: Field, value: Any) -> str:
        """The value of a field that is no array, or of an element of one."""
        type_ = field.type
        if (enumeration := field.enumeration) is not None:
            chosen = enumeration.members[int(value)].name
            member = self._spelling.choice(enumeration.name, chosen)
            return f"{self._spelling.enumeration(enumeration.name)}_{member}"
        if isinstance(type_, Structure):
            given = dict(zip((each.word for each in type_.fields), value, strict=True))
            parts = (
                f".{self._spelling.member(each.word)} = {self._value(each, given[each.word])}"
                for each in type_.fields
            )
            return f"{{{', '.join(parts)}}}"
        if type_.columns:
            return f"{{{', '.join(_lanes(type_, column) for column in value)}}}"
        return _lanes(type_, value) if type_.stored_lanes > 1 else number(type_, value)

    def lane(self, place: str, number: int) -> str:
        """A lane of a vector."""
        return f"{place}[{number}]"

    def has_length_one(self, place: str, lanes: int) -> str:
        """The condition that a vector has length one."""
        return f"burnish_has_length_one({place}, {lanes})"

    def natural(self, place: str) -> str:
        """A member of an enumeration as a number without a sign."""
        return f"(uint32_t){place}"

    def sentence(self, name: str) -> str:
        """What an assertion tells; C11 insists on a text."""
        return f', "{name}"'


def _about(field: Field) -> str:
    text = about_field(field)
    return f"{text[:1].upper()}{text[1:]}." if text else ""


def _lanes(type_: Numbers, lanes: Any) -> str:
    return f"{{{', '.join(number(type_, lane) for lane in lanes)}}}"


def _enumerator(enumeration: str, word: str) -> str:
    name = "_".join(words(enumeration))
    return f"BURNISH_{name}_{word.replace('-', '_')}".upper()


def _words(name: str, constants: Iterable[str]) -> list[str]:
    """The lines that declare an enumeration of the tables."""
    names = [_enumerator(name, word) for word in constants]
    return enumerated(f"typedef enum burnish_{name}", names, f"}} burnish_{name};")


def _literal(text: str | None) -> str:
    """A text in parts, with their number: compilers take no longer ones."""
    if text is None:
        return "NULL, 0"
    parts = [
        "\n".join(map(_line, each.splitlines(keepends=True))) for each in chunks(text, _LONGEST)
    ]
    together = ",\n".join(parts)
    return f"(const char* const[]){{\n{together}\n}}, {len(parts)}"


def _line(line: str) -> str:
    """A line of a text, without what C would read as a trigraph."""
    return string(line).replace("??", "?\\?")
