"""Lays fields out in blocks that no text has: their offsets are the binding's own affair."""

from __future__ import annotations

from collections.abc import Sequence

from ..compiler.documents.representations import kind_of, lanes_of
from ..compiler.documents.values import ParameterRow
from ..support.frozen import changed
from .fields import Field, Numbers
from .structures import Structures

ROW = 16


def loose(structures: Structures, rows: Sequence[ParameterRow]) -> tuple[Field, ...]:
    """The fields of parameters, one behind the other."""
    words = {row.name: row.name.replace(".", "_") for row in rows}
    arrays = {row.count: words[row.name] for row in rows if row.count}
    found: list[Field] = []
    for row in rows:
        field = structures.field(row, words[row.name], end(found), arrays.get(row.name, ""))
        found.append(changed(field, counter=words.get(row.count, "") if row.count else ""))
    return tuple(found)


def end(fields: Sequence[Field]) -> int:
    """The bytes of these fields, with which the next one begins."""
    return fields[-1].offset + -(-fields[-1].size // ROW) * ROW if fields else 0


def computed(word: str, representation: str, offset: int, doc: str = "") -> Field:
    """The field of a value that the host computes."""
    plain, _, count = representation.rstrip("]").partition("[")
    type_ = _numbers(plain, is_element=bool(count))
    stride = 4 * type_.stored_lanes * (type_.columns or 1) if count else 0
    return Field(
        name=word, word=word, type=type_, offset=offset, stride=stride, capacity=int(count or 0),
        meaning=representation, doc=doc, computed=True,
    )  # fmt: skip


def _numbers(plain: str, *, is_element: bool) -> Numbers:
    if plain.startswith("mat"):
        columns, _, rows = plain[3:].partition("x")
        lanes = int(rows or columns)
        return Numbers(kind="float", lanes=lanes, columns=int(columns), stored_lanes=4)
    kind, lanes = kind_of(plain), lanes_of(plain)
    return Numbers(
        kind="uint" if kind == "bool" else kind, truth=kind == "bool", lanes=lanes,
        stored_lanes=4 if is_element and lanes == 3 else lanes,
    )  # fmt: skip
