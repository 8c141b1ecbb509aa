"""Helpers for the tests of passes: graphs after every pass, and values of their leaves."""

from __future__ import annotations

import math
import random
import struct
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from unittest.mock import patch

from burnish.compiler.diagnostics.diagnostic import CompileError, Report
from burnish.compiler.frontend import Frontend
from burnish.compiler.ir.leaves import Attribute, Buffer, Parameter
from burnish.compiler.ir.node import Node, Roots, reachable
from burnish.compiler.ir.operations import INPUT, builtin_of, joins_group
from burnish.compiler.ir.rulebook import RULES
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.types import (
    Array,
    Matrix,
    Scalar,
    Struct,
    TextureType,
    Type,
    Vector,
    scalar_kind,
    width,
)
from burnish.compiler.packing import Packing, element_packing
from burnish.compiler.passes import pipeline
from burnish.compiler.passes.checkpoint import verified
from burnish.compiler.passes.hoist import Derived
from burnish.compiler.passes.lower_stages import lower_stages
from burnish.compiler.passes.pipeline import Options, Staged
from burnish.compiler.reference import scalars
from burnish.compiler.reference.evaluate import Evaluator
from burnish.compiler.reference.held_values import stored
from burnish.compiler.reference.namespace import Binary, Lanes, WorkGroups
from burnish.compiler.reference.storage_buffers import BufferReader, Contents
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import UNKNOWN, Fact
from burnish.stdlib.builtins.row import anything
from burnish.support.frozen import changed

TRAPS = (0.0, -0.0, 1.0, -1.0, 1e-40, -1e-30, 2.0, 0.5)
LARGEST_INT = 2**31 - 1
INT_TRAPS = (0, 1, -1, 2, 31, 50_000, -(2**31), LARGEST_INT)


def range_rules() -> tuple[str, ...]:
    """The names of all rules of range analysis, builtins' last."""
    return (*RULES, *(name for name, row in BUILTINS.items() if row.range is not anything))


def elaborated(
    source: str | Path, rig: str | None = None, pass_: str | None = None
) -> list[Shader]:
    """The shaders of a text or a file, as semantics makes them."""
    report = Report()
    frontend = Frontend(report)
    if isinstance(source, Path):
        module = frontend.open_file(source)
    else:
        module = frontend.open_text(source, "<test>")
    assert module is not None
    found = frontend.shaders(module, None, rig, pass_)
    if report.failed:
        raise CompileError(report.diagnostics)
    return found


def shaders(source: str | Path, rig: str | None = None, pass_: str | None = None) -> list[Shader]:
    """The shaders of a text or a file, in the form that the other passes take."""
    return [lower_stages(found) for found in elaborated(source, rig, pass_)]


def shader(source: str) -> Shader:
    """The only shader of a text."""
    (only,) = shaders(source)
    return only


@dataclass(frozen=True)
class History:
    """A shader's roots (position, targets, discard) after every pass, in order."""

    roots: dict[str, list[Node]]
    staged: Staged


def history(given: Shader, options: Options | None = None) -> History:
    """The roots of a shader after every pass; each graph is verified."""
    roots: dict[str, list[Node]] = {}

    def record(name: Any, form: Any, found: Roots) -> Roots:
        roots[name] = list(found)
        return verified(name, form, found)

    with patch.object(pipeline, "verified", record):
        staged = pipeline.stage(given, options or Options())
    return History(roots, staged)


# --- values of leaves ----------------------------------------------------------------------------


def _pack(data: bytearray, offset: int, packing: Packing, value: Any) -> None:
    """Write a value to where a storage buffer has it."""
    if packing.count is not None:
        for number, element in enumerate(value):
            place = offset + number * packing.stride
            _pack(data, place, changed(packing, count=None), element)
    elif packing.members:
        for member, part in zip(packing.members, value, strict=True):
            _pack(data, offset + member.offset, member.packing, part)
    else:
        kind = {"float": "f", "int": "i", "uint": "I"}[str(packing.kind)]
        for number, column in enumerate(value if packing.columns > 1 else [value]):
            place = offset + number * packing.column_stride
            struct.pack_into(f"<{packing.lanes}{kind}", data, place, *column)


