"""Prints the code of derived values as Python.

Functions of ``math`` raise where others return infinity or NaN, so the skeleton has those that do
not. Its integers have no largest one.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import ClassVar

from ...compiler.tracing import Expression, Kind
from ..fields import Field
from ..forms import CHOICE, PRODUCT, SUM, UNARY, WHOLE, Form, calls, infix, prefix
from ..printer import Printer, power_of_two
from ..statements import Set

_OR, _AND, _NOT, _ORDER, _BITS = 10, 15, 18, 20, 30


def _safe(names: Mapping[str, str]) -> dict[str, Form]:
    """Functions of one number of the skeleton, which return infinity where Python's raise."""
    return {op: Form(f"{name}({{0}})", helper=name) for op, name in names.items()}


class PythonPrinter(Printer):
    """Prints Python."""

    END = ""
    FORMS: ClassVar[Mapping[str, Form]] = {
        "add": infix("+", SUM),
        "sub": infix("-", SUM),
        "mul": infix("*", PRODUCT),
        "mul_int": infix("*", PRODUCT),
        "div": infix("/", PRODUCT),
        "floordiv": infix("//", PRODUCT),
        "mod": infix("%", PRODUCT),
        "remainder": infix("%", PRODUCT),
        "neg": prefix("-", UNARY),
        "lt": infix("<", _ORDER, SUM),
        "le": infix("<=", _ORDER, SUM),
        "gt": infix(">", _ORDER, SUM),
        "ge": infix(">=", _ORDER, SUM),
        "eq": infix("==", _ORDER, SUM),
        "ne": infix("!=", _ORDER, SUM),
        "and": infix("&", _BITS, UNARY),
        "or": infix("|", _BITS, UNARY),
        "xor": infix("^", _BITS, UNARY),
        "invert": prefix("~", UNARY),
        "low_bits": Form("{0} & 0xFFFFFFFF", _BITS, (UNARY,)),
        "wrap": Form("_wrapped({0})", helper="_wrapped"),
        "lshift": infix("<<", _BITS, UNARY),
        "rshift": infix(">>", _BITS, UNARY),
        "where": Form("{1} if {0} else {2}", CHOICE, (_OR, CHOICE + 1, CHOICE)),
        "logical_and": infix("and", _AND, _NOT),
        "logical_or": infix("or", _OR, _AND),
        "logical_not": prefix("not ", _NOT),
        "ldexp": Form("_ldexp({0}, {1})", helper="_ldexp"),
        "power": Form("_power({0}, {1})", helper="_power"),
        "exp2": Form("_power(2.0, {0})", helper="_power"),
        "sinh": Form("_sinh({0})", helper="_sinh"),
        **calls({
            "abs": "abs", "minimum": "min", "maximum": "max", "sqrt": "math.sqrt",
            "log": "math.log", "log2": "math.log2", "arcsin": "math.asin", "arccos": "math.acos",
            "arctan": "math.atan", "arctan2": "math.atan2", "tanh": "math.tanh",
            "arcsinh": "math.asinh", "arccosh": "math.acosh", "arctanh": "math.atanh",
        }),
        "sin": Form("_total(math.sin, {0})", helper="_total"),
        "cos": Form("_total(math.cos, {0})", helper="_total"),
        "tan": Form("_total(math.tan, {0})", helper="_total"),
        "exp": Form("_total(math.exp, {0})", helper="_total"),
        "cosh": Form("_total(math.cosh, {0})", helper="_total"),
        "floor": Form("_rounded(math.floor, {0})", helper="_rounded"),
        "ceil": Form("_rounded(math.ceil, {0})", helper="_rounded"),
        "rint": Form("_rounded(round, {0})", helper="_rounded"),
        "trunc": Form("_rounded(math.trunc, {0})", helper="_rounded"),
        "int64": Form("_whole({0})", helper="_whole"),
        "fraction": Form("math.frexp({0})[0]", WHOLE),
        "exponent": Form("math.frexp({0})[1]", WHOLE),
    }  # fmt: skip
    CONVERSIONS: ClassVar[Mapping[tuple[Kind, Kind], Form]] = {
        ("int", "float"): Form("float({0})"),
        ("bool", "float"): Form("float({0})"),
        ("bool", "int"): Form("int({0})"),
        ("float", "int"): Form("_whole({0})", helper="_whole"),
        ("int", "bool"): Form("{0} != 0", _ORDER, (SUM,)),
        ("float", "bool"): Form("{0} != 0.0", _ORDER, (SUM,)),
    }

    def number(self, value: float, kind: Kind) -> str:
        """A constant."""
        if kind == "float" and (exponent := power_of_two(value)) is not None:
            return f"2.0**{exponent}"
        return repr(value)

    def read(self, place: str, each: Expression) -> str:  # noqa: ARG002
        """The number at a place, which has its kind already."""
        return place

    def part(self, place: str, part: tuple[int, ...]) -> str:
        """A lane of a vector, or of a column."""
        return place + "".join(f"[{number}]" for number in part)

    def let(self, name: str, value: Expression) -> str:
        """The statement that gives a number a name."""
        return f"{name} = {self.text(value)}"

    def set(self, place: str, statement: Set) -> Iterator[str]:
        """The statement that stores a value: a number, or a tuple of lanes or columns."""
        yield f"{place} = {self._lanes(statement.lanes, statement.field)}"

    def _lanes(self, lanes: tuple[object, ...], field: Field) -> str:
        if len(lanes) == 1:
            return self._lane(lanes[0])
        parts = [
            self._lanes(each, field) if isinstance(each, tuple) else self._lane(each)
            for each in lanes
        ]
        return f"({', '.join(parts)})"

    def _lane(self, lane: object) -> str:
        assert isinstance(lane, Expression)
        return self.text(lane)

    def each(self, index: str, count: str, body: Iterable[str]) -> Iterator[str]:
        """The loop over numbers from 0."""
        yield f"for {index} in range({count}):"
        yield from body

    def state(self, name: str, value: Expression) -> str:
        """The statement that makes a variable."""
        return self.let(name, value)
