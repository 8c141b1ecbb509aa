"""Random types and values, and the pixels in which a shader shows a value.

``layouts.py`` makes programs of them. A float32 can represent all whole numbers among the values,
which still use all of their bytes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from random import Random
from typing import Any

from burnish.compiler.ir.types import (
    MATRICES,
    Array,
    Matrix,
    Scalar,
    ScalarKind,
    Struct,
    Type,
    Vector,
)

from ..layout.declarations import ELEMENTS, KINDS

Value = Any
"""A value in the form that ``Instance.set`` takes."""
Numbers = tuple[float, ...]

PLAIN: Sequence[Type] = [
    *map(Scalar, KINDS),
    *(Vector(kind, size) for kind in KINDS for size in (2, 3, 4)),
    *MATRICES,
]
SHORTEST, LONGEST = 1, 4
"""The number of elements of an array and of members of a structure."""


@dataclass(frozen=True, slots=True)
class Unit:
    """The contents of one pixel: a scalar, a vector or a column, padded with zeros."""

    name: str
    """The expression that it shows, such as ``p2[3].m1[0]``."""
    lanes: Numbers


class Declarations:
    """Chooses random types, and collects the structures among them."""

    def __init__(self, chance: Random) -> None:
        self._chance = chance
        self.structs: list[Struct] = []

    def type(self, depth: int = 2) -> Type:
        """A random type in which arrays and structures are nested at most ``depth`` deep."""
        drawn = self._chance.random()
        if not depth or drawn < 0.4:
            return self._chance.choice(PLAIN)
        if drawn < 0.6:
            return self._array(self._chance.choice(ELEMENTS))
        struct = self._struct(depth)
        return struct if drawn < 0.8 else self._array(struct)

    def _array(self, element: Type) -> Type:
        return Array(element, self._chance.randint(SHORTEST, LONGEST))

    def _struct(self, depth: int) -> Struct:
        count = self._chance.randint(SHORTEST, LONGEST)
        members = tuple((f"m{i}", self.type(depth - 1)) for i in range(count))
        made = Struct(f"Part{len(self.structs)}", members)
        self.structs.append(made)
        return made


def value_of(chance: Random, type_: Type) -> Value:
    """A random value of a declared type."""
    match type_:
        case Scalar(kind):
            return _scalar(chance, kind)
        case Vector(kind, size):
            return [_scalar(chance, kind) for _ in range(size)]
        case Matrix(columns):
            return [value_of(chance, type_.column) for _ in range(columns)]
        case Array(element, count):
            return [value_of(chance, element) for _ in range(count)]
        case Struct(members=members):
            return {name: value_of(chance, member) for name, member in members}
        case _:
            raise TypeError(type_)


def _scalar(chance: Random, kind: ScalarKind) -> Value:
    """A random number. Floats need rounding; integers have 24 significant bits, followed by
    zeros."""
    match kind:
        case "bool":
            return chance.random() < 0.5
        case "float":
            return math.ldexp(chance.uniform(-1, 1), chance.randint(-20, 30))
        case "int":
            return chance.randint(-(2**24), 2**24 - 1) << chance.randint(0, 7)
        case "uint":
            return chance.randint(0, 2**24 - 1) << chance.randint(0, 8)


def units_of(name: str, type_: Type, value: Value) -> Iterator[Unit]:
    """The pixels that show a value, in order."""
    match type_:
        case Scalar():
            yield Unit(name, (value,))
        case Vector():
            yield Unit(name, tuple(value))
        case Matrix(columns):
            yield from (Unit(f"{name}[{i}]", tuple(value[i])) for i in range(columns))
        case Array(element, count):
            for i in range(count):
                yield from units_of(f"{name}[{i}]", element, value[i])
        case Struct(members=members):
            for member, inner in members:
                yield from units_of(f"{name}.{member}", inner, value[member])
        case _:
            raise TypeError(type_)


def size_of(type_: Type) -> int:
    """The number of pixels that show a value of a type."""
    match type_:
        case Matrix(columns):
            return columns
        case Array(element, count):
            return count * size_of(element)
        case Struct(members=members):
            return sum(size_of(member) for _, member in members)
        case _:
            return 1


Naming = Callable[[str], str]
"""Gives an expression that is used several times a short name."""


def reading(type_: Type, place: str, number: str, named: Naming) -> str:
    """An expression for the pixel whose number is the expression ``number``, of the value at
    ``place``."""
    match type_:
        case Scalar(kind):
            return f"vec4({place if kind == 'float' else f'float({place})'}, 0, 0, 0)"
        case Vector(kind, size):
            floats = place if kind == "float" else f"vec{size}({place})"
            return f"vec4({', '.join([floats, *'0' * (4 - size)])})"
        case Matrix(rows=rows):
            return f"vec4({', '.join([f'{place}[{number}]', *'0' * (4 - rows)])})"
        case Array(element):
            each = size_of(element)
            if each == 1:
                return reading(element, f"{place}[{number}]", number, named)
            at = named(f"{number} / {each}")
            return reading(element, f"{place}[{at}]", named(f"{number} mod {each}"), named)
        case Struct(members=members):
            parts = [(inner, f"{place}.{member}") for member, inner in members]
            return choice(parts, number, named)
        case _:
            raise TypeError(type_)


def choice(parts: Sequence[tuple[Type, str]], number: str, named: Naming) -> str:
    """An expression for the pixel with this number, of several values one after the other."""
    (type_, place), *others = parts
    first = reading(type_, place, number, named)
    if not others:
        return first
    size = size_of(type_)
    further = choice(others, named(f"{number} - {size}"), named)
    return f"(if {number} < {size} then {first} else {further})"
