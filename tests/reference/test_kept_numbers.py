"""Draws that keep numbers for each other have the same bounds as single ones, bit for bit."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np
import pytest

from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.kept_numbers import KeptNumbers
from burnish.compiler.reference.picture import Canvas, draw_onto, written_by

from .kit import few_ulps
from .test_drawing import at, passing, triangles

PIXELS = 16
CORNERS = [(3.0, 20.0, 0.5, 1.0), (-20.0, 0.0, 0.5, 1.0), (3.0, -20.0, 0.5, 1.0)]
PLACES = [(0.0, 0.1), (1.0, 0.2), (0.3, 0.9)]
TURNS = 8
LOOP = passing(
    "attribute s : vec2\nparam rough : float = 0.5\n"
    f"turned = iterate t from s.x for i in 0..{TURNS} :"
    " t * cos(float(i) * 0.7 + rough) + (sin(rough) - float(i) * sin(rough))\n"
    f"still = iterate x from rough for i in 0..{TURNS} : x + 0.25 * (sin(rough) - x)\n"
    "value = vec4(turned, still, s.y * rough, 1)"
)
"""A loop that reads what is the same for all pixels in each turn, and one with such a state."""


def drawn(rough: float, errors: Errors | None, kept: KeptNumbers | None) -> list[bytes]:
    """The pixels with their bounds, as bytes."""
    canvas = Canvas(PIXELS, [(0.0,) * 4], written_by(LOOP), rounds=errors is not None)
    mesh = triangles(CORNERS, s=PLACES)
    draw_onto(canvas, LOOP, {"rough": (rough,)}, {}, mesh, at(), errors, kept=kept)
    return [np.asarray(ends).tobytes() for ends in canvas.targets]


@pytest.mark.parametrize("errors", [few_ulps, None], ids=["with bounds", "as meant"])
def test_bounds_are_those_of_a_draw_by_itself(errors: Any) -> None:
    kept = KeptNumbers()
    for rough in (0.25, 0.25, 0.75, 0.25, -0.0, 0.0):
        assert drawn(rough, errors, kept) == drawn(rough, errors, None), rough


def test_what_all_pixels_have_in_common_is_computed_once() -> None:
    asked: Counter[str] = Counter()

    def counting(name: str, operand: Any, result: Any) -> Any:
        asked[name] += 1
        return few_ulps(name, operand, result)

    kept, errors = KeptNumbers(), counting
    counts = []
    for rough in (0.25, 0.25, 0.75):
        drawn(rough, errors, kept)  # type: ignore[arg-type]
        counts.append(asked["cos"])
    assert counts == [TURNS, TURNS, 2 * TURNS]
