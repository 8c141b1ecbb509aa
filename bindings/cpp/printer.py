"""Prints the code of derived values as C++17."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import ClassVar

from ...compiler.tracing import Expression, Kind
from ..fields import Field, Numbers
from ..forms import C_LIKE, EQUAL, PRODUCT, SUM, UNARY, Form, calls, infix
from ..printer import Printer, power_of_two
from ..statements import Set

_TYPES: Mapping[str, str] = {"float": "double", "int": "std::int64_t", "bool": "bool"}


def _helped(name: str, count: int) -> Form:
    """A function of the skeleton's."""
    return Form(f"{name}({', '.join(f'{{{n}}}' for n in range(count))})", helper=name)


class CppPrinter(Printer):
    """Prints C++."""

    FORMS: ClassVar[Mapping[str, Form]] = {
        **C_LIKE,
        "floordiv": infix("/", PRODUCT),
        "mod": _helped("remainder_of", 2),
        "remainder": _helped("floored_remainder", 2),
        "mul_int": _helped("wide_product", 2),
        "wrap": Form("static_cast<std::int32_t>(static_cast<std::uint32_t>({0}))"),
        "lshift": Form("{0} * (std::int64_t{{1}} << {1})", PRODUCT, (PRODUCT, SUM + 1)),
        "rshift": infix(">>", SUM - 5, UNARY),
        "low_bits": Form("static_cast<std::int64_t>(static_cast<std::uint32_t>({0}))"),
        "ldexp": Form("std::ldexp({0}, static_cast<int>({1}))"),
        "int64": _helped("whole", 1),
        "fraction": _helped("fraction_of", 1),
        "exponent": _helped("exponent_of", 1),
        "minimum": Form("std::min<{kind}>({0}, {1})"),
        "maximum": Form("std::max<{kind}>({0}, {1})"),
        **calls({
            "abs": "std::abs", "floor": "std::floor", "ceil": "std::ceil", "rint": "std::nearbyint",
            "trunc": "std::trunc", "sqrt": "std::sqrt", "power": "std::pow", "exp": "std::exp",
            "exp2": "std::exp2", "log": "std::log", "log2": "std::log2", "sin": "std::sin",
            "cos": "std::cos", "tan": "std::tan", "arcsin": "std::asin", "arccos": "std::acos",
            "arctan": "std::atan", "arctan2": "std::atan2", "sinh": "std::sinh",
            "cosh": "std::cosh", "tanh": "std::tanh", "arcsinh": "std::asinh",
            "arccosh": "std::acosh", "arctanh": "std::atanh",
        }),
    }  # fmt: skip
    CONVERSIONS: ClassVar[Mapping[tuple[Kind, Kind], Form]] = {
        ("int", "float"): Form("static_cast<double>({0})"),
        ("bool", "float"): Form("{0} ? 1.0 : 0.0", 5, (10,)),
        ("bool", "int"): Form("std::int64_t{{{0}}}"),
        ("float", "int"): _helped("whole", 1),
        ("int", "bool"): Form("{0} != 0", EQUAL, (SUM,)),
        ("float", "bool"): Form("{0} != 0.0", EQUAL, (SUM,)),
    }

    def number(self, value: float, kind: Kind) -> str:
        """A constant."""
        if kind == "bool":
            return "true" if value else "false"
        if kind == "int":
            return str(value) if abs(value) < 2**31 else f"{value}LL"
        if (exponent := power_of_two(value)) is not None:
            return f"0x1p{exponent:+d}"
        return repr(float(value))

    def _formed(self, form: Form, each: Expression, level: int) -> str:
        text = form.text.replace("{kind}", _TYPES[each.kind])
        return super()._formed(Form(text, form.level, form.inner, form.helper), each, level)

    def lesser(self, count: Expression, bound: int) -> str:
        """The number of terms of a fold."""
        return f"std::min<std::int64_t>({self.text(count, kind='int')}, {bound})"

    def read(self, place: str, each: Expression) -> str:
        """The number at a place; where it is a uint, it stands for a bool.

        Floats are made doubles here, as C++ computes with floats otherwise.
        """
        if each.kind == "bool":
            return f"({place} != 0)"
        return f"{_TYPES[each.kind]}{{{place}}}"

    def part(self, place: str, part: tuple[int, ...]) -> str:
        """A lane of a vector, or of a column."""
        *columns, lane = part
        return place + "".join(f"[{column}]" for column in columns) + f".{'xyzw'[lane]}"

    def element(self, array: str, index: object) -> str:
        """An element of an array."""
        return f"{array}[{index}]"

    def let(self, name: str, value: Expression) -> str:
        """The statement that gives a number a name."""
        text = self.text(value)
        if value.op == "load" and value.kind != "bool":
            text = text.removeprefix(f"{_TYPES[value.kind]}{{").removesuffix("}")
        return f"const {_TYPES[value.kind]} {name} = {text};"

    def set(self, place: str, statement: Set) -> Iterator[str]:
        """The statements that store a value: one for each column of a matrix."""
        kind = statement.field.type
        assert isinstance(kind, Numbers)
        if not kind.columns:
            yield f"{place} = {self._lanes(statement.lanes, statement.field)};"
            return
        for number, column in enumerate(statement.lanes):
            assert isinstance(column, tuple)
            yield f"{place}[{number}] = {self._lanes(column, statement.field)};"

    def _lanes(self, lanes: tuple[object, ...], field: Field) -> str:
        assert isinstance(field.type, Numbers)
        texts = [self._lane(lane, field.type) for lane in lanes]
        if len(texts) == 1:
            return texts[0]
        missing = field.type.stored_lanes - len(texts)
        return f"{{{', '.join([*texts, *['0.0f'] * missing])}}}"

    def _lane(self, lane: object, kind: Numbers) -> str:
        assert isinstance(lane, Expression)
        if kind.kind == "float":
            return f"static_cast<float>({self.text(lane, kind='float')})"
        stored = "std::int32_t" if kind.kind == "int" else "std::uint32_t"
        return f"static_cast<{stored}>({self.text(lane)})"

    def each(self, index: str, count: str, body: Iterable[str]) -> Iterator[str]:
        """The loop over numbers from 0."""
        yield f"for (std::int64_t {index} = 0; {index} < {count}; ++{index}) {{"
        yield from body
        yield "}"

    def state(self, name: str, value: Expression) -> str:
        """The statement that makes a variable."""
        return f"{_TYPES[value.kind]} {name} = {self.text(value)};"
