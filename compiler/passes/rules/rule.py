"""The type of simplification rules, and the patterns and results that their rows are written with.

A rule is about one operation: if the operands match ``pattern`` and the condition ``when`` holds,
``gives`` builds the value that replaces the operation. Both must be equal for all finite operands;
the sign of a zero is not part of the meaning. No operation makes an infinite value or a NaN of
finite operands, so finite operands are all that there are.

``simplify.py`` applies the rules, and ``table.py`` collects them. ``docs/passes.md`` explains how
to add one; ``tests/passes/test_rules.py`` tries each rule on random and special values.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping

from ....frozen import frozen
from ...ir import build
from ...ir.build import Number
from ...ir.node import HEADS, SPECIAL, Formal, Graph, Node, Op
from ...ir.ranges import Ranges
from ...ir.shader import Notes
from ...ir.types import Matrix, Scalar, Type, Vector, scalar_kind, width
from ...reference.operations import constant_lanes


class Builder:
    """Builds nodes for rules. ``Simplifier`` is the one that simplifies what it builds."""

    def __init__(self, graph: Graph, ranges: Ranges, notes: Notes) -> None:
        self.graph = graph
        self.ranges = ranges
        self.notes = notes
        self.steady: dict[Node, bool] = {}
        """Whether values are the same for all pixels of a triangle (``differences``)."""

    def make(
        self, op: Op, type_: Type, operands: tuple[Node, ...] = (), data: Hashable = None
    ) -> Node:
        """The simplest node with the value of this operation."""
        raise NotImplementedError

    def substituted(self, body: Node, replacements: Mapping[Formal, Node]) -> Node:
        """``body`` with formals replaced; all that changes is built in its simplest form."""
        raise NotImplementedError

    def call(self, name: str, type_: Type, *operands: Node) -> Node:
        """A builtin with Burnish's meaning."""
        return self.make("call", type_, operands, name)

    def constant(self, type_: Type, value: Number) -> Node:
        """A constant with one value in every lane."""
        lane = float(value) if scalar_kind(type_) == "float" else value
        lanes = width(type_)
        return build.constant(self.graph, type_, lane if lanes == 1 else (lane,) * lanes)

    def fitted(self, node: Node, type_: Type) -> Node:
        """An operand as a result of this type: itself, or a scalar in every lane."""
        return node if node.type == type_ else self.make("splat", type_, (node,))


class Site:
    """The operation that a rule looks at; its operands are in the order of the rule's pattern."""

    __slots__ = ("data", "op", "operands", "type")

    def __init__(self, op: Op, type_: Type, operands: tuple[Node, ...], data: Hashable) -> None:
        self.op = op
        self.type = type_
        self.operands = operands
        self.data = data


@frozen
class Pattern:
    """What an operand looks like."""

    heads: frozenset[Hashable] | None = None
    """The ``Node.head``s that it may have; any, if ``None``."""
    lane: Number | None = None
    """Of a constant, the number in each of its lanes; the head says so."""
    parts: tuple[Pattern, ...] = ()
    """What its own operands look like, if that matters."""

    @property
    def is_told_by_head(self) -> bool:
        """Whether the head alone decides if a node matches."""
        return not self.parts

    def admits(self, head: Hashable) -> bool:
        """Whether a node with this head can match."""
        return self.heads is None or head in self.heads

    def matches(self, node: Node) -> bool:
        """Whether ``node`` looks like this."""
        if not self.admits(node.head):
            return False
        pairs = zip(self.parts, node.operands, strict=False)
        return all(part.matches(operand) for part, operand in pairs)


ANY = Pattern()
CONSTANT = Pattern(frozenset({HEADS["constant"], *SPECIAL.values()}))


def lanes(value: Number) -> Pattern:
    """A constant with this number in every lane: one of those that nodes tell by their heads."""
    return Pattern(frozenset({SPECIAL[isinstance(value, bool), value]}), value)


def builtin(*names: str, parts: tuple[Pattern, ...] = ()) -> Pattern:
    """One of these builtins."""
    return Pattern(frozenset(names), parts=parts)


def made(*ops: Op) -> Pattern:
    """One of these operations, which are no builtins."""
    heads = frozenset(HEADS[op] for op in ops)
    return Pattern(heads | (CONSTANT.heads or heads) if "constant" in ops else heads)


