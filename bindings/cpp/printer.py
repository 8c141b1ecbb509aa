"""Prints the code of derived values as C++17."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar

from ...compiler.tracing import Expression, Kind
from ..c_family.printer import CFamilyPrinter, conversions, forms
from ..fields import Numbers
from ..forms import WHOLE, Form


def _cast(type_: str, text: str) -> str:
    std = "std::" if type_.endswith("_t") else ""
    return f"static_cast<{std}{type_}>({text})"


class CppPrinter(CFamilyPrinter):
    """Prints C++."""

    TYPES: ClassVar[Mapping[str, str]] = {"float": "double", "int": "std::int64_t", "bool": "bool"}
    STORED: ClassVar[Mapping[str, str]] = {"float": "float", "int": "int32_t", "uint": "uint32_t"}
    FORMS: ClassVar[Mapping[str, Form]] = {
        **forms("std::", "", _cast, WHOLE),
        "abs": Form("std::abs({0})"),
    }
    CONVERSIONS: ClassVar[Mapping[tuple[Kind, Kind], Form]] = conversions("", _cast, WHOLE)
    OF_KIND: ClassVar[Mapping[tuple[str, Kind], Form]] = {
        ("minimum", "float"): Form("std::min<double>({0}, {1})"),
        ("maximum", "float"): Form("std::max<double>({0}, {1})"),
        ("minimum", "int"): Form("std::min<std::int64_t>({0}, {1})"),
        ("maximum", "int"): Form("std::max<std::int64_t>({0}, {1})"),
    }

    def cast(self, type_: str, text: str) -> str:
        """The conversion of a text to a type."""
        return _cast(type_, text)

    def lesser(self, count: Expression, bound: int) -> str:
        """The number of terms of a fold."""
        return f"std::min<std::int64_t>({self.text(count, kind='int')}, {bound})"

    def read(self, place: str, each: Expression) -> str:
        """The number at a place; where it is a uint, it stands for a bool.

        Floats are made doubles here, as C++ computes with floats otherwise.
        """
        if each.kind == "bool":
            return f"({place} != 0)"
        if each.value.is_choice:
            return self.cast("int64_t", place)
        return f"{self.TYPES[each.kind]}{{{place}}}"

    def part(self, place: str, part: tuple[int, ...]) -> str:
        """A lane of a vector, or of a column."""
        *columns, lane = part
        return place + "".join(f"[{column}]" for column in columns) + f".{'xyzw'[lane]}"

    def stored(self, place: str, lanes: list[str], kind: Numbers) -> Iterator[str]:
        """The statement that stores a number, a vector or a column."""
        if len(lanes) == 1:
            yield f"{place} = {lanes[0]};"
            return
        zero = "0.0f" if kind.kind == "float" else "0"
        missing = kind.stored_lanes - len(lanes)
        yield f"{place} = {{{', '.join([*lanes, *[zero] * missing])}}};"
