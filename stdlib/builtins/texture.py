"""Reads of textures."""

from __future__ import annotations

from .row import Accuracy, Builtin

ROWS = (
    Builtin(
        name="sample",
        signatures=("texture2d, vec2 -> vec4",),
        meaning="numbers",
        doc="The texture's colour at a coordinate, filtered; the level of detail is implicit.",
        accuracy=Accuracy("filtering", "the device's subtexel and mip bits"),
        cost=16,
        uniform_control_flow=True,
    ),
)
