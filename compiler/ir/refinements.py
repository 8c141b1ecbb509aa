"""Refinement: facts about two values that follow from a comparison that holds, or does not."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

from ...stdlib.builtins.facts import SMALLEST_NORMAL, UNKNOWN, Fact
from ...support.frozen import frozen
from .node import Node
from .operations import CALL, builtin_of
from .rulebook import ABOVE, BELOW, BOTH, DIFFERS, EQUALS, NEGATION

OPPOSITES = {"lt": "ge", "ge": "lt", "gt": "le", "le": "gt", "eq": "ne", "ne": "eq"}
MIRRORED = {"lt": "gt", "gt": "lt", "le": "ge", "ge": "le", "eq": "eq", "ne": "ne"}

MOST = 32
"""Parts of one condition that are looked at; people write far fewer."""

_RULES = {"gt": ABOVE, "ge": ABOVE, "lt": BELOW, "le": BELOW, "eq": EQUALS, "ne": DIFFERS}


@frozen
class Refinement:
    """A fact that holds wherever a condition does."""

    about: Node
    fact: Fact
    rule: str
    condition: Node
    """The comparison that says so."""
    holds: bool
    """True if the comparison is known to hold, false if it is known not to."""


def refinements(
    of: Callable[[Node], Fact], condition: Node, holds: bool, without: frozenset[str]
) -> Iterator[Refinement]:
    """Yields all facts that follow from ``condition`` being ``holds``.

    ``of`` gives the facts of values.
    """
    pending = [(condition, holds)]
    for _ in range(MOST):
        if not pending:
            return
        node, truth = pending.pop()
        name = builtin_of(node)
        if name == "not":
            if NEGATION not in without:
                pending.append((node.operands[0], not truth))
        elif (name, truth) in (("and", True), ("or", False)):
            if BOTH not in without:
                pending.extend((operand, truth) for operand in node.operands)
        elif name in OPPOSITES:
            yield from _compared(of, node, truth, without)


def _compared(
    of: Callable[[Node], Fact], node: Node, truth: bool, without: frozenset[str]
) -> Iterator[Refinement]:
    name = CALL.data(node) if truth else OPPOSITES[CALL.data(node)]
    left, right = node.operands
    for about, sign, other in ((left, name, right), (right, MIRRORED[name], left)):
        if about.op == "constant" or _RULES[sign] in without:
            continue
        fact = _bounded(sign, of(other))
        if fact is not UNKNOWN:
            yield Refinement(about, fact, _RULES[sign], node, truth)


def _bounded(sign: str, bound: Fact) -> Fact:
    """The fact of a value that stands in a relation to one within ``bound``."""
    match sign:
        case "gt":
            return Fact(bound.lo, math.inf, nonzero=bound.lo >= 0)
        case "lt":
            return Fact(-math.inf, bound.hi, nonzero=bound.hi <= 0)
        case "ge":
            return Fact(bound.lo, math.inf, nonzero=bound.lo >= SMALLEST_NORMAL)
        case "le":
            return Fact(-math.inf, bound.hi, nonzero=bound.hi <= -SMALLEST_NORMAL)
        case "eq":
            return bound
        case _:
            return Fact(nonzero=True) if (bound.lo, bound.hi) == (0.0, 0.0) else UNKNOWN
