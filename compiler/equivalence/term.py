"""One term: a number, a whole number or a condition that a program computes.

``terms.py`` makes them. The reference computes with them as with numbers, by their operators.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any

from . import spans
from .spans import Span


class Maker(ABC):
    """Makes the terms of operators: ``terms.Terms``."""

    @abstractmethod
    def add(self, x: Any, y: Any) -> Any:
        """The sum of two lanes."""

    @abstractmethod
    def mul(self, x: Any, y: Any) -> Any:
        """The product of two lanes."""

    @abstractmethod
    def divide(self, x: Any, y: Any) -> Any:
        """A quotient; its divisor is never zero."""

    @abstractmethod
    def negative(self, x: Any) -> Any:
        """The number with the other sign."""

    @abstractmethod
    def absolute(self, x: Any) -> Any:
        """The magnitude."""

    @abstractmethod
    def whole(self, op: str, x: Any, y: Any) -> Any:
        """An operation on whole numbers."""

    @abstractmethod
    def bits_and(self, x: Any, y: Any) -> Any:
        """The bits of both."""

    @abstractmethod
    def less(self, x: Any, y: Any) -> Any:
        """True where the first number is below the second one."""

    @abstractmethod
    def equal(self, x: Any, y: Any) -> Any:
        """True where both are equal."""

    @abstractmethod
    def opposite(self, x: Any) -> Any:
        """True where a condition does not hold."""

    @abstractmethod
    def at_neighbour(self, term: Term, axis: int, index: int) -> Term:
        """The value at a pixel of the quad."""


class Term:
    """One number, whole number or condition; a lane of the reference's evaluation."""

    __slots__ = ("args", "data", "id", "is_varying", "kind", "op", "span", "terms")
    __hash__ = None  # type: ignore[assignment]
    is_exact = False
    """No condition is decided while terms are made, unless it is a plain ``bool``."""
    shape = (2, 2)
    """The shape of a quad of pixels: derivatives are differences of neighbours."""

    def __init__(
        self, terms: Maker, op: str, args: tuple[Term, ...], data: Any, id_: int, span: Span
    ) -> None:
        self.terms, self.op, self.args, self.data = terms, op, args, data
        self.id, self.span = id_, span
        self.kind = spans.kind_of(op, args, data)
        """``f`` for floats, ``i`` for whole numbers, ``b`` for conditions."""
        self.is_varying: bool = any(arg.is_varying for arg in args)
        """True if it may differ between the pixels of a triangle."""
        if op in ("variable", "element"):
            self.is_varying = op == "element" or data.is_varying
        if op == "read":
            self.is_varying = True

    def __repr__(self) -> str:
        inner = ", ".join(f"%{arg.id}" for arg in self.args)
        return f"%{self.id} = {self.op} {self.data if self.data is not None else ''}({inner})"

    def any(self) -> bool:
        """A condition may hold for some points."""
        return True

    def take(self, indices: Sequence[int], axis: int) -> Term:
        """The value at a neighbour in the quad of pixels."""
        return self.terms.at_neighbour(self, axis, indices[0])

    def repeat(self, _times: int, _axis: int) -> Term:
        """The same value at both pixels of a row or column."""
        return self

    def __add__(self, other: Any) -> Any:
        return self.terms.add(self, other)

    def __sub__(self, other: Any) -> Any:
        return self.terms.add(self, self.terms.negative(other))

    def __mul__(self, other: Any) -> Any:
        return self.terms.mul(self, other)

    def __truediv__(self, other: Any) -> Any:
        return self.terms.divide(self, other)

    def __neg__(self) -> Any:
        return self.terms.negative(self)

    def __abs__(self) -> Any:
        return self.terms.absolute(self)

    def __radd__(self, other: Any) -> Any:
        return self.terms.add(other, self)

    def __rsub__(self, other: Any) -> Any:
        return self.terms.add(other, self.terms.negative(self))

    def __rmul__(self, other: Any) -> Any:
        return self.terms.mul(other, self)

    def __lt__(self, other: Any) -> Any:
        return self.terms.less(self, other)

    def __gt__(self, other: Any) -> Any:
        return self.terms.less(other, self)

    def __le__(self, other: Any) -> Any:
        return self.terms.opposite(self.terms.less(other, self))

    def __ge__(self, other: Any) -> Any:
        return self.terms.opposite(self.terms.less(self, other))

    def __eq__(self, other: Any) -> Any:
        return self.terms.equal(self, other)

    def __ne__(self, other: Any) -> Any:
        return self.terms.opposite(self.terms.equal(self, other))

    # --- whole numbers ----------------------------------------------------------------------------

    def __and__(self, other: Any) -> Any:
        return self.terms.bits_and(self, other)

    def __or__(self, other: Any) -> Any:
        return self.terms.whole("bit_or", self, other)

    def __xor__(self, other: Any) -> Any:
        return self.terms.whole("bit_xor", self, other)

    def __lshift__(self, other: Any) -> Any:
        return self.terms.whole("shift_left", self, other)

    def __rshift__(self, other: Any) -> Any:
        return self.terms.whole("shift_right", self, other)

    def __floordiv__(self, other: Any) -> Any:
        return self.terms.whole("quotient", self, other)

    def __mod__(self, other: Any) -> Any:
        return self.terms.whole("remainder", self, other)

    def __invert__(self) -> Any:
        return self.terms.add(-1, self.terms.negative(self))

    def __rand__(self, other: Any) -> Any:
        return self.terms.bits_and(self, other)

    def __ror__(self, other: Any) -> Any:
        return self.terms.whole("bit_or", other, self)

    def __rxor__(self, other: Any) -> Any:
        return self.terms.whole("bit_xor", other, self)

    def __rlshift__(self, other: Any) -> Any:
        return self.terms.whole("shift_left", other, self)

    def __rrshift__(self, other: Any) -> Any:
        return self.terms.whole("shift_right", other, self)

    def __rfloordiv__(self, other: Any) -> Any:
        return self.terms.whole("quotient", other, self)


def below(roots: Iterable[Term], known: Any = ()) -> list[Term]:
    """All terms that ``roots`` need, and that are not known, arguments before users."""
    pending = [root for root in roots if root.id not in known]
    seen = {term.id: term for term in pending}
    while pending:
        for arg in pending.pop().args:
            if arg.id not in seen and arg.id not in known:
                seen[arg.id] = arg
                pending.append(arg)
    return [seen[id_] for id_ in sorted(seen)]


def value_of(term: Term) -> Fraction | None:
    """The number that a constant is; ``None`` for any other term."""
    if term.op != "constant":
        return None
    value: Fraction = term.data[0]
    return value


def plain(condition: Term) -> Any:
    """A condition as the methods of ``Terms`` take it: a plain ``bool`` if it is known."""
    value = value_of(condition)
    return condition if value is None else bool(value)
