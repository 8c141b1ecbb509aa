"""Gives the leaves of a program's graph their values: terms of variables that both programs share.

``programs.py`` hands them to the reference's evaluator.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ...stdlib.builtins.facts import UNKNOWN, Fact
from ...support.frozen import frozen
from ..ir.leaves import Attribute, Buffer, Parameter, Texture
from ..ir.meaning import Meaning
from ..ir.node import Node
from ..ir.shader import ConstantValue, ParameterInfo
from ..ir.stages import SystemInput
from ..ir.types import Array, Matrix, RuntimeArray, Scalar, Struct, TextureType, Type, Vector
from ..reference.namespace import Lanes
from .domain import Domain
from .term import Term, plain
from .terms import Terms
from .variables import Variable

LANES = "xyzw"
_KINDS = {"float": "f", "int": "i", "uint": "i", "bool": "b"}
_INPUTS: Mapping[str, tuple[tuple[float, float], ...]] = {
    "frag_coord": ((0.0, 4096.0), (0.0, 4096.0), (0.0, 1.0), (0.01, 100.0)),
}
"""The ranges of the lanes of inputs that the pipeline supplies."""
_COUNTS = ("texture_size", "texture_layers", "texture_levels")
_COUNT = Fact(1.0, 4096.0, kind="int")
_TEXEL = Fact(0.0, 1.0)
_WHOLE_TEXEL = Fact(0.0, 255.0, kind="int")
_MOST_ELEMENTS = 64.0
"""The number of vertices, instances, invocations and elements of buffers that are compared."""


@frozen(key=True)
class Source:
    """What is read at a place that is computed: a lane of a texture's read, or of an element."""

    name: str
    """The texture or the buffer, with the lane or member: ``albedo.x``."""
    method: str
    """How it is read, as the builtins are named."""
    kind: str
    low: float
    high: float

    def __str__(self) -> str:
        return self.name


class Leaves:
    """The values of all leaves of one program."""

    def __init__(self, terms: Terms, domain: Domain, declared: Iterable[ParameterInfo]) -> None:
        self._terms, self._domain = terms, domain
        self._defaults = {info.leaf.name: _default_of(info) for info in declared}

    def __call__(self, node: Node) -> Lanes | None:
        """The value of a leaf, for the evaluator; crossings have that of their operand."""
        match node.data:
            case Parameter() as leaf:
                default = self._defaults.get(leaf.name)
                facts = {"": leaf.fact, **dict(leaf.member_facts)}
                return self._value(leaf.type, leaf.name, facts, leaf.meaning, default, False)
            case Attribute() as leaf:
                return self._value(leaf.type, leaf.name, {}, leaf.meaning, None, True)
            case SystemInput() as supplied:
                return self._input(supplied)
            case Texture() as leaf:
                return (_Reader(self._terms, self._domain, leaf),)
            case Buffer() as leaf:
                return (_Elements(self._terms, self._domain, leaf),)
        return None

    def _value(
        self,
        type_: Type,
        name: str,
        facts: Mapping[str, Fact],
        meaning: Meaning | None,
        default: ConstantValue | None,
        is_varying: bool,
        member: str = "",
    ) -> Lanes:
        """The lanes of a value of any type, with parts of parts."""
        if isinstance(type_, Struct):
            return tuple(
                self._value(
                    inner, f"{name}.{each}", facts, meaning and meaning.member(each),
                    _part(default, number), is_varying, f"{member}.{each}".lstrip("."),
                )
                for number, (each, inner) in enumerate(type_.members)
            )  # fmt: skip
        if isinstance(type_, Array | Matrix):
            count = type_.count if isinstance(type_, Array) else type_.columns
            inner = type_.element if isinstance(type_, Array) else type_.column
            if isinstance(type_, Matrix) and default is None:
                default = _identity(type_)
            return tuple(
                self._value(
                    inner, f"{name}[{i}]", facts, meaning, _part(default, i), is_varying, member
                )
                for i in range(count)
            )
        fact = facts.get(member, facts.get(member.rpartition(".")[2], UNKNOWN))
        return self._lanes(type_, name, fact, meaning, default, is_varying)

    def _lanes(
        self, type_: Type, name: str, fact: Fact, meaning: Meaning | None,
        default: ConstantValue | None, is_varying: bool,
    ) -> Lanes:  # fmt: skip
        """The lanes of a number or a vector."""
        assert isinstance(type_, Scalar | Vector)
        kind = _KINDS[type_.kind]
        names = lane_names(type_, name)
        is_unit = fact.unit and not is_varying
        found = []
        for number, each in enumerate(names):
            setting = self._domain.set_to(each, number)
            if setting is not None:
                found.append(self._constant(setting, kind))
                continue
            low, high = self._domain.range_of(each, kind, fact, meaning)
            if is_unit:
                low, high = -1.0, 1.0
            given = _part(default, number) if len(names) > 1 else default
            start = float(given) if isinstance(given, float | int) else None
            unit = name if is_unit else ""
            found.append(
                self._terms.variable(Variable(each, kind, low, high, is_varying, unit, "", start))
            )
        lanes: list[Any] = [plain_condition(lane) for lane in found]
        if is_unit and all(lane.op == "variable" for lane in lanes):
            self._terms.units[lanes[-1].id] = tuple(lanes[:-1])
        return tuple(lanes)

    def _constant(self, value: float, kind: str) -> Term:
        if kind == "b":
            return self._terms.term(bool(value))
        return self._terms.constant(int(value) if kind == "i" else float(value))

    def _input(self, supplied: SystemInput) -> Lanes:
        """What the pipeline supplies."""
        ranges = _INPUTS.get(supplied.name)
        type_ = supplied.type
        assert isinstance(type_, Scalar | Vector)
        if ranges is None:
            fact = Fact(0.0, _MOST_ELEMENTS, kind="int")
            return self._lanes(type_, supplied.name, fact, None, None, True)
        names = lane_names(type_, supplied.name)
        return tuple(
            self._terms.variable(Variable(each, "f", low, high, is_varying=True))
            for each, (low, high) in zip(names, ranges, strict=True)
        )