ELEMENTS = 8
"""The number of elements in a storage buffer."""


@dataclass(frozen=True)
class World:
    """Random values for every leaf, within the declared ranges; they depend only on the seed."""

    seed: int
    traps: bool = False
    """True if special operands (zeros, subnormal numbers …) are likely."""
    derived: Sequence[Derived] = ()
    noise: float = 0.0
    """The largest difference of parameters called ``noise.*`` from 1."""
    fixed: Mapping[str, Lanes] = field(default_factory=dict)
    """The values of parameters that are not random."""

    def __call__(self, node: Node) -> Lanes | None:
        """The value of a leaf."""
        leaf = node.data
        if isinstance(leaf, Parameter):
            value = self._parameter(leaf)
            return value if node.type == leaf.type else stored(leaf.type, value)
        if isinstance(leaf, Attribute):
            return self._drawn(f"attribute {leaf.name}", leaf.type, UNKNOWN)
        if node.op == "texture":
            return (Smooth(node.type),)
        if isinstance(leaf, Buffer):
            return (BufferReader(self._contents(leaf), leaf, node.type),)
        if node.op != "input":
            return None
        most = INPUT.data(node).most
        fact = UNKNOWN if most is None else Fact(0.0, float(most), kind="int")
        return self._drawn(str(leaf), node.type, fact)

    def _parameter(self, leaf: Parameter) -> Lanes:
        for value in self.derived:
            if value.parameter == leaf:
                return derived_value(value, Evaluator(self))
        if leaf.name in self.fixed:
            return self.fixed[leaf.name]
        if leaf.name.startswith("noise."):
            return (1.0 + self.noise * self._random(leaf.name).uniform(-1.0, 1.0),)
        fact = leaf.fact
        if leaf.name.endswith(".count") and fact.hi == LARGEST_INT:
            fact = changed(fact, hi=float(ELEMENTS))  # of a buffer's lights: as many as it has
        return self._drawn(leaf.name, leaf.type, fact, dict(leaf.member_facts))

    def _contents(self, leaf: Buffer) -> Contents:
        """A few elements, within what is declared of them."""
        chance, packing = self._random(leaf.name), element_packing(leaf.type.element)
        data = bytearray(ELEMENTS * packing.stride)
        for number in range(ELEMENTS):
            element = self._of(chance, leaf.type.element, leaf.fact, dict(leaf.member_facts))
            _pack(data, number * packing.stride, packing, element)
        return Contents(bytes(data))

    def _random(self, name: str) -> random.Random:
        return random.Random(f"{self.seed} {name}")

    def _drawn(
        self, name: str, type_: Type, fact: Fact, members: dict[str, Fact] | None = None
    ) -> Lanes:
        return self._of(self._random(name), type_, fact, members or {})

    def _of(
        self, chance: random.Random, type_: Type, fact: Fact, members: dict[str, Fact]
    ) -> Lanes:
        match type_:
            case Scalar(kind):
                return (self._lane(chance, kind, fact),)
            case Vector(kind, size):
                lanes = tuple(self._lane(chance, kind, fact) for _ in range(size))
                return unit(lanes) if fact.unit else lanes
            case Matrix(columns):
                return tuple(self._of(chance, type_.column, UNKNOWN, {}) for _ in range(columns))
            case Array(element, count):
                return tuple(self._of(chance, element, fact, members) for _ in range(count))
            case Struct():
                return tuple(
                    self._of(chance, inner, members.get(name, UNKNOWN), {})
                    for name, inner in type_.members
                )
            case _:
                raise TypeError(type_)

    def _lane(self, chance: random.Random, kind: str, fact: Fact) -> Any:
        if kind == "bool":
            return chance.random() < 0.5
        lo, hi = max(fact.lo, -4.0), min(fact.hi, 4.0)
        if fact.lo > hi or fact.hi < lo:
            lo, hi = fact.lo, fact.hi
        if kind == "float":
            allowed = [trap for trap in TRAPS if fact.lo <= trap <= fact.hi]
            allowed += [end for end in (fact.lo, fact.hi) if math.isfinite(end)]
            if self.traps and allowed and chance.random() < 0.6:
                return chance.choice(allowed)
            return float(chance.uniform(lo, hi))
        ends = [int(end) for end in (fact.lo, fact.hi) if abs(end) < 2.0**31]
        traps = (*INT_TRAPS, *ends)
        integers = [n for n in traps if fact.lo <= n <= fact.hi and (kind == "int" or n >= 0)]
        if self.traps and integers and chance.random() < 0.6:
            return chance.choice(integers)
        return chance.randint(max(math.ceil(lo), 0 if kind == "uint" else -4), math.floor(hi))


