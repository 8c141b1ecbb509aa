"""The array library that the reference is written for, as a protocol.

NumPy implements it for pictures, and ``scalars`` for plain Python numbers. The names and their
behaviour are NumPy's: no function raises, an undefined result is NaN, and overflow is infinite.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any, Protocol

Lane = Any
"""One lane: a Python number, or an array that holds this lane of many values."""

Lanes = tuple[Any, ...]
"""A value: the lanes of a vector, a single lane for a scalar, a tuple of columns for a matrix."""


class Unary(Protocol):
    """A function of one lane."""

    def __call__(self, x: Lane, /) -> Lane: ...


class Binary(Protocol):
    """A function of two lanes."""

    def __call__(self, x: Lane, y: Lane, /) -> Lane: ...


class Ternary(Protocol):
    """A function of three lanes."""

    def __call__(self, x: Lane, y: Lane, z: Lane, /) -> Lane: ...


class Namespace(Protocol):
    """The functions of an array library that the reference uses."""

    @property
    def where(self) -> Ternary: ...
    @property
    def float64(self) -> Unary: ...
    @property
    def int64(self) -> Unary: ...
    @property
    def logical_and(self) -> Binary: ...
    @property
    def logical_or(self) -> Binary: ...
    @property
    def logical_not(self) -> Unary: ...
    @property
    def minimum(self) -> Binary: ...
    @property
    def maximum(self) -> Binary: ...
    @property
    def divide(self) -> Binary: ...
    @property
    def remainder(self) -> Binary: ...
    @property
    def floor(self) -> Unary: ...
    @property
    def ceil(self) -> Unary: ...
    @property
    def rint(self) -> Unary: ...
    @property
    def trunc(self) -> Unary: ...
    @property
    def sqrt(self) -> Unary: ...
    @property
    def power(self) -> Binary: ...
    @property
    def exp(self) -> Unary: ...
    @property
    def exp2(self) -> Unary: ...
    @property
    def log(self) -> Unary: ...
    @property
    def log2(self) -> Unary: ...
    @property
    def sin(self) -> Unary: ...
    @property
    def cos(self) -> Unary: ...
    @property
    def tan(self) -> Unary: ...
    @property
    def arcsin(self) -> Unary: ...
    @property
    def arccos(self) -> Unary: ...
    @property
    def arctan(self) -> Unary: ...
    @property
    def arctan2(self) -> Binary: ...
    @property
    def sinh(self) -> Unary: ...
    @property
    def cosh(self) -> Unary: ...
    @property
    def tanh(self) -> Unary: ...
    @property
    def arcsinh(self) -> Unary: ...
    @property
    def arccosh(self) -> Unary: ...
    @property
    def arctanh(self) -> Unary: ...
    @property
    def frexp(self) -> Unary: ...
    @property
    def ldexp(self) -> Binary: ...


class WorkGroups(ABC):
    """The operations of an array library that join the values of a work group's invocations.

    ``in_groups.InGroups`` is such a library: its arrays have an element for each invocation of a
    kernel. In others there is one value and no group, so that nothing is joined.
    """

    @abstractmethod
    def all_joined(self, join: Binary, x: Lane) -> Lane:
        """The joined lanes of all invocations of a group, at each of them (a reduction)."""

    @abstractmethod
    def joined_through(self, join: Binary, x: Lane) -> Lane:
        """The joined lanes of the invocations up to each one, and its own (an inclusive scan)."""

    @abstractmethod
    def at_the_one_before(self, x: Lane, first: Lane) -> Lane:
        """The lane of the invocation before each one, and ``first`` at the first of a group."""


class OwnFunctions(ABC):
    """Functions that an array library computes in a way of its own, not by the definitions here.

    ``bounds.Bounds`` is such a library. The bounds of most builtins are those of their definitions,
    but of these a device's may be wider, as it may use another formula, or are known to be tighter.
    """

    @abstractmethod
    def fract(self, x: Lane, /) -> Lane:
        """The part above the floor."""

    @abstractmethod
    def mix(self, x: Lane, y: Lane, a: Lane, /) -> Lane:
        """A linear blend from ``x`` to ``y``."""

    @abstractmethod
    def inversesqrt(self, x: Lane, /) -> Lane:
        """The reciprocal of the square root of a positive number."""

    @abstractmethod
    def rising(self, function: Callable[[Any, Lane], Lane], x: Lane, /) -> Lane:
        """A function that never falls, of an array library and a lane."""


class Endings(ABC):
    """The states with which a loop ends, where rounding may decide in what turn that is."""

    @abstractmethod
    def decided(self, before: Lane, condition: Lane) -> Lane:
        """The condition of a turn, as far as it is decided."""

    @abstractmethod
    def goes_on(self, before: Lane, condition: Lane, states: list[Lanes]) -> Lane:
        """The condition by which the next states are chosen.

        ``before`` says which elements may have come to this turn with these states, and
        ``condition`` whether the loop goes on.
        """

    @abstractmethod
    def of(self, states: list[Lanes]) -> list[Lanes]:
        """The states behind the loop, from the last ones."""


class OpenLoops(ABC):
    """Array libraries whose conditions may hold or not, so that loops may have ended or not."""

    @abstractmethod
    def endings(self) -> Endings:
        """The endings of one loop."""


class Attempts(ABC):
    """The evaluations of one body, one for each combination of what its decisions may be."""

    @abstractmethod
    def begin(self, frame: object) -> None:
        """Begin the next evaluation, in a frame of its own."""

    @abstractmethod
    def end(self, value: Lanes) -> Lanes | None:
        """Take the value of the body; returns that of all evaluations, or ``None`` before the
        last one."""


class Decisions(ABC):
    """Array libraries that try both sides of decisions which rounding may tip."""

    @abstractmethod
    def at(self, node: Any, frame: object) -> None:
        """Called before an operation is computed, whose value is kept in this frame."""

    @abstractmethod
    def attempts(self) -> Attempts:
        """The evaluations of one body."""
