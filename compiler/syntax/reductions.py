"""The reductions of the LALR machine, for which the parts of a production are complete.

Each production has a function that replaces these parts by the node that they make together. The
functions are made when they are first needed, and kept for the whole process: they know nothing of
the text.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, partial
from operator import itemgetter
from typing import Any

from ..diagnostics.source import Source, Span
from .builder import Builder, Maker, maker
from .lalr_tables import Production, load_tables

Stack = list[int]
"""For each part that was read, its start, its end, and the state after it."""

Reduction = Callable[[Stack, list[object], Source, Builder], None]
"""Replaces the newest parts on the stack, and in the list of their values."""


@cache
def reduction(number: int) -> Reduction:
    """The reduction by a production of the grammar."""
    tables = load_tables()
    production = tables.productions[number]
    states = {
        below: gotos[production.origin]
        for below, gotos in enumerate(tables.gotos)
        if production.origin in gotos
    }
    make = _maker(production)
    if production.length == 0:
        return _of_nothing(make, production, states)
    if production.length == 1 and production.as_read:
        return _of_one(make, states)
    return _of_several(make, production, states)


def _maker(production: Production) -> Maker | None:
    """The function that makes the node of a production; None if its parts become a list."""
    if production.collapses and len(production.plan) == 1:
        return _the_part
    return maker(production.method)


def _the_part(_builder: Builder, _span: Span, part: object) -> object:
    """Unwraps an expression in parentheses."""
    return part


def _of_nothing(make: Maker | None, production: Production, states: Mapping[int, int]) -> Reduction:
    absent = [None] * len(production.plan)

    def reduce(stack: Stack, values: list[object], source: Source, builder: Builder) -> None:
        place = stack[-2]
        made = list(absent) if make is None else make(builder, Span(source, place, place), *absent)
        values.append(made)
        stack += (place, place, states[stack[-1]])

    return reduce


def _of_one(make: Maker | None, states: Mapping[int, int]) -> Reduction:
    """Nearly half of all: a name, a number, the first part of a list."""

    def reduce(stack: Stack, values: list[object], source: Source, builder: Builder) -> None:
        part = values[-1]
        values[-1] = (
            [part] if make is None else make(builder, Span(source, stack[-3], stack[-2]), part)
        )
        stack[-1] = states[stack[-4]]

    return reduce


def _of_several(make: Maker | None, production: Production, states: Mapping[int, int]) -> Reduction:
    length, depth = production.length, 3 * production.length
    arranged = _arrangement(production)

    def reduce(stack: Stack, values: list[object], source: Source, builder: Builder) -> None:
        start, end = stack[-depth], stack[-2]
        parts = arranged(values[-length:])
        del stack[-depth:], values[-length:]
        values.append(parts if make is None else make(builder, Span(source, start, end), *parts))
        stack += (start, end, states[stack[-1]])

    return reduce


def _arrangement(production: Production) -> Callable[[list[object]], Any]:
    """Makes a list, or some sequence for a maker, of the parts that a production hands over."""
    if production.as_read:
        return _as_read
    positions = [position for position, _ in production.plan]
    if (
        len(positions) > 1
        and production.method
        and not any(unpack for _, unpack in production.plan)
    ):
        chosen = itemgetter(*positions)
        return lambda parts: chosen([*parts, None])  # An absent option is at position -1.
    return partial(_arranged, production.plan)


def _as_read(parts: list[object]) -> list[object]:
    return parts


def _arranged(plan: tuple[tuple[int, bool], ...], parts: list[object]) -> list[object]:
    """A leading list is extended in place, so that long lists take linear time."""
    arranged: list[object] = []
    for position, unpack in plan:
        part = parts[position] if position >= 0 else None
        if not unpack:
            arranged.append(part)
        elif arranged:
            arranged.extend(part)  # type: ignore[arg-type]
        else:
            arranged = part  # type: ignore[assignment]
    return arranged
