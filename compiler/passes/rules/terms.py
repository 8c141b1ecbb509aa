"""The terms that simplification rules are written with: ``sqrt(x * x)`` and ``abs_(x)``.

On the left of a rule, a term says what an operation looks like. Each ``Variable`` in it stands for
a value, the same one wherever it occurs, and a number for a constant with this number in every
lane. On the right, a term says what the operation is equal to: variables are the values that were
found, and what has to be worked out is ``Computed``. A ``Condition`` says when that is so.

Arithmetic, operations on bits and comparisons have Python's operators; ``vocabulary.py`` has the
words for all other operations. ``matching.py`` makes functions of terms, ``notation.py`` texts.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any

from ....stdlib.builtins import BUILTINS
from ....stdlib.builtins.facts import Fact
from ....support.frozen import changed, frozen
from ...ir.comparisons import HOLDS
from ...ir.leaves import Number
from ...ir.node import HEADS, SPECIAL, Node
from ...ir.types import Type
from .builder import Builder

Heads = frozenset[Hashable]
"""Some of the ``Node.head``s. ``None`` in their place stands for any head."""

CONSTANT: Heads = frozenset({HEADS["constant"], *SPECIAL.values()})
"""The heads of constants."""


class Term:
    """A pattern of a value, or the way to make one. Its operators make larger terms."""

    __slots__ = ()

    def __add__(self, other: Operand) -> Operation:
        return ADD(self, other)

    def __sub__(self, other: Operand) -> Operation:
        return SUB(self, other)

    def __rsub__(self, other: Number) -> Operation:
        return SUB(other, self)

    def __mul__(self, other: Operand) -> Operation:
        return MUL(self, other)

    def __truediv__(self, other: Operand) -> Operation:
        return DIV(self, other)

    def __rtruediv__(self, other: Number) -> Operation:
        return DIV(other, self)

    def __neg__(self) -> Operation:
        return NEG(self)

    def __and__(self, other: Operand) -> Operation:
        return BIT_AND(self, other)

    def __or__(self, other: Operand) -> Operation:
        return BIT_OR(self, other)

    def __xor__(self, other: Operand) -> Operation:
        return BIT_XOR(self, other)

    def __invert__(self) -> Operation:
        return BIT_NOT(self)


Operand = Term | Number
"""A term, or a number in its place."""


@frozen(eq=False)
class Variable(Term):
    """A value: any, or one with certain heads."""

    name: str
    heads: Heads | None = None

    def __matmul__(self, operation: Operation) -> Operation:
        """An operation that the variable stands for: ``s @ (x + y)``."""
        return changed(operation, label=self)

    def __lt__(self, other: Variable | Number) -> Condition:
        return proven("lt", self, other)

    def __le__(self, other: Variable | Number) -> Condition:
        return proven("le", self, other)

    def __gt__(self, other: Variable | Number) -> Condition:
        return proven("gt", self, other)

    def __ge__(self, other: Variable | Number) -> Condition:
        return proven("ge", self, other)


@frozen(eq=False)
class Several(Term):
    """All operands that are left; only the last of an operation can be it."""

    name: str
    every: Heads | None = None
    """The heads that each of them may have."""
    some: Heads | None = None
    """The heads of which one of them, at least, has one."""


@frozen(eq=False)
class Uniform(Term):
    """A constant with one number in every lane."""

    value: Number


@frozen(eq=False)
class Data(Term):
    """The data of an operation, such as the lanes that a swizzle takes."""

    name: str


@frozen(eq=False)
class Computed(Term):
    """A value that a function computes; ``None`` where there turns out to be no simpler value."""

    name: str
    function: Callable[..., Any]
    """A function of the builder, the type of the result, and the values of the arguments."""
    arguments: tuple[Term | Function, ...]


@frozen(eq=False)
class Function:
    """One of some operations: builtins by their names, others with a dot (``.select``)."""

    name: str
    heads: tuple[str, ...]
    data: Data | Computed | None = None

    def __getitem__(self, data: Data | Computed) -> Function:
        """The operation with data, in the notation of nodes: ``swizzle[lanes](x)``."""
        return changed(self, data=data)

    def __call__(self, *operands: Operand) -> Operation:
        """The term of this function, applied to ``operands``."""
        return Operation(self, tuple(map(as_term, operands)))


@frozen(eq=False)
class Operation(Term):
    """An operation of some operands."""

    function: Function
    operands: tuple[Term, ...]
    label: Variable | None = None
    """The variable that stands for its value."""
    is_either: bool = False
    """True if its operands may also stand the other way round."""


@frozen(eq=False)
class Condition:
    """A condition of an equation."""

    words: str
    """The condition in words, with ``{}`` for each argument."""
    function: Callable[..., bool]
    """A function of the builder, the type of the result, and the values of the arguments."""
    arguments: tuple[Term | Function, ...]


def as_term(operand: Operand) -> Term:
    """A number as a term."""
    return operand if isinstance(operand, Term) else Uniform(operand)


def either(operation: Operation) -> Operation:
    """An operation of two operands that may also stand the other way round."""
    return changed(operation, is_either=True)


def function(name: str, *others: str) -> Function:
    """An operation by its head, or any of several, which rules call ``f``."""
    return Function("f" if others else name.removeprefix("."), (name, *others))


def computed(work_out: Callable[..., Any]) -> Callable[..., Computed]:
    """Makes a word for the right sides of rules of a function."""
    name = work_out.__name__.strip("_")
    return lambda *arguments: Computed(name, work_out, tuple(map(_argument, arguments)))


def condition(words: str) -> Callable[[Callable[..., bool]], Callable[..., Condition]]:
    """Makes a condition of a function, with words that have ``{}`` for each argument."""

    def word(holds: Callable[..., bool]) -> Callable[..., Condition]:
        return lambda *arguments: Condition(words, holds, tuple(map(_argument, arguments)))

    return word


def proven(comparison: str, left: Variable, right: Variable | Number) -> Condition:
    """The condition that ranges show that a comparison always holds."""
    decision, sign = HOLDS[comparison], BUILTINS[comparison].operator

    def holds(builder: Builder, _type: Type, one: Node, other: Node) -> bool:
        return decision(builder.ranges.of(one), builder.ranges.of(other))

    if isinstance(right, Variable):
        return Condition(f"{{}} {sign} {{}}", holds, (left, right))
    fact = Fact(right, right)

    def holds_for_number(builder: Builder, _type: Type, one: Node) -> bool:
        return decision(builder.ranges.of(one), fact)

    return Condition(f"{{}} {sign} {right}", holds_for_number, (left,))


def _argument(given: Function | Operand) -> Function | Term:
    return given if isinstance(given, Function) else as_term(given)


ADD, SUB, MUL, DIV, NEG = map(function, ("add", "sub", "mul", "div", "neg"))
BIT_AND, BIT_OR, BIT_XOR, BIT_NOT = map(function, ("bit_and", "bit_or", "bit_xor", "bit_not"))
