"""The LALR machine: it shifts tokens, reduces by the grammar's productions, and builds nodes.

The parser runs it over the tokens of each declaration. It has its own stack, so neither a long nor
a deeply nested text can exhaust the stack of Python.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..diagnostics.source import Source, Span
from .builder import Builder, Method
from .lalr_tables import Production, Tables
from .tokens import Token


class Machine:
    """Takes tokens; ``builder`` makes a node for each production that has a name."""

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
        return self._values[0]

    def reset(self) -> None:
        """Forget everything fed so far."""
        del self._stack[3:]
        self._values.clear()

    def knows(self, symbol: str) -> bool:
        """Whether the present state has an action for ``symbol``."""
        return symbol in self._actions[self._stack[-1]]

    def run(
        self, tokens: Sequence[Token], begin: int, end: int, symbol_of: Callable[[int], str]
    ) -> int:
        """Shift the tokens from ``begin`` on; returns the first one without a place, or ``end``.

        ``symbol_of`` decides whether a word counts as one here, or as a name.
        """
        actions, productions = self._actions, self._tables.productions
        words, stack, values = self._tables.literals, self._stack, self._values
        for index in range(begin, end):
            token = tokens[index]
            symbol = token[0]
            if symbol == "NAME" and token[1] in words:
                symbol = symbol_of(index)
            while (action := actions[stack[-1]].get(symbol)) is not None and action < 0:
                production = productions[~action]
                if production.renames:
                    stack[-1] = self._collapsed(stack[-4], stack[-1], symbol)
                else:
                    self._reduce(~action, production)
            if action is None:
                return index
            stack += (token[2], token[3], action)
            values.append(token)
        return end

    def feed(self, token: Token) -> bool:
        """Shift one token by its kind; False where the grammar has no place for it."""
        return self.run((token,), 0, 1, lambda _: token.kind) == 1

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

    def _reduce(self, number: int, production: Production) -> None:
        """Replace the newest parts by what they make together."""
        try:
            make = self._makers[number]
        except KeyError:
            make = self._makers[number] = self._maker(production)
        origin, length, _, plan, _, _, as_read = production
        stack, values = self._stack, self._values
        if length == 1 and as_read:  # Nearly half of all: a name, a number, the first of a list.
            if make is None:
                values[-1] = [values[-1]]
            else:
                values[-1] = make(Span(self._source, stack[-3], stack[-2]), values[-1])
            stack[-1] = self._tables.gotos[stack[-4]][origin]
            return
        start = end = stack[-2]
        parts: list[object] = []
        if length:
            start = stack[-3 * length]
            parts = values[-length:]
            del stack[-3 * length :], values[-length:]
        if not as_read:
            parts = _arranged(parts, plan)
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
