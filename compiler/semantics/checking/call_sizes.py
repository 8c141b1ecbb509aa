"""The number of bodies that one call evaluates, if each inner call has its own arguments.

It doubles with each function that calls the one before it twice. ``applications`` asks, and has the
bodies of functions that are too large in this sense evaluated once for many calls.
"""

from __future__ import annotations

from collections import Counter
from functools import lru_cache

from ...syntax import ast
from ..names.modules import Symbol
from ..state.context import Context


def bodies_of(ctx: Context, symbol: Symbol) -> int:
    """The number of bodies in one call of a function: its own and those of all inner calls."""
    known = ctx.call_sizes
    pending = [] if symbol in known else [symbol]
    entered: set[Symbol] = set()
    while pending:
        top = pending[-1]
        calls = _calls(top)
        missing = [] if top in entered else [s for s in calls if s not in known]
        if missing:
            entered.add(top)
            # A function that was entered already is recursive, which is reported at its call.
            pending += [s for s in missing if s not in entered]
            continue
        pending.pop()
        known[top] = 1 + sum(known.get(s, 1) * count for s, count in calls.items())
    return known[symbol]


def _calls(symbol: Symbol) -> Counter[Symbol]:
    """The functions that are called in a body or a default, with the number of their calls.

    Each overload counts, as the types of the arguments are not known here.
    """
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    found: Counter[Symbol] = Counter()
    for name, count in _called_names(function):
        for known in symbol.module.known(name):
            if isinstance(known.declaration, ast.Function):
                found[known] += count
    return found


@lru_cache(maxsize=1024)
def _called_names(function: ast.Function) -> tuple[tuple[str, int], ...]:
    """The names that are called in a function; syntax trees of the library stay the same."""
    found: Counter[str] = Counter()
    waiting: list[object] = [function.body, *(part.value for part in function.parts)]
    waiting += [formal.default for formal in function.arguments]
    while waiting:
        part = waiting.pop()
        waiting.extend(ast.parts(part))
        if isinstance(part, ast.Call) and isinstance(part.callee, ast.Reference):
            found[part.callee.name] += 1
    return tuple(found.items())
