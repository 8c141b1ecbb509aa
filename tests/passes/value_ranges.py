"""Evaluates programs, and compares each value with what range analysis knows about it."""

from __future__ import annotations

import math
import struct
from typing import Any

from burnish.compiler.ir.node import Node
from burnish.compiler.ir.ranges import Ranges
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.types import Scalar, Vector
from burnish.compiler.passes.open_binders import open_binders
from burnish.compiler.reference.evaluate import Evaluator
from burnish.compiler.reference.namespace import Lanes
from burnish.stdlib.builtins.facts import SMALLEST_NORMAL, UNIT, Fact

from .hardware import flat
from .kit import Alike, World

LARGEST = 3.4028234663852886e38


def to_float32(value: Any) -> Any:
    """Every lane rounded as a device does."""
    if isinstance(value, tuple):
        return tuple(map(to_float32, value))
    if not isinstance(value, float) or not abs(value) <= LARGEST:
        return value
    return struct.unpack("f", struct.pack("f", value))[0]


def holds(fact: Fact, lanes: list[float]) -> bool:
    """True if all that a fact says is true of some float64 lanes, or of float32 ones.

    Rounding never changes the order of two values, so float32 lanes keep to the rounded bounds.
    """
    lo, hi = (min(fact.lo, to_float32(fact.lo)), max(fact.hi, to_float32(fact.hi)))
    return (
        all(lo <= lane <= hi for lane in lanes)
        and (not fact.nonzero or all(abs(lane) >= SMALLEST_NORMAL for lane in lanes))
        and (not fact.unit or math.hypot(*lanes) <= UNIT.hi)
        and math.hypot(*lanes) >= _certain_length(fact)
    )


def _certain_length(fact: Fact) -> float:
    """The length that float32 lanes have at least; nothing is certain of subnormal numbers."""
    return fact.length * (1 - 1e-6) if fact.length >= SMALLEST_NORMAL else 0.0


class OverflowedError(Exception):
    """A value left float32, after which nothing is claimed."""


def broken(given_shader: Shader, world: World, *, single: bool) -> list[str]:
    """The values that lie outside, with every operation rounded to float32 if ``single``."""
    roots = given_shader.roots
    roots = open_binders(given_shader.graph, roots, given_shader.notes)
    ranges = Ranges(roots)
    found: list[str] = []

    def check(node: Node, _operands: list[Lanes], value: Lanes) -> Lanes:
        value = to_float32(value) if single else value
        if not isinstance(node.type, Scalar | Vector):
            return value
        lanes = list(flat(value))
        if not all(abs(lane) <= LARGEST for lane in lanes):
            raise OverflowedError
        if not holds(ranges.of(node), lanes):
            found.append(f"{node} is {lanes}, not {ranges.of(node)}")
        return value

    try:
        evaluator = Evaluator(world, Alike(), check)
        for root in roots:
            evaluator.value(root)
    except OverflowedError:
        return found
    return found
