"""Derives facts of a loop's states that hold in every iteration, for range analysis.

``ranges.py`` calls ``invariants``. It begins with the facts of the initial states, and extends each
by the fact of the state's next value, until nothing changes. If this takes long, bounds that still
move are given up (widening: Cousot and Cousot, *Abstract interpretation*, 1977).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

from ...stdlib.builtins.facts import Fact
from .node import Formal, Node

PATIENCE = 8
"""Turns that are followed before bounds which still move are given up."""

Turn = Callable[[Sequence[Fact]], Sequence[Fact]]
"""A function from the facts of the states to their facts after an iteration."""


def invariants(starts: Sequence[Fact], turn: Turn, turns: int) -> list[Fact]:
    """Facts of each state that hold at the start of every one of at most ``turns`` iterations."""
    states = list(starts)
    for number in range(1, turns):
        pairs = zip(states, turn(states), strict=True)
        joined = [state.union(following) for state, following in pairs]
        if joined == states:
            break
        if number > PATIENCE:
            joined = [_widened(old, new) for old, new in zip(states, joined, strict=True)]
        states = joined
    return states


def parts_of(roots: Iterable[Node], variables: frozenset[Formal]) -> list[Node]:
    """The largest parts of ``roots`` in which no other variables occur than these."""
    seen = {root.id: root for root in roots}
    pending = list(seen.values())
    found: list[Node] = []
    while pending:
        node = pending.pop()
        if node.variables <= variables:
            found.append(node)
            continue
        for operand in node.operands:
            if operand.id not in seen:
                seen[operand.id] = operand
                pending.append(operand)
    return sorted(found, key=lambda node: node.id)


def _widened(old: Fact, new: Fact) -> Fact:
    """``new`` without the bounds that still move; zero is where many of them would end."""
    return Fact(
        new.lo if new.lo == old.lo else 0.0 if new.lo > 0 else -math.inf,
        new.hi if new.hi == old.hi else 0.0 if new.hi < 0 else math.inf,
        new.nonzero,
        new.unit,
        new.length if new.length == old.length else 0.0,
        new.kind,
    ).as_kind(new.kind)
