"""Whatever a program computes lies within what range analysis knows of it."""

from __future__ import annotations

import math
import struct
from typing import Any

import pytest
from hypothesis import HealthCheck, given, note, reject, settings
from hypothesis import strategies as st

from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.ranges import Ranges
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.types import Scalar, Vector
from burnish.compiler.passes.open_binders import open_binders
from burnish.compiler.reference.evaluate import Evaluator
from burnish.compiler.reference.namespace import Lanes
from burnish.stdlib.builtins.facts import SMALLEST_NORMAL, UNIT, Fact

from .hardware import flat
from .kit import World, shader
from .programs import programs

SLOW = (HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.filter_too_much)
LARGEST = 3.4028234663852886e38


def to_float32(value: Any) -> Any:
    """Every lane rounded as a device does."""
    if isinstance(value, tuple):
        return tuple(map(to_float32, value))
    if not isinstance(value, float) or not abs(value) <= LARGEST:
        return value
    return struct.unpack("f", struct.pack("f", value))[0]


def holds(fact: Fact, lanes: list[float]) -> bool:
    """Whether all that a fact says is true of some float64 lanes, or of float32 ones.

    Rounding never changes the order of two values, so float32 lanes keep to the rounded bounds.
    """
    lo, hi = (min(fact.lo, to_float32(fact.lo)), max(fact.hi, to_float32(fact.hi)))
    return (
        all(lo <= lane <= hi for lane in lanes)
        and (not fact.nonzero or all(abs(lane) >= SMALLEST_NORMAL for lane in lanes))
        and (not fact.unit or math.hypot(*lanes) <= UNIT.hi)
        and (not fact.length or math.hypot(*lanes) >= fact.length * (1 - 1e-6))
    )


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
        evaluator = Evaluator(world, observer=check)
        for root in roots:
            evaluator.value(root)
    except OverflowedError:
        return found
    return found


@pytest.mark.parametrize("single", [False, True], ids=["float64", "float32"])
@settings(max_examples=40, suppress_health_check=SLOW)
@given(text=programs(), seed=st.integers(0, 2**16), traps=st.booleans())
def test_values_of_random_programs_lie_within_their_facts(
    single: bool, text: str, seed: int, traps: bool
) -> None:
    note(text)
    try:
        given_shader = shader(text)
    except CompileError:
        reject()
    assert not broken(given_shader, World(seed, traps), single=single)


def test_a_fact_that_does_not_hold_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    given_shader = shader("material M { color = vec3(uv.x * 2) }")
    monkeypatch.setattr(Ranges, "of", lambda _self, _node: Fact(7.0, 8.0))
    assert broken(given_shader, World(1), single=True)
