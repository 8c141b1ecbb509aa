"""Edges that rounding may move are decided where every device discards what it draws."""

from __future__ import annotations

import pytest

from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.picture import RasterRules

from .kit import geometry, picture, shader

SIZE = 16
EDGE = 4.5 + 0.5 / 256
"""Where the left side is, in pixels: in the middle between two places of the grid, of which one
covers the middles of the pixels in the fifth column."""


@pytest.mark.parametrize(("share", "undecided"), [(0.5, 0), (0.0, SIZE)])
def test_what_all_devices_discard_leaves_nothing_undecided(share: float, undecided: int) -> None:
    left = EDGE / (SIZE / 2) - 1
    square = geometry(
        [[0, 1, 2], [0, 2, 3]],
        vertex_position=[[left, -1, 0], [1, -1, 0], [1, 1, 0], [left, 1, 0]],
        vertex_uv=[[0, 0], [1, 0], [1, 1], [0, 1]],
    )
    drawn = shader(
        "material M {\nclip_position = (vec4(vertex_position, 1.0) as point<clip>)\n"
        "color = vec3(1.0)\n}\n"
        f"pass Cut : Forward {{ discard when vertex_uv.x < {share} - 0.1 }}",
        "Cut",
    )
    found = picture(drawn, square, RasterRules(SIZE, SIZE, 8), errors=Errors(("vulkan",)))
    assert found.undecided.sum() == undecided
    assert found.covered[:, SIZE - 1].all()
