"""Evaluates a shader to terms: for each lane of each result, one.

``comparing.py`` does so with both programs, in one ``Terms``.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ...support.frozen import changed, frozen
from ..ir.node import Node
from ..ir.operations import CROSS, builtin_of
from ..ir.shader import Result, Shader
from ..ir.stages import DISCARD, TARGET
from ..ir.types import Scalar, Vector
from ..reference.evaluate import Evaluator, NotConstantError, TooLongError
from ..reference.namespace import Lanes
from .arithmetic import TooManyTermsError
from .domain import Domain
from .leaves import LANES, Leaves
from .symbols import Symbols
from .term import Term, plain
from .terms import Terms
from .variables import Variable

MOST_OPERATIONS = 400_000
"""The number of operations, with the turns of loops, from which a program is too large."""


class TooLargeError(Exception):
    """A program is too large to be written out as terms."""


class NotComparableError(Exception):
    """Programs cannot be compared; the text says why."""


@frozen
class Lane:
    """One number that a program delivers."""

    name: str
    """``color.r``, ``clip_position.w``, ``discard``."""
    result: str
    """The result that it is a lane of."""
    term: Term


def lanes_of(shader: Shader, terms: Terms, domain: Domain) -> list[Lane]:
    """The lanes of all results of a shader. Raises ``TooLargeError``.

    Where a fragment is discarded, its colours count as zero.
    """
    terms.neighbour = at_neighbour
    leaves = Leaves(terms, domain, shader.parameters)
    evaluator = Evaluator(
        leaves,
        Symbols(terms),
        Observer(terms),
        most_operations=MOST_OPERATIONS,
    )
    try:
        values = evaluator.values([result.value for result in shader.results])
    except (TooLongError, TooManyTermsError) as error:
        raise TooLargeError(shader.name) from error
    except NotConstantError as error:
        raise NotComparableError(
            f"{shader.name} joins the values of a work group, which is not compared"
        ) from error
    found = [
        Lane(name, name_of(result), terms.term(lane))
        for result, value in zip(shader.results, values, strict=True)
        for name, lane in zip(_names(result), flat(value), strict=True)
    ]
    return list(_without_discarded(found, terms))


def name_of(result: Result) -> str:
    """The name of a result, by which both programs are compared."""
    if result.store is not None:
        return ".".join(map(str, (result.store.buffer.name, *result.store.path, result.kind)))
    return result.name or result.kind


def flat(value: Lanes) -> Iterator[Any]:
    """All lanes of a value, those of its parts one after the other."""
    for lane in value:
        if isinstance(lane, tuple):
            yield from flat(lane)
        else:
            yield lane


def _names(result: Result) -> list[str]:
    """The names of a result's lanes."""
    name, type_ = name_of(result), result.value.type
    if isinstance(type_, Scalar):
        return [name]
    if isinstance(type_, Vector):
        lanes = "rgba" if result.kind == TARGET else LANES
        return [f"{name}.{lane}" for lane in lanes[: type_.size]]
    return [f"{name}[{number}]" for number in range(getattr(type_, "columns", 1) * 4)]


def _without_discarded(lanes: list[Lane], terms: Terms) -> Iterator[Lane]:
    """The lanes, with zero for what a fragment draws that is discarded."""
    discards = [lane.term for lane in lanes if lane.result == DISCARD]
    for lane in lanes:
        if not discards or lane.result in (DISCARD, "clip_position"):
            yield lane
        else:
            kept = terms.where(plain(discards[0]), terms.constant(0.0), lane.term)
            yield changed(lane, term=terms.term(kept))


class Observer:
    """Called for each operation: constants become exact numbers, and crossings what is known."""

    def __init__(self, terms: Terms) -> None:
        self._terms = terms
        self._crossed: dict[tuple[int, str], Term] = {}

    def __call__(self, node: Node, _operands: list[Lanes], value: Lanes) -> Lanes:
        if node.op == "constant":
            return self._exact(value)
        if node.op == "cross":
            return self._each(value, CROSS.data(node).mode)
        if builtin_of(node) == "normalize" and all(isinstance(lane, Term) for lane in value):
            *others, last = value
            self._terms.units.setdefault(last.id, tuple(others))
        return value

    def _exact(self, value: Lanes) -> Lanes:
        return tuple(
            self._exact(lane) if isinstance(lane, tuple)
            else self._terms.constant(lane) if isinstance(lane, float) else lane
            for lane in value
        )  # fmt: skip

    def _each(self, value: Lanes, mode: str) -> Lanes:
        return tuple(
            self._each(lane, mode) if isinstance(lane, tuple)
            else self._terms.crossed(lane, mode) if isinstance(lane, Term) else lane
            for lane in value
        )  # fmt: skip


def at_neighbour(variable: Variable, axis: int, index: int) -> Variable | None:
    """The variable with the value of another at a pixel of its quad."""
    if not variable.is_varying or variable.name == "front_facing":
        return None
    row, column = (index, None) if axis == -2 else (None, index)
    place = f"row {row}" if column is None else f"column {column}"
    return changed(variable, name=f"{variable.name} at {place}", near=variable.name)
