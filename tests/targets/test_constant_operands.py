"""Real front ends take every builtin of constants, whatever these are.

WGSL has compilers compute expressions of constants and refuse those that overflow, divide by zero
or clamp between reversed limits. So no text may have such an expression. Which operands are
constant varies: all of them, or all but one.
"""

from __future__ import annotations

import random
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from itertools import product

import pytest

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.frontend import Frontend
from burnish.compiler.ir import build
from burnish.compiler.ir.leaves import Number
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

from ..suite.verdicts import refused
from .kit import PROFILES, Selected, can_have, has, instances

Profiles = tuple[Selected, ...]

SPECIAL: Mapping[ScalarKind, tuple[Number, ...]] = {
    "float": (0.0, 1.0, -1.0, 0.5, 2.5, -0.0, 1e-30, 1e-40, 100.0, 1e30, LARGEST_FLOAT, -3e38),
    "int": (0, 1, -1, 2, 31, 32, 33, -32, 2**31 - 1, -(2**31)),
    "uint": (0, 1, 2, 31, 32, 33, 2**31, 2**32 - 1),
    "bool": (False, True),
}
MOST = 8
"""The number of random combinations of special values for each row and choice of operands."""
TOGETHER = 600
"""The most values that are added up in one shader: compilers take longer to start than to read."""
ROWS = [
    row
    for row in BUILTINS.values()
    if row.method is None and not row.constants and row.of_group is None
]
MADE_OF_BITS = {"exponent", "extract_bits", "insert_bits", "ldexp", "mantissa", "quantize_half"}
"""The builtins that become operations on the bits of unsigned integers."""
PARTS = [ROWS[at : at + 26] for at in range(0, len(ROWS), 26)]
"""The rows whose values share shaders."""


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

    def all(self) -> Iterator[tuple[Profiles, Node]]:
        """Floats that are made of the builtin's values, each with the profiles that have it."""
        for types, result in self._shapes():
            having = _having(self._row, (*types, result))
            places = range(len(types))
            for constant in ([True] * len(types), *([i != v for i in places] for v in places)):
                for _ in range(MOST // len(types)):
                    pairs = zip(types, constant, strict=True)
                    operands = tuple(self._operand(type_, fixed) for type_, fixed in pairs)
                    value = self._graph.node("call", result, operands, self._row.name)
                    yield having, self._as_float(value)

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
            column = type_.column
            columns = tuple(self._operand(column, is_constant) for _ in range(type_.columns))
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


def _having(row: Builtin, types: tuple[Type, ...]) -> Profiles:
    """The profiles that have a builtin for values of these types, and these values themselves."""
    unsigned = row.name in MADE_OF_BITS or "uint" in map(scalar_kind, types)
    having = (each for each in PROFILES if has(each.profile, row, types))
    return tuple(each for each in having if each.profile.wide_integers or not unsigned)


def _sum(graph: Graph, terms: Sequence[Node]) -> Node:
    total = terms[0]
    for term in terms[1:]:
        total = graph.node("call", FLOAT, (total, term), "add")
    return total


def shaders(rows: Sequence[Builtin]) -> Iterator[tuple[Profiles, Shader]]:
    """Shaders that compute the values of builtins, many in each, and the profiles that have
    them."""
    first = shader()
    (target,) = first.results_of(TARGET)
    varying = next(n for n in first.roots.nodes if n.op == "cross")
    number = build.swizzle(first.graph, varying, (0,))
    alike: defaultdict[Profiles, list[Node]] = defaultdict(list)
    for row in rows:
        for having, value in Values(row, first.graph, number).all():
            alike[having].append(value)
    for having, values in alike.items():
        for at in range(0, len(values), TOGETHER):
            alpha = _sum(first.graph, values[at : at + TOGETHER])
            value = first.graph.node("splat", VEC4, (alpha,))
            results = tuple(
                changed(r, value=value) if r.kind == target.kind else r for r in first.results
            )
            yield having, changed(first, results=results)


def jobs(rows: Sequence[Builtin]) -> Iterator[Job]:
    """The texts that every profile's checkers must accept."""
    for having, made in shaders(rows):
        staged = stage(made, Options())
        for selected in having:
            assert can_have(selected, staged.program)
            legal = legalise(staged.program, selected.language, selected.profile, staged.undecided)
            for file, checker in product(emit(legal).files, selected.profile.checkers):
                if "fragment" in file.entries:
                    entry = file.entries["fragment"]
                    yield Job(checker, "frag", file.text, entry, str(selected))


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


@pytest.mark.parametrize("rows", PARTS, ids=lambda rows: f"{rows[0].name}-{rows[-1].name}")
def test_constant_operands_are_taken(rows: Sequence[Builtin], toolchain: Toolchain) -> None:
    asked = list(jobs(rows))
    found = [verdict.report() for verdict in refused(asked, toolchain)]
    assert asked and not found, "\n".join(found[:5])
