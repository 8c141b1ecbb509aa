"""Random values of any type, with heads that a simplification rule asks for."""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping

from burnish.compiler.ir import build
from burnish.compiler.ir.leaves import Number, Parameter
from burnish.compiler.ir.node import HEADS, SPECIAL, Graph, Node
from burnish.compiler.ir.types import (
    FLOAT,
    Array,
    Matrix,
    Scalar,
    ScalarKind,
    Struct,
    Type,
    Vector,
    scalar_kind,
    width,
    with_width,
)
from burnish.compiler.passes.rules.terms import CONSTANT, Heads
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import UNIT, UNKNOWN, Fact

from .typings import UnsuitableError, typed

FACTS = (
    UNKNOWN, Fact(0.0, 1.0), Fact(0.0, 1.0), Fact(1.0, 2.0), Fact(2.0, 3.0), Fact(-1.0, 0.0),
    Fact(-3.0, -2.0), Fact(0.5, 4.0), Fact(2.0, 2.0), Fact(-1e-4, 1.0), Fact(-1.0, 1e-4),
    Fact(-1e-30, 1.0), Fact(1e-30, 1.0), Fact(-50_000.0, 50_000.0),
)  # fmt: skip
"""Some are just below and above zero, and the squares of some integers wrap."""
NUMBERS: Mapping[ScalarKind, tuple[Number, ...]] = {
    "float": (0.0, -0.0, 1.0, -1.0, 0.5, 2.0, -3.25, 1e-30, 3e38),
    "int": (0, 1, -1, 2, 5, 31, 32, 33, 64, -32, 2**31 - 1, -(2**31)),
    "uint": (0, 1, 2, 5, 31, 32, 33, 64, 2**32 - 1),
    "bool": (True, False),
}
_NUMBERS: Mapping[str, Number] = {
    head: lane for (_is_bool, lane), head in SPECIAL.items() if isinstance(lane, int)
}
"""The numbers that the heads of constants tell."""
PAIR = Struct("Pair", (("a", FLOAT), ("b", Vector("float", 3))))
KINDS: tuple[ScalarKind, ...] = ("float", "int", "uint", "bool")


