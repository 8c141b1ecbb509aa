"""The table of operations is complete, and whoever has to know each operation does.

A new operation makes these tests name the tables that lack it.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import get_args

import pytest

from burnish.compiler.ir import build, range_rules
from burnish.compiler.ir.node import Binder, Graph, Op
from burnish.compiler.ir.operations import (
    BINDING,
    FORMS,
    LEAVES,
    LOOPS,
    OPERATIONS,
    OUTSIDE,
    with_role,
)
from burnish.compiler.ir.types import FLOAT, INT
from burnish.compiler.ir.verify import InvalidGraphError, verify
from burnish.compiler.reference import operations as reference
from burnish.compiler.semantics.types import meanings
from burnish.targets.emit.expressions import Expressions

OPS = frozenset(get_args(Op))

UNKNOWN_RANGE = frozenset({"texture", "attribute", "bound", "matrix", "struct"})
"""Nothing is known of their values, or a range of them would say nothing."""

BARE = frozenset({"constant", "argument", "input", "bound", "formal", "vector", "splat", "matrix"})
"""The operations without a meaning of their own: a node ``as`` ascribes one."""

WITHOUT_STATEMENT = frozenset(OPS - LOOPS)
"""The operations that are printed as expressions; a loop is a statement."""


def standing_in(form: str) -> frozenset[str]:
    return frozenset(name for name, row in OPERATIONS.items() if form in row.forms)


def test_each_operation_has_a_row() -> None:
    assert OPERATIONS.keys() == OPS
    assert all(row.name == name for name, row in OPERATIONS.items())


def test_what_binds_has_a_binder_as_its_data() -> None:
    binders = {
        name
        for name, row in OPERATIONS.items()
        if isinstance(row.kinds, type) and issubclass(row.kinds, Binder)
    }
    assert binders == BINDING


def test_only_leaves_are_constants_variables_or_from_outside() -> None:
    assert with_role("constant", "outside", "variable") == LEAVES


@pytest.mark.parametrize(
    ("table", "needed"),
    [
        (reference._STEPS, OPS - BINDING - OUTSIDE - with_role("variable")),
        (range_rules.RULES, OPS - UNKNOWN_RANGE),
        (meanings._RULES, OPS - BARE - {"iterate"}),
        (Expressions.PRINTERS, standing_in("stored") & WITHOUT_STATEMENT),
    ],
    ids=["reference", "ranges", "meanings", "emission"],
)
def test_whoever_has_to_know_an_operation_does(
    table: Collection[str], needed: frozenset[str]
) -> None:
    assert frozenset(table) == needed


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("op", sorted(OPS))
def test_the_verifier_refuses_wrong_data_operands_and_forms(op: Op, form: str) -> None:
    """An object that is no data of any operation stands in for wrong data."""
    graph = Graph()
    one = build.floating(graph, 1.0)
    number = 1 if OPERATIONS[op].is_leaf else 0
    wrong = graph.node(op, FLOAT, (one,) * number, frozenset())
    with pytest.raises(InvalidGraphError):
        verify([wrong], stage=next(f for f in FORMS if f == form))


def test_data_is_as_typed_as_its_row() -> None:
    graph = Graph()
    swizzle = graph.node("swizzle", FLOAT, (build.constant(graph, INT, 1),), (0,))
    lanes: tuple[int, ...] = OPERATIONS["swizzle"].data(swizzle)
    assert lanes == (0,)
