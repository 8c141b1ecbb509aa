"""Every expansion of ``stdlib/meaning.burnish`` means what the reference says its builtin means."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from burnish.compiler.expansion_templates import definition, template
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Graph, Node, Roots
from burnish.compiler.ir.ranges import Ranges
from burnish.compiler.ir.shader import Notes
from burnish.compiler.ir.signatures import result_type
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    INT,
    MATRICES,
    UINT,
    Matrix,
    Scalar,
    Type,
    Vector,
    scalar_kind,
)
from burnish.compiler.ir.verify import verify
from burnish.compiler.passes.guard import Guarding
from burnish.compiler.passes.path_conditions import PathConditions
from burnish.compiler.reference.evaluate import evaluate
from burnish.compiler.reference.functions import evaluate as meaning
from burnish.compiler.reference.namespace import Lanes
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import SMALLEST_NORMAL

from ..fuzz.rules import instances
from .hardware import flat, hardware
from .kit import INT_TRAPS

TYPES: frozenset[Type] = frozenset({
    FLOAT, INT, UINT, BOOL, *(Vector("float", n) for n in (2, 3, 4)), Vector("int", 2),
    Vector("uint", 2), Vector("bool", 2), *MATRICES,
})  # fmt: skip
"""Enough types to see each form of a builtin, without every number of lanes of every kind."""


def fitting(name: str) -> list[tuple[Type, ...]]:
    """The types of operands, among ``TYPES``, that a builtin accepts."""
    return [operands for operands, _ in instances(name) if {*operands} <= TYPES]


EXPANDED = [row.name for row in BUILTINS.values() if row.expansion]
CASES = [(name, operands) for name in EXPANDED for operands in fitting(name)]
FLOAT_TRAPS = (0.0, -0.0, 1.0, -1.0, SMALLEST_NORMAL, -SMALLEST_NORMAL, 1e-40, -1e-40, 1e10)
LANES: dict[str, st.SearchStrategy[Any]] = {
    # Eighths, so that a quotient is whole just where it is exactly.
    "float": st.sampled_from(FLOAT_TRAPS) | st.integers(-64, 64).map(lambda n: n / 8),
    "int": st.sampled_from(INT_TRAPS) | st.integers(-20, 20),
    "uint": st.sampled_from([n for n in INT_TRAPS if n >= 0]) | st.integers(0, 2**32 - 1),
    "bool": st.booleans(),
}
BY_LOGARITHM = {"asinh", "acosh", "atanh"}
"""Near zero these are a difference of what is near one."""
EIGHTHS = st.integers(-32, 32).map(lambda n: n / 8)


def values(type_: Type) -> st.SearchStrategy[Lanes]:
    """Any value of a type, and the traps."""
    match type_:
        case Scalar(kind):
            return st.tuples(LANES[kind])
        case Vector(kind, size):
            return st.tuples(*[LANES[kind]] * size)
        case Matrix(columns, rows):
            # Without rounding it is clear which determinants are zero.
            return st.tuples(*[st.tuples(*[EIGHTHS] * rows)] * columns)
        case _:
            raise TypeError(type_)


def expanded(name: str, types: tuple[Type, ...]) -> tuple[Node, list[Node]]:
    """A builtin of parameters about which nothing is known, guarded; and the parameters."""
    graph = Graph()
    leaves = [
        graph.node("parameter", type_, (), Parameter(f"x{i}", type_, "material"))
        for i, type_ in enumerate(types)
    ]
    result = result_type(name, types)
    assert result is not None
    ranges = Ranges(())
    guarding = Guarding(graph, ranges, Notes(), PathConditions(Roots(), ranges))
    return guarding.make("call", result, tuple(leaves), name), leaves


def defined(name: str, types: tuple[Type, ...]) -> tuple[Node, list[Node]]:
    """The value that replaces a builtin where a language lacks it, and its parameters."""
    graph, ranges = Graph(), Ranges(())
    leaves = [
        graph.node("parameter", type_, (), Parameter(f"x{i}", type_, "material"))
        for i, type_ in enumerate(types)
    ]
    guarding = Guarding(graph, ranges, Notes(), PathConditions(Roots(), ranges))
    return guarding.written_out(definition(name, types), tuple(leaves)), leaves


def _shown(case: str | tuple[Type, ...]) -> str:
    return case if isinstance(case, str) else "-".join(map(str, case))


@pytest.mark.parametrize(("name", "types"), CASES, ids=_shown)
@settings(max_examples=15)
@given(data=st.data())
def test_an_expansion_is_the_builtin(
    name: str, types: tuple[Type, ...], data: st.DataObject
) -> None:
    node, leaves = expanded(name, types)
    verify([node], stage="guarded")
    operands = [data.draw(values(type_)) for type_ in types]
    given_lanes = {leaf.id: value for leaf, value in zip(leaves, operands, strict=True)}
    with hardware():
        found = evaluate(node, lambda leaf: given_lanes.get(leaf.id))
    expected = meaning(name, operands, kind=scalar_kind(types[0]) or "float")
    slack = 1e-9 if name in BY_LOGARITHM else 1e-300
    assert list(flat(found)) == pytest.approx(list(flat(expected)), rel=1e-9, abs=slack)
    assert not any(map(math.isnan, flat(found)))


DEFINED = [row.name for row in BUILTINS.values() if row.definition]
BY_EXPONENTIAL = {"sinh", "tanh"}
"""Near zero, their definitions are a difference of what is near one."""


def with_a_definition(name: str) -> list[tuple[Type, ...]]:
    """The types of operands for which the library defines a builtin: some languages lack it for
    whole numbers only."""
    found = []
    for types in fitting(name):
        with suppress(AssertionError):
            definition(name, types)
            found.append(types)
    return found


@pytest.mark.parametrize("name", DEFINED)
@settings(max_examples=30)
@given(data=st.data())
def test_a_definition_is_the_builtin(name: str, data: st.DataObject) -> None:
    types = data.draw(st.sampled_from(with_a_definition(name)))
    node, leaves = defined(name, types)
    operands = [data.draw(values(type_)) for type_ in types]
    given_lanes = {leaf.id: value for leaf, value in zip(leaves, operands, strict=True)}
    with hardware():
        found = evaluate(node, lambda leaf: given_lanes.get(leaf.id))
    expected = meaning(name, operands, kind=scalar_kind(types[0]) or "float")
    if name in BY_EXPONENTIAL:
        assert list(flat(found)) == pytest.approx(list(flat(expected)), rel=1e-9, abs=1e-15)
    else:
        assert found == expected


def test_a_scalar_expansion_is_applied_to_each_lane() -> None:
    assert template("pow", (Vector("float", 3), Vector("float", 3))).lanewise
    assert not template("sqrt", (Vector("float", 3),)).lanewise
