"""Evaluates a graph whose leaves have values; this defines what a program means.

Semantics and the rules for loops evaluate constants with it while compiling. The reference's
pictures pass arrays instead of numbers, and tests compare a graph before and after a pass. The
evaluator accepts graphs of every phase of the compiler, with binders closed (de Bruijn indices) or
open (formals). Graphs and binders may be nested without limit.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Sequence
from typing import Protocol

from ...support.frozen import record
from ..ir.node import Node, bare, bodies_of, reachable
from ..ir.operations import BINDING, BOUND, FORMAL, OUTSIDE
from . import scalars
from .bodies import Frame, Opened, opened
from .namespace import Decisions, Lanes, Namespace
from .operations import NotConstantError, apply, constant_lanes

__all__ = ["Evaluator", "LeafValues", "NotConstantError", "Observer", "TooLongError", "evaluate"]

LeafValues = Callable[[Node], Lanes | None]
"""A function that returns the value of a leaf, or ``None`` if it has none.

The value of a texture is a ``texture_reads.Reader``, that of a buffer a
``storage_buffers.BufferReader``. It is also called for crossings (``cross``); one without a value
has that of its operand.
"""

Observer = Callable[[Node, list[Lanes], Lanes], Lanes]
"""Called for every operation that is computed, with the values of its operands and its own value.
Evaluation continues with the value that it returns."""

Stored = Callable[[Lanes], Lanes]
"""A function that is called with the states of an iteration.