def derived_value(derived: Derived, evaluator: Evaluator) -> Lanes:
    """The value that the host stores for a derived parameter; of a table, one for each element."""
    type_, expression = derived.parameter.type, derived.expression
    if isinstance(type_, Array):
        return tuple(evaluator.value(expression, (i,)) for i in range(type_.count))
    return evaluator.value(expression)


def unit(lanes: Lanes) -> Lanes:
    """A vector of length one."""
    length = math.hypot(*lanes)
    if length < 1e-3:
        return (1.0, *[0.0] * (len(lanes) - 1))
    return tuple(lane / length for lane in lanes)


@dataclass
class Smooth:
    """A texture without edges; every read depends on all of its operands."""

    type: Type
    xp: Any = scalars

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of a read."""
        assert isinstance(self.type, TextureType)
        if name.startswith("texture_"):
            sizes = {"texture_size": (16,) * self.type.extents, "texture_layers": (3,)}
            return sizes.get(name, (5,))
        if name == "load":
            last = [self.type.extents * (15,), *((2,),) * self.type.layered, (4,)]
            operands = tuple(
                tuple(self.xp.maximum(self.xp.minimum(lane, m), 0) for lane, m in pairs)
                for pairs in map(zip, operands, last)
            )
        place: Any = 0.0
        for number, lane in enumerate(lane for operand in operands for lane in operand):
            place = place + (-1.0) ** number * (2.0 + number) * lane
        texel = self.type.texel
        count = 1 if name == "compare" else 4 if name.startswith("gather") else width(texel)
        lanes = tuple(0.5 + 0.5 * self.xp.sin(i + place) for i in range(count))
        if scalar_kind(texel) == "float":
            return lanes
        return tuple(self.xp.int64(100.0 * lane) for lane in lanes)


class Alike(WorkGroups):
    """Python's numbers in the place of arrays, for the last one of 64 invocations of a work group
    that all have the same values."""

    def __getattr__(self, name: str) -> Any:
        return getattr(scalars, name)

    def all_joined(self, join: Binary, x: Any) -> Any:
        """The joined value of all 64 invocations, which doubling reaches in six steps."""
        for _ in range(6):
            x = join(x, x)
        return x

    def joined_through(self, join: Binary, x: Any) -> Any:
        """The value of the last invocation, with that of all before it."""
        return self.all_joined(join, x)

    def at_the_one_before(self, x: Any, _first: Any) -> Any:
        """The value of the invocation before, which is the same."""
        return x


def evaluator_of(roots: Sequence[Node], world: World) -> Evaluator:
    """The evaluator of some values in a world."""
    if any(map(joins_group, reachable(tuple(roots)))):
        return Evaluator(world, Alike())
    return Evaluator(world)


# --- looking at graphs ---------------------------------------------------------------------------


def calls(roots: Iterable[Node], name: str) -> list[Node]:
    """The operations called ``name`` that ``roots`` need."""
    return [n for n in reachable(roots) if builtin_of(n) == name]


def ops(roots: Iterable[Node], op: str) -> list[Node]:
    """The nodes of one kind that ``roots`` need."""
    return [n for n in reachable(roots) if n.op == op]
