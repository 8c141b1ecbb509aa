"""The fields of a document's records, as reading, writing and schemas need them.

Python keeps no types of fields that can be used as they are: annotations are texts here, so that
declaring a record costs next to nothing. They are resolved when a record is first read or
described; writing needs only the names.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

from ...support.frozen import DEFAULTS, frozen
from ..constraints import Spelling

KEYS = "KEYS"
"""The attribute of a record with the names in JSON of some fields, by their names in Python."""
WORDS = "WORDS"
"""The attribute of a record with the spellings of some fields' words, by their names in Python."""


def keys_of(kind: Any) -> dict[str, str]:
    """The names in JSON of a record's fields: words of Python have an underscore behind them."""
    own = getattr(kind, KEYS, {})
    return {name: own.get(name, name.rstrip("_")) for name in kind.__match_args__}


def spelling_of(kind: Any, name: str) -> Spelling | None:
    """The words in JSON of a record's field, by those in Python; ``None`` if they are the same."""
    spellings: Mapping[str, Spelling] = getattr(kind, WORDS, {})
    return spellings.get(name)


def left_out(kind: Any) -> frozenset[str]:
    """The fields of a record that JSON leaves out where they are ``None``, their default."""
    defaults = getattr(kind, DEFAULTS)
    return frozenset(name for name, default in defaults.items() if default is None)


@frozen
class Field:
    """One field of a record."""

    name: str
    """The name in Python."""
    key: str
    """The name in JSON."""
    type: Any
    """The type, with constraints."""
    is_optional: bool
    """True if JSON leaves it out where it is ``None``."""
    spelling: Spelling | None
    """The words that it may have in JSON, by those in Python, where they differ."""


@cache
def fields_of(kind: type) -> tuple[Field, ...]:
    """The fields of a kind of record, in order."""
    hints = get_type_hints(kind, include_extras=True)
    optional = left_out(kind)
    return tuple(
        Field(name, key, hints[name], name in optional, spelling_of(kind, name))
        for name, key in keys_of(kind).items()
    )


def is_record(type_: Any) -> bool:
    """True if a type is a kind of record."""
    return isinstance(type_, type) and hasattr(type_, DEFAULTS)


def constraints_of(type_: Any) -> tuple[Any, ...]:
    """The constraints beside a type in ``Annotated``, also of a type that may be null."""
    if get_origin(type_) is Annotated:
        return tuple(type_.__metadata__)
    return ()


def bare(type_: Any) -> Any:
    """A type without its constraints."""
    return get_args(type_)[0] if get_origin(type_) is Annotated else type_


def alternatives_of(type_: Any) -> Sequence[Any]:
    """The types of a union, but for ``None``; of another type itself alone."""
    if get_origin(type_) in (Union, UnionType):
        return [each for each in get_args(type_) if each is not NoneType]
    return [type_]


def may_be_null(type_: Any) -> bool:
    """True if ``None`` is one of the values of a type."""
    if get_origin(type_) in (Union, UnionType):
        return NoneType in get_args(type_)
    return get_origin(type_) is Literal and None in get_args(type_)


@cache
def words_of(kind: type) -> dict[str, tuple[Any, ...]]:
    """The fields of a record that have one of a few values, by their names in JSON, with these:
    alternatives are told apart by them."""
    found = {field.key: bare(field.type) for field in fields_of(kind)}
    return {key: get_args(type_) for key, type_ in found.items() if get_origin(type_) is Literal}


def telling(kinds: Sequence[type]) -> str:
    """The name in JSON of the field that tells some kinds of records apart.

    It has other values in each of them.
    """
    for key in words_of(kinds[0]):
        words = [word for kind in kinds for word in words_of(kind).get(key, ())]
        if len(set(words)) == len(words) and all(key in words_of(kind) for kind in kinds):
            return key
    raise TypeError(f"nothing tells {', '.join(kind.__name__ for kind in kinds)} apart")
