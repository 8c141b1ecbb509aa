"""Random graphs of operations, with random values for their leaves, for tests of evaluation.

A graph grows from leaves of all types. Each step applies a random operation to nodes that are there
already, so that values are shared, and sums and products become long.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from functools import cache
from itertools import product
from typing import Any

import numpy as np

from burnish.compiler.ir import build
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Folding, FoldOperator, Formal, Graph, Iterating, Node
from burnish.compiler.ir.signatures import parsed, result_type
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    INT,
    UINT,
    Array,
    Matrix,
    Scalar,
    Struct,
    Type,
    Vector,
    scalar_kind,
    square,
    width,
)
from burnish.compiler.reference.namespace import Lanes
from burnish.stdlib.builtins import BUILTINS

VECTORS = tuple(Vector("float", size) for size in (2, 3, 4))
TYPES: tuple[Type, ...] = (
    FLOAT, INT, UINT, BOOL, *VECTORS, Vector("int", 2), Vector("uint", 2), Vector("bool", 2),
    *(square(size) for size in (2, 3, 4)),
)  # fmt: skip
PAIR = Struct("Pair", (("number", FLOAT), ("vector", VECTORS[1])))

OTHERWISE = {
    name for name, row in BUILTINS.items() if row.uniform_control_flow or row.method is not None
}
"""Builtins that need a texture, or the values of others."""
CONSTANTS = (0.0, 1.0, -1.0, 0.5, 2.0, 3.0, 0.1, 1e-3, 7.5, 100.0)
SPECIAL = (0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 3.0, 1e-30, 2.0**-126, 1e-40, 255.0, 1e6)
WHOLE = (0, 1, 2, 3, 7, 31, 32, 255, 2**24 + 1, 2**31 - 1)


@cache
def instances(name: str) -> tuple[tuple[tuple[Type, ...], Type], ...]:
    """The types of operands that a builtin accepts, with that of its result."""
    counts = sorted({len(parsed(signature)[0]) for signature in BUILTINS[name].signatures})
    found = (
        (types, result_type(name, types)) for n in counts for types in product(TYPES, repeat=n)
    )
    return tuple((types, result) for types, result in found if result in TYPES)


@cache
def usable() -> tuple[str, ...]:
    """The builtins that random graphs use."""
    return tuple(name for name in BUILTINS if name not in OTHERWISE and instances(name))


class RandomGraph:
    """A graph with its leaves; the seed determines all of it."""

    def __init__(self, seed: int, steps: int = 24, names: tuple[str, ...] = ()) -> None:
        """``names`` are the builtins that it uses; without them, all that are ``usable``."""
        self.graph = Graph()
        self._chance = random.Random(seed)
        self._names = names or usable()
        self._nodes: dict[Type, list[Node]] = {}
        self.roots: list[Node] = []
        for _ in range(steps):
            self._keep(self._chance.choice(_WAYS)(self))
        used = {operand for root in self.roots for operand in root.operands}
        self.roots = [root for root in self.roots if root not in used] or self.roots[-1:]

    def _keep(self, node: Node) -> None:
        self._nodes.setdefault(node.type, []).append(node)
        self.roots.append(node)

    # --- operands ---------------------------------------------------------------------------------

    def _value(self, type_: Type) -> Node:
        """A node of a type: one that is there, or a new leaf."""
        known = self._nodes.setdefault(type_, [])
        if known and self._chance.random() < 0.8:
            return self._chance.choice(known[-4:])
        node = self._leaf(type_)
        known.append(node)
        return node

    def _leaf(self, type_: Type) -> Node:
        if type_ == FLOAT and self._chance.random() < 0.3:
            return build.floating(self.graph, self._chance.choice(CONSTANTS))
        if type_ == PAIR:
            return self._pair()
        if isinstance(type_, Array):
            return self._array()
        name = f"p{len(self.graph)}"
        return self.graph.node("parameter", type_, (), Parameter(name, type_, "material"))

    # --- operations -------------------------------------------------------------------------------

    def _builtin(self) -> Node:
        name = self._chance.choice(self._names)
        types, result = self._chance.choice(instances(name))
        return self.graph.node("call", result, tuple(map(self._value, types)), name)

    def _arithmetic(self) -> Node:
        """An operation of which long sums and products are made."""
        name = self._chance.choice(("add", "sub", "mul", "mul", "mix", "dot", "fma"))
        types, result = self._chance.choice([
            (types, result) for types, result in instances(name)
            if {scalar_kind(type_) for type_ in types} == {"float"}
        ])  # fmt: skip
        return self.graph.node("call", result, tuple(map(self._value, types)), name)

    def _select(self) -> Node:
        type_ = self._chance.choice(TYPES)
        operands = (self._value(BOOL), self._value(type_), self._value(type_))
        return self.graph.node("select", type_, operands)

    def _comparison(self) -> Node:
        name = self._chance.choice(("lt", "le", "gt", "ge", "eq", "ne"))
        return self.graph.node("call", BOOL, (self._value(FLOAT), self._value(FLOAT)), name)

    def _vector(self) -> Node:
        pairs: list[tuple[Type, Type]] = [
            (FLOAT, FLOAT), (FLOAT, VECTORS[0]), (VECTORS[1], FLOAT)
        ]  # fmt: skip
        parts = self._chance.choice(pairs)
        return build.vector(self.graph, tuple(map(self._value, parts)))

    def _swizzle(self) -> Node:
        source = self._value(self._chance.choice(VECTORS))
        size = self._chance.randint(1, 4)
        lanes = tuple(self._chance.randrange(width(source.type)) for _ in range(size))
        return build.swizzle(self.graph, source, lanes)

    def _index(self) -> Node:
        wholes: list[tuple[Type, int]] = [(each, each.size) for each in VECTORS]
        wholes += [(square(3), 3), (Array(FLOAT, 3), 3)]
        whole, count = self._chance.choice(wholes)
        bound = build.constant(self.graph, INT, count)
        at = self.graph.node("call", INT, (self._value(INT), bound), "mod")
        return build.index(self.graph, self._value(whole), at)

    def _array(self) -> Node:
        return self.graph.node("array", Array(FLOAT, 3), tuple(map(self._value, (FLOAT,) * 3)))

    def _pair(self) -> Node:
        operands = tuple(self._value(type_) for _, type_ in PAIR.members)
        return self.graph.node("struct", PAIR, operands)

    def _member(self) -> Node:
        name, _ = self._chance.choice(PAIR.members)
        return build.member(self.graph, self._value(PAIR), name)

    def _fold(self) -> Node:
        operators: tuple[FoldOperator, ...] = ("add", "add", "mul", "min", "max")
        operator, bound = self._chance.choice(operators), self._chance.randint(1, 6)
        formal = Formal("i")
        number = self._number(formal)
        term = self._applied(number, self._value(FLOAT))
        operands = (self._count(bound), self._value(FLOAT), term)
        return self.graph.node("fold", FLOAT, operands, Folding(operator, bound, (formal,)))

    def _iterate(self) -> Node:
        """A state that is fed back; a comparison of it may end the loop."""
        turn, state = Formal("i"), Formal("x")
        before = self.graph.node("formal", FLOAT, (), state)
        following = self._applied(before, self._value(FLOAT))
        if self._chance.random() < 0.5:
            following = self._applied(following, self._number(turn))
        going = build.constant(self.graph, BOOL, True)
        if self._chance.random() < 0.4:
            going = self.graph.node("call", BOOL, (before, self._value(FLOAT)), "lt")
        bound = self._chance.randint(1, 6)
        operands = (self._count(bound), self._value(FLOAT), going, following)
        return self.graph.node("iterate", FLOAT, operands, Iterating(bound, 1, (turn, state)))

    def _count(self, bound: int) -> Node:
        if self._chance.random() < 0.6:
            return build.constant(self.graph, INT, bound)
        limits = (build.constant(self.graph, INT, n) for n in (0, bound))
        return self.graph.node("call", INT, (self._value(INT), *limits), "clamp")

    def _number(self, formal: Formal) -> Node:
        index = self.graph.node("formal", INT, (), formal)
        return self.graph.node("call", FLOAT, (index,), "to_float")

    def _applied(self, x: Node, y: Node) -> Node:
        """A function of two numbers."""
        name = self._chance.choice(("add", "sub", "mul", "min", "sin", "mix", "fract", "div"))
        if name in ("sin", "fract"):
            inner = self.graph.node("call", FLOAT, (x, y), "mul")
            return self.graph.node("call", FLOAT, (inner,), name)
        operands = (x, y, build.floating(self.graph, 0.25)) if name == "mix" else (x, y)
        return self.graph.node("call", FLOAT, operands, name)


_WAYS: tuple[Callable[[RandomGraph], Node], ...] = (
    *(RandomGraph._builtin,) * 8,
    *(RandomGraph._arithmetic,) * 8,
    RandomGraph._select, RandomGraph._comparison, RandomGraph._vector, RandomGraph._swizzle,
    RandomGraph._index, RandomGraph._array, RandomGraph._pair, RandomGraph._member,
    RandomGraph._fold, RandomGraph._iterate,
)  # fmt: skip


class Values:
    """Values of parameters: arrays of numbers that every device has. They depend on the seed."""

    def __init__(self, seed: int, count: int = 32) -> None:
        self._seed, self._count = seed, count

    def lanes(self, name: str, type_: Type) -> Any:
        """The arrays of a parameter, in the form of its type."""
        chance = np.random.default_rng([self._seed, *name.encode()])
        match type_:
            case Matrix(columns, rows):
                return tuple(
                    tuple(self._lane(chance, "float") for _ in range(rows)) for _ in range(columns)
                )
            case Scalar() | Vector():
                kind = scalar_kind(type_) or "float"
                return tuple(self._lane(chance, kind) for _ in range(width(type_)))
        raise TypeError(type_)

    def _lane(self, chance: np.random.Generator, kind: str) -> Any:
        if kind == "bool":
            return chance.random(self._count) < 0.5
        is_special = chance.random(self._count) < 0.25
        if kind == "float":
            ordinary = chance.choice((-1.0, 1.0), self._count) * np.exp2(
                chance.uniform(-4.0, 4.0, self._count)
            )
            special = chance.choice(SPECIAL, self._count)
            return np.where(is_special, special, ordinary).astype(np.float32).astype(np.float64)
        low = 0 if kind == "uint" else -8
        ordinary = chance.integers(low, 9, self._count)
        return np.where(is_special, chance.choice(WHOLE, self._count), ordinary)


def leaves(
    values: Values, made: Callable[[Any, float, str], Any]
) -> Callable[[Node], Lanes | None]:
    """The function that the evaluator asks for the values of leaves.

    ``made`` makes a lane of an array, of the relative error that it may have, and of the name of
    its place. Some parameters are like interpolated values, which no device has exactly.
    """

    def lanes(node: Node) -> Lanes | None:
        if not isinstance(node.data, Parameter):
            return None
        name = node.data.name
        is_float = scalar_kind(node.type) == "float"
        error = 2.0**-18 if is_float and name.encode()[-1] % 3 == 0 else 0.0
        given = values.lanes(name, node.type)
        found: Lanes = _mapped(given, name, lambda array, place: made(array, error, place))
        return found

    return lanes


def _mapped(value: Any, place: str, made: Callable[[Any, str], Any]) -> Any:
    if isinstance(value, tuple):
        return tuple(_mapped(part, f"{place}.{i}", made) for i, part in enumerate(value))
    return made(value, place)


def flat(value: Any) -> Iterator[Any]:
    """All lanes of a value."""
    if isinstance(value, tuple):
        for part in value:
            yield from flat(part)
    else:
        yield value
