"""The operands of the corpus: for each overload, cases that follow from its row.

First come the samples of the row and the places where its accuracy changes, with the numbers beside
them, then numbers at which operations stumble, and then numbers that are drawn at random, of which
most lie in the domain of the row. The same seed gives the same cases on every machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from random import Random
from typing import cast

from ....compiler.reference.functions import is_lanewise
from ....stdlib.builtins.accuracy import PLATFORMS, Within
from ....stdlib.builtins.facts import SMALLEST_NORMAL, Fact, Kind
from ....stdlib.builtins.overloads import COMPUTING, Overload, Shape, overloads
from ....stdlib.builtins.row import Builtin, nowhere
from ....support.frozen import frozen
from .numbers import EDGES, WHOLE_EDGES, beside, distribution, float32, one_of

OPERATIONS = {row.name: row for row in COMPUTING if not row.is_promise}
"""The builtins and operators that compute something of their operands alone."""

SCALAR_CASES, WHOLE_CASES, WIDE_CASES = 96, 48, 16
"""The most cases of an overload of scalars, of one of whole vectors, and of any other one.

Vectors are less worth where an operation works lane by lane, and matrices have many lanes.
"""
_OUTSIDE = 0.25
"""The part of the drawn cases that may be outside of the domain."""
_TRIES = 40
"""How many cases are drawn for each one that is wanted, until those that there are must do."""

Lanes = tuple[float, ...]
"""The lanes of an operand, those of a matrix column by column."""


@frozen
class CorpusCase:
    """Operands, and whether a device's own operation is not relied on for them."""

    operands: tuple[Lanes, ...]
    guarded: bool


def chosen_overloads(row: Builtin) -> list[Overload]:
    """The overloads that the corpus has cases for.

    An operation lane by lane has scalars and vectors of three lanes. Of all others, each size is an
    operation of its own.
    """
    found = list(overloads(row))
    if not is_lanewise(row.name):
        return found
    return [each for each in found if _is_matrix(each) or each.result.width in (1, 3)]


