"""Rows for derivatives: how a value changes from pixel to pixel."""

from __future__ import annotations

from .accuracy import Rounded, promised, silent
from .row import Builtin

_SILENT = "the difference of two neighbours in the quad, which the device chooses, is subtracted"
_ANY = "the specification allows any error; that of Vulkan is assumed"
DIFFERENCE = promised(
    Rounded(),
    {
        **silent(Rounded(), _ANY, "wgsl"),
        **silent(Rounded(), _SILENT, "direct3d", "opengl", "es"),
    },
)

ROWS = (
    Builtin(
        name="ddx",
        signatures=("T -> T",),
        meaning="change",
        doc="The difference of `x` to the next pixel on the right, along x of `frag_coord`.",
        accuracy=DIFFERENCE,
        cost=2,
        uniform_control_flow=True,
    ),
    Builtin(
        name="ddy",
        signatures=("T -> T",),
        meaning="change",
        doc="The difference of `x` to the next pixel below, along y of `frag_coord`.",
        accuracy=DIFFERENCE,
        cost=2,
        uniform_control_flow=True,
    ),
)
