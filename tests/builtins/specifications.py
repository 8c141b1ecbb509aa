"""The accuracy tables of the specifications, typed in from them, for single precision.

``test_accuracy.py`` compares the builtins' rows with them. A function that is missing in a table is
one about which that specification says nothing.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from burnish.stdlib.builtins.accuracy import Platform


@dataclass(frozen=True)
class Table:
    """The promises of one specification, by the names of Burnish's builtins."""

    document: str
    section: str
    correctly_rounded: str = ""
    ulp: Mapping[str, float] = field(default_factory=dict)
    """The error in units in the last place; for an operand of the given magnitude, if the
    specification makes it depend on that."""
    ulp_by_operand: Mapping[str, float] = field(default_factory=dict)
    relative: Mapping[str, float] = field(default_factory=dict)
    absolute: Mapping[str, tuple[float, float, float]] = field(default_factory=dict)
    """An absolute error, and between which operands it is meant."""
    inherited: Mapping[str, str] = field(default_factory=dict)
    at_least: Mapping[str, float] = field(default_factory=dict)
    """Absolute errors that are allowed even where the inherited error is less."""
    by_equation: str = ""
    """Functions that the specification defines by an equation of these operations, outside of its
    table. They inherit their error from it."""


PI = 3.141592653589793

_EXPONENTIALS = {"exp": 3.0, "exp2": 3.0}
_BY_EXPONENT = {"exp": 2.0, "exp2": 2.0}
_NEAR_ONE = {"log": (2.0**-21, 0.5, 2.0), "log2": (2.0**-21, 0.5, 2.0)}
_OUTSIDE = {"log": 3.0, "log2": 3.0}
_KHRONOS = {"sqrt": "1 / inversesqrt(x)", "pow": "exp2(y * log2(x))", "fma": "x * y + z"}
_SHARED = {
    **_KHRONOS,
    "tan": "sin(x) / cos(x)",
    "asin": "atan2(x, sqrt(1 - x * x))",
    "acos": "atan2(sqrt(1 - x * x), x)",
    "sinh": "(exp(x) - exp(-x)) * 0.5",
    "cosh": "(exp(x) + exp(-x)) * 0.5",
    "tanh": "sinh(x) / cosh(x)",
    "asinh": "log(x + sqrt(x * x + 1))",
    "acosh": "log(x + sqrt(x * x - 1))",
    "atanh": "log((1 + x) / (1 - x)) * 0.5",
    "length": "sqrt(dot(x, x))",
    "distance": "length(x - y)",
    "mix": "x * (1 - z) + y * z",
    "reflect": "x - 2 * dot(x, y) * y",
    "smoothstep": "t * t * (3 - 2 * t)",
    "radians": "x * 0.01745329",
    "degrees": "x * 57.29578",
    "dot": "the sum of x[i] * y[i]",
    "cross": "x[i] * y[j] - x[j] * y[i]",
    "refract": "z * x - (z * dot(y, x) + sqrt(k)) * y",
    "faceforward": "dot(z, y) < 0 ? x : -x",
}
_EQUATIONS = (
    "mod fract mix smoothstep radians degrees sinh cosh tanh dot cross length distance normalize "
    "reflect refract faceforward"
)
"""The builtins of chapter 8 of both specifications of GLSL."""

TABLES: Mapping[Platform, Table] = {
    "wgsl": Table(
        "WebGPU Shading Language, gpuweb at da251f90",
        "Accuracy of Concrete Floating Point Expressions",
        "add sub mul neg abs ceil clamp floor ldexp max min round sign saturate step trunc "
        "to_float",
        ulp={
            "div": 2.5, "inversesqrt": 2.0, "atan": 4096.0, "atan2": 4096.0,
            **_EXPONENTIALS, **_OUTSIDE,
        },
        ulp_by_operand=_BY_EXPONENT,
        absolute={"sin": (2.0**-11, -PI, PI), "cos": (2.0**-11, -PI, PI), **_NEAR_ONE},
        inherited={**_SHARED, "fract": "x - floor(x)", "normalize": "x / length(x)"},
        at_least={"asin": 6.81e-5, "acos": 6.77e-5, "tanh": 1.0e-5},
        # `x % y` cuts the quotient, so Burnish writes the equation itself.
        by_equation="mod",
    ),
    "vulkan": Table(
        "Vulkan 1.4.360",
        "Precision of Core SPIR-V Instructions; Precision of GLSL.std.450 Instructions",
        "add sub mul neg abs ceil clamp saturate floor fract ldexp max min round sign step trunc "
        "outer ddx ddy to_float",
        ulp={
            "div": 2.5, "inversesqrt": 2.0, "atan": 4096.0, "atan2": 4096.0,
            **_EXPONENTIALS, **_OUTSIDE,
        },
        ulp_by_operand=_BY_EXPONENT,
        absolute={"sin": (2.0**-11, -PI, PI), "cos": (2.0**-11, -PI, PI), **_NEAR_ONE},
        inherited={
            **_SHARED, "normalize": "x * inversesqrt(dot(x, x))", "mod": "x - y * floor(x / y)",
        },
    ),
    "direct3d": Table(
        "Direct3D 11.3 functional specification",
        "3.1.3 32-bit floating point; 3.2.2 conversions; 22.10.6 exp, 22.10.7 frc, 22.10.8 log, "
        "22.10.19 rsq, 22.10.20 sincos, 22.10.21 sqrt",
        "add sub mul to_float",
        ulp={"sqrt": 1.0},
        relative={"exp2": 2.0**-21, "log2": 2.0**-21, "inversesqrt": 2.0**-21},
        absolute={
            "sin": (0.0008, -100 * PI, 100 * PI),
            "cos": (0.0008, -100 * PI, 100 * PI),
            "log2": (2.0**-21, 0.5, 2.0),
        },
        by_equation="div fract",
    ),
    "opengl": Table(
        "OpenGL Shading Language 4.60",
        "4.7.1 Range and Precision",
        "add sub mul to_float",
        ulp={"div": 2.5, "inversesqrt": 2.0, **_EXPONENTIALS, **_OUTSIDE},
        ulp_by_operand=_BY_EXPONENT,
        absolute=_NEAR_ONE,
        inherited=_KHRONOS,
        by_equation=_EQUATIONS,
    ),
    "es": Table(
        "OpenGL ES Shading Language 3.20",
        "4.7.1 Range and Precision",
        "add sub mul to_float",
        ulp={"div": 2.5, "inversesqrt": 2.0, **_EXPONENTIALS, **_OUTSIDE},
        ulp_by_operand=_BY_EXPONENT,
        absolute=_NEAR_ONE,
        inherited=_KHRONOS,
        by_equation=_EQUATIONS,
    ),
}  # fmt: skip
