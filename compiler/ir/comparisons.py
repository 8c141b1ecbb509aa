"""Finds the comparisons that always hold, by the ranges of their operands.

The simplification rules for comparisons ask for this, and ``semantics/state/conditions.py``, which
finds sides of choices that are never taken.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ...stdlib.builtins.facts import Fact

Decision = Callable[[Fact, Fact], bool]

HOLDS: Mapping[str, Decision] = {
    "lt": lambda left, right: left.hi < right.lo,
    "le": lambda left, right: left.hi <= right.lo,
    "gt": lambda left, right: left.lo > right.hi,
    "ge": lambda left, right: left.lo >= right.hi,
    "ne": lambda left, right: left.hi < right.lo or left.lo > right.hi,
}
"""A function for each builtin that says if the comparison always holds.

One never holds where its opposite always does (``refinements.OPPOSITES``). No ranges show that two
values are equal.
"""
