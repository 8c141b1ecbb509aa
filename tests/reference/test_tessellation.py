"""Patches are divided as Direct3D specifies, and as Mesa does it, to the last bit."""

from __future__ import annotations

import json
import math
import random
import subprocess
import sys
from collections import Counter
from typing import Any, get_args

import numpy as np
import pytest

from burnish.compiler.ir.tessellation import Spacing
from burnish.compiler.reference import tessellation
from burnish.compiler.reference.tessellation import ONE, Pattern

KINDS = ("triangle", "quad", "isolines")
SPACINGS: tuple[Spacing, ...] = get_args(Spacing)
CASES = 120
"""Patches of each kind that are compared with Mesa's."""
LEVELS = (1.0, 1.0, 2.0, 3.0, 4.0, 5.0, 0.0, math.inf, 63.0, 64.0)


def divided(kind: str, spacing: Spacing, edges: Any, inside: Any) -> Pattern:
    match kind:
        case "triangle":
            return tessellation.triangle(edges[:3], inside[0], spacing)
        case "quad":
            return tessellation.quad(edges, inside, spacing)
        case _:
            return tessellation.isolines(edges[0], edges[1], spacing)


def cells(pattern: Pattern) -> list[list[tuple[int, ...]]]:
    return [[pattern.places[point] for point in cell] for cell in pattern.cells]


def level(chance: random.Random) -> float:
    some = (chance.choice(LEVELS), chance.uniform(0.3, 8), chance.uniform(1, 70))
    return float(np.float32(chance.choice(some)))


def cases(kind: str, seed: int) -> list[Any]:
    chance = random.Random(seed)
    return [
        (kind, chance.choice(SPACINGS), [level(chance) for _ in range(4)],
         [level(chance) for _ in range(2)])
        for _ in range(CASES)
    ]  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_mesa_divides_patches_in_the_same_way(kind: str) -> None:
    asked = cases(kind, seed=1)
    answer = subprocess.run(
        [sys.executable, "-m", "burnish.tests.reference.mesa_tessellator"],
        input=json.dumps(asked).replace("Infinity", "1e30"),
        capture_output=True, text=True, timeout=300, check=True,
    )  # fmt: skip
    for case, drawn in zip(asked, json.loads(answer.stdout), strict=True):
        own = cells(divided(*case))
        assert own == [[tuple(point) for point in cell] for cell in drawn], case


@pytest.mark.parametrize("spacing", SPACINGS)
@pytest.mark.parametrize("kind", ["triangle", "quad"])
def test_triangles_cover_the_patch_once(kind: str, spacing: Spacing) -> None:
    """Each edge inside belongs to two triangles that go along it in opposite directions."""
    chance = random.Random(5)
    for _ in range(40):
        edges, inside = ([chance.uniform(1.1, 20) for _ in range(n)] for n in (4, 2))
        pattern = divided(kind, spacing, edges, inside)
        sides: Counter[tuple[Any, Any]] = Counter()
        area = 0
        for a, b, c in cells(pattern):
            twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            assert twice >= 0
            area += twice
            if twice:
                sides.update([(a, b), (b, c), (c, a)])
        assert area == (ONE * ONE if kind == "triangle" else 2 * ONE * ONE)
        assert set(sides.values()) == {1}
        for a, b in sides:
            if (b, a) not in sides:
                assert _is_at_edge(kind, a, b), (a, b)


def _is_at_edge(kind: str, a: Any, b: Any) -> bool:
    ends = (0,) if kind == "triangle" else (0, ONE)
    lanes = 3 if kind == "triangle" else 2
    return any(a[i] == b[i] and a[i] in ends for i in range(lanes))


@pytest.mark.parametrize("spacing", SPACINGS)
def test_an_edge_looks_alike_from_both_of_its_patches(spacing: Spacing) -> None:
    """The places on an edge depend on the edge's level only, from either end: no cracks."""
    chance = random.Random(8)
    for _ in range(40):
        own = chance.uniform(1, 64)
        found = []
        for _ in range(2):
            others = [chance.uniform(1, 20) for _ in range(4)]
            pattern = tessellation.triangle([own, others[0], others[1]], others[2], spacing)
            found.append({place[1] for place in pattern.places if place[0] == 0})
        assert found[0] == found[1] == {ONE - place for place in found[0]}


@pytest.mark.parametrize("wrong", [0.0, -1.0, math.nan])
@pytest.mark.parametrize("kind", KINDS)
def test_a_patch_with_an_edge_without_a_level_is_not_drawn(kind: str, wrong: float) -> None:
    for edge in range(2):
        edges = [3.0] * 4
        edges[edge] = wrong
        assert not divided(kind, "equal", edges, [3.0, 3.0]).cells


def test_levels_beyond_the_range_are_clamped() -> None:
    most = tessellation.quad([64.0] * 4, [64.0] * 2, "equal")
    assert tessellation.quad([1e9] * 4, [math.inf] * 2, "equal") == most
    assert len(most.cells) == 2 * 64 * 64
    even = tessellation.triangle([0.1] * 3, -5.0, "fractional_even")
    assert even == tessellation.triangle([2.0] * 3, 2.0, "fractional_even")
    assert tessellation.triangle([3.0] * 3, math.nan, "equal") == tessellation.triangle(
        [3.0] * 3, 1.0, "equal"
    )
