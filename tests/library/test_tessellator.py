"""The tessellator of the library divides patches as the reference's does, vertex by vertex.

The reference's is held against Mesa's in ``tests/reference/test_tessellation.py``.
"""

from __future__ import annotations

import random

import numpy as np
import pytest

from burnish.compiler.ir.stages import STORE
from burnish.compiler.reference.evaluate import evaluate
from burnish.compiler.reference.namespace import Lanes
from burnish.compiler.reference.tessellation import ONE

from ..reference.test_tessellation import SPACINGS, cells, divided, level
from ..semantics.kit import leaves, shader
from .truth import truth

CALLS = {
    "triangle": "triangle_vertex(edges.xyz, insides.x, {spacing}, index)",
    "quad": "quad_vertex(edges, insides, {spacing}, index)",
    "isolines": "line_vertex(edges.xy, {spacing}, index)",
}
MORE = 9
"""Vertices that are asked for beyond those that there are."""
RANDOM = 4
"""Patches of each kind and spacing whose levels are drawn by chance."""


def vertices(kind: str, spacing: int, edges: Lanes, insides: Lanes, count: int) -> list[Lanes]:
    """The place of each vertex, and 1 behind it where there is one."""
    call = CALLS[kind].format(spacing=spacing)
    made = shader(
        f"""
        import std.tessellator
        kernel Points {{
            param edges   : vec4
            param insides : vec2
            found = {call}
            result points : vec4[1] = vec4(found.place, float(int(found.there)))
        }}
        """
    )
    (stored,) = made.results_of(STORE)
    known = leaves(made, {"edges": edges, "insides": insides, "index": (np.arange(count),)})
    lanes = evaluate(stored.value, known, np)
    return list(zip(*(np.broadcast_to(lane, count).tolist() for lane in lanes), strict=True))


def levels(seed: str) -> list[tuple[Lanes, Lanes]]:
    """The levels of edges, and of insides: of an undivided patch, of some of which one edge or one
    direction alone is divided, of some with a hidden edge, and any."""
    chance = random.Random(seed)
    ones, pair = (1.0,) * 4, (1.0,) * 2
    single = [tuple(3.0 if edge == i else 1.0 for edge in range(4)) for i in range(4)]
    hidden = [tuple(0.0 if edge == i else 2.0 for edge in range(4)) for i in range(4)]
    return [
        (ones, pair), ((0.5,) * 4, (0.5,) * 2), (ones, (3.0, 1.0)), (ones, (1.0, 3.0)),
        *((edges, pair) for edges in single), *((edges, (2.0, 2.0)) for edges in hidden),
        *(
            (tuple(level(chance) for _ in range(4)), tuple(level(chance) for _ in range(2)))
            for _ in range(RANDOM)
        ),
    ]  # fmt: skip


@truth(*(f"std.tessellator.{name}" for name in ("triangle_vertex", "quad_vertex", "line_vertex")))
@pytest.mark.parametrize("spacing", SPACINGS)
@pytest.mark.parametrize("kind", CALLS)
def test_vertices_lie_where_the_reference_has_them(kind: str, spacing: str) -> None:
    for edges, insides in levels(f"{kind} {spacing}"):
        pattern = divided(kind, SPACINGS[SPACINGS.index(spacing)], edges, insides)
        expected = [point for cell in cells(pattern) for point in cell]
        count = len(expected) + MORE
        found = vertices(kind, SPACINGS.index(spacing), edges, insides, count)
        assert [there for *_, there in found] == [1] * len(expected) + [0] * MORE
        got = [tuple(ONE * lane for lane in place) for *place, _ in found[: len(expected)]]
        assert got == expected, (edges, insides)
