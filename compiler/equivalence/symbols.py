"""The array library whose lanes are terms: the reference then evaluates programs to terms.

Its functions have NumPy's names, as ``namespace.Namespace`` asks. Here the many functions of
NumPy become the few operations of terms: a sine of a sum is one, a quotient is none.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from ..reference.namespace import Lane, OwnFunctions
from .terms import Terms

_LOG2_E = math.log2(math.e)
_LN_2 = math.log(2.0)


class Symbols(OwnFunctions):
    """An array library of terms."""

    def __init__(self, terms: Terms) -> None:
        self._terms = terms

    # --- choices ----------------------------------------------------------------------------------

    def where(self, condition: Any, x: Any, y: Any, /) -> Any:
        """``x`` where the condition holds, else ``y``."""
        return self._terms.where(condition, x, y)

    def logical_and(self, x: Any, y: Any, /) -> Any:
        """True where both conditions hold."""
        return self._terms.both(x, y)

    def logical_or(self, x: Any, y: Any, /) -> Any:
        """True where at least one condition holds."""
        return self._terms.either(x, y)

    def logical_not(self, x: Any, /) -> Any:
        """True where the condition does not hold."""
        return self._terms.opposite(x)

    def minimum(self, x: Any, y: Any, /) -> Any:
        """The lesser number."""
        return self._terms.least(x, y)

    def maximum(self, x: Any, y: Any, /) -> Any:
        """The greater number."""
        return self._terms.greatest(x, y)

    # --- arithmetic -------------------------------------------------------------------------------

    def mix(self, x: Lane, y: Lane, a: Lane, /) -> Lane:
        """A linear blend."""
        terms = self._terms
        return terms.add(terms.mul(x, terms.add(1.0, terms.negative(a))), terms.mul(y, a))

    def divide(self, x: Any, y: Any, /) -> Any:
        """A quotient; definitions never divide by zero."""
        return self._terms.divide(x, y)

    def remainder(self, x: Any, y: Any, /) -> Any:
        """The remainder of the quotient rounded down."""
        terms = self._terms
        return terms.add(x, terms.negative(terms.mul(y, self.floor(terms.divide(x, y)))))

    def sqrt(self, x: Any, /) -> Any:
        """The root of what is not negative."""
        return self._terms.root(x)

    def inversesqrt(self, x: Lane, /) -> Lane:
        """The reciprocal of the root."""
        return self._terms.inverse_root(x)

    def power(self, x: Any, y: Any, /) -> Any:
        """A power of what is not negative."""
        return self._terms.power(x, y)

    def exp(self, x: Any, /) -> Any:
        """A power of e, as one of two."""
        return self.exp2(self._terms.mul(_LOG2_E, x))

    def exp2(self, x: Any, /) -> Any:
        """A power of two."""
        return self._terms.exponential(x)

    def log(self, x: Any, /) -> Any:
        """The natural logarithm, by that to the base of two."""
        return self._terms.mul(_LN_2, self.log2(x))

    def log2(self, x: Any, /) -> Any:
        """The logarithm to the base of two."""
        return self._terms.function("log2", x)

    # --- steps and conversions --------------------------------------------------------------------

    def fract(self, x: Lane, /) -> Lane:
        """The part above the floor."""
        return self._terms.add(x, self._terms.negative(self.floor(x)))

    def floor(self, x: Any, /) -> Any:
        """The next whole number below."""
        return self._terms.step("floor", x)

    def ceil(self, x: Any, /) -> Any:
        """The next whole number above."""
        return self._terms.negative(self.floor(self._terms.negative(x)))

    def rint(self, x: Any, /) -> Any:
        """The nearest whole number."""
        return self._terms.step("rint", x)

    def trunc(self, x: Any, /) -> Any:
        """The next whole number towards zero."""
        return self._terms.step("trunc", x)

    def float64(self, x: Any, /) -> Any:
        """A whole number as a float."""
        return self._terms.as_float(x)

    def int64(self, x: Any, /) -> Any:
        """A number truncated to a whole one."""
        return self._terms.as_whole(x)

    def rising(self, function: Callable[[Any, Lane], Lane], x: Lane, /) -> Lane:
        """A function that never falls: what it does."""
        return function(self, x)

    def frexp(self, x: Any, /) -> Any:
        """The fraction and the exponent."""
        return self._terms.function("mantissa", x), self._terms.function("exponent", x)

    def ldexp(self, x: Any, n: Any, /) -> Any:
        """``x`` times two to the power of ``n``."""
        return self._terms.mul(x, self.exp2(self._terms.as_float(n)))

    # --- angles and hyperbolic functions ----------------------------------------------------------

    def tan(self, x: Any, /) -> Any:
        """The tangent, as a quotient."""
        return self._terms.divide(self.sin(x), self.cos(x))

    def arccos(self, x: Any, /) -> Any:
        """The angle of a cosine, as what is left of that of a sine."""
        return self._terms.add(math.pi / 2, self._terms.negative(self.arcsin(x)))

    def arctan2(self, y: Any, x: Any, /) -> Any:
        """The angle of a point."""
        return self._terms.function("arctan2", y, x)

    def sinh(self, x: Any, /) -> Any:
        """Half the difference of two exponentials."""
        terms, negative = self._terms, self._terms.negative(x)
        return terms.mul(0.5, terms.add(self.exp(x), terms.negative(self.exp(negative))))

    def cosh(self, x: Any, /) -> Any:
        """Half the sum of two exponentials."""
        terms = self._terms
        return terms.mul(0.5, terms.add(self.exp(x), self.exp(terms.negative(x))))

    def sin(self, x: Any, /) -> Any:
        """The sine."""
        return self._terms.function("sin", x)

    def cos(self, x: Any, /) -> Any:
        """The cosine."""
        return self._terms.function("cos", x)

    def arcsin(self, x: Any, /) -> Any:
        """The angle of a sine."""
        return self._terms.function("arcsin", x)

    def arctan(self, x: Any, /) -> Any:
        """The angle of a tangent."""
        return self._terms.function("arctan", x)

    def tanh(self, x: Any, /) -> Any:
        """The hyperbolic tangent."""
        return self._terms.function("tanh", x)

    def arcsinh(self, x: Any, /) -> Any:
        """The inverse of the hyperbolic sine."""
        return self._terms.function("arcsinh", x)

    def arccosh(self, x: Any, /) -> Any:
        """The inverse of the hyperbolic cosine."""
        return self._terms.function("arccosh", x)

    def arctanh(self, x: Any, /) -> Any:
        """The inverse of the hyperbolic tangent."""
        return self._terms.function("arctanh", x)
