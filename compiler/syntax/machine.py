"""The LALR machine: it shifts tokens, reduces by the grammar's productions, and builds nodes.

The parser feeds it one token after the other. It has its own stack, so neither a long nor a deeply
nested text can exhaust the stack of Python.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..diagnostics.source import Source, Span
from .builder import Builder, Method
from .lalr_tables import END, Production, Tables
from .tokens import Token


class Machine:
    """Takes tokens one by one; ``builder`` makes a node for each named production."""

    def __init__(self, tables: Tables, builder: Builder, source: Source) -> None:
        self._tables = tables
        self._actions = tables.actions
        self._builder = builder
        self._makers: dict[int, Method | None] = {}
        """By production, as far as they were needed: what makes its node."""
        self._source = source
        self._stack = [0, 0, tables.start]
        """For each part that was read, where it starts, where it ends, and the state after it."""
        self._values: list[object] = []
        """What was made of these parts; the first entry of the stack stands before all of them."""

    @property
    def result(self) -> object:
        """The node for the whole text, after ``END`` was fed."""
        return self._values[-1]

    def reset(self) -> None:
        """Forget everything fed so far."""
        del self._stack[3:]
        self._values.clear()

    def knows(self, symbol: str) -> bool:
        """Whether the present state has an action for ``symbol``."""
        return symbol in self._actions[self._stack[-1]]

    def run(
        self, tokens: Sequence[Token], index: int, end: int, symbols: Callable[[int], str]
    ) -> int:
        """Feed the tokens from ``index`` on; the first that has no place, or ``end``.

        ``symbols`` decides what a word counts as that is a name in other places.
        """
        words = self._tables.literals
        while index < end:
            token = tokens[index]
            kind = token[0]
            if kind == "NAME" and token[1] in words:
                kind = symbols(index)
            if not self.feed(kind, token):
                return index
            index += 1
        return end

    def feed(self, symbol: str, token: Token) -> bool:
        """Shift ``token`` as ``symbol``; False where the grammar has no place for it."""
        stack, actions = self._stack, self._actions
        while True:
            state = stack[-1]
            action = actions[state].get(symbol)
            if action is None:
                return False
            if action >= 0:
                stack += (token[2], token[3], action)
                self._values.append(token)
                return True
            production = self._tables.productions[~action]
            if production.renames:
                stack[-1] = self._collapsed(stack[-4], state, symbol)
                continue
            self._reduce(~action, production)
            if symbol == END and stack[-1] == self._tables.accept:
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
                if not production.renames:
                    break
                state = self._tables.gotos[below][production.origin]
            known[key] = state
        return known[key]

    def unwind(self, origins: Sequence[str]) -> bool:
        """Drop what is unfinished, down to where one of ``origins`` may begin; False if nowhere."""
        depth = self._depth(origins)
        if depth is None:
            return False
        del self._stack[3 * depth + 3 :]
        del self._values[depth:]
        return True

    def begun(self, origins: Sequence[str]) -> int | None:
        """The place in the text where what ``unwind`` would drop begins, if it drops anything."""
        depth = self._depth(origins)
        if depth is None or depth == len(self._values):
            return None
        return self._stack[3 * depth + 3]

    def _depth(self, origins: Sequence[str]) -> int | None:
        """How many parts stand before the last place where one of ``origins`` may begin."""
        gotos = self._tables.gotos
        for depth in range(len(self._values), -1, -1):
            if any(origin in gotos[self._stack[3 * depth + 2]] for origin in origins):
                return depth
        return None

    def expected(self) -> set[str]:
        """The symbols that the grammar has a place for, now."""
        return {symbol for symbol in self._actions[self._stack[-1]] if self.accepts(symbol)}

    def accepts(self, symbol: str) -> bool:
        """Whether ``symbol`` would be shifted: reductions are tried on a copy of the states."""
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
            if states[-1] == self._tables.accept:
                return True

    def _reduce(self, number: int, production: Production) -> None:
        """Replace the newest parts by what they make together."""
        origin, length, _, plan, _, _, as_read = production
        stack, values = self._stack, self._values
        if length:
            start, end = stack[-3 * length], stack[-2]
            parts = values[-length:]
            del stack[-3 * length :], values[-length:]
        else:
            start = end = stack[-2]
            parts = []
        if not as_read:
            parts = _arranged(parts, plan)
        try:
            make = self._makers[number]
        except KeyError:
            make = self._makers[number] = self._maker(production)
        values.append(parts if make is None else make(Span(self._source, start, end), *parts))
        stack += (start, end, self._tables.gotos[stack[-1]][origin])

    def _maker(self, production: Production) -> Method | None:
        """What makes the node of a production; None where its parts are handed on as a list."""
        if production.collapses and len(production.plan) == 1:
            return _the_part
        return self._builder.method(production.method)


def _the_part(_: Span, part: object) -> object:
    """What an expression in parentheses is."""
    return part


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