It is called before each iteration and after the last one. Evaluation continues with the value that
it returns.
"""


class Kept(Protocol):
    """The values of operations that earlier evaluations have kept (``kept_numbers.py``)."""

    def value(self, node: Node, place: Hashable, operands: list[Lanes]) -> Lanes | None:
        """The value of an operation at a place of the evaluation, if it was kept."""

    def keep(self, node: Node, place: Hashable, operands: list[Lanes], value: Lanes) -> None:
        """Keep a value, if that pays."""


_ASKED = OUTSIDE | {"cross"}
"""Operations for which ``LeafValues`` may have a value."""

_GIVEN = _ASKED | {"bound", "formal"}
"""Operations that may have a value without being evaluated."""


class TooLongError(Exception):
    """An evaluation takes more steps than its caller is willing to wait for."""


def evaluate(
    root: Node,
    leaves: LeafValues | None = None,
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
class _Walk:
    """The evaluation of ``root`` in ``frame``, up to the binder at which it waits for a body."""

    root: Node
    frame: Frame
    pending: list[Node]
    """The nodes that are still to be evaluated; the last one comes first."""


class Evaluator:
    """Evaluates several roots that share nodes; each node once for each value of its variables."""

    def __init__(
        self,
        leaves: LeafValues | None = None,
        xp: Namespace = scalars,
        observer: Observer | None = None,
        most_operations: int | None = None,
        stored: Stored | None = None,
        kept: Kept | None = None,
    ) -> None:
        """``most_operations`` limits how many operations are computed; a turn is one, too.

        ``kept`` has values of earlier evaluations with the same array library.
        """
        self._kept = kept
        self._stored = stored or _as_it_is
        self._most = most_operations
        self.computed = 0
        """The number of operations and iterations computed so far, if that is limited."""
        self._leaves = leaves
        self._xp = xp
        self._observer = observer
        self._is_lazy = xp is scalars and observer is None
        """True if only the side of a choice that is taken is evaluated."""
        self.outermost = Frame()
        """The frame of what is under no binder."""
        self._decisions = xp if isinstance(xp, Decisions) else None
        self._uses: Counter[int] = Counter()
        """The number of users of a node's value still to come, by the node's id, for ``values``."""

    def values(self, roots: Sequence[Node]) -> list[Lanes]:
        """The lanes of several roots.

        A value is forgotten after its last use. A picture has thousands of values with a number for
        each pixel, few of which are needed at any time, so this takes a fraction of the memory.
        """
        self._uses = Counter(root.id for root in roots)
        for node in reachable(roots):
            self._uses.update(operand.id for operand in node.operands)
        return [self.value(root) for root in roots]

    def value(self, root: Node, *free: Lanes) -> Lanes:
        """The lanes of ``root``; ``free`` are the values of its free variables, if it has any."""
        frame = Frame(self.outermost, free) if free else self.outermost
        walk = _Walk(root, frame, [root])
        waiting: list[tuple[_Walk, Opened]] = []
        while True:
            entered = self._walk(walk)
            if entered is not None:
                waiting.append((walk, entered))
            elif waiting:
                waiting[-1][1].take(self._known(walk.root, walk.frame))
            else:
                return self._known(root, frame)
            outer, binder = waiting[-1]
            body = binder.following()
            if body is not None:
                walk = _Walk(*body, [body[0]])
            else:
                waiting.pop()
                walk = outer
                node = walk.pending.pop()
                self._home(node, walk.frame).values[node.id] = binder.result

    def _home(self, node: Node, frame: Frame) -> Frame:
        """The outermost frame in which ``node`` has the same value as in ``frame``."""
        if node.free:
            return frame
        wanted = node.variables
        if not wanted:
            return self.outermost
        while frame.parent is not None and wanted.isdisjoint(frame.formals):
            frame = frame.parent
        return frame

    def _known(self, node: Node, frame: Frame) -> Lanes:
        """The value of a node that has been evaluated."""
        return self._home(node, frame).values[node.id]

    def _walk(self, walk: _Walk) -> Opened | None:
        """Evaluate until ``root`` is known, or until a node needs the value of a body."""
        pending, frame = walk.pending, walk.frame
        while pending:
            node = pending[-1]
            is_under_binder = node.free or node.variables
            home = self._home(node, frame) if is_under_binder else self.outermost
            known = home.values.get(node.id)
            if known is None and node.op in _GIVEN:
                known = self._given(node, home)
            if known is None:
                is_choice = self._is_lazy and node.op == "select"
                has_bodies = node.op in BINDING
                before = (
                    self._condition_or_side(node, frame) if is_choice
                    else _besides_bodies(node) if has_bodies
                    else node.operands
                )  # fmt: skip
                operands = self._operands(before, frame, pending)
                if operands is None:
                    continue
                if self._most is not None:
                    self._spend()
                if has_bodies:
                    return opened(node, operands, home, self._xp, self._spend, self._stored)
                known = operands[0] if is_choice else self._computed(node, operands, home)
                if self._uses and home is self.outermost:
                    self._used(before)
            home.values[node.id] = known
            pending.pop()
        return None

    def _computed(self, node: Node, operands: list[Lanes], home: Frame) -> Lanes:
        """The value of an operation without bodies, as the observer leaves it."""
        kept = self._kept
        if self._decisions is not None:
            self._decisions.at(node, home)
        before = None if kept is None else kept.value(node, home.place, operands)
        value = apply(node, operands, self._xp) if before is None else before
        if self._observer is not None:
            value = self._observer(node, operands, value)
        if kept is not None and before is None:
            kept.keep(node, home.place, operands, value)
        return value

    def _operands(
        self, wanted: Sequence[Node], frame: Frame, pending: list[Node]
    ) -> list[Lanes] | None:
        """The values of operands; ``None`` if some are not known yet: ``pending`` gets these."""
        values, missing = [], False
        outermost = self.outermost.values
        for operand in wanted:
            if operand.free or operand.variables:
                value = self._home(operand, frame).values.get(operand.id)
            else:
                value = outermost.get(operand.id)
            if value is None:
                pending.append(operand)
                missing = True
            else:
                values.append(value)
        return None if missing else values

    def _used(self, operands: Sequence[Node]) -> None:
        """Forgets values that only this node, which is evaluated once, still needs.

        Users under binders, which may need a value in every iteration, are never done.
        """
        for operand in operands:
            self._uses[operand.id] -= 1
            if not self._uses[operand.id]:
                del self.outermost.values[operand.id]

    def _condition_or_side(self, node: Node, frame: Frame) -> tuple[Node]:
        """The side of a choice that is taken; the condition, as long as that is not known."""
        condition, then, otherwise = node.operands
        if condition.id not in self._home(condition, frame).values:
            return (condition,)
        (holds,) = self._known(condition, frame)
        return (then if holds else otherwise,)

    def _given(self, node: Node, frame: Frame) -> Lanes | None:
        """The value of a variable or a leaf, or ``None`` for any other node."""
        if node.op in _ASKED:
            return self._leaves(node) if self._leaves is not None else None
        if node.op == "bound":
            index = BOUND.data(node)
            return frame.bound[index] if index < len(frame.bound) else None
        return frame.formals.get(FORMAL.data(node)) if node.op == "formal" else None

    def _spend(self) -> None:
        """Count one operation, which a turn of a loop is, too."""
        if self._most is not None:
            self.computed += 1
            if self.computed > self._most:
                raise TooLongError


def _as_it_is(value: Lanes) -> Lanes:
    return value


def _besides_bodies(node: Node) -> tuple[Node, ...]:
    """The operands that are evaluated before a node with bodies."""
    inside = bodies_of(node)
    return node.operands[: inside.start] + node.operands[inside.stop :]
