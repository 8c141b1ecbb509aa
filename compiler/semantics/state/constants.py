"""Values that have to be known when compiling: counts, ranges, defaults."""

from __future__ import annotations

from math import hypot

from ....stdlib.builtins.facts import SMALLEST_NORMAL, UNIT_SLACK
from ...diagnostics import rules
from ...diagnostics.diagnostic import Report
from ...diagnostics.source import Span
from ...ir.build import parts_of
from ...ir.node import Node, bare, reachable
from ...ir.shader import ConstantValue as Value
from ...ir.types import Scalar, Type
from ...reference.evaluate import NotConstantError, TooLongError, evaluate
from ...reference.namespace import Lanes
from .scope import Failure

MOST_OPERATIONS = 500_000
"""Operations that are computed for one value, and each turn of a loop is one: about two seconds."""

_OPERATIONS = frozenset(
    {
        "as",
        "called",
        "constant",
        "call",
        "vector",
        "splat",
        "matrix",
        "swizzle",
        "select",
        "struct",
        "array",
        "member",
        "index",
    }
)


class ConstantValues:
    """Evaluates nodes that depend on nothing; reports those that do."""

    def __init__(self, report: Report) -> None:
        self._report = report

    def lanes(self, node: Node, span: Span) -> Lanes | None:
        """The lanes of a node, or ``None`` after reporting why they cannot be known here."""
        try:
            return evaluate(node, most_operations=MOST_OPERATIONS)
        except NotConstantError:
            self._report.add(rules.NOT_CONSTANT, span)
        except TooLongError:
            self._report.add(rules.TOO_MUCH_WORK, span, most=MOST_OPERATIONS)
        return None

    def integer(self, node: Node | Failure, span: Span) -> int | None:
        """The value of an ``int``; ``None`` where there is none (reported)."""
        lanes = None if isinstance(node, Failure) else self.lanes(node, span)
        return None if lanes is None else int(lanes[0])

    def number(self, node: Node | Failure, span: Span) -> float | None:
        """The value of a scalar; ``None`` where there is none (reported)."""
        lanes = None if isinstance(node, Failure) else self.lanes(node, span)
        return None if lanes is None else float(lanes[0])

    def value(self, node: Node | Failure, span: Span) -> Value | None:
        """The value of anything as nested tuples (a scalar as itself)."""
        lanes = None if isinstance(node, Failure) else self.lanes(node, span)
        if lanes is None or isinstance(node, Failure):
            return None
        return _nested(node.type, lanes)

    def is_known(self, node: Node) -> bool:
        """Whether a node is plainly a constant, which can be computed at once."""
        return self._small_constant(node)

    def known(self, node: Node) -> Value | None:
        """The value of a node where it is plainly a constant, and nothing is reported if not."""
        return _nested(node.type, evaluate(node)) if self._small_constant(node) else None

    def known_integer(self, node: Node) -> int | None:
        """The value of an ``int`` where it is one, and nothing is reported if not."""
        return int(evaluate(node)[0]) if self._small_constant(node) else None

    def is_zero(self, node: Node) -> bool:
        """Whether a node is a constant with a lane that counts as zero."""
        if not self._small_constant(node):
            return False
        lanes = evaluate(node)
        return any(not isinstance(v, tuple) and abs(v) < SMALLEST_NORMAL for v in lanes)

    def is_unit(self, node: Node) -> bool:
        """Whether a node is a constant vector of length one, up to rounding."""
        if not self._small_constant(node):
            return False
        lanes = [float(v) for v in evaluate(node) if not isinstance(v, tuple)]
        return abs(hypot(*lanes) - 1.0) < UNIT_SLACK

    def _small_constant(self, node: Node) -> bool:
        """Whether a node is plainly made of constants; only its near surroundings are looked at."""
        if bare(node).op == "constant":
            return True
        if any(op.op not in _OPERATIONS for op in (node, *node.operands)):
            return False
        return all(n.op in _OPERATIONS for n in reachable((node,)))


def _nested(type_: Type, lanes: Lanes) -> Value:
    """A value as the reflection has it; recurses over a type."""
    if isinstance(type_, Scalar):
        return lanes[0]  # type: ignore[no-any-return]
    parts = parts_of(type_)
    if parts is None:
        return lanes
    return tuple(_nested(inner, part) for inner, part in zip(parts, lanes, strict=True))
