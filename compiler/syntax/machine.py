"""A shift-reduce machine over the grammar's tables, building nodes as it reduces.

It keeps its own stack, so neither the length nor the nesting of a text can exhaust Python's.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..diagnostics.source import Source, Span
from .tables import END, Production, Tables
from .tokens import Token


class Machine:
    """Takes tokens one by one; ``builder`` has one method per named production of the grammar."""

    def __init__(self, tables: Tables, builder: object, source: Source) -> None:
        self._tables = tables
        self._actions = tables.actions
        self._methods: dict[str, Callable[..., object] | None] = {
            production.method: getattr(builder, production.method, None)
            for production in tables.productions
        }
        self._source = source
        self._states = [tables.start]
        self._values: list[object] = []
        self._starts: list[int] = []
        self._ends: list[int] = []

    @property
    def result(self) -> object:
        """What stands for the whole text, once ``END`` was fed."""
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
        states = self._states
        while True:
            action = self._actions[states[-1]].get(symbol)
            if action is None:
                return False
            if action >= 0:
                states.append(action)
                self._values.append(token)
                self._starts.append(token.start)
                self._ends.append(token.end)
                return True
            self._reduce(self._tables.productions[~action])
            if symbol == END and states[-1] == self._tables.accept:
                return True

    def unwind(self, origins: Sequence[str]) -> bool:
        """Drop what is unfinished, down to where one of ``origins`` may begin; False if nowhere."""
        gotos = self._tables.gotos
        for depth in range(len(self._states) - 1, -1, -1):
            if any(origin in gotos[self._states[depth]] for origin in origins):
                del self._states[depth + 1 :]
                del self._values[depth:]
                del self._starts[depth:]
                del self._ends[depth:]
                return True
        return False

    def expected(self) -> set[str]:
        """The symbols that the grammar has a place for, now."""
        return {symbol for symbol in self._actions[self._states[-1]] if self._accepts(symbol)}

    def _accepts(self, symbol: str) -> bool:
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
        if length == 1 and collapses:
            states[-1] = self._tables.gotos[states[-2]][origin]
            return
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
    """The parts that matter; a leading list is extended in place: long lists stay linear."""
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
