"""Turns functions of the reference into expressions of JavaScript.

The functions of ``compiler/reference`` are written for any array library. ``Tracing`` is one whose
arrays are expressions: a function that is called with the names of lanes returns the text by which
JavaScript computes the same. ``builtin_table.py`` makes the host's table of builtins with it.

Numbers of JavaScript are floats of 64 bits, and so are integers here: shifts are products, which
are exact. Only ``&``, ``|``, ``^``, ``~`` and products of integers have the lowest 32 bits alone,
which is all that the reference uses of these. ``is_natural`` tells whether these bits stand for a
number without a sign.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal

Kind = Literal["float", "int", "bool"]

_HALF = 0x80000000
"""The reference wraps to signed 32 bits by adding this, taking the low 32 bits, and subtracting it;
JavaScript has one operation for the three."""
_CALL = re.compile(r"[\w.]+\(({}|\d+)(, {})*\)")
"""The form of a call, whose arguments take no parentheses."""
_SHORT = 60
"""The most characters of a list that stands on one line."""


@dataclass(frozen=True, slots=True, eq=False)
class Expression:
    """A number or truth of JavaScript: a form, with operands in its braces."""

    form: str
    operands: tuple[Expression, ...]
    kind: Kind
    is_natural: bool = False

    def __add__(self, other: Any) -> Expression:
        return self if is_number(other, 0) else self._joined("{} + {}", other)

    def __radd__(self, other: Any) -> Expression:
        return self if is_number(other, 0) else wrapped(other)._joined("{} + {}", self)

    def __sub__(self, other: Any) -> Expression:
        if is_number(other, _HALF) and self.form == "{} >>> 0":
            (biased,) = self.operands
            if biased.form == "{} + {}" and biased.operands[1] is wrapped(_HALF):
                return made("{} | 0", biased.operands[0], kind="int")
        return self._joined("{} - {}", other)

    def __rsub__(self, other: Any) -> Expression:
        return wrapped(other)._joined("{} - {}", self)

    def __mul__(self, other: Any) -> Expression:
        if is_number(other, 1):
            return self
        if is_number(other, -1):
            return -self
        is_integer = self.kind == wrapped(other).kind == "int"
        return self._joined("Math.imul({}, {})" if is_integer else "{} * {}", other)

    def __rmul__(self, other: Any) -> Expression:
        return wrapped(other)._joined("{} * {}", self)

    def __truediv__(self, other: Any) -> Expression:
        return made("{} / {}", self, other)

    def __floordiv__(self, other: Any) -> Expression:
        return made("Math.floor({} / {})", self, other, kind="int")

    def __mod__(self, other: Any) -> Expression:
        return made("remainder({}, {})", self, other, kind="int")

    def __neg__(self) -> Expression:
        return made("-{}", self, kind=self.kind)

    def __abs__(self) -> Expression:
        return made("Math.abs({})", self, kind=self.kind, is_natural=True)

    def __lt__(self, other: Any) -> Expression:
        return made("{} < {}", self, other, kind="bool")

    def __le__(self, other: Any) -> Expression:
        return made("{} <= {}", self, other, kind="bool")

    def __gt__(self, other: Any) -> Expression:
        return made("{} > {}", self, other, kind="bool")

    def __ge__(self, other: Any) -> Expression:
        return made("{} >= {}", self, other, kind="bool")

    def __eq__(self, other: object) -> Any:
        return made("{} === {}", self, other, kind="bool")

    def __ne__(self, other: object) -> Any:
        return made("{} !== {}", self, other, kind="bool")

    __hash__ = object.__hash__

    def __and__(self, other: Any) -> Expression:
        if is_number(other, 0xFFFFFFFF):
            is_done = self.form == "{} >>> 0"
            return self if is_done else made("{} >>> 0", self, kind="int", is_natural=True)
        is_natural = self.is_natural or wrapped(other).is_natural
        return self._bits("{} & {}", other, is_natural)

    def __or__(self, other: Any) -> Expression:
        return self._bits("{} | {}", other, self.is_natural and wrapped(other).is_natural)

    def __xor__(self, other: Any) -> Expression:
        return self._bits("{} ^ {}", other, self.is_natural and wrapped(other).is_natural)

    def __ror__(self, other: Any) -> Expression:
        return self if is_number(other, 0) else wrapped(other) | self

    def __invert__(self) -> Expression:
        return made("~{}", self, kind="int")

    def __lshift__(self, other: Any) -> Expression:
        if is_number(other, 0):
            return self
        return made("{} * 2 ** {}", self, other, kind="int", is_natural=self.is_natural)

    def __rlshift__(self, other: Any) -> Expression:
        return wrapped(other) << self

    def __rshift__(self, other: Any) -> Expression:
        if is_number(other, 0):
            return self
        form = "Math.floor({} / 2 ** {})"
        return made(form, self, other, kind="int", is_natural=self.is_natural)

    def _joined(self, form: str, other: Any) -> Expression:
        both = self, wrapped(other)
        kind: Kind = "int" if all(each.kind == "int" for each in both) else "float"
        return made(form, *both, kind=kind)

    def _bits(self, form: str, other: Any, is_natural: bool) -> Expression:
        found = made(form, self, other, kind="int")
        return made("{} >>> 0", found, kind="int", is_natural=True) if is_natural else found


_KNOWN: dict[tuple[Any, ...], Expression] = {}
"""Equal expressions are one, so that what several others need is computed once."""


def made(form: str, *operands: Any, kind: Kind = "float", is_natural: bool = False) -> Expression:
    """The expression of a form, with what stands in its braces."""
    found = tuple(map(wrapped, operands))
    key = form, kind, is_natural, *map(id, found)
    return _KNOWN.setdefault(key, Expression(form, found, kind, is_natural))


def wrapped(value: Any) -> Expression:
    """An expression, or a constant as one."""
    if isinstance(value, Expression):
        return value
    if isinstance(value, bool):
        return made(str(value).lower(), kind="bool")
    if isinstance(value, int):
        return made(str(value), kind="int", is_natural=value >= 0)
    return made(repr(float(value)).removesuffix(".0"))


def is_number(value: Any, number: int) -> bool:
    """True if something is a constant with this value."""
    return not isinstance(value, Expression) and bool(value == number)


def _named(form: str, kind: Kind = "float") -> Callable[..., Expression]:
    return partial(made, form, kind=kind)


def _chosen(condition: Any, x: Any, y: Any) -> Expression:
    both = wrapped(x), wrapped(y)
    kind: Kind = "int" if all(each.kind == "int" for each in both) else "float"
    is_natural = all(each.is_natural for each in both)
    return made("{} ? {} : {}", condition, *both, kind=kind, is_natural=is_natural)


def _extreme(form: str, x: Any, y: Any) -> Expression:
    both = wrapped(x), wrapped(y)
    kind: Kind = "int" if all(each.kind == "int" for each in both) else "float"
    return made(form, *both, kind=kind, is_natural=all(each.is_natural for each in both))


class Tracing:
    """The functions of ``compiler/reference/namespace.py``."""

    where = staticmethod(_chosen)
    minimum = staticmethod(partial(_extreme, "Math.min({}, {})"))
    maximum = staticmethod(partial(_extreme, "Math.max({}, {})"))
    int64 = staticmethod(_named("whole({})", "int"))
    logical_and = staticmethod(_named("{} && {}", "bool"))
    logical_or = staticmethod(_named("{} || {}", "bool"))
    logical_not = staticmethod(_named("!{}", "bool"))
    divide = staticmethod(_named("{} / {}"))
    remainder = staticmethod(_named("remainder({}, {})"))
    floor = staticmethod(_named("Math.floor({})"))
    ceil = staticmethod(_named("Math.ceil({})"))
    rint = staticmethod(_named("nearest({})"))
    trunc = staticmethod(_named("Math.trunc({})"))
    sqrt = staticmethod(_named("Math.sqrt({})"))
    power = staticmethod(_named("Math.pow({}, {})"))
    exp = staticmethod(_named("Math.exp({})"))
    exp2 = staticmethod(_named("Math.pow(2, {})"))
    log = staticmethod(_named("Math.log({})"))
    log2 = staticmethod(_named("Math.log2({})"))
    sin = staticmethod(_named("Math.sin({})"))
    cos = staticmethod(_named("Math.cos({})"))
    tan = staticmethod(_named("Math.tan({})"))
    arcsin = staticmethod(_named("Math.asin({})"))
    arccos = staticmethod(_named("Math.acos({})"))
    arctan = staticmethod(_named("Math.atan({})"))
    arctan2 = staticmethod(_named("Math.atan2({}, {})"))
    sinh = staticmethod(_named("Math.sinh({})"))
    cosh = staticmethod(_named("Math.cosh({})"))
    tanh = staticmethod(_named("Math.tanh({})"))
    arcsinh = staticmethod(_named("Math.asinh({})"))
    arccosh = staticmethod(_named("Math.acosh({})"))
    arctanh = staticmethod(_named("Math.atanh({})"))
    ldexp = staticmethod(_named("{} * 2 ** {}"))

    @staticmethod
    def float64(x: Any) -> Expression:
        """Integers are floats already."""
        return made("{}", x)

    @staticmethod
    def frexp(x: Any) -> Any:
        """The fraction and the exponent."""
        return made("fractionOf({})", x), made("exponentOf({})", x, kind="int")


def function(parameters: str, results: Expression | tuple[Any, ...]) -> str:
    """The arrow function with these results, which are nested like columns. Operands that several
    expressions have get a name in it. Its lines behind the first are those of a row of a table."""
    names: dict[int, str] = {}
    lines: list[str] = []
    for each in _shared(tuple(_lanes(results))):
        text = _text(each, names, is_whole=True)
        names[id(each)] = f"v{len(names)}"
        lines.append(f"const {names[id(each)]} = {text};")
    if not lines:
        return f"({parameters}) => {_written(results, names, 2)}"
    body = "".join(f"    {line}\n" for line in (*lines, f"return {_written(results, names, 4)};"))
    return f"({parameters}) => {{\n{body}  }}"


def _lanes(results: Any) -> Iterator[Expression]:
    if isinstance(results, tuple):
        for each in results:
            yield from _lanes(each)
    else:
        yield wrapped(results)


def _written(results: Any, names: dict[int, str], indent: int) -> str:
    """A list of lanes, or of columns, on one line if it is short; or else a lane."""
    if isinstance(results, tuple):
        parts = [_written(each, names, indent + 2) for each in results]
        line = f"[{', '.join(parts)}]"
        if len(line) <= _SHORT and "\n" not in line:
            return line
        inside = "".join(f"{' ' * (indent + 2)}{part},\n" for part in parts)
        return f"[\n{inside}{' ' * indent}]"
    lane = wrapped(results)
    text = _text(lane, names, is_whole=True)
    return f"Number({text})" if lane.kind == "bool" else text


def _shared(roots: tuple[Expression, ...]) -> list[Expression]:
    """The expressions that more than one expression needs, operands first."""
    uses: dict[int, int] = {}
    order: list[Expression] = []

    def visit(each: Expression) -> None:
        uses[id(each)] = uses.get(id(each), 0) + 1
        if uses[id(each)] == 1:
            for operand in each.operands:
                visit(operand)
            order.append(each)

    for root in roots:
        visit(root)
    return [each for each in order if uses[id(each)] > 1 and each.operands]


def _text(each: Expression, names: dict[int, str], *, is_whole: bool = False) -> str:
    """An expression; in parentheses, unless it is a whole one or needs none."""
    if id(each) in names:
        return names[id(each)]
    is_call = _CALL.fullmatch(each.form) is not None
    parts = [_text(operand, names, is_whole=is_call) for operand in each.operands]
    text = each.form.format(*parts)
    is_closed = not each.operands or each.form.endswith(")") or each.form == "{}"
    return text if is_whole or is_closed else f"({text})"
