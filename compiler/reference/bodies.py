"""Evaluates operations with bodies: folds, iterations and applications of functions.

When ``Evaluator`` comes to such a node, it calls ``opened``. It then asks ``following`` which body
to evaluate next, and with which values of the variables, and reports the body's value to ``take``.
When no body follows, ``result`` is the value of the node. Bodies may contain bodies without limit,
so nothing here calls the evaluator, which keeps all open nodes on a list.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Hashable, Mapping

from ...support.frozen import fresh, record
from ..ir.node import Formal, Node, binders, bodies_of, formals_of
from ..ir.operations import FOLD, ITERATE
from ..ir.types import scalar_kind
from .namespace import Attempts, Decisions, Lane, Lanes, Namespace, OpenLoops
from .operations import builtins, chosen

Spend = Callable[[], None]
"""Counts one turn of a loop as an operation; raises an error if there were too many."""


@record
class Frame:
    """One evaluation of a binder's body; without a parent, that of all nodes under no binder."""

    parent: Frame | None = None
    bound: tuple[Lanes, ...] = ()
    """The values of the de Bruijn variables of all binders around the body, the innermost first."""
    formals: Mapping[Formal, Lanes] = fresh(factory=dict)
    values: dict[int, Lanes] = fresh(factory=dict)
    place: Hashable = None
    """The place of the body in the whole evaluation: that of the binder, and the turn."""


class Opened(ABC):
    """A node with bodies while it is evaluated."""

    result: Lanes
    """The value of the node, once no body follows."""

    @abstractmethod
    def following(self) -> tuple[Node, Frame] | None:
        """The body to evaluate next, in a frame with its variables; ``None`` at the end."""

    @abstractmethod
    def take(self, value: Lanes) -> None:
        """Receive the value of the body that ``following`` returned last."""


def opened(
    node: Node,
    operands: list[Lanes],
    frame: Frame,
    xp: Namespace,
    spend: Spend,
    stored: Callable[[Lanes], Lanes],
) -> Opened:
    """Begin to evaluate a node that has bodies in ``frame``, from the values of its other operands.

    ``stored`` is called for the states of an iteration.
    """
    made: Opened
    if node.op == "apply":
        made = _Application(node, operands, frame)
    elif node.op == "fold":
        made = _Fold(node, operands, frame, xp, spend)
    else:
        assert node.op == "iterate"
        made = _Iteration(node, operands, frame, xp, spend, stored)
    return _Tried(made, node, frame, xp) if isinstance(xp, Decisions) else made


class _Application(Opened):
    """A call of a function: its body is evaluated once."""

    def __init__(self, node: Node, arguments: list[Lanes], frame: Frame) -> None:
        self._body: tuple[Node, Frame] | None = (
            node.operands[0],
            _inner(node, frame, tuple(arguments), 0),
        )

    def following(self) -> tuple[Node, Frame] | None:
        body, self._body = self._body, None
        return body

    def take(self, value: Lanes) -> None:
        self.result = value


class _Fold(Opened):
    """A fold: its body is evaluated in each turn.

    If the count is an array, elements that have finished keep their totals.
    """

    def __init__(
        self, node: Node, operands: list[Lanes], frame: Frame, xp: Namespace, spend: Spend
    ) -> None:
        (self._count,), self.result = operands
        self._node, self._frame, self._xp, self._spend = node, frame, xp, spend
        self._data = FOLD.data(node)
        self._turn = 0
        self._goes_on: Lane = True

    def following(self) -> tuple[Node, Frame] | None:
        self._goes_on = self._turn < self._count
        if self._turn == self._data.bound or self._goes_on is False:
            return None
        self._spend()
        return self._node.operands[2], _inner(self._node, self._frame, ((self._turn,),), self._turn)

    def take(self, value: Lanes) -> None:
        kind = scalar_kind(self._node.type) or "float"
        combined = builtins()(self._data.operator, (self.result, value), self._xp, kind)
        self.result = chosen(self._xp, self._goes_on, combined, self.result)
        self._turn += 1


