"""The largest errors of operations on each platform, as data.

Every builtin's row has an ``Accuracy``: what the specification of each platform promises of the
float32 operation, or what is assumed where the specification is silent. The reference computes
error bounds from it (``compiler/reference/bounds/errors.py``), and the manual shows it.
``tests/builtins/specifications.py`` has the tables of the specifications themselves, with which the
rows are compared.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Literal

from ...support.frozen import EMPTY, frozen

Platform = Literal["wgsl", "vulkan", "direct3d", "opengl", "es"]

PLATFORMS: Mapping[Platform, str] = MappingProxyType(
    {
        "wgsl": "WGSL",
        "vulkan": "Vulkan",
        "direct3d": "Direct3D",
        "opengl": "OpenGL",
        "es": "OpenGL ES",
    }
)
"""The specifications that say how accurate operations are, with their names in the manual."""

SECTIONS: Mapping[Platform, str] = {
    "wgsl": "section Accuracy of Concrete Floating Point Expressions",
    "vulkan": "appendix Vulkan Environment for SPIR-V, section Precision and Operation",
    "direct3d": "Direct3D 11.3 functional specification, 3.1.3",
    "opengl": "GLSL 4.60, 4.7.1 Range and Precision (assumed of 3.30, which has no such table)",
    "es": "GLSL ES 3.20, 4.7.1 Range and Precision (assumed of 3.00, which has no such table)",
}
"""The place of the table of each platform."""


INTERPOLATED_BITS = 16
"""Binary places to which a value between vertices is exact, relative to the largest at a vertex.

This is assumed of all platforms, as none promises anything. It is less than what is known of any
device; those whose precision is known better have it in ``targets/conformance/drivers.py``."""


@frozen
class Error:
    """A largest error. It is the sum of its parts, of which most errors have only one."""

    ulp: float = 0.0
    """Units in the last place of the result."""
    ulp_by_operand: float = 0.0
    """Further units in the last place, for each unit of the operand's magnitude."""
    relative: float = 0.0
    """The error as a part of the result."""
    absolute: float = 0.0
    absolute_by_operand: float = 0.0
    """Further absolute error, for each unit of the operand's magnitude."""

    def __str__(self) -> str:
        by_operand = f" + {_number(self.ulp_by_operand)} * |x|" if self.ulp_by_operand else ""
        ulp = f"({_number(self.ulp)}{by_operand}) ulp" if by_operand else f"{_number(self.ulp)} ulp"
        parts = (
            (self.ulp or self.ulp_by_operand, ulp),
            (self.relative, f"{_part(self.relative)} result"),
            (self.absolute, _number(self.absolute)),
            (self.absolute_by_operand, f"{_number(self.absolute_by_operand)} * |x|"),
        )
        return " + ".join(text for part, text in parts if part)


@frozen
class Exact:
    """The result is the only possible one: an integer, a bit pattern, one of the operands."""

    def __str__(self) -> str:
        return "exact"


@frozen
class Rounded:
    """The result is one of the two float32 numbers around the exact one, or equal to it."""

    def __str__(self) -> str:
        return "correctly rounded"


@frozen
class Within:
    """The error has a largest value, which may be another one beyond some magnitude."""

    error: Error
    limit: float = math.inf
    """The largest magnitude for which the error is this one."""
    of: Literal["operand", "result"] = "operand"
    """The value whose magnitude is compared."""
    beyond: Error = Error()
    """The error where the magnitude is larger than the limit."""

    def __str__(self) -> str:
        if self.limit == math.inf:
            return str(self.error)
        limit = f"{_LIMITS.get(self.limit) or _number(self.limit)}"
        where = f"|x| <= {limit}" if self.of == "operand" else f"results up to {limit}"
        return f"{self.error} for {where}, else {self.beyond}"


@frozen
class Inherited:
    """The error is that of an expression in simpler operations."""

    definition: str = ""
    """The expression; empty if it is the builtin's own definition or expansion."""
    at_least: float = 0.0
    """An absolute error that is allowed in any case."""

    def __str__(self) -> str:
        inherited = f"inherited from `{self.definition}`" if self.definition else "inherited"
        return f"{inherited}, or {_number(self.at_least)}" if self.at_least else inherited


