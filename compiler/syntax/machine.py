"""The LALR machine: it shifts tokens, reduces by the grammar's productions, and builds nodes.

The parser feeds it one token after the other. It has its own stack, so neither a long nor a deeply
nested text can exhaust the stack of Python.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..diagnostics.source import Source, Span
from .builder import Builder
from .lalr_tables import END, Production, Tables
from .tokens import Token


class Machine:
    """Takes tokens one by one; ``builder`` makes a node for each named production."""

    def __init__(self, tables: Tables, builder: Builder, source: Source) -> None:
        self._tables = tables
        self._actions = tables.actions
        names = {production.method for production in tables.productions}
        self._methods = {name: builder.method(name) for name in names}
        self._source = source
        self._states = [tables.start]
        self._values: list[object] = []
        self._starts: list[int] = []
        self._ends: list[int] = []

    @property
    def result(self) -> object:
        """The node for the whole text, after ``END`` was fed."""
        return self._values[-1]

    def reset(self) -> None:
        """Forget everything fed so far."""
        del self._states[1:]
        self._values.clear()
        self._starts.clear()
        self._ends.clear()

    def knows(self, symbol: str) -> bool:
        """Whether the present state has an action for ``symbol``."""
        return symbol in self._actions[self._states[-1]]

    def feed(self, symbol: str, token: Token) -> bool:
        """Shift ``token`` as ``symbol``; False where the grammar has no place for it."""
        states, actions = self._states, self._actions
        while True:
            action = actions[states[-1]].get(symbol)
            if action is None:
                return False
            if action >= 0:
                states.append(action)
                self._values.append(token)
                self._starts.append(token.start)
                self._ends.append(token.end)
                return True
            production = self._tables.productions[~action]
            if production.collapses and production.length == 1:
                states[-1] = self._collapsed(states[-2], states[-1], symbol)
                continue
            self._reduce(production)
            if symbol == END and states[-1] == self._tables.accept:
                return True

    def _collapsed(self, below: int, state: int, symbol: str) -> int:
        """The state after all reductions in a row that only rename the newest part.

        A name alone is a primary, a product, a sum, …: with one level of precedence for each of
        them these chains are most of all reductions, so each is followed once and kept.
        """
        known = self._tables.collapsed
        key = (below, state, symbol)
        if key not in known:
            while (action := self._actions[state].get(symbol, 0)) < 0:
                production = self._tables.productions[~action]
                if production.length != 1 or not production.collapses:
                    break
                state = self._tables.gotos[below][production.origin]
            known[key] = state
        return known[key]

    def unwind(self, origins: Sequence[str]) -> bool:
        """Drop what is unfinished, down to where one of ``origins`` may begin; False if nowhere."""
        depth = self._depth(origins)
        if depth is None:
            return False
        del self._states[depth + 1 :]
        del self._values[depth:]
        del self._starts[depth:]
        del self._ends[depth:]
        return True

    def begun(self, origins: Sequence[str]) -> int | None:
        """The place in the text where what ``unwind`` would drop begins, if it drops anything."""
        depth = self._depth(origins)
        return None if depth is None or depth == len(self._starts) else self._starts[depth]

    def _depth(self, origins: Sequence[str]) -> int | None:
        gotos = self._tables.gotos
        for depth in range(len(self._states) - 1, -1, -1):
            if any(origin in gotos[self._states[depth]] for origin in origins):
                return depth
        return None

    def expected(self) -> set[str]:
        """The symbols that the grammar has a place for, now."""
        return {symbol for symbol in self._actions[self._states[-1]] if self.accepts(symbol)}

    def accepts(self, symbol: str) -> bool:
        """Whether ``symbol`` would be shifted: reductions are tried on a copy of the states."""
        states = list(self._states)
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
            if states[-1] == self._tables.accept:
                return True

    def _reduce(self, production: Production) -> None:
        """Replace the newest parts by what they make together."""
        origin, length, method, plan, collapses = production
        states, values = self._states, self._values
        parts: list[object] = []
        end = start = self._ends[-1] if self._ends else 0
        if length:
            parts = values[-length:]
            start = self._starts[-length]
            del states[-length:], values[-length:], self._starts[-length:], self._ends[-length:]
        arguments = _arranged(parts, plan)
        make = self._methods[method]
        if collapses and len(arguments) == 1:
            values.append(arguments[0])
        elif make is None:
            values.append(arguments)
        else:
            values.append(make(Span(self._source, start, end), *arguments))
        self._starts.append(start)
        self._ends.append(end)
        states.append(self._tables.gotos[states[-1]][origin])


def _arranged(parts: list[object], plan: tuple[tuple[int, bool], ...]) -> list[object]:
    """The parts that the builder gets. A leading list is extended in place, so that long lists take
    linear time."""
    arranged: list[object] = []
    for position, unpack in plan:
        part = parts[position] if position >= 0 else None
        if not unpack:
            arranged.append(part)
        elif arranged:
            arranged.extend(part)  # type: ignore[arg-type]
        else:
            arranged = part  # type: ignore[assignment]
    return arranged
