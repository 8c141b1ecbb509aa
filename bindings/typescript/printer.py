"""Prints the code of derived values as TypeScript.

All numbers are floats of 64 bits, integers too: shifts are products, which are exact.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import ClassVar

from ...compiler.javascript import MATH
from ...compiler.tracing import Expression, Kind
from ..fields import Field, Numbers
from ..forms import BITS, C_LIKE, CHOICE, EQUAL, OR, PRODUCT, SUM, UNARY, WHOLE, Form, calls, infix
from ..printer import Printer, power_of_two
from ..statements import Place, Set


class TypeScriptPrinter(Printer):
    """Prints TypeScript."""

    INDENT: ClassVar[str] = "  "
    FORMS: ClassVar[Mapping[str, Form]] = {
        **C_LIKE,
        **calls(MATH),
        "eq": infix("===", EQUAL, SUM),
        "ne": infix("!==", EQUAL, SUM),
        "floordiv": Form("Math.floor({0} / {1})", WHOLE, (PRODUCT, PRODUCT + 1)),
        "mod": Form("remainder({0}, {1})", helper="remainder"),
        "remainder": Form("remainder({0}, {1})", helper="remainder"),
        "low_bits": Form("{0} >>> 0", BITS, (UNARY,)),
        "wrap": Form("{0} | 0", BITS, (UNARY,)),
        "lshift": Form("{0} * 2 ** {1}", PRODUCT, (PRODUCT, WHOLE)),
        "rshift": Form("Math.floor({0} / 2 ** {1})", WHOLE, (PRODUCT, WHOLE)),
        "ldexp": Form("{0} * 2 ** {1}", PRODUCT, (PRODUCT, WHOLE)),
        "exp2": Form("Math.pow(2, {0})"),
        "rint": Form("nearest({0})", helper="nearest"),
        "int64": Form("whole({0})", helper="whole"),
        "fraction": Form("{0} / 2 ** exponentOf({0})", PRODUCT, (PRODUCT,), "exponentOf"),
        "exponent": Form("exponentOf({0})", helper="exponentOf"),
    }
    CONVERSIONS: ClassVar[Mapping[tuple[Kind, Kind], Form]] = {
        ("bool", "float"): Form("{0} ? 1 : 0", CHOICE, (OR,)),
        ("bool", "int"): Form("{0} ? 1 : 0", CHOICE, (OR,)),
        ("float", "int"): Form("whole({0})", helper="whole"),
        ("int", "bool"): Form("{0} !== 0", EQUAL, (SUM,)),
        ("float", "bool"): Form("{0} !== 0", EQUAL, (SUM,)),
    }

    def number(self, value: float, kind: Kind) -> str:
        """A constant."""
        if kind == "bool":
            return "true" if value else "false"
        if kind == "int":
            return str(value)
        if (exponent := power_of_two(value)) is not None:
            return f"2 ** {exponent}"
        return repr(float(value)).removesuffix(".0")

    def read(self, place: str, each: Expression) -> str:
        """The number at a place; where it is a uint, it stands for a bool."""
        found: Place = each.value
        is_lane = bool(found.part) or not isinstance(found.way[-1], str)
        text = place if found.part or not is_lane else f"{place}[0]!"
        return f"({text} !== 0)" if is_lane and each.kind == "bool" else text

    def part(self, place: str, part: tuple[int, ...]) -> str:
        """A lane of a vector, or of a column, each of which has room for four."""
        *columns, lane = part
        return f"{place}[{sum(4 * column for column in columns) + lane}]!"

    def element(self, array: str, index: object) -> str:
        """An element of an array."""
        return f"{array}[{index}]!"

    def let(self, name: str, value: Expression) -> str:
        """The statement that gives a number a name."""
        text = self.text(value)
        is_enclosed = value.op == "load" and text.startswith("(")
        return f"const {name} = {text[1:-1] if is_enclosed else text};"

    def set(self, place: str, statement: Set) -> Iterator[str]:
        """The statement that stores a value: a number, or the lanes of all columns."""
        field = statement.field
        columns = [each if isinstance(each, tuple) else (each,) for each in statement.lanes]
        lanes = [self._lane(lane, field) for column in columns for lane in column]
        if not statement.place.way or isinstance(statement.place.way[-1], str):
            text = lanes[0] if len(lanes) == 1 else f"[{', '.join(lanes)}]"
            yield f"{place} = {text};"
        else:
            yield f"store({place}, [{', '.join(lanes)}]);"

    def _lane(self, lane: object, field: Field) -> str:
        assert isinstance(lane, Expression)
        assert isinstance(field.type, Numbers)
        kind: Kind = "bool" if field.type.truth else "float"
        if field.type.kind != "float" and not field.type.truth:
            kind = "int"
        return self.text(lane, kind=kind)

    def each(self, index: str, count: str, body: Iterable[str]) -> Iterator[str]:
        """The loop over numbers from 0."""
        yield f"for (let {index} = 0; {index} < {count}; {index} += 1) {{"
        yield from body
        yield "}"

    def state(self, name: str, value: Expression) -> str:
        """The statement that makes a variable."""
        return f"let {name} = {self.text(value)};"
