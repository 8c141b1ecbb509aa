"""The arithmetic of terms: sums, products, quotients, powers and functions, in simple forms.

``terms.Terms`` adds conditions and choices. A form is simple if nobody could do without a part of
it: no sum has a zero, and constants are one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from ...stdlib.builtins.facts import SMALLEST_NORMAL
from . import spans
from .term import Maker, Term, value_of
from .variables import Variable

MOST = 200_000
"""The number of terms from which a program is too large to be compared."""
LARGEST_POWER = 32
"""The largest whole exponent for which a power is written out as products."""

LARGEST_EXPONENT = 400
"""The largest magnitude of the exponent of a power of two that is a constant."""
_ODD = frozenset(("sin", "arcsin", "arctan", "tanh", "arcsinh", "arctanh"))
"""Functions that change their sign with that of their argument."""
_EVEN = frozenset(("cos",))
"""Functions that do not depend on the sign of their argument."""

TINY = Fraction(repr(SMALLEST_NORMAL))
"""Below this, a device may treat a number as zero."""
_STEPS: Mapping[str, Callable[[Fraction], int]] = {
    "floor": math.floor,
    "rint": round,
    "trunc": math.trunc,
}
Key = tuple[str, tuple[int, ...], Hashable]


class TooManyTermsError(Exception):
    """A program is too large to be compared."""


class Arithmetic(Maker):
    """Makes terms in a simple form, each one once."""

    def __init__(self) -> None:
        self._known: dict[Key, Term] = {}
        self._variables: dict[str, Variable] = {}
        self.all: list[Term] = []
        """All terms; the arguments of each come before it."""
        self.units: dict[int, tuple[Term, ...]] = {}
        """For the last lane of a vector of length one, by its id, the others."""

    def node(self, op: str, args: tuple[Term, ...] = (), data: Hashable = None) -> Term:
        """The one term of an operation."""
        key = op, tuple([arg.id for arg in args]), data
        found = self._known.get(key)
        if found is None:
            if len(self.all) >= MOST:
                raise TooManyTermsError
            span = spans.span_of(op, args, data)
            found = Term(self, op, args, data, len(self.all), span)
            self._known[key] = found
            self.all.append(found)
        return found

    def make(self, op: str, args: Sequence[Term], data: Hashable = None) -> Any:
        """An operation of other arguments, in a simple form again: a term, or a plain ``bool``."""
        rule = getattr(self, _SIMPLIFIED.get(op, ""), None)
        return self.node(op, tuple(args), data) if rule is None else rule(*args)

    def constant(self, value: float | int | Fraction) -> Term:
        """A number; of a float, the one that people write for it."""
        exact = Fraction(repr(value)) if isinstance(value, float) else Fraction(value)
        return self.node("constant", (), (exact, "i" if isinstance(value, int) else "f"))

    def term(self, lane: Any) -> Term:
        """A lane as a term. A plain condition becomes 0 or 1 of the kind ``b``."""
        if isinstance(lane, Term):
            return lane
        if type(lane).__name__ in ("bool", "bool_"):
            return self.node("constant", (), (Fraction(int(lane)), "b"))
        return self.constant(lane if isinstance(lane, Fraction | int) else float(lane))

    def variable(self, variable: Variable) -> Term:
        """A value from outside: of one name, it is one in both programs."""
        known = self._variables.setdefault(variable.name, variable)
        return self.node("variable", (), known)

    # --- arithmetic -------------------------------------------------------------------------------

    def add(self, x: Any, y: Any) -> Any:
        """The sum of two lanes."""
        x, y = ordered(self.term(x), self.term(y))
        a, b = value_of(x), value_of(y)
        if a is not None and b is not None:
            return self._number(a + b, x, y)
        if a == 0:
            return y
        if self.negative(x) is y:
            return self._number(Fraction(0), x, y)
        return self.node("add", (x, y))

    def negative(self, x: Any) -> Any:
        """The number with the other sign."""
        x = self.term(x)
        return self.mul(self.constant(-1 if x.kind == "i" else -1.0), x)

    def mul(self, x: Any, y: Any) -> Any:
        """The product of two lanes; a constant factor stands first."""
        x, y = ordered(self.term(x), self.term(y))
        a, b = value_of(x), value_of(y)
        if a is None:
            return self.node("mul", (x, y))
        if b is not None or a == 0:
            return self._number(a * (b or 0), x, y)
        if a == 1:
            return y
        inner = value_of(y.args[0]) if y.op == "mul" else None
        if inner is not None:
            return self.mul(self._number(a * inner, x, y.args[0]), y.args[1])
        return self.node("mul", (x, y))

    def _number(self, value: Fraction, *of: Term) -> Term:
        whole = all(term.kind != "f" for term in of)
        return self.node("constant", (), (value, "i" if whole else "f"))

    def divide(self, x: Any, y: Any) -> Any:
        """A quotient; its divisor is never zero."""
        return self.mul(x, self.reciprocal(self.term(y)))

    def reciprocal(self, y: Term) -> Any:
        """One over a number that is never zero."""
        value = value_of(y)
        if value is not None and value != 0:
            return self.node("constant", (), (1 / value, "f"))
        factor, rest = factor_of(y)
        if factor not in (0, 1):
            return self.mul(self.node("constant", (), (1 / factor, "f")), self.reciprocal(rest))
        if y.op == "reciprocal":
            return y.args[0]
        return self.node("reciprocal", (y,))

    def inverse(self, y: Any) -> Any:
        """One over a number, and zero where that is zero.

        A vector that is divided by its length has one: where it has none is left out.
        """
        y = self.term(y)
        if y.op == "sqrt":
            return self.node("inverse_root", y.args)
        value = value_of(y)
        if value is not None:
            return self.node("constant", (), (1 / value if value else value, "f"))
        factor, rest = factor_of(y)
        if factor != 1:
            return self.mul(self.node("constant", (), (1 / factor, "f")), self.inverse(rest))
        return (
            self.reciprocal(y) if y.span.low > 0 or y.span.high < 0 else self.node("inverse", (y,))
        )

    def absolute(self, x: Any) -> Any:
        """The magnitude."""
        x = self.term(x)
        if x.span.low >= 0:
            return x
        if x.span.high <= 0:
            return self.negative(x)
        factor, rest = factor_of(x)
        if factor != 1:
            return self.mul(self._number(abs(factor), x), self.absolute(rest))
        return self.node("abs", (x,))

    def least(self, x: Any, y: Any) -> Any:
        """The lesser of two numbers."""
        return self._extreme("min", x, y)

    def greatest(self, x: Any, y: Any) -> Any:
        """The greater of two numbers."""
        return self._extreme("max", x, y)

    def _extreme(self, op: str, x: Any, y: Any) -> Any:
        x, y = ordered(self.term(x), self.term(y))
        if x is y:
            return x
        if x.span.high <= y.span.low:
            return x if op == "min" else y
        if y.span.high <= x.span.low:
            return y if op == "min" else x
        return self.node(op, (x, y))

    def root(self, x: Any) -> Any:
        """The square root of a number that is not negative."""
        x = self.term(x)
        value = value_of(x)
        if value in (0, 1):
            return x
        return self.node("sqrt", (x,))

    def inverse_root(self, x: Any) -> Any:
        """The reciprocal of the root of a number above zero.

        ``max(q, tiny)`` is ``q`` where that is a sum of squares: what a vector without length
        becomes is left out, and so are lengths that a device may flush to zero.
        """
        x = self.term(x)
        if x.op == "max" and is_tiny(x.args[0]) and x.args[1].span.low >= 0:
            x = x.args[1]
        return self.node("inverse_root", (x,))

    def power(self, x: Any, y: Any) -> Any:
        """``x`` to the power of ``y``; ``x`` is not negative."""
        x, y = self.term(x), self.term(y)
        exponent = value_of(y)
        if exponent == Fraction(1, 2):
            return self.root(x)
        if exponent is not None and exponent.denominator == 1 and 0 < exponent <= LARGEST_POWER:
            return self._product([x] * int(exponent))
        return self.node("power", (x, y))

    def _product(self, factors: list[Term]) -> Any:
        """The product of equal factors by squaring."""
        count, base, found = len(factors), factors[0], None
        while count:
            if count & 1:
                found = base if found is None else self.mul(found, base)
            count >>= 1
            if count:
                base = self.mul(base, base)
        return found

    def step(self, op: str, x: Any) -> Any:
        """``floor``, ``rint`` or ``trunc``: whole numbers are what they are."""
        x = self.term(x)
        if x.kind == "i" or x.op in ("float", "floor", "rint", "trunc"):
            return x
        value = value_of(x)
        if value is not None:
            return self.node("constant", (), (Fraction(_STEPS[op](value)), "f"))
        low, high = spans.stepped(op, x.span)
        if low == high:
            return self.node("constant", (), (Fraction(low), "f"))
        return self.node(op, (x,))

    def function(self, op: str, *args: Any) -> Any:
        """An operation of which little more is known than its value."""
        terms = tuple(map(self.term, args))
        factor, _ = factor_of(terms[0])
        if factor < 0 and op in _ODD:
            return self.negative(self.function(op, self.negative(terms[0])))
        if factor < 0 and op in _EVEN:
            return self.function(op, self.negative(terms[0]))
        return self.node(op, terms)

    def exponential(self, x: Any) -> Any:
        """A power of two."""
        x = self.term(x)
        value = value_of(x)
        if value is not None and value.denominator == 1 and abs(value) <= LARGEST_EXPONENT:
            return self.node("constant", (), (Fraction(2) ** int(value), "f"))
        return self.node("exp2", (x,))

    def as_float(self, x: Any) -> Any:
        """A whole number as a float."""
        x = self.term(x)
        value = value_of(x)
        if value is not None:
            return self.node("constant", (), (value, "f"))
        return x if x.kind == "f" else self.node("float", (x,))

    def as_whole(self, x: Any) -> Any:
        """A number truncated to a whole one."""
        x = self.term(x)
        if x.kind == "i":
            return x
        value = value_of(x)
        if value is not None:
            return self.node("constant", (), (Fraction(int(value)), "i"))
        return x.args[0] if x.op == "float" and x.args[0].kind == "i" else self.node("int", (x,))

    # --- whole numbers ----------------------------------------------------------------------------

    def whole(self, op: str, x: Any, y: Any) -> Any:
        """An operation on whole numbers."""
        x, y = self.term(x), self.term(y)
        a, b = value_of(x), value_of(y)
        if a is not None and b is not None:
            return self.node("constant", (), (Fraction(spans.WHOLE[op](int(a), int(b))), "i"))
        return self.node(op, (x, y))

    def bits_and(self, x: Any, y: Any) -> Any:
        """The bits of both; a number that a mask contains stays as it is."""
        x, y = ordered(self.term(x), self.term(y))
        mask = value_of(x)
        if mask is not None and value_of(y) is None:
            is_mask = mask >= 0 and int(mask) & (int(mask) + 1) == 0
            if is_mask and y.span.low >= 0 and y.span.high <= mask:
                return y
        return self.whole("bit_and", x, y)


_SIMPLIFIED = {
    "add": "add", "mul": "mul", "reciprocal": "reciprocal", "abs": "absolute", "min": "least",
    "max": "greatest", "sqrt": "root", "inverse_root": "inverse_root", "power": "power",
    "less": "less", "equal": "equal", "not": "opposite", "and": "both", "where": "where",
    "bit_and": "bits_and", "exp2": "exponential", "inverse": "inverse",
    "float": "as_float", "int": "as_whole",
}  # fmt: skip
"""The methods that make operations in a simple form."""


def ordered(x: Term, y: Term) -> tuple[Term, Term]:
    """Two operands in one order, a constant first."""
    if (y.op == "constant", -y.id) > (x.op == "constant", -x.id):
        return y, x
    return x, y


def factor_of(x: Term) -> tuple[Fraction, Term]:
    """The constant factor of a product, and the rest."""
    if x.op == "mul" and (value := value_of(x.args[0])) is not None:
        return value, x.args[1]
    return Fraction(1), x


def is_tiny(x: Term) -> bool:
    """True for the number below which a device may treat one as zero."""
    return value_of(x) == TINY
