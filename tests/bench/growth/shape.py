"""Shapes of programs: a generator of sources by size, and the largest size of each."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

Sources = str | Mapping[str, str]
"""The text of a file, or the texts of several by name, of which ``MAIN`` is compiled."""

MAIN = "main.burnish"


@dataclass(frozen=True, slots=True)
class Shape:
    """One way in which a program can be large."""

    name: str
    make: Callable[[int], Sources]
    first: int
    """The smallest size that is tried; each of the following is twice the one before."""
    last: int
    """No size above this is tried."""
    says: str = ""
    """Code of the error that the program is meant to have; empty if it has to compile.

    Any other error means that the compiler refuses this size."""

    def sizes(self) -> Iterator[int]:
        """The sizes to try, in ascending order."""
        size = self.first
        while size <= self.last:
            yield size
            size *= 2

    def files(self, size: int) -> Mapping[str, str]:
        """The files of the program with this size, by name."""
        made = self.make(size)
        return {MAIN: made} if isinstance(made, str) else made


SHAPES: dict[str, Shape] = {}
"""Every shape by its name, in the order in which they are declared and measured."""


def shape(
    first: int, last: int, says: str = ""
) -> Callable[[Callable[[int], Sources]], Callable[[int], Sources]]:
    """Declare the function below as a shape, under its own name."""

    def declare(make: Callable[[int], Sources]) -> Callable[[int], Sources]:
        name = make.__name__.replace("_", " ")
        SHAPES[name] = Shape(name, make, first, last, says)
        return make

    return declare


def material(body: str) -> str:
    """A material with these members."""
    return f"material Long {{\n{body}\n}}\n"


def lines(parts: Iterable[str]) -> str:
    """Parts, each on a line of its own."""
    return "\n".join(parts)
