"""Makes JSON of documents: ``burnish.compile`` and the packages of web pages call ``to_json``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from .shapes import keys_of, left_out, spelling_of

_PLAIN = frozenset((str, int, float, bool, type(None)))


def to_json(value: object) -> Any:
    """A record, or anything that consists of records, as data for JSON."""
    kind: Any = type(value)
    if kind in _PLAIN:
        return value
    if isinstance(value, tuple | list):
        return [to_json(each) for each in value]
    if isinstance(value, Mapping):
        return {key: to_json(each) for key, each in value.items()}
    return _writer(kind)(value)


@cache
def _writer(kind: Any) -> Callable[[object], dict[str, Any]]:
    optional = left_out(kind)
    rows = [
        (name, key, name in optional, spelling_of(kind, name))
        for name, key in keys_of(kind).items()
    ]

    def write(record: object) -> dict[str, Any]:
        found = {}
        for name, key, is_optional, spelling in rows:
            value = getattr(record, name)
            if value is not None and spelling is not None:
                found[key] = spelling[value]
            elif value is not None or not is_optional:
                found[key] = to_json(value)
        return found

    return write
