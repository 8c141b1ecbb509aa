"""Real front ends take every builtin of constants, whatever these are.

WGSL has compilers compute expressions of constants and refuse those that overflow, divide by zero
or clamp between reversed limits. So no text may have such an expression. Which operands are
constant varies: all of them, or all but one.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice, product

import pytest

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.frontend import Frontend
from burnish.compiler.ir import build
from burnish.compiler.ir.build import Number
from burnish.compiler.ir.node import Graph, Node
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.stages import TARGET
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    VEC4,
    Matrix,
    Scalar,
    ScalarKind,
    Type,
    Vector,
    scalar_kind,
    width,
)
from burnish.compiler.passes.pipeline import Options, stage
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import LARGEST_FLOAT
from burnish.stdlib.builtins.row import Builtin
from burnish.support.frozen import changed
from burnish.targets.emit.emitter import emit
from burnish.targets.legalise.legalise import legalise
from burnish.targets.toolchain import Job, Toolchain

from .kit import PROFILES, can_have, instances

SPECIAL: Mapping[ScalarKind, tuple[Number, ...]] = {
    "float": (0.0, 1.0, -1.0, 0.5, 2.5, -0.0, 1e-30, 1e-40, 100.0, 1e30, LARGEST_FLOAT, -3e38),
    "int": (0, 1, -1, 2, 31, 32, 33, -32, 2**31 - 1, -(2**31)),
    "uint": (0, 1, 2, 31, 32, 33, 2**31, 2**32 - 1),
    "bool": (False, True),
}
MOST = 8
"""The number of random combinations of special values for each row and choice of operands."""
TOGETHER = 150
"""The number of values that are added up in one shader."""
ROWS = [
    row
    for row in BUILTINS.values()
    if row.method is None and not row.constants and row.of_group is None
]


def shader() -> Shader:
    """A shader that delivers the numbers of which values are made that are not constant."""
    report = Report()
    frontend = Frontend(report)
    module = frontend.open_text("material M { alpha = uv.x }", "<test>")
    assert module is not None
    (found,) = frontend.shaders(module, None, None, None)
    return found


class Values:
    """Makes operations of random special operands."""

    def __init__(self, row: Builtin, graph: Graph, varying: Node) -> None:
        self._row = row
        self._graph = graph
        self._varying = varying
        self._chance = random.Random(row.name)

    def all(self) -> Iterator[Node]:
        """Floats that are made of the builtin's values."""
        for types, result in self._shapes():
            places = range(len(types))
            for constant in ([True] * len(types), *([i != v for i in places] for v in places)):
                for _ in range(MOST // len(types)):
                    pairs = zip(types, constant, strict=True)
                    operands = tuple(self._operand(type_, fixed) for type_, fixed in pairs)
                    yield self._as_float(self._graph.node("call", result, operands, self._row.name))

    def _shapes(self) -> list[tuple[tuple[Type, ...], Type]]:
        """An instance of scalars and one of vectors for each number and kind of operands."""
        found = {}
        for types, result in instances(self._row):
            key = tuple((scalar_kind(t), type(t)) for t in types)
            found[key] = types, result
        return list(found.values())

    def _operand(self, type_: Type, is_constant: bool) -> Node:
        graph = self._graph
        if isinstance(type_, Matrix):
            column = Vector("float", type_.size)
            columns = tuple(self._operand(column, is_constant) for _ in range(type_.size))
            return graph.node("matrix", type_, columns)
        kind = scalar_kind(type_)
        assert kind is not None
        if not is_constant:
            return self._spread(self._varied(kind), type_)
        lanes = tuple(self._chance.choice(SPECIAL[kind]) for _ in range(width(type_)))
        return build.constant(graph, type_, lanes if isinstance(type_, Vector) else lanes[0])

    def _varied(self, kind: ScalarKind) -> Node:
        graph, number = self._graph, self._varying
        if kind == "float":
            return number
        if kind == "bool":
            return graph.node("call", BOOL, (number, build.floating(graph, 0.5)), "lt")
        return graph.node("call", Scalar(kind), (number,), f"to_{kind}")

    def _spread(self, scalar: Node, type_: Type) -> Node:
        return build.splat(self._graph, scalar, width(type_))

    def _as_float(self, value: Node) -> Node:
        graph = self._graph
        if isinstance(value.type, Matrix):
            value = build.part(graph, value, 1)
        if isinstance(value.type, Vector):
            lanes = [build.swizzle(graph, value, (i,)) for i in range(value.type.size)]
            return _sum(graph, [self._as_float(lane) for lane in lanes])
        if value.type == BOOL:
            sides = build.floating(graph, 0.25), build.floating(graph, 0.75)
            return graph.node("select", FLOAT, (value, *sides))
        return value if value.type == FLOAT else graph.node("call", FLOAT, (value,), "to_float")


def _sum(graph: Graph, terms: Sequence[Node]) -> Node:
    total = terms[0]
    for term in terms[1:]:
        total = graph.node("call", FLOAT, (total, term), "add")
    return total


def shaders(row: Builtin) -> Iterator[Shader]:
    """Shaders that compute the builtin's values, many in each."""
    first = shader()
    (target,) = first.results_of(TARGET)
    varying = next(n for n in first.roots.nodes if n.op == "cross")
    number = build.swizzle(first.graph, varying, (0,))
    values = Values(row, first.graph, number).all()
    while terms := list(islice(values, TOGETHER)):
        alpha = _sum(first.graph, terms)
        value = first.graph.node("splat", VEC4, (alpha,))
        results = tuple(
            changed(r, value=value) if r.kind == target.kind else r for r in first.results
        )
        yield changed(first, results=results)


def jobs(row: Builtin) -> Iterator[Job]:
    """The texts that every profile's checkers must accept."""
    for made in shaders(row):
        staged = stage(made, Options())
        for selected in PROFILES:
            if not can_have(selected, staged.program):
                continue
            legal = legalise(staged.program, selected.language, selected.profile, staged.undecided)
            for file, checker in product(emit(legal).files, selected.profile.checkers):
                if "fragment" in file.entries:
                    entry = file.entries["fragment"]
                    yield Job(checker, "frag", file.text, entry, f"{selected} {row.name}")


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.name)
def test_constant_operands_are_taken(row: Builtin, toolchain: Toolchain) -> None:
    asked = list(jobs(row))
    refused = [
        verdict.report() for verdict in toolchain.check(asked) if verdict.status != "accepted"
    ]
    assert asked and not refused, "\n".join(refused[:5])