class _Reader:
    """A texture, of which each read is a number of its own for each place."""

    def __init__(self, terms: Terms, domain: Domain, leaf: Texture) -> None:
        self._terms, self._domain, self._leaf = terms, domain, leaf

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of the builtin ``name`` at a place."""
        place = [self._terms.term(lane) for operand in operands for lane in operand]
        state = ",".join(f"{key}={value}" for key, value in self._leaf.state)
        lanes, kind, fact = self._read_as(name)
        found = []
        for lane in lanes:
            each = f"{self._leaf.name}{lane}"
            low, high = self._domain.range_of(each, kind, fact, None)
            source = Source(each, f"{name} {state}".strip(), kind, low, high)
            found.append(self._terms.node("read", tuple(place), source))
        return tuple(found)

    def _read_as(self, name: str) -> tuple[Sequence[str], str, Fact]:
        """The ends of the names of a read's lanes, their kind, and what is known of them."""
        type_ = self._leaf.type
        assert isinstance(type_, TextureType)
        if name in _COUNTS:
            lanes = LANES[: 3 if type_.dimension == "3d" else 2] if name == "texture_size" else ""
            return [f".{name}{lane}" for lane in lanes or ("",)], "i", _COUNT
        whole = type_.sample in ("int", "uint")
        known = (_WHOLE_TEXEL, "i") if whole else (_TEXEL, "f")
        is_single = isinstance(type_.texel, Scalar) or name == "compare"
        lanes = "" if is_single and "gather" not in name else LANES
        return [f".{lane}" for lane in lanes] or [""], known[1], known[0]


class _Elements:
    """A buffer, of which each element is a value of its own for each place."""

    def __init__(self, terms: Terms, domain: Domain, leaf: Buffer) -> None:
        self._terms, self._domain, self._leaf = terms, domain, leaf

    def element(self, position: Any) -> Lanes:
        """The element at a place."""
        assert isinstance(self._leaf.type, RuntimeArray)
        facts = {"": self._leaf.fact, **dict(self._leaf.member_facts)}
        place = self._terms.term(position)
        return self._part(self._leaf.type.element, self._leaf.name, "", facts, place)

    def _part(
        self, type_: Type, name: str, member: str, facts: Mapping[str, Fact], place: Term
    ) -> Lanes:
        if isinstance(type_, Struct):
            return tuple(
                self._part(inner, f"{name}.{each}", each, facts, place)
                for each, inner in type_.members
            )
        if isinstance(type_, Array | Matrix):
            count = type_.count if isinstance(type_, Array) else type_.columns
            inner = type_.element if isinstance(type_, Array) else type_.column
            return tuple(
                self._part(inner, f"{name}[{i}]", member, facts, place) for i in range(count)
            )
        assert isinstance(type_, Scalar | Vector)
        kind = _KINDS[type_.kind]
        found = []
        for each in lane_names(type_, name):
            fact = facts.get(member, UNKNOWN)
            low, high = self._domain.range_of(each, kind, fact, self._leaf.meaning)
            source = Source(each, "element", kind, low, high)
            found.append(self._terms.node("element", (place,), source))
        return tuple(plain_condition(lane) for lane in found)


def lane_names(type_: Scalar | Vector, name: str) -> list[str]:
    """The names of the lanes of a value."""
    if isinstance(type_, Scalar):
        return [name]
    return [f"{name}.{LANES[lane]}" for lane in range(type_.size)]


def plain_condition(lane: Term) -> Any:
    """A lane as the reference's definitions take it: a condition that is known as a ``bool``."""
    return plain(lane) if lane.kind == "b" else lane


def _part(value: ConstantValue | None, number: int) -> ConstantValue | None:
    """A part of a default."""
    if isinstance(value, tuple):
        return value[number] if number < len(value) else None
    return None


def _identity(type_: Matrix) -> ConstantValue:
    """The matrix that changes nothing: what a host would set to begin with."""
    rows = range(type_.rows)
    return tuple(tuple(float(row == column) for row in rows) for column in range(type_.columns))


def _default_of(info: ParameterInfo) -> ConstantValue | None:
    """The default of a parameter; of a structure, those of its members."""
    if info.default is not None or not info.members:
        return info.default
    return tuple(_known(_default_of(member)) for member in info.members)


def _known(value: ConstantValue | None) -> ConstantValue:
    return () if value is None else value
