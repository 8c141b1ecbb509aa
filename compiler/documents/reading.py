"""Makes records of JSON, and checks it: a document may come from anybody.

``read`` is called with the content of a file, after ``targets/runner/documents.py`` has read its
text. Each value is looked at once. For each kind of record a function is made once that checks and
reads it, so that a large document takes little longer than reading its text.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from functools import cache
from math import isfinite
from typing import Any, Literal, TypeVar, cast, get_args, get_origin

from ..constraints import Length, Nested, Pattern, Range, Spelling
from .shapes import (
    Field,
    alternatives_of,
    bare,
    constraints_of,
    fields_of,
    is_record,
    may_be_null,
    telling,
    words_of,
)

T = TypeVar("T")

Place = tuple[Any, str | int] | None
"""The place of the container of a value, and the value's key in it; ``None`` for the document."""

MOST = 100
"""The number of errors that are told."""

VERSION = "VERSION"
"""The attribute of a record that names its field with the version of the document."""

_SAID = 60
"""The number of letters of a value that are told."""


class ShapeError(ValueError):
    """A document has another shape than its kind; the text says where, in lines."""


class _EnoughError(Exception):
    """The document has more errors than people want to read."""


class Found(list[str]):
    """The errors in a document, so far."""

    def add(self, place: Place, message: str) -> None:
        """Note an error. Raises ``_EnoughError`` where enough are known."""
        self.append(f"{pointer(place)}: {message}")
        if len(self) > MOST:
            raise _EnoughError


Reader = Callable[[Any, Place, Found], Any]
"""Reads a value at a place, and notes its errors; with errors, the result means nothing."""


def read(kind: type[T], document: object) -> T:
    """Makes a record of a document.

    Raises ``ShapeError`` with the first places that are wrong: each as a JSON pointer, with its
    error.
    """
    _check_version(kind, document)
    found = Found()
    with suppress(_EnoughError):
        reader = _reader(cast(Any, kind))
        made: T = reader(document, None, found)
        if not found:
            return made
    told = found[:MOST] + ["and more"] * (len(found) > MOST)
    raise ShapeError("\n".join(told))


def _check_version(kind: Any, document: object) -> None:
    """Raise ``ShapeError`` for a document of another version: that is all that is wrong then."""
    field = getattr(kind, VERSION, "")
    if not field or not isinstance(document, dict) or field not in document:
        return
    (version,) = words_of(kind)[field]
    if document[field] != version or isinstance(document[field], bool):
        raise ShapeError(
            f"/{field}: this is version {shown(document[field])}, and Burnish reads version "
            f"{version}: compile the source again"
        )


def pointer(place: Place) -> str:
    """A place as a JSON pointer; ``/`` is the whole document."""
    parts: list[str] = []
    while place is not None:
        place, key = place
        part = str(key).replace("~", "~0").replace("/", "~1")
        parts.append(part if len(part) <= _SAID else f"{part[:_SAID]}…")
    return "/" + "/".join(reversed(parts))


def shown(value: Any) -> str:
    """A value of a document for a message: containers only by their size."""
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, list):
        return f"a list of {len(value)}"
    if isinstance(value, str) and len(value) > _SAID:
        return json.dumps(f"{value[:_SAID]}…", ensure_ascii=False)
    return json.dumps(value, ensure_ascii=False)


# --- readers of types ----------------------------------------------------------------------------


@cache
def _reader(type_: Any) -> Reader:
    """The function that reads values of a type."""
    constraints, inner = constraints_of(type_), bare(type_)
    for each in constraints:
        if isinstance(each, Nested):
            return _nested(each)
    plain = _plain_reader(inner)
    for each in constraints:
        if type(each) in _CHECKS:
            plain = _checked(plain, _CHECKS[type(each)](each))
    return plain