Bound = Exact | Rounded | Within | Inherited


@frozen
class Promise:
    """The promise of one platform, and its source."""

    bound: Bound
    source: str
    """The section of the specification that says it, or the reason to assume it."""
    assumed: bool = False
    """True if the specification is silent."""
    beyond_assumed: str = ""
    """If the specification is silent beyond the limit of ``Within``: the reason to assume that."""


@frozen
class Accuracy:
    """The promises of all platforms."""

    wgsl: Promise
    vulkan: Promise
    direct3d: Promise
    opengl: Promise
    es: Promise

    def on(self, platform: Platform) -> Promise:
        """The promise of one platform."""
        promise: Promise = getattr(self, platform)
        return promise


def promised(
    bound: Bound, others: Mapping[Platform, Promise] = EMPTY, *, beyond_assumed: str = ""
) -> Accuracy:
    """The accuracy that all platforms but ``others`` promise in their tables."""
    tables = {
        platform: Promise(bound, section, beyond_assumed=beyond_assumed)
        for platform, section in SECTIONS.items()
    }
    return Accuracy(**{**tables, **others})


def in_table(
    platform: Platform, bound: Bound, *, beyond_assumed: str = ""
) -> Mapping[Platform, Promise]:
    """The promise of one platform in its table, other than that of the others."""
    return {platform: Promise(bound, SECTIONS[platform], beyond_assumed=beyond_assumed)}


def in_section(
    bound: Bound, section: str, *, beyond_assumed: str = ""
) -> Mapping[Platform, Promise]:
    """The promise of Direct3D's specification in a section of its own."""
    source = f"Direct3D 11.3 functional specification, {section}"
    return {"direct3d": Promise(bound, source, beyond_assumed=beyond_assumed)}


def silent(bound: Bound, reason: str, *platforms: Platform) -> Mapping[Platform, Promise]:
    """The assumption about platforms whose specifications are silent, with the reason."""
    return {platform: Promise(bound, reason, assumed=True) for platform in platforms}


def _part(value: float) -> str:
    return "the whole" if value == 1.0 else f"{_number(value)} of the"


def _number(value: float) -> str:
    """A number; small powers of two as such."""
    mantissa, exponent = math.frexp(value)
    is_power = mantissa == 0.5 and not -4 < exponent <= 13
    return f"2^{exponent - 1}" if is_power else f"{value:g}"


_LIMITS: Mapping[float, str] = {
    math.pi: "pi",
    100 * math.pi: "100 * pi",
    math.log(2.0): "ln 2",
}
"""Limits that are shown by name."""

_NO_WORD = "a whole number, an operand or a sign is exact everywhere"
_WRITTEN_OUT = "HLSL's compiler writes it out with instructions whose accuracy is promised"

CORRECT = promised(Rounded())
"""Operators that are correctly rounded on all platforms."""
COMMON = promised(Rounded(), silent(Rounded(), _NO_WORD, "direct3d", "opengl", "es"))
"""Functions that return a whole number, an operand or a sign."""
EXACT = promised(Exact())
"""Integers, conditions, bit patterns, and values that are only moved to another place."""
INHERITED = promised(Inherited(), silent(Inherited(), _WRITTEN_OUT, "direct3d"))
"""Functions that the specifications define by other operations, or that Burnish expands."""


def inherited(definition: str, at_least: float = 0.0, *, direct3d: str = _WRITTEN_OUT) -> Accuracy:
    """A function that all but Direct3D define by the same expression.

    ``at_least`` is an absolute error that WGSL allows in any case, and ``direct3d`` the reason to
    assume the expression there.
    """
    bound = Inherited(definition)
    return promised(
        bound,
        {
            **in_table("wgsl", Inherited(definition, at_least)),
            **silent(bound, direct3d, "direct3d"),
        },
    )
