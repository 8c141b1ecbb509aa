"""Reads JSON from outside: plans, reflections, and the elements of buffers.

Nothing in such a text is believed. It is refused if it has too many values, before any of them is
made; if it is nested too deeply; if a name occurs twice in an object, which hosts understand in
different ways; or if other programs could not read a number or a text in it.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Sequence
from typing import Any, NoReturn

from ...compiler.budget import allowed, check, holding
from .files import FileError

MOST_NESTED = 200
"""The deepest nesting of lists and objects."""

LARGEST = 2**53
"""The largest number up to which all languages of hosts tell whole numbers apart."""

_TEXT = re.compile(rb'"[^"\\]*+(?:\\.?[^"\\]*+)*+(?:"|\Z)', re.DOTALL)
_ASTRAL = re.compile(rb"[\xf0-\xff]|\\u[dD][89abAB]")
"""A pattern of characters for which Python needs four bytes, as they are written."""
_HALF = re.compile(r"\\u[dD][89a-fA-F]")
"""A pattern of escaped halves of characters (surrogates), as they are written."""
_SURROGATE = re.compile("[\ud800-\udfff]")
"""A pattern of halves of characters (surrogates) in a text that was read."""
_OF_A_VALUE = 256
"""The most bytes that a value takes, with a short name."""


class DocumentError(FileError):
    """The text is no JSON that can be read; the message says where, and why."""


class Quota:
    """The number of values that several documents may still have together."""

    def __init__(self, what: str) -> None:
        """``what`` begins the message if there are too many values, and ends with its verb."""
        self._what = what
        self._taken = 0

    def take(self, data: bytes) -> int:
        """Count the values of a text; returns the most that it can have. Raises ``BudgetError``."""
        count = _at_most(data)
        if self._taken + count > allowed("values"):
            # Commas and brackets within strings do not count.
            count = _at_most(_TEXT.sub(b"", data))
        self._taken += count
        check("values", self._taken, self._what)
        return count


def read_json(data: bytes, name: str, quota: Quota | None = None) -> Any:
    """The value of a JSON text in UTF-8.

    ``name`` is the text's name in errors, and ``quota`` the number of values that there may be.
    Raises ``DocumentError`` and ``BudgetError``.
    """
    count = (quota or Quota(f"{name} has")).take(data)
    # Python needs as many bytes for each character of a text as for the largest one.
    size = count * _OF_A_VALUE + 2 * len(data) * _width_of_characters(data)
    with holding(size, f"reading {name} takes"):
        return _read(data, name)


def _read(data: bytes, name: str) -> Any:
    try:
        text = data.decode("utf-8")
        found = json.loads(
            text, object_pairs_hook=_members, parse_constant=_constant, parse_float=_float,
            parse_int=_integer,
        )  # fmt: skip
        _check_nesting(found)
        if _HALF.search(text):
            _check_halves(found)
    except json.JSONDecodeError as error:
        reason = f"{error.msg}, line {error.lineno}, column {error.colno}"
    except UnicodeDecodeError:
        raise DocumentError(f"{name} is no text in UTF-8") from None
    except RecursionError:
        reason = _TOO_DEEP
    except ValueError as error:
        reason = str(error)
    else:
        return found
    raise DocumentError(f"{name} is no JSON that can be read: {reason}")


_TOO_DEEP = f"lists and objects stand in each other more than {MOST_NESTED} times"


def _at_most(data: bytes) -> int:
    """The most values that a text can have: the number of commas and opening brackets, and one."""
    return 1 + data.count(b",") + data.count(b"[") + data.count(b"{")


def _width_of_characters(data: bytes) -> int:
    """The bytes that Python needs for each character of a text in UTF-8 that may be escaped."""
    if _ASTRAL.search(data):
        return 4
    return 1 if data.isascii() and rb"\u" not in data else 2


def _check_nesting(document: Any) -> None:
    level = [document]
    for _ in range(MOST_NESTED + 1):
        level = [
            inner
            for each in level
            if isinstance(each, dict | list)
            for inner in (each.values() if isinstance(each, dict) else each)
        ]
        if not level:
            return
    raise ValueError(_TOO_DEEP)


def _check_halves(document: Any) -> None:
    """Refuse texts with half a character, one by one: a copy of all texts would be large."""
    if isinstance(document, str):
        if not document.isascii() and _SURROGATE.search(document):
            raise ValueError("a text in it has half of a character")
    elif isinstance(document, list):
        for each in document:
            _check_halves(each)
    elif isinstance(document, dict):
        for name, value in document.items():
            _check_halves(name)
            _check_halves(value)


def _members(pairs: Sequence[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) != len(pairs):
        seen: set[str] = set()
        for name, _ in pairs:
            if name in seen:
                raise ValueError(f"{json.dumps(name[:60])} stands twice in one object")
            seen.add(name)
    return found


def _constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is no number of JSON")


def _float(text: str) -> float:
    number = float(text)
    if not math.isfinite(number):
        raise ValueError(f"{_short(text)} is too large for a number")
    return number


def _integer(text: str) -> int:
    if len(text) > len(str(-LARGEST)) or abs(number := int(text)) > LARGEST:
        raise ValueError(f"{_short(text)} is too large for a whole number")
    return number


def _short(text: str) -> str:
    return text if len(text) <= 20 else f"{text[:20]}…"
