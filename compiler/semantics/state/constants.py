"""Values that have to be known when compiling: counts, ranges, defaults."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot

from ....stdlib.builtins.facts import SMALLEST_NORMAL, UNIT_SLACK
from ...diagnostics import rules
from ...diagnostics.diagnostic import Report
from ...diagnostics.source import Span
from ...ir.build import parts_of
from ...ir.node import Node
from ...ir.operations import joins_group
from ...ir.shader import ConstantValue as Value
from ...ir.types import Matrix, Scalar, Type, scalar_kind
from ...reference.evaluate import Evaluator, NotConstantError, TooLongError
from ...reference.namespace import Lanes
from ...reference.turns import least_turns
from ..work import Work
from .scope import Failure

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

    def __init__(self, report: Report, is_wrong: Callable[[Node], bool], work: Work) -> None:
        """``is_wrong`` says whether a value has errors of its own, and reports them.

        ``work`` is the computation of the whole compile so far.
        """
        self._report = report
        self._work = work
        self._is_wrong = is_wrong
        self._plain: dict[Node, bool] = {}
        """The nodes that were looked at, and whether they are made of constants."""
        self._known = Evaluator()
        """Has the values of those that are."""

    def lanes(self, node: Node, span: Span) -> Lanes | None:
        """The lanes of a node, or ``None`` after reporting why they cannot be known here."""
        if self._is_wrong(node):
            return None
        if self.is_known(node):
            return self._known.value(node)
        work = self._work
        allowed = work.allowed(span)
        if span not in work.refused and least_turns(node) > allowed:
            work.refuse(span, allowed)
        if span not in work.refused:
            evaluator = Evaluator(most_operations=allowed)
            try:
                return evaluator.value(node)
            except NotConstantError:
                self._report.add(rules.NOT_CONSTANT, span)
                return None
            except TooLongError:
                work.refuse(span, allowed)
            finally:
                work.took(span, evaluator.computed)
        self._report.add(rules.TOO_MUCH_WORK, span, most=work.refused[span])
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

    def known(self, node: Node) -> Value | None:
        """The value of a node where it is plainly a constant, and nothing is reported if not."""
        return _nested(node.type, self._known.value(node)) if self.is_known(node) else None

    def known_integer(self, node: Node) -> int | None:
        """The value of an ``int`` where it is one, and nothing is reported if not."""
        return int(self._known.value(node)[0]) if self.is_known(node) else None

    def largest(self, node: Node) -> float | None:
        """The largest magnitude among the floats of a constant; ``None`` if it is none."""
        if scalar_kind(node.type) != "float" or not self.is_known(node):
            return None
        lanes = self._known.value(node)
        columns = lanes if isinstance(node.type, Matrix) else (lanes,)
        return max(abs(float(lane)) for column in columns for lane in column)

    def is_zero(self, node: Node) -> bool:
        """True if a node is a constant with a lane that counts as zero."""
        if not self.is_known(node):
            return False
        lanes = self._known.value(node)
        return any(not isinstance(v, tuple) and abs(v) < SMALLEST_NORMAL for v in lanes)

    def is_unit(self, node: Node) -> bool:
        """True if a node is a constant vector of length one, up to rounding."""
        if not self.is_known(node):
            return False
        lanes = [float(v) for v in self._known.value(node) if not isinstance(v, tuple)]
        return abs(hypot(*lanes) - 1.0) < UNIT_SLACK

    def is_known(self, node: Node) -> bool:
        """True if a node is plainly made of constants, without loops: it can be computed at once.

        Each node is looked at once, however many values are made of it.
        """
        if not all(map(_is_computed, (node, *node.operands))):
            return False
        plain, pending = self._plain, [node]
        while pending:
            top = pending[-1]
            missing = [operand for operand in top.operands if operand not in plain]
            if missing and _is_computed(top):
                pending += missing
                continue
            plain[top] = _is_computed(top) and all(plain[o] for o in top.operands)
            pending.pop()
        return plain[node]


def _is_computed(node: Node) -> bool:
    """True if an operation can be computed at once, if its operands can."""
    return node.op in _OPERATIONS and not joins_group(node)


def _nested(type_: Type, lanes: Lanes) -> Value:
    """A value as the reflection has it; recurses over a type."""
    if isinstance(type_, Scalar):
        return lanes[0]  # type: ignore[no-any-return]
    parts = parts_of(type_)
    if parts is None:
        return lanes
    return tuple(_nested(inner, part) for inner, part in zip(parts, lanes, strict=True))