def cases_of(overload: Overload, seed: int) -> list[CorpusCase]:
    """The cases of an overload, without repetition: those of its row, then those drawn.

    Of these, at most a part is outside of the domain, unless there are too few inside of it.
    """
    chance = Random(f"{seed} {overload}")
    most = _most(overload)
    known: set[str] = set()

    def new(candidates: Iterator[tuple[Lanes, ...]]) -> Iterator[CorpusCase]:
        for operands in candidates:
            if (key := repr(operands)) not in known:
                known.add(key)
                yield CorpusCase(operands, is_guarded(overload, operands))

    found = list(new(_of_row(overload, most // 2)))
    room = most - len(found)
    inside, outside = list[CorpusCase](), list[CorpusCase]()
    for case in new(_drawn(overload, chance, most * _TRIES)):
        (outside if case.guarded else inside).append(case)
        if len(inside) == room or (len(outside) >= room and overload.row.domain is nowhere):
            break
    are_outside = max(round(room * _OUTSIDE), room - len(inside))
    outside = outside[:are_outside]
    return found + inside[: room - len(outside)] + outside


def is_guarded(overload: Overload, operands: tuple[Lanes, ...]) -> bool:
    """True if the operands are outside of the domain of the row."""
    row = overload.row
    if not is_lanewise(row.name) or _is_matrix(overload):
        return not row.domain(tuple(map(_fact, overload.operands, operands)))
    width = max(map(len, operands))
    spread = [lanes * width if len(lanes) == 1 else lanes for lanes in operands]
    return not all(
        row.domain(tuple(_fact(s, (x,)) for s, x in zip(overload.operands, lanes, strict=True)))
        for lanes in zip(*spread, strict=True)
    )


def _fact(shape: Shape, lanes: Lanes) -> Fact:
    """What range analysis knows of an operand of which it knows the value."""
    kind = cast(Kind, "matrix" if shape.columns else shape.kind)
    nonzero = all(abs(lane) >= SMALLEST_NORMAL for lane in lanes)
    length = math.hypot(*lanes) * (1.0 - 2.0**-20) if shape.width > 1 else 0.0
    return Fact(min(lanes), max(lanes), nonzero, length=length, kind=kind)


def _is_matrix(overload: Overload) -> bool:
    return any(shape.columns for shape in (*overload.operands, overload.result))


def _widest(overload: Overload) -> int:
    return max(shape.lanes for shape in (*overload.operands, overload.result))


def _most(overload: Overload) -> int:
    """The number of cases that an overload has, if there are so many."""
    if _widest(overload) == 1:
        return SCALAR_CASES
    is_wide = is_lanewise(overload.row.name) or _is_matrix(overload)
    return WIDE_CASES if is_wide else WHOLE_CASES


# --- what the row says ----------------------------------------------------------------------------


def _of_row(overload: Overload, most: int) -> Iterator[tuple[Lanes, ...]]:
    """The samples of the row, those beside them, and the limits of its accuracy."""
    count = len(overload.operands)
    samples = [sample for sample in overload.row.samples if len(sample) == count]
    if count == 1:
        samples += [(place,) for limit in _limits(overload.row) for place in (limit, -limit)]
    nearby = [
        (*sample[:place], beside(sample[place], step), *sample[place + 1 :])
        for sample in samples
        for place in range(count)
        for step in (1, -1)
        if overload.operands[place].kind == "float"
    ]
    for sample in [*samples, *nearby][:most]:
        pairs = zip(overload.operands, sample, strict=True)
        yield tuple((_fitting(shape, number),) * shape.lanes for shape, number in pairs)


def _limits(row: Builtin) -> list[float]:
    """The magnitudes of the operand beyond which some platform promises less."""
    bounds = [row.accuracy.on(platform).bound for platform in PLATFORMS]
    return sorted(
        {b.limit for b in bounds if isinstance(b, Within) and b.of == "operand"} - {math.inf}
    )


def _fitting(shape: Shape, number: float) -> float:
    """A number as a lane of a type."""
    if shape.kind == "float":
        return float32(number)
    if shape.kind == "bool":
        return int(number) & 1
    bits = int(number) & 0xFFFFFFFF
    return bits if shape.kind == "uint" or bits < 2**31 else bits - 2**32


# --- at random ------------------------------------------------------------------------------------


def _drawn(overload: Overload, chance: Random, count: int) -> Iterator[tuple[Lanes, ...]]:
    """Operands: edges, operands that resemble each other, and numbers of all distributions."""
    is_matrix = _is_matrix(overload)
    if not is_matrix:
        yield from _edges(overload)
    for number in range(count):
        if number % 4 == 0 and not is_matrix:
            yield tuple(_edge(chance, shape) for shape in overload.operands)
        elif number % 4 == 1 and len(overload.operands) > 1:
            yield _related(overload, chance, moderate=is_matrix)
        else:
            yield tuple(_random(chance, s, moderate=is_matrix) for s in overload.operands)


def _edges(overload: Overload) -> Iterator[tuple[Lanes, ...]]:
    """Each edge in turn, where there is a single operand of one lane."""
    if _widest(overload) == len(overload.operands) == 1:
        (shape,) = overload.operands
        for number in EDGES if shape.kind == "float" else WHOLE_EDGES:
            yield ((_fitting(shape, number),),)


def _edge(chance: Random, shape: Shape) -> Lanes:
    edges = EDGES if shape.kind == "float" else WHOLE_EDGES
    return tuple(_fitting(shape, one_of(chance, edges)) for _ in range(shape.lanes))


def _random(chance: Random, shape: Shape, *, moderate: bool) -> Lanes:
    draw = distribution(chance, shape.kind, moderate=moderate)
    return tuple(_fitting(shape, draw(chance)) for _ in range(shape.lanes))


def _related(overload: Overload, chance: Random, *, moderate: bool) -> tuple[Lanes, ...]:
    """Operands that are equal to the first one, opposite, half of it, or next to it."""
    first = _random(chance, overload.operands[0], moderate=moderate)
    found = [first]
    for shape in overload.operands[1:]:
        factor = one_of(chance, (1.0, -1.0, 0.5, 1.0 + 2.0**-23))
        lanes = (first * shape.lanes)[: shape.lanes]
        found.append(tuple(_fitting(shape, lane * factor) for lane in lanes))
    return tuple(found)
