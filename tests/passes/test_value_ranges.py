"""The comparison of values with the facts of range analysis sees a fact that does not hold.

``tests/fuzz`` compares the values of random programs in this way.
"""

from __future__ import annotations

import math

import pytest

from burnish.compiler.ir.ranges import Ranges
from burnish.stdlib.builtins.facts import Fact

from .kit import World, shader
from .value_ranges import broken


def test_a_fact_that_does_not_hold_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    given_shader = shader("material M { color = vec3(uv.x * 2) }")
    assert not broken(given_shader, World(1), single=True)
    monkeypatch.setattr(Ranges, "of", lambda _self, _node: Fact(7.0, 8.0))
    assert broken(given_shader, World(1), single=True)


def test_no_fact_has_a_zero_with_a_sign() -> None:
    """Calls with equal facts of their operands share one: it must not depend on who asked first."""
    for zero in ("0", "-0"):
        given = shader(f"material M {{ color = vec3(-max(uv.x, {zero}.0) * -saturate(uv.y)) }}")
        ranges = Ranges(given.roots)
        facts = [ranges.of(node) for node in given.roots.nodes]
        ends = [end for fact in facts for end in (fact.lo, fact.hi) if end == 0]
        assert {math.copysign(1.0, end) for end in ends} == {1.0}
