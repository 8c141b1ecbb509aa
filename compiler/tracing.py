"""Turns functions of the reference into expressions, which any language can print.

The functions of ``reference`` are written for any array library. ``Tracing`` is one whose arrays
are expressions: a function that is called with inputs returns what computes the same from them. The
table of builtins of web pages is made so (``targets/web_host/serving``), and the derived values of
bindings (``bindings/derivation``).

An operation's name is that of the method here, or of the function of ``namespace``. Integers need
more than 32 bits: the reference computes with more, and cuts them off. Only ``and``, ``or``,
``xor``, ``invert`` and products of integers have the lowest 32 bits alone, which is all that the
reference uses of these. ``is_natural`` tells whether these bits stand for a number without a sign.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal

Kind = Literal["float", "int", "bool"]

_HALF = 0x80000000
"""The reference wraps to signed 32 bits by adding this, taking the low 32 bits, and subtracting it;
``wrap`` is one operation for the three."""


@dataclass(frozen=True, slots=True, eq=False)
class Expression:
    """A number or a truth: an operation and its operands."""

    op: str
    """The operation; ``constant`` and ``input`` have no operands, but a value."""
    operands: tuple[Expression, ...]
    kind: Kind
    is_natural: bool = False
    value: Any = None
    """The number, the truth, what the input is, or what else the operation has to know."""

    def __add__(self, other: Any) -> Expression:
        return self if is_number(other, 0) else self._joined("add", other)

    def __radd__(self, other: Any) -> Expression:
        return self if is_number(other, 0) else wrapped(other)._joined("add", self)

    def __sub__(self, other: Any) -> Expression:
        if is_number(other, _HALF) and self.op == "low_bits":
            (biased,) = self.operands
            if biased.op == "add" and biased.operands[1] is wrapped(_HALF):
                return made("wrap", biased.operands[0], kind="int")
        return self._joined("sub", other)

    def __rsub__(self, other: Any) -> Expression:
        return wrapped(other)._joined("sub", self)

    def __mul__(self, other: Any) -> Expression:
        if is_number(other, 1):
            return self
        if is_number(other, -1):
            return -self
        is_integer = self.kind == wrapped(other).kind == "int"
        return self._joined("mul_int" if is_integer else "mul", other)

    def __rmul__(self, other: Any) -> Expression:
        return wrapped(other)._joined("mul", self)

    def __truediv__(self, other: Any) -> Expression:
        return made("div", self, other)

    def __floordiv__(self, other: Any) -> Expression:
        return made("floordiv", self, other, kind="int")

    def __mod__(self, other: Any) -> Expression:
        return made("mod", self, other, kind="int")

    def __neg__(self) -> Expression:
        return made("neg", self, kind=self.kind)

    def __abs__(self) -> Expression:
        return made("abs", self, kind=self.kind, is_natural=True)

    def __lt__(self, other: Any) -> Expression:
        return made("lt", self, other, kind="bool")

    def __le__(self, other: Any) -> Expression:
        return made("le", self, other, kind="bool")

    def __gt__(self, other: Any) -> Expression:
        return made("gt", self, other, kind="bool")

    def __ge__(self, other: Any) -> Expression:
        return made("ge", self, other, kind="bool")

    def __eq__(self, other: object) -> Any:
        return made("eq", self, other, kind="bool")

    def __ne__(self, other: object) -> Any:
        return made("ne", self, other, kind="bool")

    __hash__ = object.__hash__

    def __and__(self, other: Any) -> Expression:
        if is_number(other, 0xFFFFFFFF):
            is_done = self.op == "low_bits"
            return self if is_done else made("low_bits", self, kind="int", is_natural=True)
        is_natural = self.is_natural or wrapped(other).is_natural
        return self._bits("and", other, is_natural)

    def __or__(self, other: Any) -> Expression:
        return self._bits("or", other, self.is_natural and wrapped(other).is_natural)

    def __xor__(self, other: Any) -> Expression:
        return self._bits("xor", other, self.is_natural and wrapped(other).is_natural)

    def __ror__(self, other: Any) -> Expression:
        return self if is_number(other, 0) else wrapped(other) | self

    def __invert__(self) -> Expression:
        return made("invert", self, kind="int")

    def __lshift__(self, other: Any) -> Expression:
        if is_number(other, 0):
            return self
        return made("lshift", self, other, kind="int", is_natural=self.is_natural)

    def __rlshift__(self, other: Any) -> Expression:
        return wrapped(other) << self

    def __rshift__(self, other: Any) -> Expression:
        if is_number(other, 0):
            return self
        return made("rshift", self, other, kind="int", is_natural=self.is_natural)

    def _joined(self, op: str, other: Any) -> Expression:
        both = self, wrapped(other)
        kind: Kind = "int" if all(each.kind == "int" for each in both) else "float"
        return made(op, *both, kind=kind)

    def _bits(self, op: str, other: Any, is_natural: bool) -> Expression:
        found = made(op, self, other, kind="int")
        return made("low_bits", found, kind="int", is_natural=True) if is_natural else found


_KNOWN: dict[tuple[Any, ...], Expression] = {}
"""Equal expressions are one, so that what several others need is computed once."""


def made(
    op: str,
    *operands: Any,
    kind: Kind = "float",
    is_natural: bool = False,
    value: Hashable = None,
) -> Expression:
    """The expression of an operation with its operands.

    ``value`` is what an operation needs to know besides, such as which parameter it reads.
    """
    found = tuple(map(wrapped, operands))
    return _only(Expression(op, found, kind, is_natural, value))


def given(value: Hashable, kind: Kind = "float", *, is_natural: bool = False) -> Expression:
    """The expression of an input, such as the name of a lane."""
    return _only(Expression("input", (), kind, is_natural, value))


def _only(new: Expression) -> Expression:
    # Numbers of several types, and zeros of either sign, are equal, but their texts are not.
    value = repr(new.value) if new.op == "constant" else new.value
    key = new.op, new.kind, new.is_natural, value, *map(id, new.operands)
    return _KNOWN.setdefault(key, new)


def wrapped(value: Any) -> Expression:
    """An expression, or a constant as one."""
    if isinstance(value, Expression):
        return value
    if isinstance(value, bool):
        return _constant(value, "bool")
    if isinstance(value, int):
        return _constant(value, "int", is_natural=value >= 0)
    return _constant(float(value), "float")


def _constant(value: float, kind: Kind, *, is_natural: bool = False) -> Expression:
    return _only(Expression("constant", (), kind, is_natural, value))


def is_number(value: Any, number: int) -> bool:
    """True if something is a constant with this value."""
    return not isinstance(value, Expression) and bool(value == number)


def _named(op: str, kind: Kind = "float") -> Callable[..., Expression]:
    return partial(made, op, kind=kind)


def _chosen(condition: Any, x: Any, y: Any) -> Expression:
    both = wrapped(x), wrapped(y)
    kind = both[0].kind if both[0].kind == both[1].kind else "float"
    is_natural = all(each.is_natural for each in both)
    return made("where", condition, *both, kind=kind, is_natural=is_natural)


def _extreme(op: str, x: Any, y: Any) -> Expression:
    both = wrapped(x), wrapped(y)
    kind: Kind = "int" if all(each.kind == "int" for each in both) else "float"
    return made(op, *both, kind=kind, is_natural=all(each.is_natural for each in both))


class Tracing:
    """The functions of ``reference/namespace.py``."""

    where = staticmethod(_chosen)
    minimum = staticmethod(partial(_extreme, "minimum"))
    maximum = staticmethod(partial(_extreme, "maximum"))
    int64 = staticmethod(_named("int64", "int"))
    logical_and = staticmethod(_named("logical_and", "bool"))
    logical_or = staticmethod(_named("logical_or", "bool"))
    logical_not = staticmethod(_named("logical_not", "bool"))
    divide = staticmethod(_named("div"))
    remainder = staticmethod(_named("remainder"))
    floor = staticmethod(_named("floor"))
    ceil = staticmethod(_named("ceil"))
    rint = staticmethod(_named("rint"))
    trunc = staticmethod(_named("trunc"))
    sqrt = staticmethod(_named("sqrt"))
    power = staticmethod(_named("power"))
    exp = staticmethod(_named("exp"))
    exp2 = staticmethod(_named("exp2"))
    log = staticmethod(_named("log"))
    log2 = staticmethod(_named("log2"))
    sin = staticmethod(_named("sin"))
    cos = staticmethod(_named("cos"))
    tan = staticmethod(_named("tan"))
    arcsin = staticmethod(_named("arcsin"))
    arccos = staticmethod(_named("arccos"))
    arctan = staticmethod(_named("arctan"))
    arctan2 = staticmethod(_named("arctan2"))
    sinh = staticmethod(_named("sinh"))
    cosh = staticmethod(_named("cosh"))
    tanh = staticmethod(_named("tanh"))
    arcsinh = staticmethod(_named("arcsinh"))
    arccosh = staticmethod(_named("arccosh"))
    arctanh = staticmethod(_named("arctanh"))
    ldexp = staticmethod(_named("ldexp"))

    @staticmethod
    def float64(x: Any) -> Expression:
        """The number as a float."""
        return made("float64", x)

    @staticmethod
    def frexp(x: Any) -> Any:
        """The fraction and the exponent."""
        return made("fraction", x), made("exponent", x, kind="int")


def shared(roots: Iterable[Expression]) -> list[Expression]:
    """The expressions that more than one expression needs, operands first."""
    uses: dict[int, int] = {}
    order: list[Expression] = []
    # Formulas may be as deep as a program makes them: the second time, all operands are done.
    pending = [(root, False) for root in reversed(tuple(roots))]
    while pending:
        each, is_done = pending.pop()
        if is_done:
            order.append(each)
            continue
        uses[id(each)] = uses.get(id(each), 0) + 1
        if uses[id(each)] == 1:
            pending.append((each, True))
            pending.extend((operand, False) for operand in reversed(each.operands))
    return [each for each in order if uses[id(each)] > 1 and each.operands]
