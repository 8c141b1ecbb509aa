"""Prints the code of derived values as Rust."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import ClassVar

from ...compiler.tracing import Expression, Kind
from ..fields import Field, Numbers
from ..forms import C_LIKE, CHOICE, EQUAL, PRODUCT, SUM, UNARY, WHOLE, Form, infix, prefix
from ..printer import Printer, power_of_two
from ..statements import Set

_TYPES: Mapping[str, str] = {"float": "f64", "int": "i64", "bool": "bool"}
_SHIFT = SUM - 5
_CAST = CHOICE
"""The strength of ``as``: in parentheses beside any operator, as ``x as i64 < y`` is an error."""
_ARITY = {"power": 2, "arctan2": 2, "minimum": 2, "maximum": 2, "mul_int": 2}
_AS_GIVEN = ("add", "sub", "mul", "div", "neg", "and", "or", "xor", "invert", "low_bits")
"""Operations whose value is of the type of their operands."""


def _helped(name: str, count: int) -> Form:
    """A function of the skeleton's."""
    return Form(f"{name}({', '.join(f'{{{n}}}' for n in range(count))})", helper=name)


def _methods(names: Mapping[str, str]) -> dict[str, Form]:
    """Methods of the first operand, by operation."""
    return {
        op: Form(f"{{0}}.{name}({'{1}' if op in _ARITY else ''})", WHOLE, (WHOLE,))
        for op, name in names.items()
    }


class RustPrinter(Printer):
    """Prints Rust."""

    FORMS: ClassVar[Mapping[str, Form]] = {
        **C_LIKE,
        "invert": prefix("!", UNARY),
        "where": Form("if {0} {{ {1} }} else {{ {2} }}", CHOICE),
        "floordiv": infix("/", PRODUCT),
        "mod": _helped("remainder_of", 2),
        "remainder": _helped("floored_remainder", 2),
        "wrap": Form("i64::from({0} as i32)", WHOLE, (UNARY,)),
        "lshift": infix("<<", _SHIFT, UNARY),
        "rshift": infix(">>", _SHIFT, UNARY),
        "ldexp": _helped("scaled", 2),
        "int64": _helped("whole", 1),
        "fraction": _helped("fraction_of", 1),
        "exponent": _helped("exponent_of", 1),
        **_methods({
            "abs": "abs", "minimum": "min", "maximum": "max", "floor": "floor", "ceil": "ceil",
            "rint": "round_ties_even", "trunc": "trunc", "sqrt": "sqrt", "power": "powf",
            "exp": "exp", "exp2": "exp2", "log": "ln", "log2": "log2", "sin": "sin", "cos": "cos",
            "tan": "tan", "arcsin": "asin", "arccos": "acos", "arctan": "atan",
            "arctan2": "atan2", "sinh": "sinh", "cosh": "cosh", "tanh": "tanh",
            "arcsinh": "asinh", "arccosh": "acosh", "arctanh": "atanh",
            "mul_int": "wrapping_mul",
        }),
    }  # fmt: skip
    CONVERSIONS: ClassVar[Mapping[tuple[Kind, Kind], Form]] = {
        ("int", "float"): Form("{0} as f64", _CAST, (UNARY,)),
        ("bool", "float"): Form("f64::from({0})"),
        ("bool", "int"): Form("i64::from({0})"),
        ("float", "int"): _helped("whole", 1),
        ("int", "bool"): Form("{0} != 0", EQUAL, (SUM,)),
        ("float", "bool"): Form("{0} != 0.0", EQUAL, (SUM,)),
    }

    def number(self, value: float, kind: Kind) -> str:
        """A constant."""
        if kind == "bool":
            return "true" if value else "false"
        if kind == "int":
            return str(value)
        if (exponent := power_of_two(value)) is not None:
            return f"f64::powi(2.0, {exponent})"
        return repr(float(value))

    def text(self, each: Expression, level: int = 0, kind: Kind | None = None) -> str:
        """An expression as one of a kind; a bool is read by a comparison."""
        text = super().text(each, level, kind)
        is_bool = each.op == "load" and each.kind == "bool" and kind in (None, "bool")
        return f"({text})" if is_bool and level > EQUAL else text

    def _formed(self, form: Form, each: Expression, level: int) -> str:
        if each.op == "int64" and each.operands[0].kind == "bool":
            return self._converted(each.operands[0], level, "int")
        if form.text.startswith("{0}.") and not _is_typed(each.operands[0]):
            form = _as_function(form, _TYPES[each.kind])
        return super()._formed(form, each, level)

    def _converted(self, each: Expression, level: int, kind: Kind) -> str:
        if each.op == "load" and (each.kind, kind) == ("int", "float"):
            return f"f64::from({self._place(each)})"
        return super()._converted(each, level, kind)

    def lesser(self, count: Expression, bound: int) -> str:
        """The number of terms of a fold."""
        return f"i64::min({self.text(count, kind='int')}, {bound})"

    def read(self, place: str, each: Expression) -> str:
        """The number at a place; where it is a uint, it stands for a bool."""
        return f"{place} != 0" if each.kind == "bool" else f"{_TYPES[each.kind]}::from({place})"

    def part(self, place: str, part: tuple[int, ...]) -> str:
        """A lane of a vector, or of a column."""
        return place + "".join(f"[{number}]" for number in part)

    def element(self, array: str, index: object) -> str:
        """An element of an array."""
        text = str(index)
        if text.isdigit():
            return f"{array}[{text}]"
        return f"{array}[{text} as usize]" if text.isidentifier() else f"{array}[({text}) as usize]"

    def let(self, name: str, value: Expression) -> str:
        """The statement that gives a number a name."""
        return f"let {self._typed(name, value)} = {self.text(value)};"

    def _typed(self, name: str, value: Expression) -> str:
        return name if _is_typed(value) else f"{name}: {_TYPES[value.kind]}"

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
        zero = "0.0" if field.type.kind == "float" else "0"
        return f"[{', '.join([*texts, *[zero] * (field.type.stored_lanes - len(texts))])}]"

    def _lane(self, lane: object, kind: Numbers) -> str:
        assert isinstance(lane, Expression)
        if kind.kind == "float":
            return f"{self.text(lane, UNARY, 'float')} as f32"
        return f"{self.text(lane, UNARY)} as {'i32' if kind.kind == 'int' else 'u32'}"

    def each(self, index: str, count: str, body: Iterable[str]) -> Iterator[str]:
        """The loop over numbers from 0."""
        yield f"for {index} in 0_i64..{count} {{"
        yield from body
        yield "}"

    def state(self, name: str, value: Expression) -> str:
        """The statement that makes a variable."""
        return f"let mut {name}: {_TYPES[value.kind]} = {self.text(value)};"

    def returned(self, value: str) -> str:
        """The value of a function, which is its last expression."""
        return value


def _is_typed(each: Expression) -> bool:
    """True if Rust knows the type of an expression without what stands around it."""
    if each.op == "constant":
        return power_of_two(each.value) is not None if each.kind == "float" else False
    if each.op == "where":
        return any(map(_is_typed, each.operands[1:]))
    return each.op not in _AS_GIVEN or any(map(_is_typed, each.operands))


def _as_function(form: Form, type_: str) -> Form:
    """A method as a function of its type, for operands whose type Rust does not know."""
    found = re.fullmatch(r"\{0\}\.(\w+)\((.*)\)", form.text)
    assert found is not None
    operands = f"{{0}}, {found[2]}" if found[2] else "{0}"
    return Form(f"{type_}::{found[1]}({operands})")