def _plain_reader(type_: Any) -> Reader:
    """The function that reads values of a type without constraints."""
    if is_record(type_):
        return _late(type_)
    origin = get_origin(type_)
    if origin is Literal:
        return _word(get_args(type_))
    if origin is tuple:
        return _list(get_args(type_))
    if origin is Mapping or origin is get_origin(Mapping[str, int]):
        return _object(get_args(type_)[1])
    if type_ in _SCALARS:
        return _scalar(type_)
    if type_ is Any:
        return lambda value, _place, _found: value
    return _union(type_)


def _scalar(type_: Any) -> Reader:
    wanted, kinds = _SCALARS[type_]

    def read_scalar(value: Any, place: Place, found: Found) -> Any:
        if type(value) not in kinds or not _is_of_json(value):
            found.add(place, f"{shown(value)} is not {wanted}")
        return value

    return read_scalar


_SCALARS: Mapping[Any, tuple[str, frozenset[type]]] = {
    bool: ("true or false", frozenset((bool,))),
    # A whole number has no point, so that it can be an index in every language.
    int: ("a whole number", frozenset((int,))),
    float: ("a number", frozenset((int, float))),
    str: ("a text", frozenset((str,))),
}
"""The name of a type in messages, and its classes in Python, where true is no number here."""


def _word(words: Sequence[Any]) -> Reader:
    known = {(isinstance(word, bool), word) for word in words}
    wanted = _or(map(shown, words))

    def read_word(value: Any, place: Place, found: Found) -> Any:
        is_scalar = not isinstance(value, dict | list)
        if not is_scalar or (isinstance(value, bool), value) not in known:
            found.add(place, f"{shown(value)} is not {wanted}")
        return value

    return read_word


def _spelled(spelling: Spelling, *, is_nullable: bool) -> Reader:
    """Words that a record in Python spells in another way."""
    meant = {spelt: word for word, spelt in spelling.items()}
    known = _word([*meant, None] if is_nullable else [*meant])

    def read_spelled(value: Any, place: Place, found: Found) -> Any:
        known(value, place, found)
        return meant.get(value) if isinstance(value, str) else None

    return read_spelled


def _list(parts: Sequence[Any]) -> Reader:
    """Lists of any length, which become tuples, or of as many elements as there are types."""
    each = _reader(parts[0] if parts else Any)
    count = None if parts and parts[-1] is ... else len(parts)

    def read_list(value: Any, place: Place, found: Found) -> Any:
        if not isinstance(value, list):
            found.add(place, f"{shown(value)} is not a list")
            return ()
        if count is not None and len(value) != count:
            found.add(place, f"it has {len(value)} elements, and not {count}")
        return tuple([each(inner, (place, number), found) for number, inner in enumerate(value)])

    return read_list


def _object(type_: Any) -> Reader:
    """Objects whose members have any name."""
    each = _reader(type_)

    def read_object(value: Any, place: Place, found: Found) -> Any:
        if not isinstance(value, dict):
            found.add(place, f"{shown(value)} is not an object")
            return {}
        return {key: each(inner, (place, key), found) for key, inner in value.items()}

    return read_object


def _nested(constraint: Nested) -> Reader:
    """Values of any shape: lists become tuples."""

    def read_nested(value: Any, place: Place, found: Found) -> Any:
        if isinstance(value, list):
            return tuple([read_nested(each, (place, n), found) for n, each in enumerate(value)])
        if isinstance(value, dict) and constraint.objects:
            return {key: read_nested(each, (place, key), found) for key, each in value.items()}
        if type(value) not in _OF_VALUES or not _is_of_json(value):
            found.add(place, f"{shown(value)} is no part of a value")
        return value

    return read_nested


_OF_VALUES = frozenset((bool, int, float, type(None)))


def _is_of_json(value: Any) -> bool:
    """True if JSON can have a scalar: it has no infinite numbers and no NaN."""
    return type(value) is not float or isfinite(value)


# --- records and alternatives --------------------------------------------------------------------


def _late(kind: type) -> Reader:
    """A reader of a kind of record, which is made when it is first needed.

    Some kinds have themselves as members.
    """

    def read_record(value: Any, place: Place, found: Found) -> Any:
        return _record(kind)(value, place, found)

    return read_record


