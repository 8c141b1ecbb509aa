"""Converts jobs and pictures to JSON and back, for the pipe to a driver's process."""

from __future__ import annotations

import base64
import dataclasses
import types
import typing
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, TypeVar

from ....support.frozen import DEFAULTS

T = TypeVar("T")


def to_json(value: Any) -> Any:
    """A record of a job or of an answer, or a part of one, as JSON; bytes become base64."""
    if isinstance(value, bytes):
        return base64.b64encode(value).decode("ascii")
    if isinstance(value, tuple):
        return [to_json(item) for item in value]
    if isinstance(value, Mapping):
        return {key: to_json(item) for key, item in value.items()}
    if is_record(type(value)):
        names = type(value).__match_args__
        return {name: to_json(getattr(value, name)) for name in names}
    return value


def is_record(kind: Any) -> bool:
    """True if a type is a record of jobs: a dataclass, or one of the compiler's (``frozen``)."""
    return isinstance(kind, type) and (dataclasses.is_dataclass(kind) or hasattr(kind, DEFAULTS))


def from_json(kind: type[T], data: Mapping[str, Any]) -> T:
    """The record of class ``kind`` from which ``to_json`` has made ``data``."""
    hints = _hints(kind)
    return kind(**{name: _read(hints[name], value) for name, value in data.items()})


_hints: Callable[[type], Mapping[str, Any]] = cache(typing.get_type_hints)
"""The types of a record's fields. They are kept, as a job has many records of few classes."""


def _read(hint: Any, value: Any) -> Any:
    if value is None:
        return None
    if hint is bytes:
        return base64.b64decode(value)
    if typing.get_origin(hint) is tuple:
        return _read_tuple(typing.get_args(hint), value)
    if typing.get_origin(hint) is Mapping:
        _, kind = typing.get_args(hint)
        return {key: _read(kind, item) for key, item in value.items()}
    if isinstance(hint, types.UnionType):
        (hint,) = (part for part in typing.get_args(hint) if part is not type(None))
    return from_json(hint, value) if is_record(hint) else value


def _read_tuple(parts: tuple[Any, ...], values: list[Any]) -> tuple[Any, ...]:
    if parts[-1] is Ellipsis:
        return tuple(_read(parts[0], value) for value in values)
    return tuple(_read(part, value) for part, value in zip(parts, values, strict=True))
