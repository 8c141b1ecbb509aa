"""Rows for the hyperbolic functions and their inverses."""

from __future__ import annotations

import math

from .accuracy import CORRECT, inherited
from .arithmetic import QUOTIENT
from .exponential import exponential_error
from .facts import Fact
from .intervals import around, inexact
from .row import Builtin, nowhere
from .weakest import absolute, relative

_FLOATS = ("T -> T",)
_INSTRUCTION = "DXIL has an instruction without a limit of its error; the definition is assumed"
_FLAT = 16.0
"""The operand from which on tanh is 1 in float32.

Far beyond it, the quotient of exponentials would overflow.
"""


TANH = inherited("sinh(x) / cosh(x)", 1e-5, direct3d=_INSTRUCTION)


def _half_sum_error(operand: float) -> float:
    """The error of ``sinh`` and ``cosh``, as a part of the latter."""
    return (1.0 + exponential_error(operand)) * (1.0 + relative(CORRECT, CORRECT)) - 1.0


_TANH_ERROR = max(
    absolute(TANH),
    (1.0 + _half_sum_error(_FLAT))
    / (1.0 - _half_sum_error(_FLAT))
    * (1.0 + relative(QUOTIENT, CORRECT))
    - 1.0,
)
"""The error where the result is not 1 yet: both functions' errors count in the quotient."""


def _tangent(_facts: tuple[Fact, ...], _same: bool) -> Fact:
    return around(Fact(-1.0, 1.0), _TANH_ERROR)


def _cosine(_facts: tuple[Fact, ...], _same: bool) -> Fact:
    # The error grows with the operand, but more slowly than the result does.
    return inexact(1.0, math.inf, _half_sum_error(0.0))


def _is_near(facts: tuple[Fact, ...]) -> bool:
    return facts[0].within(-_FLAT, _FLAT)


ROWS = (
    Builtin(
        name="sinh",
        signatures=_FLOATS,
        meaning="numbers",
        doc="Hyperbolic sine, (exp(x) - exp(-x)) / 2. Beyond 88 it is too large for float32.",
        definition="sinh",
        accuracy=inherited("(exp(x) - exp(-x)) * 0.5", direct3d=_INSTRUCTION),
        cost=10,
    ),
    Builtin(
        name="cosh",
        signatures=_FLOATS,
        meaning="numbers",
        doc="Hyperbolic cosine, (exp(x) + exp(-x)) / 2. Beyond 88 it is too large for float32.",
        definition="cosh",
        range=_cosine,
        accuracy=inherited("(exp(x) + exp(-x)) * 0.5", direct3d=_INSTRUCTION),
        cost=10,
    ),
    Builtin(
        name="tanh",
        signatures=_FLOATS,
        meaning="numbers",
        doc="Hyperbolic tangent, sinh(x) / cosh(x).",
        domain=_is_near,
        needs="the operand lies within -16..16",
        outside="-1 or 1 outside of -16 to 16, also where exponentials are too large for float32.",
        expansion="tanh",
        definition="tanh_of_exponential",
        range=_tangent,
        accuracy=TANH,
        cost=14,
        samples=((0.0,), (20.0,), (-1e30,)),
    ),
    Builtin(
        name="asinh",
        signatures=_FLOATS,
        meaning="numbers",
        doc="Inverse hyperbolic sine: log(x + sqrt(x * x + 1)).",
        domain=nowhere,
        outside="Also where x * x is too large for float32; as precise for negative operands.",
        expansion="asinh",
        accuracy=inherited("log(x + sqrt(x * x + 1))"),
        cost=14,
        samples=((0.0,), (-3.0,), (1e30,), (-1e30,)),
    ),
    Builtin(
        name="acosh",
        signatures=_FLOATS,
        meaning="numbers",
        doc="Inverse hyperbolic cosine, 0 or more: log(x + sqrt(x * x - 1)).",
        domain=nowhere,
        outside="0 for operands below 1.",
        expansion="acosh",
        accuracy=inherited("log(x + sqrt(x * x - 1))"),
        cost=14,
        samples=((1.0,), (0.0,), (2.0,), (1e30,)),
    ),
    Builtin(
        name="atanh",
        signatures=_FLOATS,
        meaning="numbers",
        doc="Inverse hyperbolic tangent: log((1 + x) / (1 - x)) / 2.",
        domain=nowhere,
        outside="The operand is clamped to -0.99999994 to 0.99999994, the floats next to -1 and 1.",
        expansion="atanh",
        accuracy=inherited("log((1 + x) / (1 - x)) * 0.5"),
        cost=12,
        samples=((0.0,), (0.5,), (1.0,), (-7.0,)),
    ),
)
