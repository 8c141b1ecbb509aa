"""Prints the code of derived values as C11."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, ClassVar

from ...compiler.tracing import Expression, Kind
from ..c_family.printer import CFamilyPrinter, conversions, forms
from ..fields import Numbers
from ..forms import UNARY, Form
from ..statements import Place

_SHARED = "burnish_"
"""What the functions begin with that all bindings share."""


def _cast(type_: str, text: str) -> str:
    return f"({type_}){text}"


class CPrinter(CFamilyPrinter):
    """Prints C. Blocks are read through pointers, and lanes are elements of arrays."""

    TYPES: ClassVar[Mapping[str, str]] = {"float": "double", "int": "int64_t", "bool": "bool"}
    STORED: ClassVar[Mapping[str, str]] = {"float": "float", "int": "int32_t", "uint": "uint32_t"}
    LEVEL: ClassVar[int] = UNARY
    FORMS: ClassVar[Mapping[str, Form]] = {
        **forms("", _SHARED, _cast, UNARY),
        "abs": Form("fabs({0})"),
    }
    CONVERSIONS: ClassVar[Mapping[tuple[Kind, Kind], Form]] = conversions(_SHARED, _cast, UNARY)
    OF_KIND: ClassVar[Mapping[tuple[str, Kind], Form]] = {
        ("abs", "int"): Form("llabs({0})"),
        ("minimum", "float"): Form("burnish_least({0}, {1})"),
        ("maximum", "float"): Form("burnish_largest({0}, {1})"),
        ("minimum", "int"): Form("burnish_least_whole({0}, {1})"),
        ("maximum", "int"): Form("burnish_largest_whole({0}, {1})"),
    }

    def cast(self, type_: str, text: str) -> str:
        """The conversion of a text to a type."""
        return _cast(type_, text)

    def lesser(self, count: Expression, bound: int) -> str:
        """The number of terms of a fold."""
        return f"burnish_least_whole({self.text(count, kind='int')}, {bound})"

    def place(self, place: Place, way: Iterable[Any]) -> str:
        """A field of a block, which is behind a pointer unless it is computed here."""
        text = super().place(place, way)
        return text if place.block == "derived" else text.replace(".", "->", 1)

    def read(self, place: str, each: Expression) -> str:
        """The number at a place; where it is a uint, it stands for a bool.

        Numbers are widened here, as C computes in the type that they are stored in otherwise.
        """
        if each.kind == "bool":
            return f"({place} != 0)"
        return f"({self.TYPES[each.kind]}){place}"

    def part(self, place: str, part: tuple[int, ...]) -> str:
        """A lane of a vector, or of a column."""
        return place + "".join(f"[{number}]" for number in part)

    def stored(self, place: str, lanes: list[str], kind: Numbers) -> Iterator[str]:
        """The statements that store a number, or each lane."""
        del kind
        if len(lanes) == 1:
            yield f"{place} = {lanes[0]};"
            return
        yield from (f"{place}[{number}] = {lane};" for number, lane in enumerate(lanes))