@cache
def _record(kind: type) -> Reader:
    fields = fields_of(kind)
    readers = {field.key: (field.name, _field(field)) for field in fields}
    required = [field.key for field in fields if not field.is_optional]

    def read_record(value: Any, place: Place, found: Found) -> Any:
        if not isinstance(value, dict):
            found.add(place, f"{shown(value)} is not an object")
            return None
        before = len(found)
        for key in required:
            if key not in value:
                found.add(place, f"there is no `{key}`")
        made = {}
        for key, inner in value.items():
            known = readers.get(key)
            if known is None:
                found.add(place, f"there is {shown(key)}, which has no meaning there")
            else:
                name, reader = known
                made[name] = reader(inner, (place, key), found)
        if len(found) > before:
            return None
        return kind(**made)

    return read_record


def _field(field: Field) -> Reader:
    """The reader of a record's field."""
    if field.spelling is None:
        return _reader(field.type)
    return _spelled(field.spelling, is_nullable=may_be_null(bare(field.type)))


def _union(type_: Any) -> Reader:
    """One of several kinds of records, told apart by a member, or anything that may be null."""
    kinds = alternatives_of(type_)
    is_nullable = may_be_null(type_)
    one = _reader(kinds[0]) if len(kinds) == 1 else _told_apart(kinds, is_nullable=is_nullable)

    def read_one(value: Any, place: Place, found: Found) -> Any:
        return None if value is None and is_nullable else one(value, place, found)

    return read_one


def _told_apart(kinds: Sequence[type], *, is_nullable: bool) -> Reader:
    """Records of several kinds, by the member that says of which kind one is."""
    key = telling(kinds)
    readers = {word: _reader(kind) for kind in kinds for word in words_of(kind)[key]}
    said = [f"an object whose `{key}` is {shown(word)}" for word in readers]
    wanted = _or([*said, "null"] if is_nullable else said)

    def read_one(value: Any, place: Place, found: Found) -> Any:
        word = value.get(key) if isinstance(value, dict) else None
        reader = readers.get(word) if isinstance(word, str) else None
        if reader is None:
            found.add(place, f"it is not {wanted}")
            return None
        return reader(value, place, found)

    return read_one


# --- constraints ---------------------------------------------------------------------------------

Fault = Callable[[Any], str | None]
"""A function that finds the fault in a value of the right type; ``None`` if there is none."""


def _checked(reader: Reader, fault: Fault) -> Reader:
    def read_checked(value: Any, place: Place, found: Found) -> Any:
        before = len(found)
        made = reader(value, place, found)
        if len(found) == before and made is not None and (message := fault(made)) is not None:
            found.add(place, message)
        return made

    return read_checked


def _range(constraint: Range) -> Fault:
    least, most, step = constraint.least, constraint.most, constraint.multiple_of

    def fault(value: Any) -> str | None:
        if (least is not None and value < least) or (most is not None and value > most):
            return f"{shown(value)} is not {_limits(least, most)}"
        if step is not None and value % step:
            return f"{shown(value)} is no multiple of {step}"
        return None

    return fault


def _length(constraint: Length) -> Fault:
    def fault(value: Any) -> str | None:
        if len(value) >= constraint.least:
            return None
        return f"it has {len(value)} elements, and not {_limits(constraint.least, None)}"

    return fault


def _pattern(constraint: Pattern) -> Fault:
    matches = re.compile(constraint.text).fullmatch

    def fault(value: Any) -> str | None:
        return None if matches(value) else f"{shown(value)} does not look like {constraint.text}"

    return fault


_CHECKS: Mapping[type, Callable[[Any], Fault]] = {
    Range: _range, Length: _length, Pattern: _pattern,
}  # fmt: skip
"""The function that makes the check of each kind of constraint."""


def _limits(least: float | None, most: float | None) -> str:
    if most is None:
        return f"{least} or more"
    return f"{most} or less" if least is None else f"{least} to {most}"


def _or(words: Iterable[str]) -> str:
    *most, last = words
    return f"{', '.join(most)} or {last}" if most else last