def always(_builder: Builder, _site: Site) -> bool:
    """The condition of a rule whose pattern says it all."""
    return True


@frozen(eq=False)
class Rule:
    """One rule."""

    name: str
    """How tests and ``Options.without`` call it."""
    says: str
    """What it does and why that is right, in a sentence."""
    on: tuple[str, ...]
    """The builtins that it is for, or operations with a dot (``.select``); ``*``: all builtins."""
    pattern: tuple[Pattern, ...] | Pattern
    """What the operands look like: each of them, or (told by its head) all."""
    gives: Callable[[Builder, Site], Node | None]
    """The simpler value; ``None`` where it turns out that there is none."""
    when: Callable[[Builder, Site], bool] = always
    """What has to hold besides, of types and ranges."""
    some: Pattern = ANY
    """What at least one of the operands looks like; only the head counts."""
    either: bool = False
    """Whether the two operands may also stand the other way round."""
    drops: bool = False
    """Whether it removes an operation that a user wrote because of what is known of the operands;
    this is worth a remark."""

    @property
    def orders(self) -> tuple[bool, ...]:
        """Whether operands are swapped, each way that is tried."""
        return (False, True) if self.either else (False,)

    def admits(self, heads: tuple[Hashable, ...]) -> bool:
        """Whether operands with these heads can match."""
        if not any(map(self.some.admits, heads)):
            return False
        if isinstance(self.pattern, Pattern):
            return all(map(self.pattern.admits, heads))
        return len(heads) == len(self.pattern) and all(
            pattern.admits(head) for pattern, head in zip(self.pattern, heads, strict=True)
        )

    @property
    def closer(self) -> tuple[tuple[int, Pattern], ...]:
        """The operands whose heads alone do not decide, with what they look like."""
        if isinstance(self.pattern, Pattern):
            return ()
        patterns = enumerate(self.pattern)
        return tuple((i, pattern) for i, pattern in patterns if not pattern.is_told_by_head)

    def apply(
        self, builder: Builder, site: Site, closer: tuple[tuple[int, Pattern], ...]
    ) -> Node | None:
        """The simpler value, if the rule has one for an operation.

        The rule ``admits`` the heads of its operands already, ``closer`` is what is left to see.
        """
        for position, pattern in closer:
            if not pattern.matches(site.operands[position]):
                return None
        return self.gives(builder, site) if self.when(builder, site) else None


# --- words for conditions and results ------------------------------------------------------------


def uniform_lane(node: Node) -> Number | None:
    """The value in every lane of a constant, if they are all the same."""
    if node.op != "constant" or isinstance(node.type, Matrix):
        return None
    values = constant_lanes(node.type, node.data)
    first: Number = values[0]
    return first if values.count(first) == len(values) else None


def swizzled_lanes(at: Site) -> tuple[int, ...]:
    """The lanes that a swizzle takes of its operand."""
    assert isinstance(at.data, tuple)
    return at.data


def operand(position: int) -> Callable[[Builder, Site], Node]:
    """One of the operands as the result."""
    return lambda b, at: b.fitted(at.operands[position], at.type)


def inner(builder: Builder, at: Site) -> Node:  # noqa: ARG001 - as every result is called
    """The operand of the only operand."""
    return at.operands[0].operands[0]


def constant(value: Number) -> Callable[[Builder, Site], Node]:
    """A constant result, the same in every lane."""
    return lambda b, at: b.constant(at.type, value)


def are_same(_builder: Builder, at: Site) -> bool:
    """Whether all operands are one value."""
    return all(each is at.operands[0] for each in at.operands)


def is_numeric(_builder: Builder, at: Site) -> bool:
    """Whether scalars and vectors are computed with, and no matrices."""
    return isinstance(at.type, Scalar | Vector) and not any(
        isinstance(each.type, Matrix) for each in at.operands
    )


def is_float(_builder: Builder, at: Site) -> bool:
    """Whether the result is a float, or a vector of floats."""
    return not isinstance(at.type, Matrix) and scalar_kind(at.type) == "float"


def is_whole_bool(position: int) -> Callable[[Builder, Site], bool]:
    """Whether the result has the type of an operand that is a bool, or a vector of bools."""
    return lambda _b, at: at.operands[position].type == at.type