class RandomValues:
    """Makes values, from a seed."""

    def __init__(self, seed: str) -> None:
        self.graph = Graph()
        self._chance = random.Random(seed)
        self._made: list[Node] = []
        """The operands so far; some are used again."""

    def _any(self, type_: Type, heads: Heads | None) -> Node:
        """A value with one of these heads."""
        again = [n for n in self._made if n.type == type_ and (heads is None or n.head in heads)]
        if again and self._chance.random() < 0.3:
            return self._chance.choice(again)
        if heads is None:
            if scalar_kind(type_) and self._chance.random() < 0.2:
                return self._constant(type_)
            return self._leaf(type_)
        if heads >= CONSTANT and self._chance.random() < 0.5:
            return self._constant(type_)
        return self._with_head(type_, str(self._chance.choice(sorted(map(str, heads)))))

    def _with_head(self, type_: Type, head: str) -> Node:
        """A value with this head, and any operands."""
        if head in _NUMBERS:
            return self._constant(type_, _NUMBERS[head])
        if head == HEADS["constant"]:
            return self._constant(type_)
        if head not in BUILTINS:
            return _PARTS[head](self, type_)
        types = self._types(type_, head)
        heads = self._chance.choices((None, None, CONSTANT), k=len(types))
        return self.graph.node("call", type_, tuple(map(self._any, types, heads)), head)

    def _types(self, type_: Type, builtin: str) -> tuple[Type, ...]:
        """Types of operands with which a builtin has a result of this type."""
        found = [types for types, result in typed(builtin) if result == type_]
        if not found:
            raise UnsuitableError
        return self._chance.choice(found)

    def _leaf(self, type_: Type) -> Node:
        fact = self._fact(type_)
        leaf = Parameter(f"p{len(self.graph)}", type_, "material", fact=fact)
        return self.graph.node("parameter", type_, (), leaf)

    def _fact(self, type_: Type) -> Fact:
        kind = scalar_kind(type_)
        if kind is None or kind == "bool" or isinstance(type_, Matrix):
            return UNKNOWN
        if kind == "float" and isinstance(type_, Vector) and self._chance.random() < 0.2:
            return UNIT
        fact = self._chance.choice(FACTS)
        if kind != "float" and fact != UNKNOWN:
            low = float(max(int(fact.lo), 0)) if kind == "uint" else float(int(fact.lo))
            fact = Fact(low, float(max(int(fact.hi), low)))
        return fact.as_kind(kind)

    def _constant(self, type_: Type, lane: Number | None = None) -> Node:
        kind = scalar_kind(type_)
        if isinstance(type_, Matrix) and lane is None:
            columns = tuple(self._constant(type_.column).data for _ in range(type_.columns))
            return self.graph.node("constant", type_, (), columns)
        if kind is None or isinstance(type_, Matrix):
            raise UnsuitableError
        if lane is not None and isinstance(lane, bool) != (kind == "bool"):
            raise UnsuitableError
        if kind == "uint" and lane is not None and lane < 0:
            raise UnsuitableError
        same = self._chance.random() < 0.5
        numbers = [self._chance.choice(NUMBERS[kind]) for _ in range(width(type_))]
        if lane is not None:
            numbers = [float(lane) if kind == "float" else lane] * len(numbers)
        elif same:
            numbers = numbers[:1] * len(numbers)
        data = tuple(numbers) if isinstance(type_, Vector) else numbers[0]
        return build.constant(self.graph, type_, data)

    def _numeric(self, least: int = 1) -> Scalar | Vector:
        return with_width(self._chance.choice(KINDS), self._chance.randint(least, 4))

    # --- what is put together --------------------------------------------------------------------

    def _splat(self, type_: Type) -> Node:
        kind = scalar_kind(type_)
        if not isinstance(type_, Vector) or kind is None:
            raise UnsuitableError
        return build.splat(self.graph, self._any(Scalar(kind), None), type_.size)

    def _joined(self, type_: Type) -> Node:
        if not isinstance(type_, Vector):
            raise UnsuitableError
        first = self._chance.randint(1, type_.size - 1)
        sizes = (first, type_.size - first)
        parts = tuple(self._any(with_width(type_.kind, size), None) for size in sizes)
        return build.vector(self.graph, parts)

    def _swizzled(self, type_: Type) -> Node:
        kind = scalar_kind(type_)
        if kind is None or isinstance(type_, Matrix):
            raise UnsuitableError
        source = self._leaf(with_width(kind, self._chance.randint(2, 4)))
        lanes = self._lanes(width(source.type), width(type_))
        return self.graph.node("swizzle", type_, (source,), lanes)

    def _lanes(self, size: int, count: int) -> tuple[int, ...]:
        return tuple(self._chance.randrange(size) for _ in range(count))

    def _columns(self, type_: Type) -> Node:
        if not isinstance(type_, Matrix):
            raise UnsuitableError
        columns = [self._leaf(type_.column) for _ in range(type_.columns)]
        if self._chance.random() < 0.3 and type_.is_square:
            lanes = units(type_.columns)
            columns = [build.constant(self.graph, type_.column, unit) for unit in lanes]
        return build.matrix(self.graph, tuple(columns))

    def _elements(self, type_: Type) -> Node:
        if not isinstance(type_, Array):
            raise UnsuitableError
        same = self._chance.random() < 0.5
        one = self._leaf(type_.element)
        elements = tuple(one if same else self._leaf(type_.element) for _ in range(type_.count))
        return self.graph.node("array", type_, elements)

    def _structure(self, type_: Type) -> Node:
        if not isinstance(type_, Struct):
            raise UnsuitableError
        members = tuple(self._leaf(inner) for _, inner in type_.members)
        return self.graph.node("struct", type_, members)


_PARTS: Mapping[str, Callable[[RandomValues, Type], Node]] = {
    ".splat": RandomValues._splat,
    ".vector": RandomValues._joined,
    ".swizzle": RandomValues._swizzled,
    ".matrix": RandomValues._columns,
    ".array": RandomValues._elements,
    ".struct": RandomValues._structure,
}


def units(size: int) -> list[tuple[float, ...]]:
    """The columns of the identity."""
    return [tuple(float(row == column) for row in range(size)) for column in range(size)]
