"""The parts of a binding in C++ that its skeleton asks for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from typing import Any

from ..c_family.lines import Lines, is_scalar, number, real
from ..c_family.tables import Tables, chunks, enumerated, identifier, identity, layouts, plain, rows
from ..c_family.words import WORDS, Words
from ..describing import about_block, about_field, in_one_line, sources
from ..fields import Enumeration, Field, Numbers, Structure
from ..model import Binding
from ..spelling import Spelling
from ..writing import blocks_of, drawing, table_of
from .frames import CppFrames
from .functions import FUNCTIONS

_SCALARS = {"float": "float", "int": "std::int32_t", "uint": "std::uint32_t"}
_PREFIXES = {"float": "", "int": "i", "uint": "u"}
_LONGEST = 8000
"""Bytes of a literal; some compilers take no more than 16000."""


def texts(binding: Binding, spelling: Spelling) -> Mapping[str, Any]:
    """What the skeleton reads besides the binding."""
    parts = _Parts(spelling)
    return {
        "FUNCTIONS": FUNCTIONS,
        "enums": [_words(each.name, each.constants) for each in WORDS],
        "choices": [parts.choices(each) for each in binding.enumerations],
        "plain": plain,
        "member": parts.member,
        "asserts": parts.asserts,
        "faults": parts.faults,
        "doubles": lambda kind: {"float": "double", "int": "std::int64_t", "bool": "bool"}[kind],
        "block_doc": partial(about_block, binding),
        "sources_text": sources,
        "tables": Tables(_enumerator, spelling.type, _raw, "{}"),
        "CppFrames": CppFrames,
        "blocks_of": blocks_of,
        "drawing": drawing,
        "table_of": table_of,
        "roles": parts.roles,
        "VULKAN": [each for each in WORDS if each.vulkan],
        "constants": _constants,
        "partial": partial,
        "layouts": layouts,
        "identity": identity,
        "rows": rows,
        "list_of": lambda rows, name: name if rows else "{}",
        "element_type": parts.declared,
        "namespace": spelling.namespace(binding.namespace),
    }


class _Parts(Lines):
    """Lines that need the names of the binding."""

    def type(self, type_: Numbers | Structure) -> str:
        """The type of a value in the namespace of the binding."""
        if isinstance(type_, Structure):
            return self._spelling.type(type_.name)
        if type_.columns:
            return f"mat{type_.columns}" + ("" if type_.columns == 4 else "x4")
        if type_.lanes == 1:
            return _SCALARS[type_.kind]
        return f"{_PREFIXES[type_.kind]}vec{type_.stored_lanes}"

    def declared(self, field: Field) -> str:
        """The type of a field, or of its elements."""
        if field.enumeration is not None:
            return self._spelling.enumeration(field.enumeration.name)
        return self.type(field.type)

    def choices(self, enumeration: Enumeration) -> list[str]:
        """The lines that declare an enumeration of the language."""
        choice = partial(self._spelling.choice, enumeration.name)
        names = [choice(each.name) for each in enumeration.members]
        docs = [in_one_line(each.doc) for each in enumeration.members]
        name = self._spelling.enumeration(enumeration.name)
        return enumerated(f"enum class {name} : std::int32_t", names, "};", docs)

    def member(self, field: Field) -> Iterator[str]:
        """The lines of a member, with its comment."""
        name = self._spelling.member(field.word)
        many = f"[{field.capacity}]" if field.capacity else ""
        about = about_field(field)
        if about:
            yield f"/// {about[:1].upper()}{about[1:]}."
        yield f"{self.declared(field)} {name}{many}{self._initial(field)};"

    def _initial(self, field: Field) -> str:
        if field.default is None:
            return "{}"
        if not field.capacity:
            value = self._value(field, field.default)
            return f" = {value}" if is_scalar(field.type) else value
        typed = "" if is_scalar(field.type) else self.type(field.type)
        parts = (f"{typed}{self._value(field, each)}" for each in field.default)
        return f" = {{{', '.join(parts)}}}"

    def _value(self, field: Field, value: Any) -> str:
        """The value of a field that is no array, or of an element of one."""
        type_ = field.type
        if (enumeration := field.enumeration) is not None:
            name = self._spelling.choice(enumeration.name, enumeration.members[int(value)].name)
            return f"{self._spelling.enumeration(enumeration.name)}::{name}"
        if isinstance(type_, Structure):
            return self._structure(type_, value)
        if type_.columns:
            columns = (
                f"vec4{{{', '.join([*map(real, column), *['0.0f'] * (4 - len(column))])}}}"
                for column in value
            )
            return f"{{{', '.join(columns)}}}"
        if type_.lanes == 1:
            return number(type_, value)
        lanes = [number(type_, lane) for lane in value]
        missing = type_.stored_lanes - len(lanes)
        return f"{{{', '.join([*lanes, *[number(type_, 0)] * missing])}}}"

    def _structure(self, type_: Structure, values: Any) -> str:
        """A structure by its members in order, pads among them."""
        given = dict(zip((each.word for each in type_.fields), values, strict=True))
        parts = (
            self._value(part, given[part.word]) if isinstance(part, Field) else "{}"
            for part in type_.parts
        )
        return f"{{{', '.join(parts)}}}"

    def lane(self, place: str, number: int) -> str:
        """A lane of a vector."""
        return f"{place}.{'xyzw'[number]}"

    def has_length_one(self, place: str, lanes: int) -> str:
        """The condition that a vector has length one."""
        del lanes
        return f"has_length_one({place})"

    def natural(self, place: str) -> str:
        """A member of an enumeration as a number without a sign."""
        return f"static_cast<std::uint32_t>({place})"


def _words(name: str, words: Iterable[str]) -> list[str]:
    """The lines of an enumeration of a document's words."""
    return enumerated(f"enum class {name} : std::uint8_t", list(map(_word, words)), "};")


def _word(word: str) -> str:
    """A word of a table as an enumerator; `float` is one, which is a word of C++ besides."""
    return "float_" if word == "float" else identifier(word)


def _enumerator(enumeration: str, word: str) -> str:
    return f"{enumeration}::{_word(word)}"


def _constants(words: Words) -> list[str]:
    """The table of Vulkan's constants for the words of an enumeration, in their order."""
    names = [words.constant(each) for each in words.constants]
    return enumerated(f"static constexpr {words.vulkan} all[] =", names, "};")


def _raw(text: str | None) -> str:
    """A text as raw literals, which compilers join."""
    if text is None:
        return "nullptr"
    return "\n".join(f'R"burnish({each})burnish"' for each in chunks(text, _LONGEST))
