"""Types and constants of MaterialX, as Burnish writes them."""

from __future__ import annotations

import re
from math import isfinite
from types import MappingProxyType

from .expressions import Call, Expression, Name, Number, Unary, decimal, number, scalar
from .problems import UnsupportedError

TYPES = MappingProxyType({
    "float": "float",
    "integer": "int",
    "boolean": "bool",
    "color3": "rgb",
    "color4": "rgba",
    "vector2": "vec2",
    "vector3": "vec3",
    "vector4": "vec4",
    "matrix33": "mat3",
    "matrix44": "mat4",
    "BSDF": "Bsdf",
    "EDF": "rgb",
    "VDF": "Bsdf",
})  # fmt: skip
"""The types that values have. Colours are colours; all other vectors are bare numbers."""

BARE = MappingProxyType({**TYPES, "color3": "vec3", "color4": "vec4", "EDF": "vec3"})
"""The same without meanings: what arguments of functions are, so that they take colours and
vectors."""

CLOSURES = frozenset(("BSDF", "EDF", "VDF"))
ASKED = frozenset(("BSDF", "VDF"))
"""The closures whose values depend on what is asked of them; what is sent out is a colour."""
LANES = MappingProxyType(
    {"float": 1, "vector2": 2, "color3": 3, "vector3": 3, "color4": 4, "vector4": 4}
)
_SIDES = MappingProxyType({"matrix33": 3, "matrix44": 4})
_ZEROS = MappingProxyType({"integer": "0", "boolean": "false"})


def zero(kind: str) -> Expression:
    """The value of an input that has none."""
    if kind in _ZEROS:
        return Name(_ZEROS[kind])
    if kind in _SIDES:
        return Call(BARE[kind], (Number(1.0),))
    return literal("0", "color3" if kind == "EDF" else kind)


def literal(text: str, kind: str) -> Expression:
    """The constant that ``text`` means to MaterialX.

    One number stands for all lanes. Raises ``UnsupportedError`` if the text is no value of its
    type.
    """
    text = text.strip()
    try:
        if kind == "boolean":
            return Name({"true": "true", "false": "false", "1": "true", "0": "false"}[text.lower()])
        if kind == "integer":
            return _whole(int(text))
        numbers = numbers_of(text)
        return _vector(numbers, kind)
    except (ValueError, KeyError):
        raise UnsupportedError(f"'{text}' is no value of the type {kind}") from None


def numbers_of(text: str) -> list[float]:
    """The numbers of a value, between which stand commas or spaces. Raises ``ValueError``."""
    return [float(part) for part in re.split(r"[,\s]+", text.strip())]


def _whole(value: int) -> Expression:
    return Unary("-", Name(str(-value))) if value < 0 else Name(str(value))


def _vector(numbers: list[float], kind: str) -> Expression:
    if not all(map(isfinite, numbers)):
        raise ValueError
    if kind in _SIDES:
        return _matrix(numbers, _SIDES[kind], BARE[kind])
    lanes = LANES[kind]
    if len(numbers) == 1:
        numbers *= lanes
    if len(numbers) != lanes:
        raise ValueError
    if lanes == 1:
        return number(numbers[0])
    name = BARE[kind]
    if len(set(numbers)) == 1:
        return Call(name, (number(numbers[0]),))
    return Call(name if kind.startswith("vector") else TYPES[kind], tuple(map(number, numbers)))


def _matrix(numbers: list[float], side: int, name: str) -> Expression:
    """A matrix; MaterialX writes the columns that its generators give to shaders one after the
    other."""
    if len(numbers) != side * side:
        raise ValueError
    if numbers == [float(row == column) for row in range(side) for column in range(side)]:
        return Call(name, (Number(1.0),))
    columns = [numbers[start : start + side] for start in range(0, len(numbers), side)]
    return Call(name, tuple(Call(f"vec{side}", tuple(map(number, column))) for column in columns))


def as_float(expression: Expression) -> Expression:
    """The same number with its point, where a whole number would be an ``int``."""
    return Name(decimal(expression)) if scalar(expression) is not None else expression
