"""Rows for conversions between types of lanes, which the language writes as ``int(x)``."""

from __future__ import annotations

import math

from .accuracy import CORRECT, EXACT
from .facts import Fact
from .intervals import monotone
from .row import Builtin

LARGEST_INT = 2147483520.0
"""The largest float32 that fits an ``int``; the conversion clamps to it, as WGSL's does."""
LARGEST_UINT = 4294967040.0
"""The largest float32 that fits a ``uint``."""
_LOWEST_INT = -2147483648.0


def _signatures(target: str, *sources: str) -> tuple[str, ...]:
    """Signatures that convert each width of each source scalar to the same width of the target."""
    prefix = {"float": "", "int": "i", "uint": "u", "bool": "b"}
    return tuple(
        f"{source} -> {target}"
        if width == 1
        else f"{prefix[source]}vec{width} -> {prefix[target]}vec{width}"
        for source in sources
        for width in (1, 2, 3, 4)
    )


def _cut(x: Fact, lo: float, hi: float) -> Fact:
    return monotone(lambda bound: float(math.trunc(min(max(bound, lo), hi))), x)


def _as_float(facts: tuple[Fact, ...], _same: bool) -> Fact:
    return monotone(float, facts[0]).as_kind("float")


def _as_int(facts: tuple[Fact, ...], _same: bool) -> Fact:
    (x,) = facts
    return (_cut(x, _LOWEST_INT, LARGEST_INT) if x.kind == "float" else x).as_kind("int")


def _as_uint(facts: tuple[Fact, ...], _same: bool) -> Fact:
    (x,) = facts
    return (_cut(x, 0.0, LARGEST_UINT) if x.kind == "float" else x).as_kind("uint")


def _fits_int(facts: tuple[Fact, ...]) -> bool:
    (x,) = facts
    return x.kind != "float" or x.within(_LOWEST_INT, LARGEST_INT)


def _fits_uint(facts: tuple[Fact, ...]) -> bool:
    (x,) = facts
    return x.kind != "float" or x.within(0.0, LARGEST_UINT)


ROWS = (
    Builtin(
        name="to_float",
        signatures=_signatures("float", "int", "uint", "bool"),
        meaning="numbers",
        doc="The nearest float; 1 for true, 0 for false.",
        range=_as_float,
        accuracy=CORRECT,
    ),
    Builtin(
        name="to_int",
        signatures=_signatures("int", "float", "uint", "bool"),
        meaning="numbers",
        doc="A float truncated towards zero, the 32 bits of a uint, 1 for true or 0 for false.",
        domain=_fits_int,
        needs="the number fits an int",
        outside="A float is clamped to the floats that fit, -2147483648 to 2147483520.",
        expansion="to_int",
        range=_as_int,
        accuracy=EXACT,
        samples=((1.9,), (-1.9,), (3e9,), (-3e9,)),
    ),
    Builtin(
        name="to_uint",
        signatures=_signatures("uint", "float", "int", "bool"),
        meaning="numbers",
        doc="A float truncated towards zero, the 32 bits of an int, 1 for true or 0 for false.",
        domain=_fits_uint,
        needs="the number fits a uint",
        outside="A float is clamped to the floats that fit, 0 to 4294967040.",
        expansion="to_uint",
        range=_as_uint,
        accuracy=EXACT,
        samples=((1.9,), (-1.0,), (5e9,)),
    ),
)
