"""Expressions of Burnish as trees, which the converter builds and then lays out as text.

A tree knows nothing of types. ``flat`` prints it on one line; ``laid_out`` breaks what is longer
than a line, at the arguments of a call or before an operator.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

WIDTH = 110
"""The longest line of an imported file, in characters."""
_INDENT = "    "

_LONGEST = 12
"""The longest text of a number that a person is expected to have written, in characters."""

# How tightly operators bind, from the table of docs/language.md.
CHOICE, OR, AND, NOT, COMPARISON, SUM, PRODUCT, PREFIX, POSTFIX = range(9)
_LEVELS = {
    "or": OR,
    "and": AND,
    **dict.fromkeys(("==", "!=", "<", "<=", ">", ">="), COMPARISON),
    **dict.fromkeys("+-", SUM),
    **dict.fromkeys(("*", "/", "mod"), PRODUCT),
}


@dataclass(frozen=True)
class Name:
    """A name, or other text that never needs brackets."""

    text: str


@dataclass(frozen=True)
class Number:
    """A number that is a ``float``, written as short as its place allows."""

    value: float


@dataclass(frozen=True)
class Call:
    """A function, a constructor or a texture with its arguments."""

    name: str
    arguments: tuple[Expression, ...]
    labels: tuple[str, ...] = ()
    """The names of the last arguments, as many as are given by name."""


@dataclass(frozen=True)
class Member:
    """Lanes of a vector, a member of a structure, or an element where the name is a number."""

    base: Expression
    name: str


@dataclass(frozen=True)
class Binary:
    operator: str
    left: Expression
    right: Expression


@dataclass(frozen=True)
class Unary:
    operator: str
    operand: Expression


@dataclass(frozen=True)
class Choice:
    condition: Expression
    positive: Expression
    negative: Expression


Expression = Name | Number | Call | Member | Binary | Unary | Choice


def is_simple(expression: Expression) -> bool:
    """True for what is as easily written twice as named: names, numbers, and lanes of these."""
    if isinstance(expression, Member):
        return is_simple(expression.base)
    if isinstance(expression, Unary):
        return isinstance(expression.operand, Number)
    if isinstance(expression, Call):
        return is_literal(expression) and len(flat(expression)) < len("vec3(0.25, 0.5, 0.75)")
    return isinstance(expression, Name | Number)


def is_literal(expression: Expression) -> bool:
    """True for numbers, and for vectors of numbers."""
    if isinstance(expression, Unary):
        return is_literal(expression.operand)
    if isinstance(expression, Call):
        vector = expression.name.rstrip("234") in ("vec", "rgb", "rgba", "mat")
        return vector and all(map(is_literal, expression.arguments))
    return isinstance(expression, Number)


def called(name: str, *arguments: Expression) -> Call:
    """A call in which at least one number is surely a ``float``, if all arguments are numbers."""
    if arguments and all(isinstance(argument, Number) for argument in arguments):
        return Call(name, (Name(decimal(arguments[0])), *arguments[1:]))
    return Call(name, arguments)


class Given(NamedTuple):
    """An argument of a call; ``is_default`` if the function has this value for it anyway."""

    name: str
    value: Expression
    is_default: bool = False


_BARE = 3
"""The most arguments that are written without their names; of longer calls, the first two are."""


def call_with(name: str, given: Sequence[Given]) -> Call:
    """A call that names its arguments, unless it is short.

    It leaves out what the function has anyway, but for the first argument, which chooses between
    functions of the same name.
    """
    kept = [
        argument for place, argument in enumerate(given) if place == 0 or not argument.is_default
    ]
    bare = 0
    limit = _BARE if len(kept) <= _BARE else 2
    for argument, other in zip(kept, given, strict=False):
        if argument is not other or bare >= limit:
            break
        bare += 1
    labels = tuple(argument.name for argument in kept[bare:])
    return Call(name, tuple(argument.value for argument in kept), labels)


def binary(operator: str, left: Expression, right: Expression) -> Expression:
    """An operation on numbers that are no ``int``. Of constants, its value where that is exact."""
    one, other = scalar(left), scalar(right)
    if one is not None and other is not None:
        value = _folded(operator, one, other)
        if value is not None:
            return value
        left = Name(decimal(left))
    if operator == "-" and other is not None and other < 0:
        return Binary("+", left, number(-other))
    return Binary(operator, left, right)


def scalar(expression: Expression) -> float | None:
    """The value of a number with its sign; nothing for all else."""
    if isinstance(expression, Unary) and isinstance(expression.operand, Number):
        return -expression.operand.value
    return expression.value if isinstance(expression, Number) else None


def number(value: float) -> Expression:
    """A number of any sign."""
    return Unary("-", Number(-value)) if value < 0 else Number(value + 0.0)


def _folded(operator: str, one: float, other: float) -> Expression | None:
    comparisons = {"==": one == other, ">": one > other, ">=": one >= other}
    if operator in comparisons:
        return Name("true" if comparisons[operator] else "false")
    results = {"+": one + other, "-": one - other, "*": one * other}
    if operator == "/" and other:
        results["/"] = one / other
    value = results.get(operator)
    # Thousandths of small numbers: what people write, and no more digits than they wrote.
    exact = value is not None and abs(value) < 1e4 and value == round(value, 4)
    return number(value) if exact and value is not None else None


def splat(expression: Expression) -> float | None:
    """The number that all lanes of a constant have, or that it is."""
    if isinstance(expression, Call) and len(expression.arguments) == 1 and is_literal(expression):
        return scalar(expression.arguments[0])
    return scalar(expression)


def decimal(number: Expression) -> str:
    """A number with a point or an exponent."""
    text = flat(number)
    return text if "." in text or "e" in text else f"{text}.0"


def number_text(value: float) -> str:
    """The shortest text of a finite number, without a point if it is whole.

    Documents have numbers of programs that compute with 32 bits, such as 0.20000000298023224: these
    are as short as 32 bits need.
    """
    text = repr(value)
    if len(text) > _LONGEST and float(single := np.float32(value)) == value:
        text = repr(float(str(single)))
    if "e" in text:
        mantissa, exponent = text.split("e")
        return f"{mantissa.removesuffix('.0')}e{int(exponent)}"
    return text.removesuffix(".0")


def flat(expression: Expression, level: int = CHOICE) -> str:
    """The text on one line, in brackets if it binds less tightly than ``level``."""
    text = _bare(expression)
    return f"({text})" if _level(expression) < level else text


def _bare(expression: Expression) -> str:
    match expression:
        case Name(text):
            return text
        case Number(value):
            return number_text(value)
        case Call(name, arguments, labels):
            return f"{name}({', '.join(_labelled(arguments, labels))})"
        case Member(base, name):
            inner = flat(base, POSTFIX)
            return f"{inner}[{name}]" if name.isdigit() else f"{inner}.{name}"
        case Unary(operator, operand):
            space = " " if operator.isalpha() else ""
            return f"{operator}{space}{flat(operand, _level(expression))}"
        case Binary(operator, left, right):
            lower, upper = _sides(operator)
            return f"{flat(left, lower)} {operator} {flat(right, upper)}"
        case Choice(condition, positive, negative):
            return f"if {flat(condition)} then {flat(positive, OR)} else {flat(negative)}"


def _labelled(arguments: Sequence[Expression], labels: Sequence[str]) -> list[str]:
    texts = [flat(argument) for argument in arguments]
    first = len(texts) - len(labels)
    return texts[:first] + [
        f"{label} = {text}" for label, text in zip(labels, texts[first:], strict=True)
    ]


def _level(expression: Expression) -> int:
    match expression:
        case Binary(operator):
            return _LEVELS[operator]
        case Unary(operator):
            return NOT if operator == "not" else PREFIX
        case Choice():
            return CHOICE
    return POSTFIX


def _sides(operator: str) -> tuple[int, int]:
    """The levels that an operator asks of its operands: all but comparisons chain to the left."""
    level = _LEVELS[operator]
    return (level + 1 if level == COMPARISON else level), level + 1


def laid_out(expression: Expression, used: int, indent: int) -> str:
    """The text of an expression behind ``used`` characters of its line.

    Lines that follow are indented by at least ``indent + 1`` steps.
    """
    text = flat(expression)
    if used + len(text) <= WIDTH:
        return text
    inside = _INDENT * (indent + 1)
    match expression:
        case Call(name, arguments, labels) if arguments:
            texts = _broken_arguments(arguments, labels, indent + 1)
            return f"{name}(\n{_filled(texts, inside)}\n{_INDENT * indent})"
        case Member(Call() as whole, name):
            return f"{laid_out(whole, used, indent)}.{name}"
        case Binary(operator, left, right):
            lower, upper = _sides(operator)
            first = _side(left, lower, used, indent)
            second = _side(right, upper, len(inside) + len(operator) + 1, indent + 1)
            return f"{first}\n{inside}{operator} {second}"
        case Choice(condition, positive, negative):
            then = _side(positive, OR, len(inside) + len("then "), indent + 1)
            other = laid_out(negative, len(inside) + len("else "), indent + 1)
            return f"if {flat(condition)}\n{inside}then {then}\n{inside}else {other}"
    return text


def _filled(texts: Sequence[str], inside: str) -> str:
    """Arguments in lines as long as they may be; one that is broken has lines of its own."""
    lines = [inside]
    for place, text in enumerate(texts):
        piece = text if place == len(texts) - 1 else f"{text},"
        if lines[-1].strip() and ("\n" in piece or len(lines[-1]) + 1 + len(piece) > WIDTH):
            lines.append(inside)
        lines[-1] += piece if not lines[-1].strip() else f" {piece}"
        if "\n" in piece and place < len(texts) - 1:
            lines.append(inside)
    return "\n".join(line for line in lines if line.strip())


def _side(expression: Expression, level: int, used: int, indent: int) -> str:
    if _level(expression) < level:
        return f"({laid_out(expression, used + 1, indent)})"
    return laid_out(expression, used, indent)


def _broken_arguments(
    arguments: Sequence[Expression], labels: Sequence[str], indent: int
) -> list[str]:
    first = len(arguments) - len(labels)
    texts = []
    for place, argument in enumerate(arguments):
        label = f"{labels[place - first]} = " if place >= first else ""
        texts.append(label + laid_out(argument, len(_INDENT) * indent + len(label), indent))
    return texts
