"""How tightly expressions bind: the order that all C-like shading languages share.

WGSL demands parentheses where the others only have habits (around operands of bitwise operators
and shifts, between ``&&`` and ``||``, between comparisons). They read well everywhere, so all
targets get them.
"""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple


class Binding(IntEnum):
    """From loose to tight."""

    CHOICE = 0
    OR = 1
    AND = 2
    COMPARE = 3
    BITS = 4
    SUM = 5
    PRODUCT = 6
    PREFIX = 7
    POSTFIX = 8
    NAME = 9


class Infix(NamedTuple):
    """An operator between two operands."""

    result: Binding
    operands: Binding
    """Operands that bind at least this tightly need no parentheses."""
    chains: bool = False
    """The left operand may also be the same kind of expression: ``a - b - c``."""


_SUM = Infix(Binding.SUM, Binding.PRODUCT, chains=True)
_PRODUCT = Infix(Binding.PRODUCT, Binding.PREFIX, chains=True)
_COMPARE = Infix(Binding.COMPARE, Binding.SUM)
_BITS = Infix(Binding.BITS, Binding.PREFIX)

INFIX = {
    "+": _SUM,
    "-": _SUM,
    "*": _PRODUCT,
    "/": _PRODUCT,
    "%": _PRODUCT,
    "<": _COMPARE,
    "<=": _COMPARE,
    ">": _COMPARE,
    ">=": _COMPARE,
    "==": _COMPARE,
    "!=": _COMPARE,
    "&": _BITS,
    "|": _BITS,
    "^": _BITS,
    "<<": _BITS,
    ">>": _BITS,
    "&&": Infix(Binding.AND, Binding.COMPARE, chains=True),
    "||": Infix(Binding.OR, Binding.COMPARE, chains=True),
}

PREFIX = frozenset("-!~")


_SPECS = {"": Binding.CHOICE, "and": Binding.AND, "p": Binding.POSTFIX}
"""How tightly a field of a form binds what stands there."""


class Text(NamedTuple):
    """A printed expression."""

    text: str
    binding: Binding = Binding.POSTFIX

    def within(self, least: Binding) -> str:
        """As an operand that has to bind at least as tightly as ``least``."""
        return self.text if self.binding >= least else f"({self.text})"

    def __format__(self, spec: str) -> str:
        """As a form's field: ``{0}``, ``{0:p}`` or ``{0:and}``; see ``forms.py``."""
        return self.within(_SPECS[spec])


def infix(symbol: str, left: Text, right: Text) -> Text:
    """``left symbol right`` with the parentheses it needs."""
    rule = INFIX[symbol]
    chained = rule.chains and left.binding == rule.result
    first = left.text if chained else left.within(rule.operands)
    return Text(f"{first} {symbol} {right.within(rule.operands)}", rule.result)


def prefix(symbol: str, operand: Text) -> Text:
    """``symbol`` before ``operand``; never two signs in a row, which would read as ``--``."""
    return Text(f"{symbol}{operand.within(Binding.POSTFIX)}", Binding.PREFIX)


def choice(condition: Text, then: Text, otherwise: Text) -> Text:
    """``condition ? then : otherwise``."""
    parts = [part.within(Binding.OR) for part in (condition, then, otherwise)]
    return Text("{} ? {} : {}".format(*parts), Binding.CHOICE)
