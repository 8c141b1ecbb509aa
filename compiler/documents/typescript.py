"""Makes the TypeScript types of documents for web pages.

``generate.py`` writes them, and the host for web pages (``targets/web_host``) is checked against
them.
"""

from __future__ import annotations

import json
import textwrap
from collections.abc import Iterable, Iterator
from typing import Any, Literal, get_args, get_origin

from ..constraints import Nested, TypeScript
from .docstrings import docs_of
from .schema import is_mapping
from .shapes import (
    Field,
    alternatives_of,
    bare,
    constraints_of,
    fields_of,
    is_record,
    may_be_null,
)

_SCALARS = {bool: "boolean", int: "number", float: "number", str: "string"}
_WIDTH = 100
"""The length of lines."""


def typescript(kind: type) -> str:
    """A module with the type of a document, and of all that it consists of."""
    types = _Types()
    types.name_of(kind)
    return "\n".join(types.made[name] for name in sorted(types.made))


class _Types:
    """The types that have been made so far, by name."""

    def __init__(self) -> None:
        self.made: dict[str, str] = {}

    def name_of(self, kind: type) -> str:
        """The name of a record's type, which is made if it is not there yet."""
        name = kind.__name__
        if name not in self.made:
            self.made[name] = ""  # A record may contain itself.
            docs = docs_of(kind)
            lines = [*_comment(docs.whole, ""), f"export interface {name} {{"]
            for field in fields_of(kind):
                lines += _comment(docs.fields.get(field.name, ""), "  ")
                mark = "?" if field.is_optional else ""
                lines.append(f"  {field.key}{mark}: {self._field(field)};")
            self.made[name] = "\n".join([*lines, "}", ""])
        return name

    def _field(self, field: Field) -> str:
        """The type of a record's field; one that may be left out is never null."""
        if field.spelling is None:
            return self._type(field.type, is_optional=field.is_optional)
        words: list[str | None] = [*field.spelling.values()]
        is_nullable = may_be_null(bare(field.type)) and not field.is_optional
        return _one_of([*words, None] if is_nullable else words)

    def _type(self, type_: Any, *, is_optional: bool = False) -> str:
        """A type as TypeScript writes it; a field that may be left out is never null."""
        constraints, inner = constraints_of(type_), bare(type_)
        for each in constraints:
            if isinstance(each, TypeScript):
                return each.text
            if isinstance(each, Nested):
                return self._nested(each)
        if is_record(inner):
            return self.name_of(inner)
        origin, parts = get_origin(inner), get_args(inner)
        if origin is Literal:
            return _one_of(parts)
        if origin is tuple:
            return self._list(parts)
        if is_mapping(origin):
            return f"Record<string, {self._type(parts[1])}>"
        if inner in _SCALARS:
            return _SCALARS[inner]
        if inner is Any:
            return "unknown"
        kinds = [self._type(each) for each in alternatives_of(inner)]
        return " | ".join([*kinds, "null"] if may_be_null(inner) and not is_optional else kinds)

    def _list(self, parts: tuple[Any, ...]) -> str:
        if parts and parts[-1] is ...:
            inner = self._type(parts[0])
            return f"({inner})[]" if " " in inner else f"{inner}[]"
        return f"[{', '.join(map(self._type, parts))}]"

    def _nested(self, constraint: Nested) -> str:
        name = constraint.name
        if name not in self.made:
            kinds = ["number", "boolean", "null", f"{name}[]"]
            if constraint.objects:
                kinds.append(f"{{ [key: string]: {name} }}")
            comment = _comment(constraint.doc, "")
            self.made[name] = "\n".join(
                [*comment, f"export type {name} = {' | '.join(kinds)};", ""]
            )
        return name


def _one_of(words: Iterable[Any]) -> str:
    return " | ".join(json.dumps(word) for word in words)


def _comment(text: str, indent: str) -> Iterator[str]:
    """A text as a comment, in as many lines as it takes."""
    if not text:
        return
    short = f"{indent}/** {text} */"
    if len(short) <= _WIDTH:
        yield short
        return
    yield f"{indent}/**"
    for line in textwrap.wrap(text, _WIDTH - len(indent) - len(" * ")):
        yield f"{indent} * {line}"
    yield f"{indent} */"
