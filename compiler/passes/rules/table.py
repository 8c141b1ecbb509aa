"""The table of all simplification rules, and the lookup of those that can apply to an operation.

``RULES`` lists them in the order in which ``simplify.py`` tries them. Every node that a pass builds
is looked up, so this has to be fast: the rules that can apply are remembered by the heads of the
operation and of its operands.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator

from .arithmetic import ARITHMETIC
from .bits import BIT_RULES
from .bounds import BOUNDS
from .constant_terms import CONSTANT_TERMS
from .constants import FOLDING
from .differences import DIFFERENCES
from .loops import LOOP_RULES
from .matching import Apply
from .rule import Rule
from .structure import STRUCTURE

RULES: tuple[Rule, ...] = (
    *FOLDING, *ARITHMETIC, *CONSTANT_TERMS, *BOUNDS, *BIT_RULES, *STRUCTURE, *LOOP_RULES,
    *DIFFERENCES,
)  # fmt: skip

MOST_KEPT = 20_000
"""Combinations of heads that are kept; a program has some hundreds."""

Candidate = tuple[Rule, Apply]
"""A rule, with the function that applies one of its cases."""


class RuleTable:
    """Rules by the operations that they are for."""

    def __init__(self, rules: Iterable[Rule]) -> None:
        self._for: dict[Hashable, list[Rule]] = {}
        for rule in rules:
            for head in rule.heads:
                self._for.setdefault(head, []).append(rule)
        self._found: dict[tuple[Hashable, ...], tuple[Candidate, ...]] = {}

    def candidates(self, heads: tuple[Hashable, ...]) -> tuple[Candidate, ...]:
        """The rules that can apply to an operation: its head comes first, then its operands'."""
        found = self._found.get(heads)
        if found is None:
            if len(self._found) >= MOST_KEPT:
                self._found.clear()
            self._found[heads] = found = tuple(self._search(heads[0], heads[1:]))
        return found

    def _search(self, head: Hashable, operands: tuple[Hashable, ...]) -> Iterator[Candidate]:
        for rule in self._for.get(head, ()):
            for case in rule.cases:
                if case.admits(operands):
                    yield rule, case.apply


ALL = RuleTable(RULES)
_NAMES = frozenset(rule.name for rule in RULES)


def rule_table(without: frozenset[str]) -> RuleTable:
    """The table without some rules, by name: tests take each away to see its effect."""
    if without.isdisjoint(_NAMES):
        return ALL
    return RuleTable(rule for rule in RULES if rule.name not in without)
