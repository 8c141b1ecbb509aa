"""The lanes of ``device.py``: arrays with the operators that definitions of builtins use.

Sums, products and quotients are left to the device, which chooses how they are rounded. All else is
exact.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any, Protocol

import numpy as np

Array = Any


class Arithmetic(Protocol):
    """The operations that a lane asks of its device."""

    def lane(self, value: Any) -> Chosen:
        """A lane as it is, or one of a constant."""
        ...

    def add(self, x: Any, y: Any) -> Chosen:
        """The sum of two lanes."""
        ...

    def multiply(self, x: Any, y: Any) -> Chosen:
        """The product of two lanes."""
        ...

    def divide(self, x: Any, y: Any, /) -> Chosen:
        """The quotient of two lanes."""
        ...


class Chosen:
    """One lane on a device: an array of float64 (mostly of float32 numbers), int64 or bool."""

    __slots__ = ("device", "factors", "product", "terms", "value")
    __array_ufunc__ = None
    __hash__ = None  # type: ignore[assignment]

    def __init__(
        self,
        device: Arithmetic,
        value: Array,
        terms: tuple[Array, ...] = (),
        factors: tuple[Array, ...] = (),
    ) -> None:
        self.device, self.value, self.terms, self.factors = (
            device,
            np.asarray(value),
            terms,
            factors,
        )

    @property
    def ndim(self) -> int:
        """The number of axes."""
        return self.value.ndim

    def __bool__(self) -> bool:
        return bool(self.value)

    def any(self) -> bool:
        """True if a condition holds anywhere."""
        return bool(self.value.any())

    def __add__(self, other: Any) -> Chosen:
        return self.device.add(self, other)

    def __sub__(self, other: Any) -> Chosen:
        if other is self:  # Every compiler knows what this is.
            return Chosen(self.device, np.zeros_like(self.value))
        return self.device.add(self, -self.device.lane(other))

    def __mul__(self, other: Any) -> Chosen:
        return self.device.multiply(self, other)

    def __truediv__(self, divisor: float) -> Chosen:
        return self.device.divide(self, divisor)

    def __neg__(self) -> Chosen:
        terms = tuple(-term for term in self.terms)
        factors = (-self.factors[0], *self.factors[1:]) if self.factors else ()
        return Chosen(self.device, -self.value, terms, factors)

    def __abs__(self) -> Chosen:
        return Chosen(self.device, np.abs(self.value))

    __radd__ = __add__

    def __rsub__(self, other: Any) -> Chosen:
        return self.device.add(other, -self)

    __rmul__ = __mul__

    def _with(self, operation: Callable[[Array, Array], Array], other: Any) -> Chosen:
        return Chosen(self.device, operation(self.value, self.device.lane(other).value))

    def _from(self, operation: Callable[[Array, Array], Array], other: Any) -> Chosen:
        return Chosen(self.device, operation(self.device.lane(other).value, self.value))

    def __lt__(self, other: Any) -> Chosen:
        return self._with(operator.lt, other)

    def __le__(self, other: Any) -> Chosen:
        return self._with(operator.le, other)

    def __gt__(self, other: Any) -> Chosen:
        return self._with(operator.gt, other)

    def __ge__(self, other: Any) -> Chosen:
        return self._with(operator.ge, other)

    def __eq__(self, other: Any) -> Chosen:  # type: ignore[override]
        return self._with(operator.eq, other)

    def __ne__(self, other: Any) -> Chosen:  # type: ignore[override]
        return self._with(operator.ne, other)

    def __invert__(self) -> Chosen:
        return Chosen(self.device, ~self.value)

    def __and__(self, other: Any) -> Chosen:
        return self._with(operator.and_, other)

    def __or__(self, other: Any) -> Chosen:
        return self._with(operator.or_, other)

    def __xor__(self, other: Any) -> Chosen:
        return self._with(operator.xor, other)

    def __lshift__(self, other: Any) -> Chosen:
        return self._with(operator.lshift, other)

    def __rshift__(self, other: Any) -> Chosen:
        return self._with(operator.rshift, other)

    def __floordiv__(self, other: Any) -> Chosen:
        return self._with(operator.floordiv, other)

    def __mod__(self, other: Any) -> Chosen:
        return self._with(operator.mod, other)

    __rand__, __ror__, __rxor__ = __and__, __or__, __xor__

    def __rlshift__(self, other: Any) -> Chosen:
        return self._from(operator.lshift, other)

    def __rrshift__(self, other: Any) -> Chosen:
        return self._from(operator.rshift, other)

    def __rfloordiv__(self, other: Any) -> Chosen:
        return self._from(operator.floordiv, other)

    def __rmod__(self, other: Any) -> Chosen:
        return self._from(operator.mod, other)
