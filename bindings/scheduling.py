"""Makes statements of expressions: what several others need, or would be long, gets a name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from ..compiler.tracing import Expression, given, made
from ..support.frozen import EMPTY
from ..support.unique import Names
from .statements import Fold, Let, Place, Return, Statement

_MOST = 8
"""The most numbers in an expression without a name."""
_NOUNS = {
    "add": "sum", "sub": "difference", "mul": "product", "div": "quotient", "neg": "opposite",
    "abs": "magnitude", "where": "choice", "sqrt": "root", "lt": "below", "le": "at_most",
    "gt": "above", "ge": "at_least", "eq": "same", "ne": "differs", "minimum": "least",
    "maximum": "largest", "low_bits": "bits", "wrap": "whole", "and": "bits", "or": "bits",
    "xor": "bits", "invert": "bits", "lshift": "shifted", "rshift": "shifted",
    "float64": "number", "int64": "whole", "cos": "cosine", "sin": "sine",
}  # fmt: skip
"""Words for expressions that nobody has named."""


def returned(value: Expression, names: Names) -> tuple[Statement, ...]:
    """The statements of a function that returns a number."""
    schedule = Schedule(names, EMPTY, [value])
    last = schedule.named(value)
    return (*schedule.statements, Return(value=last))


def roots_of(values: Iterable[Any]) -> Iterator[Expression]:
    for value in values:
        if isinstance(value, Expression):
            yield value
        else:
            yield from roots_of(value)


class Schedule:
    """The statements that compute expressions, and the names that these have got."""

    def __init__(self, names: Names, hints: Mapping[int, str], roots: Iterable[Expression]) -> None:
        self._loads: list[Statement] = []
        self._others: list[Statement] = []
        self._names, self._hints = names, hints
        self._uses = _uses(roots)
        self._known: dict[int, Expression] = {}
        """What stands for each expression: a name, or the expression with names in it."""
        self._weights: dict[int, int] = {}

    @property
    def statements(self) -> tuple[Statement, ...]:
        """All statements: what is read several times is read first, in the order of its places."""
        return (*sorted(self._loads, key=_place), *self._others)

    def add(self, statement: Statement) -> None:
        """Add a statement behind those that compute what it needs."""
        self._others.append(statement)

    def inner(self, roots: Iterable[Expression]) -> Schedule:
        """The schedule of a loop's body, which may use the names around it."""
        found = Schedule(self._names, self._hints, roots)
        found._known, found._weights = dict(self._known), dict(self._weights)
        return found

    def lanes(self, lanes: Any) -> Any:
        """The lanes, or columns, with names in them."""
        if isinstance(lanes, Expression):
            return self.named(lanes)
        return tuple(self.lanes(each) for each in lanes)

    def named(self, root: Expression) -> Expression:
        """What stands for an expression, after statements for all that it needs."""
        pending = [root]
        while pending:
            each = pending[-1]
            missing = [one for one in each.operands if id(one) not in self._known]
            if missing and id(each) not in self._known:
                pending.extend(reversed(missing))
                continue
            pending.pop()
            if id(each) not in self._known:
                self._known[id(each)] = self._made(each, is_root=each is root)
        return self._known[id(root)]

    def _made(self, each: Expression, *, is_root: bool) -> Expression:
        if not each.operands and each.op != "load":
            self._weights[id(each)] = 1
            return each
        if each.op == "fold":
            return self._loop(each)
        if each.op == "lane":
            fold = self._known[id(each.operands[0])]
            name = fold.value[each.value]
            self._weights[id(each)] = 1
            return given(name, each.kind, is_natural=each.is_natural)
        weight = sum(self._weights.get(id(one), 1) for one in each.operands)
        operands = [self._known[id(one)] for one in each.operands]
        value = made(
            each.op, *operands, kind=each.kind, is_natural=each.is_natural, value=each.value
        )
        self._weights[id(each)] = max(weight, 1)
        if value.op == "neg" and value.operands[0].op == "neg":
            return value.operands[0].operands[0]
        if value.op == "neg" and not value.operands[0].operands:
            return value
        if self._uses[id(each)] < 2 and (is_root or weight <= _MOST):
            return value
        self._weights[id(each)] = 1
        name = self._names.new(self._wish(each))
        is_load = each.op == "load" and not each.operands
        (self._loads if is_load else self._others).append(Let(name=name, value=value))
        return given(name, each.kind, is_natural=each.is_natural)

    def _wish(self, each: Expression) -> str:
        if each.op == "load":
            return _word(each.value)
        return self._hints.get(id(each)) or _NOUNS.get(each.op, each.op)

    def _loop(self, each: Expression) -> Expression:
        """The name of each lane of a fold, behind its loop."""
        loop = each.value
        count, *start = (self._known[id(one)] for one in each.operands)
        index = self._names.new("term")
        lanes = [self._names.new("total") for _ in loop.states]
        inner = self.inner(roots_of(loop.following))
        inner._known[id(loop.turn)] = given(index, "int", is_natural=True)
        for state, name in zip(loop.states, lanes, strict=True):
            inner._known[id(state)] = given(name, state.kind, is_natural=state.is_natural)
        following = inner.lanes(loop.following)
        self.add(
            Fold(
                index=index, count=count, bound=loop.bound,
                states=tuple(zip(lanes, start, strict=True)),
                body=inner.statements, following=following,
            )
        )  # fmt: skip
        return given(tuple(lanes), "int")


def _place(statement: Statement) -> tuple[str, ...]:
    """The place that a statement reads, as a key for sorting."""
    assert isinstance(statement, Let)
    place: Place = statement.value.value
    return place.block, *map(str, place.way), *map(str, place.part)


def _word(place: Place) -> str:
    """A name for what is read: ``lamps_place_x``, ``object_to_world_0_x``."""
    *columns, lane = place.part or (None,)
    words = [str(each) for each in (*place.way, *columns) if each is not None]
    return "_".join(words if lane is None else [*words, "xyzw"[lane]])


def _uses(roots: Iterable[Expression]) -> dict[int, int]:
    """The number of times that each expression is needed, by identity."""
    uses: dict[int, int] = {}
    pending = list(roots)
    while pending:
        each = pending.pop()
        uses[id(each)] = uses.get(id(each), 0) + 1
        if uses[id(each)] == 1:
            pending.extend(each.operands)
    return uses
