"""The LALR machine: it shifts tokens, reduces by the grammar's productions, and builds nodes.

The parser runs it over the tokens of each declaration. It has its own stack, so neither a long nor
a deeply nested text can exhaust the stack of Python.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..diagnostics.source import Source
from .builder import Builder
from .lalr_tables import Tables
from .reductions import reduction
from .tokens import Token

OPENS_STRIP = "{"
"""The token that begins the strips of an expansion, behind an expression.

The tables do not tell these expressions from others, and reduce any, after which nobody knows what
was expected.
"""


class Machine:
    """Takes tokens; ``builder`` makes a node for each production that has a name."""

    def __init__(self, tables: Tables, builder: Builder, source: Source) -> None:
        self._tables = tables
        self._actions = tables.actions
        self._builder = builder
        self._source = source
        self._stack = [0, 0, tables.start]
        """The stack as ``reductions.py`` describes it; the first entry stands before all parts."""
        self._values: list[object] = []
        """The values that were made of these parts."""

    @property
    def result(self) -> object:
        """The node for the whole text, after ``END`` was fed."""
        return self._values[0]

    def reset(self) -> None:
        """Forget everything fed so far."""
        del self._stack[3:]
        self._values.clear()

    def knows(self, symbol: str) -> bool:
        """True if the present state has an action for ``symbol``.

        If not, then ``accepts`` says no, too, but takes longer. The other way round an action may
        only reduce the parts here, and ``symbol`` have no place afterwards.
        """
        return symbol in self._actions[self._stack[-1]]

    def run(
        self, tokens: Sequence[Token], begin: int, end: int, symbol_of: Callable[[int], str]
    ) -> int:
        """Shift the tokens from ``begin`` on; returns the first one without a place, or ``end``.

        ``symbol_of`` decides whether a word counts as one here, or as a name.
        """
        actions, productions = self._actions, self._tables.productions
        words, collapsed = self._tables.literals, self._tables.collapsed
        stack, values = self._stack, self._values
        for index in range(begin, end):
            token = tokens[index]
            symbol = token[0]
            if symbol == "NAME" and token[1] in words:
                symbol = symbol_of(index)
            if symbol == OPENS_STRIP and not self.accepts(symbol):
                return index
            while (action := actions[stack[-1]].get(symbol)) is not None and action < 0:
                production = productions[~action]
                if production.renames:
                    chain = stack[-4], stack[-1], symbol
                    stack[-1] = collapsed[chain] if chain in collapsed else self._collapse(*chain)
                else:
                    reduction(~action)(stack, values, self._source, self._builder)
            if action is None:
                return index
            stack += (token[2], token[3], action)
            values.append(token)
        return end

    def feed(self, token: Token) -> bool:
        """Shift one token by its kind; False where the grammar has no place for it."""
        return self.run((token,), 0, 1, lambda _: token.kind) == 1

    def _collapse(self, below: int, state: int, symbol: str) -> int:
        """The state after all reductions in a row that only rename the newest part.

        A name alone is a primary, a product, a sum, …: with one level of precedence for each of
        them these chains are most of all reductions, so each is followed once and kept.
        """
        begun = state
        while (action := self._actions[state].get(symbol, 0)) < 0:
            production = self._tables.productions[~action]
            if not production.renames:
                break
            state = self._tables.gotos[below][production.origin]
        self._tables.collapsed[below, begun, symbol] = state
        return state

    def unwind(self, origins: Sequence[str]) -> bool:
        """Drops unfinished parts, down to where one of ``origins`` may begin; False if nowhere."""
        depth = self._depth(origins)
        if depth is None:
            return False
        del self._stack[3 * depth + 3 :]
        del self._values[depth:]
        return True

    def begun(self, origins: Sequence[str]) -> int | None:
        """The place where the text that ``unwind`` would drop begins, if it drops anything."""
        depth = self._depth(origins)
        if depth is None or depth == len(self._values):
            return None
        return self._stack[3 * depth + 3]

    def _depth(self, origins: Sequence[str]) -> int | None:
        """The number of parts before the last place where one of ``origins`` may begin."""
        gotos = self._tables.gotos
        for depth in range(len(self._values), -1, -1):
            if any(origin in gotos[self._stack[3 * depth + 2]] for origin in origins):
                return depth
        return None

    def expected(self) -> set[str]:
        """The symbols that the grammar has a place for, now."""
        return {symbol for symbol in self._actions[self._stack[-1]] if self.accepts(symbol)}

    def accepts(self, symbol: str) -> bool:
        """True if ``symbol`` would be shifted: reductions are tried on a copy of the states."""
        states = self._stack[2::3]
        while True:
            action = self._actions[states[-1]].get(symbol)
            if action is None:
                return False
            if action >= 0:
                return True
            production = self._tables.productions[~action]
            if production.length:
                del states[-production.length :]
            states.append(self._tables.gotos[states[-1]][production.origin])
