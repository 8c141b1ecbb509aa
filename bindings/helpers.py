"""Functions of Burnish that a binding has because derived values call them.

A builtin of numbers that guards its operands, such as a quotient that is zero where the divisor is,
takes several operations. It becomes a function of the binding, and what it computes is traced from
the reference like everything else.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from ..compiler.reference.functions import LaneKind, evaluate
from ..compiler.tracing import Expression, Kind, Tracing, given, made, wrapped
from ..support.unique import Names
from .lazily import lazily
from .materials import Helper
from .scheduling import returned

_MOST = 2
"""The most operations of a function that stands where it is called."""
_LETTERS = "xyzw"
_NOUNS = {"div": "quotient", "mod": "rest", "pow": "power", "quantize_half": "nearest_half"}


class Helpers:
    """The functions that the derived values of a binding call."""

    def __init__(self) -> None:
        self._found: dict[tuple[str, LaneKind, tuple[tuple[Kind, bool], ...]], Helper] = {}

    @property
    def found(self) -> tuple[Helper, ...]:
        """The functions by name."""
        return tuple(sorted(self._found.values(), key=lambda each: each.name))

    def applied(self, function: str, kind: LaneKind, operands: Sequence[Expression]) -> Expression:
        """The value of a builtin of numbers: a call, or what it computes if that is short."""
        kinds = tuple((each.kind, each.is_natural) for each in operands)
        value = _traced(function, kind, kinds)
        if _count(value) <= _MOST:
            (short,) = evaluate(function, [(each,) for each in operands], Tracing(), kind)
            return wrapped(short)
        helper = self._helper(function, kind, kinds, value)
        return made(
            "call",
            *operands,
            kind=value.kind,
            is_natural=value.is_natural,
            value=(helper.name, helper.kinds),
        )

    def _helper(
        self,
        function: str,
        kind: LaneKind,
        kinds: tuple[tuple[Kind, bool], ...],
        value: Expression,
    ) -> Helper:
        key = function, kind, kinds
        if key not in self._found:
            letters = tuple(_LETTERS[: len(kinds)])
            plain = _NOUNS.get(function, function)
            plain = plain if kind == "float" else f"{plain}_of_{kind}s"
            taken = {each.name for each in self._found.values()}
            name = next(
                each
                for each in (plain, *(f"{plain}_{number}" for number in range(2, 99)))
                if each not in taken
            )
            self._found[key] = Helper(
                name=name, parameters=letters, kinds=tuple(each for each, _ in kinds),
                result=value.kind, statements=returned(lazily(value), Names(letters)),
            )  # fmt: skip
        return self._found[key]


@cache
def _traced(function: str, kind: LaneKind, kinds: tuple[tuple[Kind, bool], ...]) -> Expression:
    lanes = [
        (given(letter, each, is_natural=natural),)
        for letter, (each, natural) in zip(_LETTERS, kinds, strict=False)
    ]
    (found,) = evaluate(function, lanes, Tracing(), kind)
    return wrapped(found)


def _count(value: Expression) -> int:
    """The number of operations of an expression."""
    found: dict[int, Expression] = {}
    pending = [value]
    while pending:
        each = pending.pop()
        if each.operands and id(each) not in found:
            found[id(each)] = each
            pending.extend(each.operands)
    return len(found)
