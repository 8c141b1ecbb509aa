"""The operators of lanes that follow from a few others; ``bounded.py`` has these."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

from . import whole


class Operators(ABC):
    """The operators that Python falls back to, derived from a few others.

    They are those for a left operand that is no lane, the other comparisons, and those of whole
    numbers.
    """

    __slots__ = ()

    @abstractmethod
    def _lane(self, other: Any) -> Any:
        """Another operand as a lane."""

    @abstractmethod
    def _whole(self, operation: whole.Operation, other: Any) -> Any:
        """An operation on whole numbers."""

    # --- the other way round ----------------------------------------------------------------------

    def __radd__(self, other: Any) -> Any:
        return self._lane(other) + self

    def __rsub__(self, other: Any) -> Any:
        return self._lane(other) - self

    def __rmul__(self, other: Any) -> Any:
        return self._lane(other) * self

    def __gt__(self, other: Any) -> Any:
        return self._lane(other) < self

    def __ge__(self, other: Any) -> Any:
        return self._lane(other) <= self

    # --- whole numbers ----------------------------------------------------------------------------

    def __and__(self, other: Any) -> Any:
        return self._whole(whole.bit_and, other)

    def __or__(self, other: Any) -> Any:
        return self._whole(whole.bit_or, other)

    def __xor__(self, other: Any) -> Any:
        return self._whole(whole.bit_xor, other)

    def __lshift__(self, other: Any) -> Any:
        return self._whole(whole.shifted_left, other)

    def __rshift__(self, other: Any) -> Any:
        return self._whole(whole.shifted_right, other)

    def __floordiv__(self, other: Any) -> Any:
        return self._whole(whole.quotient, other)

    def __mod__(self, other: Any) -> Any:
        return self._whole(whole.remainder, other)

    def __rand__(self, other: Any) -> Any:
        return self._lane(other) & self

    def __ror__(self, other: Any) -> Any:
        return self._lane(other) | self

    def __rxor__(self, other: Any) -> Any:
        return self._lane(other) ^ self

    def __rlshift__(self, other: Any) -> Any:
        return self._lane(other) << self

    def __rrshift__(self, other: Any) -> Any:
        return self._lane(other) >> self

    def __rfloordiv__(self, other: Any) -> Any:
        return self._lane(other) // self

    def __rmod__(self, other: Any) -> Any:
        return self._lane(other) % self
