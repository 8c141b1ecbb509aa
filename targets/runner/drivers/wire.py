"""Converts jobs and their results to JSON and back: for the pipe to a driver's process and for the
store with the bytes apart, which are many, and for web pages with all in one."""

from __future__ import annotations

import base64
import dataclasses
import io
import json
import struct
import types
import typing
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, TypeVar

from ....support.frozen import DEFAULTS

T = TypeVar("T")

_PLAIN = frozenset((str, int, float, bool, type(None)))
_LENGTH = struct.Struct("<I")


def _text(data: bytes) -> str:
    return base64.b64encode(data).decode("ascii")


def to_json(value: Any, of_bytes: Callable[[bytes], Any] = _text) -> Any:
    """A record of a job or of an answer, or a part of one, as JSON; bytes become base64."""
    kind = type(value)
    if kind in _PLAIN:
        return value
    if kind is bytes:
        return of_bytes(value)
    if isinstance(value, tuple):
        if _PLAIN.issuperset(map(type, value)):
            return list(value)
        return [to_json(item, of_bytes) for item in value]
    if is_record(kind):
        return {name: to_json(getattr(value, name), of_bytes) for name in kind.__match_args__}
    if isinstance(value, Mapping):
        return {key: to_json(item, of_bytes) for key, item in value.items()}
    return value


def _is_record(kind: Any) -> bool:
    return isinstance(kind, type) and (dataclasses.is_dataclass(kind) or hasattr(kind, DEFAULTS))


is_record: Callable[[Any], bool] = cache(_is_record)
"""True if a type is a record of jobs: a dataclass, or one of the compiler's (``frozen``). What is
found is kept, as a job has many records of few classes."""


def from_json(
    kind: type[T], data: Mapping[str, Any], to_bytes: Callable[[Any], bytes] = base64.b64decode
) -> T:
    """The record of class ``kind`` from which ``to_json`` has made ``data``."""
    hints = _hints(kind)
    return kind(**{name: _read(hints[name], value, to_bytes) for name, value in data.items()})


def split(record: Any) -> tuple[Any, bytes]:
    """A record as JSON that has a length for each ``bytes``, and all of these, one behind the
    other."""
    parts: list[bytes] = []

    def length(data: bytes) -> int:
        parts.append(data)
        return len(data)

    content = to_json(record, length)
    return content, b"".join(parts)


def joined(kind: type[T], content: Mapping[str, Any], data: bytes) -> T:
    """The record of class ``kind`` that ``split`` has taken apart."""
    return from_json(kind, content, io.BytesIO(data).read)


def packed(record: Any) -> bytes:
    """A record as bytes: the JSON of ``split`` behind its length, and the bytes of the record."""
    content, data = split(record)
    head = json.dumps(content).encode()
    return b"".join((_LENGTH.pack(len(head)), head, data))


def unpacked(kind: type[T], data: bytes) -> T:
    """The record of class ``kind`` from which ``packed`` has made ``data``."""
    (length,) = _LENGTH.unpack_from(data)
    start = _LENGTH.size + length
    return joined(kind, json.loads(data[_LENGTH.size : start]), data[start:])


_hints: Callable[[type], Mapping[str, Any]] = cache(typing.get_type_hints)
"""The types of a record's fields. They are kept, as a job has many records of few classes."""


def _read(hint: Any, value: Any, to_bytes: Callable[[Any], bytes]) -> Any:
    if value is None:
        return None
    if hint is bytes:
        return to_bytes(value)
    if typing.get_origin(hint) is tuple:
        return _read_tuple(typing.get_args(hint), value, to_bytes)
    if typing.get_origin(hint) is Mapping:
        _, kind = typing.get_args(hint)
        return {key: _read(kind, item, to_bytes) for key, item in value.items()}
    if isinstance(hint, types.UnionType):
        (hint,) = (part for part in typing.get_args(hint) if part is not type(None))
    return from_json(hint, value, to_bytes) if is_record(hint) else value


def _read_tuple(
    parts: tuple[Any, ...], values: list[Any], to_bytes: Callable[[Any], bytes]
) -> tuple[Any, ...]:
    if parts[-1] is Ellipsis:
        return tuple(_read(parts[0], value, to_bytes) for value in values)
    pairs = zip(parts, values, strict=True)
    return tuple(_read(part, value, to_bytes) for part, value in pairs)
