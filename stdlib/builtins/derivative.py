"""Rows for derivatives: how a value changes from pixel to pixel."""

from __future__ import annotations

from .row import Accuracy, Builtin

DIFFERENCE = Accuracy(
    "correct, of a neighbour in the 2×2 quad that the device chooses", "WGSL, Derivative Builtins"
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
