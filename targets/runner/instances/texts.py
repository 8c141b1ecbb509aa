"""Parses values that are written as text on a command line, such as ``0,-1,0`` or ``#ff8800``.

The numbers of a matrix are written column after column, those of an array element after element. A
word that has no meaning is returned unchanged, so that the check of the value reports it.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

from ....compiler.budget import check
from ....compiler.documents.representations import Kind
from ..files import read_file
from .shapes import Elements, Members, Numbers, Shape
from .values import ParameterError

_BYTES_OF_VALUE = 72
"""The memory that Python needs for an empty list or mapping in a list; a number needs less."""
_WORDS = {"true": True, "false": False, "1": True, "0": False}


def parse(text: str, shape: Shape, name: str) -> object:
    """The value of ``text`` in a form that ``values.accepted`` takes.

    Raises ``ParameterError`` for types that have no textual form, or a wrong number of numbers.
    """
    words = re.split(r"[\s,]+", re.sub(r"^\((.*)\)$", r"\1", text.strip()).strip())
    if isinstance(shape, Numbers):
        return _numbers(words, shape)
    if isinstance(shape, Members) or not isinstance(shape.element, Numbers):
        raise ParameterError(name, f"`{name}` ({shape.type}) is set by its parts, each by its name")
    return _elements(words, shape, shape.element, name)


def elements_in_file(name: str, path: str) -> list[object]:
    """The elements of a storage buffer from a JSON file.

    Raises ``FileError`` and ``BudgetError`` if it cannot be read, and ``ParameterError`` if it
    holds no list.
    """
    data = read_file(Path(path), f"`{path}` for `{name}`")
    values = sum(map(data.count, (b",", b"[", b"{")))
    check("memory", values * _BYTES_OF_VALUE, f"the elements of `{path}` take")
    try:
        found = json.loads(data)
    except (ValueError, RecursionError) as error:
        reason = f"it is no JSON: {error}"
    else:
        if isinstance(found, list):
            return found
        reason = "it holds no list of elements"
    raise ParameterError(name, f"cannot take `{name}` from `{path}`: {reason}")


def _elements(words: list[str], shape: Elements, element: Numbers, name: str) -> object:
    width = element.lanes * max(element.columns, 1)
    if len(words) == shape.count and words[0].startswith("#"):
        width = 1
    if len(words) != width * shape.count:
        raise ParameterError(
            name, f"`{name}` ({shape.type}) takes {width * shape.count} numbers, not {len(words)}"
        )
    return [_numbers(words[at : at + width], element) for at in range(0, len(words), width)]


def _numbers(words: list[str], shape: Numbers) -> object:
    values = [_number(word, shape.kind) for word in words]
    return values[0] if len(values) == 1 else values


def _number(word: str, kind: Kind) -> object:
    if kind == "bool":
        return _WORDS.get(word, word)
    try:
        return float(word) if kind == "float" else int(word)
    except ValueError:
        return word
