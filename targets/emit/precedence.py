"""How tightly expressions bind: the order that all C-like shading languages share.

WGSL demands parentheses where the others only have habits (around operands of bitwise operators
and shifts, between ``&&`` and ``||``, between comparisons). They read well everywhere, so all
targets get them.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import IntEnum
from typing import NamedTuple, TypeAlias


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

Printed: TypeAlias = tuple[str, Binding]
"""A printed expression, and how tightly it binds. It is a plain tuple, since thousands are made."""

# Enums look their members up by a slow descriptor, so those that are used all the time stand here.
CHOICE, OR, POSTFIX, NAME = Binding.CHOICE, Binding.OR, Binding.POSTFIX, Binding.NAME
PREFIXED = Binding.PREFIX


class Field(NamedTuple):
    """A printed expression as the field of a form: ``{0}``, ``{0:p}`` or ``{0:and}``."""

    text: str
    binding: Binding

    def __format__(self, spec: str) -> str:
        """The expression with the parentheses that the form asks for; see ``forms.py``."""
        text, binding = self
        return text if binding >= _SPECS[spec] else f"({text})"


def within(printed: Printed, least: Binding) -> str:
    """An expression as an operand that has to bind at least as tightly as ``least``."""
    text, binding = printed
    return text if binding >= least else f"({text})"


def infix(symbol: str, left: Printed, right: Printed) -> Printed:
    """``left symbol right`` with the parentheses it needs."""
    result, operands, chains = INFIX[symbol]
    first, binding = left
    if binding < operands and not (chains and binding == result):
        first = f"({first})"
    second, binding = right
    if binding < operands:
        second = f"({second})"
    return f"{first} {symbol} {second}", result


def prefix(symbol: str, operand: Printed) -> Printed:
    """``symbol`` before ``operand``; never two signs in a row, which would read as ``--``."""
    return f"{symbol}{within(operand, POSTFIX)}", PREFIXED


def choice(condition: Printed, then: Printed, otherwise: Printed) -> Printed:
    """``condition ? then : otherwise``."""
    parts = [within(part, OR) for part in (condition, then, otherwise)]
    return "{} ? {} : {}".format(*parts), CHOICE


def written(spelled: str, operands: Sequence[Printed]) -> Printed:
    """A symbol between two operands or before one, or a call of a function."""
    if len(operands) == 2 and spelled in INFIX:
        return infix(spelled, *operands)
    if len(operands) == 1 and spelled in PREFIX:
        return prefix(spelled, operands[0])
    return f"{spelled}({', '.join([text for text, _binding in operands])})", POSTFIX
