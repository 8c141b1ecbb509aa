"""Decides where parentheses are needed: how tightly each kind of expression binds its operands.

The order is that of C, which all shading languages share.

WGSL demands parentheses where the others only have habits (around operands of bitwise operators
and shifts, between ``&&`` and ``||``, between comparisons). They read well everywhere, so all
languages get them.
"""

# Annotations are evaluated in this module: a named tuple compiles those that are texts, and to load
# Python's compiler for them would take a hundredth of a short compile.

from collections.abc import Callable, Iterable, Sequence
from enum import IntEnum
from typing import NamedTuple, TypeAlias


class Binding(IntEnum):
    """The strength with which an expression holds together, from loose to tight."""

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


_SPECS = {
    "": Binding.CHOICE,
    "and": Binding.AND,
    "factor": Binding.PREFIX,
    "p": Binding.POSTFIX,
}
"""The binding that an operand needs, by the word after the colon in a field of a form."""

Printed: TypeAlias = tuple[str, Binding]
"""A printed expression, and how tightly it binds. It is a plain tuple, since thousands are made."""

Writer: TypeAlias = Callable[[Sequence[Printed]], Printed]
"""Puts printed operands together."""

# Enums look their members up by a slow descriptor, so those that are used all the time stand here.
CHOICE, OR, POSTFIX, NAME = Binding.CHOICE, Binding.OR, Binding.POSTFIX, Binding.NAME
COMPARE, PREFIXED = Binding.COMPARE, Binding.PREFIX


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


def _infix(symbol: str, rule: Infix) -> Writer:
    """A writer of ``left symbol right``, with parentheses where they are needed."""
    result, least, chains = rule

    def write(operands: Sequence[Printed]) -> Printed:
        (left, binding), (right, other) = operands
        if binding < least and not (chains and binding == result):
            left = f"({left})"
        if other < least:
            right = f"({right})"
        return f"{left} {symbol} {right}", result

    return write


def prefix(symbol: str, operand: Printed) -> Printed:
    """``symbol`` before ``operand``; never two signs in a row, which would read as ``--``."""
    return f"{symbol}{within(operand, POSTFIX)}", PREFIXED


def choice(condition: Printed, then: Printed, otherwise: Printed) -> Printed:
    """``condition ? then : otherwise``."""
    parts = [within(part, OR) for part in (condition, then, otherwise)]
    return "{} ? {} : {}".format(*parts), CHOICE


def writer(spelled: str, count: int) -> Writer:
    """Make a writer for so many operands.

    A symbol stands between two operands or before one. Anything else is the name of a function,
    which is called with them.
    """
    if count == 2 and spelled in INFIX:
        return _infix(spelled, INFIX[spelled])
    if count == 1 and spelled in PREFIX:
        return lambda operands: prefix(spelled, *operands)
    return lambda operands: call(spelled, separable(operands))


def separable(arguments: Sequence[Printed]) -> list[str]:
    """The texts of arguments, between which commas can stand.

    In WGSL ``a < b, c > d`` is a name with a list of a template's arguments. So where a comparison
    with ``>`` follows one with ``<``, that one gets parentheses; in all languages, as they do no
    harm.
    """
    texts = [text for text, _binding in arguments]
    loose = [index for index, (_text, binding) in enumerate(arguments) if binding <= COMPARE]
    for index in loose[:-1]:
        if " < " in texts[index] and any(" >" in texts[later] for later in loose if later > index):
            texts[index] = f"({texts[index]})"
    return texts


def call(function: str, arguments: Iterable[str]) -> Printed:
    """``function(argument, …)``."""
    return f"{function}({', '.join(arguments)})", POSTFIX
