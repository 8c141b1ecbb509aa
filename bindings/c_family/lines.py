"""Lines about the members of structures that C and C++ have in common: what compilers check, and
what a host may have checked.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from ..describing import choices_text, range_text
from ..fields import Field, Numbers, Structure
from ..model import Material
from ..printer import single
from ..spelling import Spelling

_WIDTH = 100


class Lines:
    """Lines that need the names of the binding. A language has a subclass."""

    def __init__(self, spelling: Spelling) -> None:
        self._spelling = spelling

    def lane(self, place: str, number: int) -> str:
        """A lane of a vector."""
        raise NotImplementedError

    def has_length_one(self, place: str, lanes: int) -> str:
        """The condition that a vector has length one."""
        raise NotImplementedError

    def natural(self, place: str) -> str:
        """A member of an enumeration as a number without a sign."""
        raise NotImplementedError

    def roles(self, material: Material) -> list[tuple[str, str]]:
        """The fields that have a role, each as its role and its place among the blocks."""
        member = self._spelling.member
        return [
            (str(field.role), f"{member(block.plain_name)}.{member(field.word)}")
            for block in material.blocks
            for field in block.roles
        ]

    def returned(self, condition: str, message: str) -> str:
        """The statement that tells a sentence if a condition does not hold."""
        return f"if (!{condition}) return {string(message)};"

    def asserts(self, structure: Structure) -> Iterator[str]:
        """The assertions that the compiler checks: the size, and where each member lies."""
        name = self._spelling.type(structure.name)
        found = f"sizeof({name}) == {structure.size}"
        told = self.sentence(name)
        for field in structure.fields[1:]:
            next_ = f"offsetof({name}, {self._spelling.member(field.word)}) == {field.offset}"
            if len(found) + len(next_) > _WIDTH - len(f"static_assert( && {told});"):
                yield f"static_assert({found}{told});"
                found = next_
            else:
                found = f"{found} && {next_}"
        yield f"static_assert({found}{told});"

    def sentence(self, name: str) -> str:
        """What an assertion about a structure tells, behind its condition."""
        del name
        return ""

    def faults(self, structure: Structure, way: str = "", host: str = "") -> Iterator[str]:
        """The statements that look for values that are out of their ranges."""
        for field in structure.fields:
            place = f"{way}{self._spelling.member(field.word)}"
            yield from self._faults_of(field, place, f"{host}{field.name}", way)

    def _faults_of(self, field: Field, place: str, name: str, way: str) -> Iterator[str]:
        if not field.capacity:
            yield from self._faults_of_value(field, place, name)
            return
        last = str(field.capacity)
        if field.counter:  # Elements beyond the count are read by nobody.
            last = f"{way}{self._spelling.member(field.counter)}"
            told = f"`{name}` has room for {field.capacity} elements"
            yield self.returned(f"({last} <= {field.capacity})", told)
        inner = list(self._faults_of_value(field, f"{place}[i]", f"{name}[…]"))
        if inner:
            yield f"for (int i = 0; i < {last}; ++i) {{"
            yield from (f"    {line}" for line in inner)
            yield "}"

    def _faults_of_value(self, field: Field, place: str, name: str) -> Iterator[str]:
        type_ = field.type
        if isinstance(type_, Structure):
            yield from self.faults(type_, f"{place}.", f"{name}.")
            return
        if field.choices:
            last = len(field.choices) - 1
            inside = f"({self.natural(place)} <= {last}u)"
            yield self.returned(inside, f"`{name}` is one of {choices_text(field)}")
        elif field.range is not None and not type_.columns:
            shown = range_text(field.range)
            lanes = [self.lane(place, number) for number in range(type_.lanes)]
            for lane in lanes if len(lanes) > 1 else [place]:
                if inside := _inside(type_, lane, *field.range):
                    yield self.returned(f"({inside})", f"`{name}` is declared in {shown}")
        if field.is_unit:
            condition = self.has_length_one(place, type_.lanes)
            yield self.returned(condition, f"`{name}` has to be of length 1")


def _inside(type_: Numbers, lane: str, low: float, high: float) -> str:
    """The condition that a lane is in its range, without what its type says by itself."""
    least, most = _LIMITS.get(type_.kind, (None, None))
    parts = [
        f"{lane} >= {number(type_, low)}" if low != least else "",
        f"{lane} <= {number(type_, high)}" if high != most else "",
    ]
    return " && ".join(filter(None, parts))


_LIMITS = {"int": (-(2**31), 2**31 - 1), "uint": (0, 2**32 - 1)}
"""The least and the largest number of a type."""


def is_scalar(type_: Numbers | Structure) -> bool:
    """True for a number alone."""
    return isinstance(type_, Numbers) and type_.lanes == 1 and not type_.columns


def number(type_: Numbers, value: Any) -> str:
    """A number as it is stored."""
    if type_.kind == "float":
        return real(value)
    return f"{int(value)}u" if type_.kind == "uint" else str(int(value))


def real(value: float) -> str:
    """A float."""
    return f"{single(value)}f"


def string(value: str) -> str:
    """A text in quotes."""
    return json.dumps(value, ensure_ascii=False)
