"""Finds conditions that are known when compiling: by constants, or by ranges of operands.

``deferred`` asks for this, to find the sides of choices that are never taken.
"""

from __future__ import annotations

from ...ir.comparisons import HOLDS
from ...ir.node import Node, bare
from ...ir.operations import CALL
from ...ir.ranges import Ranges
from ...ir.refinements import OPPOSITES
from ...ir.types import BOOL, Scalar, Vector
from .constants import ConstantValues

_ABSORBING = {"and": False, "or": True}


class Conditions:
    """The values of bools, as far as they are known; each node is looked at once."""

    def __init__(self, constants: ConstantValues, ranges: Ranges) -> None:
        self._constants = constants
        self._ranges = ranges
        self._known: dict[Node, bool | None] = {}
        self._copies: dict[Node, bool | None] = {}
        """The common value of all conditions that a node is a copy of, as far as it is known."""

    def value(self, condition: Node) -> bool | None:
        """True if a condition always holds, false if it never does; ``None`` if that is unknown.

        A condition with lanes holds if all of them do, and never does if none of them does.
        """
        known, pending = self._known, [condition]
        while pending:
            node = pending[-1]
            missing = [operand for operand in _parts(node) if operand not in known]
            if missing and node not in known:
                pending += missing
                continue
            if node not in known:
                known[node] = self._value(node)
            pending.pop()
        return known[condition]

    def follow(self, old: Node, new: Node) -> bool:
        """Copies the known value of ``old``, for all values of its variables, to its copy ``new``.

        In the copy, the index of a loop may be bound: nobody could tell from it how far it runs.
        Bodies of several loops may have the same copy. Then a value that holds in only some of them
        is not known. The result is true if less is known than before.
        """
        if new.type != BOOL:
            return False
        holds = self.value(old)
        before = self._copies.setdefault(new, holds)
        if holds is before and holds is not None:
            self._known[new] = holds
        if holds is before or before is None:
            return False
        self._copies[new] = None
        self._known.pop(new, None)
        return True

    def decisive(self, node: Node) -> list[Node]:
        """The operands of ``and`` or ``or`` each of which decides it, whatever the other is."""
        if node.type != BOOL:
            return []
        absorbing = _ABSORBING[CALL.data(node)]
        return [operand for operand in node.operands if self.value(operand) is absorbing]

    def _value(self, node: Node) -> bool | None:
        plain = bare(node)
        if plain is not node:
            return self._known[plain]
        if node.type != BOOL:
            return self._of_lanes(node)
        if self._constants.is_known(node):
            return bool(self._constants.known(node))
        known = [self._known[part] for part in _parts(node)]
        if node.op == "select":
            return None if known[0] is None else known[1 if known[0] else 2]
        return self._called(node, known) if node.op == "call" else None

    def _of_lanes(self, node: Node) -> bool | None:
        """The common value of all lanes of a constant vector: ``choose`` takes a side by them."""
        known = self._constants.known(node) if isinstance(node.type, Vector) else None
        lanes = set(known) if isinstance(known, tuple) else set()
        return bool(lanes.pop()) if len(lanes) == 1 else None

    def _called(self, node: Node, known: list[bool | None]) -> bool | None:
        name = CALL.data(node)
        if name in _ABSORBING:
            absorbing = _ABSORBING[name]
            if absorbing in known:
                return absorbing
            return None if None in known else not absorbing
        if name == "not":
            return None if known[0] is None else not known[0]
        if not all(isinstance(operand.type, Scalar) for operand in node.operands):
            return None
        facts = tuple(map(self._ranges.of, node.operands))
        if name in HOLDS and HOLDS[name](*facts):
            return True
        opposite = OPPOSITES.get(name, "")
        return False if opposite in HOLDS and HOLDS[opposite](*facts) else None


def _parts(node: Node) -> tuple[Node, ...]:
    """The conditions that a condition is made of."""
    plain = bare(node)
    if plain is not node:
        return (plain,)
    if node.type != BOOL:
        return ()
    if node.op == "select" or (node.op == "call" and node.data in ("and", "or", "not")):
        return node.operands
    return ()