class _Iteration(Opened):
    """An iteration: in each turn its condition is evaluated, then the next value of each state.

    With arrays, elements that have stopped keep their states.
    """

    def __init__(
        self,
        node: Node,
        operands: list[Lanes],
        frame: Frame,
        xp: Namespace,
        spend: Spend,
        stored: Callable[[Lanes], Lanes],
    ) -> None:
        (self._count,), *states = operands
        self._node, self._frame, self._xp, self._spend = node, frame, xp, spend
        self._stored = stored
        self._states = list(map(stored, states))
        self._bound = ITERATE.data(node).bound
        self._bodies = [node.operands[i] for i in bodies_of(node)]
        self._turn = 0
        self._goes_on: Lane = True
        self._is_next: Lane = True
        """The condition by which the next states are chosen."""
        self._endings = xp.endings() if isinstance(xp, OpenLoops) else None
        self._inner = frame
        """The frame of the bodies of one turn."""
        self._following: list[Lanes] = []
        """The next states, as far as they are known."""
        self._position = 0
        """The number of the body that is evaluated next; the first one is the condition."""

    def following(self) -> tuple[Node, Frame] | None:
        if self._position == 0:
            if self._turn == self._bound or not _anywhere(self._goes_on):
                states = self._states if self._endings is None else self._endings.of(self._states)
                self.result = states[0] if len(states) == 1 else tuple(states)
                return None
            self._spend()
            variables = ((self._turn,), *self._states)
            self._inner = _inner(self._node, self._frame, variables, self._turn)
        return self._bodies[self._position], self._inner

    def take(self, value: Lanes) -> None:
        if self._position == 0:
            self._go_on(_all(self._xp, self._turn < self._count, value[0]))
            if _anywhere(self._goes_on):
                self._position = 1
            return
        state = self._states[self._position - 1]
        self._following.append(chosen(self._xp, self._is_next, value, state))
        self._position += 1
        if self._position == len(self._bodies):
            self._states, self._following = list(map(self._stored, self._following)), []
            self._position = 0
            self._turn += 1

    def _go_on(self, condition: Lane) -> None:
        """Go on with the elements for which a condition holds, or may hold."""
        before = self._goes_on
        if self._endings is not None:
            condition = self._endings.decided(before, condition)
        self._goes_on = self._is_next = _all(self._xp, before, condition)
        if self._endings is not None and not isinstance(self._goes_on, bool):
            self._is_next = self._endings.goes_on(before, condition, self._states)


class _Tried(Opened):
    """A node with bodies, each of which is evaluated in all cases of its decisions."""

    def __init__(self, opened: Opened, node: Node, frame: Frame, decisions: Decisions) -> None:
        self._opened, self._node, self._frame = opened, node, frame
        self._decisions = decisions
        self._body: tuple[Node, Frame] | None = None
        """The body of which there are more cases."""
        self._attempts: Attempts

    def following(self) -> tuple[Node, Frame] | None:
        if self._body is None:
            self._decisions.at(self._node, self._frame)
            self._body = self._opened.following()
            if self._body is None:
                self.result = self._opened.result
                return None
            self._attempts = self._decisions.attempts()
        root, shared = self._body
        frame = Frame(shared.parent, shared.bound, shared.formals, place=shared.place)
        self._attempts.begin(frame)
        return root, frame

    def take(self, value: Lanes) -> None:
        known = self._attempts.end(value)
        if known is not None:
            self._body = None
            self._decisions.at(self._node, self._frame)
            self._opened.take(known)


def _all(xp: Namespace, *conditions: Lane) -> Lane:
    """True if all conditions hold; a plain ``bool`` unless one is an array or unsure."""
    found: Lane = True
    for condition in conditions:
        found = xp.logical_and(found, condition)
    if getattr(found, "ndim", 0) or not getattr(found, "is_exact", True):
        return found
    return bool(found)


def _anywhere(condition: Lane) -> bool:
    return condition if isinstance(condition, bool) else bool(condition.any())


def _inner(node: Node, frame: Frame, variables: tuple[Lanes, ...], turn: int) -> Frame:
    """A frame for the body of ``node``, with values for the variables that it binds."""
    place = frame.place, node, turn
    if binders(node):
        return Frame(frame, variables + frame.bound, place=place)
    formals = dict(zip(formals_of(node), variables, strict=True))
    return Frame(frame, frame.bound, formals, place=place)
