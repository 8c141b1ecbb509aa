"""Prints the code of derived values as C and C++ have it in common.

Both compute with numbers of fixed sizes and have the same functions. They differ in how a number is
converted, in how the library's names begin, and in what holds the lanes of a vector.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import ClassVar

from ...compiler.tracing import Expression, Kind
from ..fields import Numbers
from ..forms import C_LIKE, EQUAL, PRODUCT, SUM, UNARY, WHOLE, Form, calls, infix
from ..printer import Printer, power_of_two
from ..statements import Set

Cast = Callable[[str, str], str]
"""Spells the conversion of a text to a type."""
SHIFT = SUM - 5
_FUNCTIONS = {
    "floor": "floor", "ceil": "ceil", "rint": "nearbyint", "trunc": "trunc", "sqrt": "sqrt",
    "power": "pow", "exp": "exp", "exp2": "exp2", "log": "log", "log2": "log2", "sin": "sin",
    "cos": "cos", "tan": "tan", "arcsin": "asin", "arccos": "acos", "arctan": "atan",
    "arctan2": "atan2", "sinh": "sinh", "cosh": "cosh", "tanh": "tanh", "arcsinh": "asinh",
    "arccosh": "acosh", "arctanh": "atanh",
}  # fmt: skip
"""Functions of numbers in the library, which both languages have, by operation."""
LIBRARY = frozenset((*_FUNCTIONS.values(), "fabs", "fmod", "frexp", "ldexp", "llabs", "memcpy"))
"""Names of functions of the library that code calls."""
_HELPED = {
    "mod": ("remainder_of", 2), "remainder": ("floored_remainder", 2),
    "mul_int": ("wide_product", 2), "wrap": ("wrapped", 1), "int64": ("whole", 1),
    "fraction": ("fraction_of", 1), "exponent": ("exponent_of", 1),
}  # fmt: skip
"""Functions of the skeleton by operation, with the number of their operands."""


def forms(library: str, helper: str, cast: Cast, level: int) -> dict[str, Form]:
    """The forms of operations.

    ``library`` and ``helper`` are what names of the library and of the skeleton's functions begin
    with, and ``level`` is how strongly a conversion holds its operand.
    """
    inner = (level,) if level < WHOLE else ()
    return {
        **C_LIKE,
        "floordiv": infix("/", PRODUCT),
        "lshift": Form(f"{{0}} * ({cast('int64_t', '1')} << {{1}})", PRODUCT, (PRODUCT, SUM + 1)),
        "rshift": infix(">>", SHIFT, UNARY),
        "low_bits": Form(cast("int64_t", cast("uint32_t", "{0}")), level, inner),
        "ldexp": Form(f"{library}ldexp({{0}}, {cast('int', '{1}')})", WHOLE, (0, *inner)),
        **{op: helped(helper, *row) for op, row in _HELPED.items()},
        **calls({op: f"{library}{name}" for op, name in _FUNCTIONS.items()}),
    }


def helped(prefix: str, name: str, count: int) -> Form:
    """A function of the skeleton's."""
    operands = ", ".join(f"{{{number}}}" for number in range(count))
    return Form(f"{prefix}{name}({operands})", helper=name)


def conversions(helper: str, cast: Cast, level: int) -> dict[tuple[Kind, Kind], Form]:
    """The forms that make a number of one kind of another."""
    inner = (level,) if level < WHOLE else ()
    return {
        ("int", "float"): Form(cast("double", "{0}"), level, inner),
        ("bool", "float"): Form("{0} ? 1.0 : 0.0", 5, (10,)),
        ("bool", "int"): Form(cast("int64_t", "{0}"), level, inner),
        ("float", "int"): helped(helper, "whole", 1),
        ("int", "bool"): Form("{0} != 0", EQUAL, (SUM,)),
        ("float", "bool"): Form("{0} != 0.0", EQUAL, (SUM,)),
    }


class CFamilyPrinter(Printer):
    """Prints C or C++."""

    TYPES: ClassVar[Mapping[str, str]]
    """The types that numbers of each kind are computed in."""
    STORED: ClassVar[Mapping[str, str]]
    """The types that they are stored in."""
    OF_KIND: ClassVar[Mapping[tuple[str, Kind], Form]]
    """The forms of operations that are spelled otherwise for each kind of number."""

    @abstractmethod
    def cast(self, type_: str, text: str) -> str:
        """The conversion of a text to a type."""

    def form(self, each: Expression) -> Form:
        """The form of an operation, which may depend on the kind of its value."""
        return self.OF_KIND.get((each.op, each.kind)) or super().form(each)

    def number(self, value: float, kind: Kind) -> str:
        """A constant."""
        if kind == "bool":
            return "true" if value else "false"
        if kind == "int":
            return str(value) if abs(value) < 2**31 else f"{value}LL"
        if (exponent := power_of_two(value)) is not None:
            return f"0x1p{exponent:+d}"
        return repr(float(value))

    def element(self, array: str, index: object) -> str:
        """An element of an array."""
        return f"{array}[{index}]"

    def let(self, name: str, value: Expression) -> str:
        """The statement that gives a number a name; one that is read is converted by that."""
        is_read = value.op == "load" and value.kind != "bool" and not value.value.is_choice
        text = self._place(value) if is_read else self.text(value)
        return f"const {self.TYPES[value.kind]} {name} = {text};"

    def state(self, name: str, value: Expression) -> str:
        """The statement that makes a variable."""
        return f"{self.TYPES[value.kind]} {name} = {self.text(value)};"

    def each(self, index: str, count: str, body: Iterable[str]) -> Iterator[str]:
        """The loop over numbers from 0."""
        yield f"for ({self.TYPES['int']} {index} = 0; {index} < {count}; ++{index}) {{"
        yield from body
        yield "}"

    def set(self, place: str, statement: Set) -> Iterator[str]:
        """The statements that store a value: those of each column of a matrix."""
        kind = statement.field.type
        assert isinstance(kind, Numbers)
        columns = [(place, statement.lanes)]
        if kind.columns:
            columns = [(f"{place}[{n}]", lanes) for n, lanes in enumerate(statement.lanes)]  # type: ignore[misc]
        for target, lanes in columns:
            texts = [self._lane(lane, kind) for lane in lanes]
            yield from self.stored(target, texts, kind)

    @abstractmethod
    def stored(self, place: str, lanes: list[str], kind: Numbers) -> Iterator[str]:
        """The statements that store a number, a vector or a column."""

    def _lane(self, lane: object, kind: Numbers) -> str:
        assert isinstance(lane, Expression)
        wish: Kind | None = "float" if kind.kind == "float" else None
        return self.cast(self.STORED[kind.kind], self.text(lane, self.LEVEL, wish))

    LEVEL: ClassVar[int] = 0
    """The least strength of what is converted without parentheses."""
