"""Evaluates a graph whose leaves have values: this is the definition of what a program means.

Constant folding and semantics use it while compiling, the reference's pictures use it with arrays
instead of numbers, and tests use it to compare a graph before and after a pass. It accepts graphs
of every phase of the compiler, with binders closed (de Bruijn indices) or open (formals). Graphs
and binders may be nested without limit.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ...frozen import fresh, record
from ..ir.node import Formal, Node, bare, binders, bodies_of, formals_of
from ..ir.operations import BOUND, FOLD, FORMAL, ITERATE, OUTSIDE
from ..ir.types import scalar_kind
from ..trampoline import Step, run
from . import scalars
from .functions import evaluate as builtin
from .namespace import Lane, Lanes, Namespace
from .operations import NotConstantError, apply, chosen, constant_lanes

__all__ = ["Evaluator", "Leaves", "NotConstantError", "Observer", "TooLongError", "evaluate"]

Leaves = Callable[[Node], Lanes | None]
"""Returns the value of a leaf, or ``None`` if it has none. The value of a texture is a
``texture_reads.Reader``.

It is also called for crossings (``cross``); one without a value has that of its operand.
"""

Observer = Callable[[Node, list[Lanes], Lanes], Lanes]
"""Called for every operation that is computed, with the values of its operands and its own value.
Evaluation continues with the value that it returns."""

_ASKED = OUTSIDE | {"cross"}
"""What ``Leaves`` may have a value for."""


class TooLongError(Exception):
    """An evaluation takes more steps than its caller is willing to wait for."""


def evaluate(
    root: Node,
    leaves: Leaves | None = None,
    xp: Namespace = scalars,
    most_operations: int | None = None,
) -> Lanes:
    """The lanes of ``root`` in float64; of a matrix, its columns.

    Raises ``NotConstantError`` if a leaf has no value, and ``TooLongError`` beyond
    ``most_operations``.
    """
    plain = bare(root)
    if plain.op == "constant":
        return constant_lanes(plain.type, plain.data)
    return Evaluator(leaves, xp, most_operations=most_operations).value(root)


@record
class _Frame:
    """One evaluation of a binder's body; without a parent, of everything that is under no
    binder."""

    parent: _Frame | None = None
    bound: tuple[Lanes, ...] = ()
    """The values of the de Bruijn variables of all binders around the body, the innermost first."""
    formals: Mapping[Formal, Lanes] = fresh(factory=dict)
    values: dict[int, Lanes] = fresh(factory=dict)


class Evaluator:
    """Evaluates several roots that share nodes; each node once for each value of its variables."""

    def __init__(
        self,
        leaves: Leaves | None = None,
        xp: Namespace = scalars,
        observer: Observer | None = None,
        most_operations: int | None = None,
    ) -> None:
        """``most_operations`` limits how many operations are computed; a turn is one, too."""
        self._left = most_operations
        self._leaves = leaves
        self._xp = xp
        self._observer = observer
        self._outermost = _Frame()

    def value(self, root: Node, *free: Lanes) -> Lanes:
        """The lanes of ``root``; ``free`` are the values of its free variables, if it has any."""
        frame = _Frame(self._outermost, free) if free else self._outermost
        return run(self._value(root, frame))

    def _home(self, node: Node, frame: _Frame) -> _Frame:
        """The outermost frame in which ``node`` has the same value as in ``frame``."""
        wanted = node.variables
        while frame.parent is not None and not node.free and wanted.isdisjoint(frame.formals):
            frame = frame.parent
        return frame

    def _value(self, root: Node, frame: _Frame) -> Step[Lanes]:
        pending = [root]
        while pending:
            node = pending[-1]
            home = self._home(node, frame)
            known = home.values.get(node.id)
            if known is None:
                known = self._given(node, home)
            if known is None:
                missing = [
                    operand
                    for operand in _needed_first(node)
                    if operand.id not in self._home(operand, frame).values
                ]
                if missing:
                    pending.extend(missing)
                    continue
                known = yield self._computed(node, home)
            home.values[node.id] = known
            pending.pop()
        return self._home(root, frame).values[root.id]

    def _given(self, node: Node, frame: _Frame) -> Lanes | None:
        """The value of a variable or a leaf, or ``None`` for any other node."""
        if node.op in _ASKED:
            return self._leaves(node) if self._leaves is not None else None
        if node.op == "bound":
            index = BOUND.data(node)
            return frame.bound[index] if index < len(frame.bound) else None
        return frame.formals.get(FORMAL.data(node)) if node.op == "formal" else None

    def _spend(self) -> None:
        """Count one operation, which a turn of a loop is, too."""
        if self._left is not None:
            self._left -= 1
            if self._left < 0:
                raise TooLongError

    def _computed(self, node: Node, frame: _Frame) -> Step[Lanes]:
        self._spend()
        operands = [
            self._home(operand, frame).values[operand.id] for operand in _needed_first(node)
        ]
        if node.op == "fold":
            folded: Lanes = yield self._folded(node, operands, frame)
            return folded
        if node.op == "iterate":
            last: Lanes = yield self._iterated(node, operands, frame)
            return last
        if node.op != "apply":
            value = apply(node, operands, self._xp)
            return value if self._observer is None else self._observer(node, operands, value)
        body = node.operands[0]
        result: Lanes = yield self._value(body, _inner(node, frame, tuple(operands)))
        return result

    def _folded(self, node: Node, operands: list[Lanes], frame: _Frame) -> Step[Lanes]:
        """Evaluate a fold, one iteration after the other.

        If the count is an array, elements that have finished keep their totals.
        """
        data = FOLD.data(node)
        (count,), total = operands
        kind = scalar_kind(node.type) or "float"
        for turn in range(data.bound):
            goes_on = turn < count
            if goes_on is False:
                break
            self._spend()
            term = yield self._value(node.operands[2], _inner(node, frame, ((turn,),)))
            combined = builtin(data.operator, (total, term), self._xp, kind)
            total = chosen(self._xp, goes_on, combined, total)
        return total

    def _iterated(self, node: Node, operands: list[Lanes], frame: _Frame) -> Step[Lanes]:
        """Evaluate an iteration. With arrays, elements that have stopped keep their states."""
        (count,), *states = operands
        going, *nexts = (node.operands[i] for i in bodies_of(node))
        goes_on: Lane = True
        for turn in range(ITERATE.data(node).bound):
            self._spend()
            inner = _inner(node, frame, ((turn,), *states))
            (condition,) = yield self._value(going, inner)
            goes_on = _all(self._xp, goes_on, turn < count, condition)
            if not _anywhere(goes_on):
                break
            following = []
            for state, next_ in zip(states, nexts, strict=True):
                new = yield self._value(next_, inner)
                following.append(chosen(self._xp, goes_on, new, state))
            states = following
        return states[0] if len(states) == 1 else tuple(states)


def _all(xp: Namespace, *conditions: Lane) -> Lane:
    """Whether all conditions hold; a plain ``bool`` unless one of them is an array."""
    found: Lane = True
    for condition in conditions:
        found = xp.logical_and(found, condition)
    return found if getattr(found, "ndim", 0) else bool(found)


def _anywhere(condition: Lane) -> bool:
    return condition if isinstance(condition, bool) else bool(condition.any())


def _needed_first(node: Node) -> tuple[Node, ...]:
    """The operands that are evaluated before the node: all but the bodies under its binder."""
    inside = bodies_of(node)
    if not inside:
        return node.operands
    return node.operands[: inside.start] + node.operands[inside.stop :]


def _inner(node: Node, frame: _Frame, variables: tuple[Lanes, ...]) -> _Frame:
    """A frame for the body of ``node``, with values for the variables that it binds."""
    if binders(node):
        return _Frame(frame, variables + frame.bound)
    return _Frame(frame, frame.bound, dict(zip(formals_of(node), variables, strict=True)))
