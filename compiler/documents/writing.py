"""Makes JSON of documents.

``burnish.compile`` and the packages of web pages call ``to_json``, and ``burnish compile`` writes
what ``to_text`` returns.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from functools import cache
from json.encoder import encode_basestring
from math import isfinite
from types import NoneType
from typing import Any

from .shapes import keys_of, left_out, spelling_of

_PLAIN = frozenset((str, int, float, bool, type(None)))
_INTEGERS = frozenset((int,))


def to_json(value: object) -> Any:
    """A record, or anything that consists of records, as data for JSON."""
    kind: Any = type(value)
    if kind in _PLAIN:
        return value
    if isinstance(value, tuple | list):
        if _PLAIN.issuperset(map(type, value)):
            return list(value)
        return [to_json(each) for each in value]
    if isinstance(value, Mapping):
        return {key: to_json(each) for key, each in value.items()}
    return _writer(kind)(value)


def to_text(document: object) -> str:
    """The JSON of a document as the text of a file, in which each value has a line.

    ``json.dumps`` writes the same with ``indent=2``, but in Python, and so generally that it takes
    twice as long: a tenth of a short compile.
    """
    return _indented(to_json(document), "\n") + "\n"


def _indented(value: Any, line: str) -> str:
    """The text of data for JSON; ``line`` ends a line, and indents the next one."""
    if (leaf := _LEAVES.get(type(value))) is not None:
        return leaf(value)
    inner = f"{line}  "
    if isinstance(value, dict):
        members = [f"{encode_basestring(key)}: {_indented(v, inner)}" for key, v in value.items()]
        return f"{{{inner}{f',{inner}'.join(members)}{line}}}" if members else "{}"
    if _INTEGERS.issuperset(map(type, value)):  # The rows of source maps are many.
        elements = list(map(repr, value))
    else:
        elements = [_indented(each, inner) for each in value]
    return f"[{inner}{f',{inner}'.join(elements)}{line}]" if elements else "[]"


def _float(number: float) -> str:
    return repr(number) if isfinite(number) else json.dumps(number)


_LEAVES: Mapping[type, Callable[[Any], str]] = {
    str: encode_basestring,
    int: repr,
    float: _float,
    bool: {False: "false", True: "true"}.__getitem__,
    NoneType: {None: "null"}.__getitem__,
}
"""Writers of values without parts."""


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
