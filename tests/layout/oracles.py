"""Three calculators of member offsets, each written from its own specification.

Each takes stored members in order and returns where it would put them by itself, knowing nothing
of the others: a layout is valid everywhere when all three agree with it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from burnish.compiler.ir.types import (
    Array,
    Matrix,
    Scalar,
    Struct,
    Type,
    Vector,
)

Offsets = dict[str, int]
"""Bytes by path: ``a.b`` counts from the start, ``a[]`` is a stride."""


def up(offset: int, alignment: int) -> int:
    """``offset`` rounded up."""
    return -(-offset // alignment) * alignment


@dataclass(frozen=True)
class Rules:
    """One specification: how far a type reaches and where the next of its kind may start."""

    align: Callable[[Type], int]
    size: Callable[[Type], int]
    stride: Callable[[Type], int]
    """The distance from one element of an array to the next, given the element's type."""
    start: Callable[[int, Type], int]
    """The offset of a member that follows on byte ``end``, given the member's type."""

    def offsets(self, members: Sequence[tuple[str, Type]], base: int = 0) -> Offsets:
        """All members of a block or struct, by path."""
        found: Offsets = {}
        for name, offset, type_ in walk(members, self):
            found[name] = base + offset
            inner = type_
            path = name
            if isinstance(inner, Array):
                path = f"{name}[]"
                inner = inner.element
                found[path] = self.stride(inner)
            if isinstance(inner, Struct):
                nested = self.offsets(inner.members, base + offset)
                found |= {f"{path}.{inside}": at for inside, at in nested.items()}
        return found


def walk(members: Sequence[tuple[str, Type]], rules: Rules) -> list[tuple[str, int, Type]]:
    """Members with their offsets within one struct."""
    end = 0
    rows = []
    for name, type_ in members:
        offset = rules.start(end, type_)
        rows.append((name, offset, type_))
        end = offset + rules.size(type_)
    return rows


def end_of(members: Sequence[tuple[str, Type]], rules: Rules) -> int:
    """The first byte after the last member."""
    rows = walk(members, rules)
    return rows[-1][1] + rules.size(rows[-1][2]) if rows else 0


# OpenGL 4.6 core, 7.6.2.2, rules 1 to 10.


def _std140_align(type_: Type) -> int:
    match type_:
        case Scalar():
            return 4
        case Vector(size=2):
            return 8
        case Vector() | Matrix() | Array():
            return 16
        case Struct(members=members):
            return up(max(_std140_align(member) for _, member in members), 16)
        case _:
            raise TypeError(type_)


def _std140_size(type_: Type) -> int:
    match type_:
        case Scalar():
            return 4
        case Vector(size=size):
            return 4 * size
        case Matrix(columns):
            return 16 * columns
        case Array(element, count):
            return count * _std140_stride(element)
        case Struct(members=members):
            return up(end_of(members, STD140), _std140_align(type_))
        case _:
            raise TypeError(type_)


def _std140_stride(element: Type) -> int:
    return up(_std140_size(element), 16)


STD140 = Rules(
    _std140_align,
    _std140_size,
    _std140_stride,
    lambda end, type_: up(end, _std140_align(type_)),
)

# Microsoft, "Packing Rules for Constant Variables": variables are packed into rows of 16 bytes and
# may not cross one; arrays, structs and matrices start a row; what follows them does not.


def _d3d_size(type_: Type) -> int:
    match type_:
        case Scalar():
            return 4
        case Vector(size=size):
            return 4 * size
        case Matrix(columns, rows):
            return 16 * (columns - 1) + 4 * rows
        case Array(element, count):
            return _d3d_stride(element) * (count - 1) + _d3d_size(element)
        case Struct(members=members):
            return end_of(members, D3D)
        case _:
            raise TypeError(type_)


def _d3d_stride(element: Type) -> int:
    return up(_d3d_size(element), 16)


def _d3d_start(end: int, type_: Type) -> int:
    crosses = end % 16 + _d3d_size(type_) > 16
    aggregate = isinstance(type_, Array | Struct | Matrix)
    return up(end, 16) if crosses or aggregate else end


D3D = Rules(lambda _type: 4, _d3d_size, _d3d_stride, _d3d_start)

# WGSL, "Alignment and Size".


def _wgsl_align(type_: Type) -> int:
    match type_:
        case Scalar():
            return 4
        case Vector(size=size) | Matrix(rows=size):
            return 8 if size == 2 else 16
        case Array(element=element):
            return _wgsl_align(element)
        case Struct(members=members):
            return max(_wgsl_align(member) for _, member in members)
        case _:
            raise TypeError(type_)


def _wgsl_size(type_: Type) -> int:
    match type_:
        case Scalar():
            return 4
        case Vector(size=size):
            return 4 * size
        case Matrix(columns, rows):
            return columns * up(4 * rows, _wgsl_align(type_))
        case Array(element, count):
            return count * _wgsl_stride(element)
        case Struct(members=members):
            return up(end_of(members, WGSL), _wgsl_align(type_))
        case _:
            raise TypeError(type_)


def _wgsl_stride(element: Type) -> int:
    return up(_wgsl_size(element), _wgsl_align(element))


WGSL = Rules(_wgsl_align, _wgsl_size, _wgsl_stride, lambda end, type_: up(end, _wgsl_align(type_)))


def wgsl_uniform_violations(members: Sequence[tuple[str, Type]]) -> list[str]:
    """Breaches of WGSL's "Address Space Layout Constraints" for uniforms, without extensions."""
    found = []
    free = 0
    for name, offset, type_ in walk(members, WGSL):
        if offset < free:
            found.append(f"{name} starts within 16 bytes of the struct before it")
        inner = type_
        if isinstance(inner, Array):
            inner = inner.element
            if _wgsl_stride(inner) % 16:
                found.append(f"elements of {name} are {_wgsl_stride(inner)} bytes apart")
        if isinstance(type_, Array | Struct) and offset % 16:
            found.append(f"{name} starts at {offset}")
        if isinstance(inner, Struct):
            found += wgsl_uniform_violations(inner.members)
        if isinstance(type_, Struct):
            free = offset + up(_wgsl_size(type_), 16)
    return found
