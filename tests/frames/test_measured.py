"""Kernels that measure in a buffer what passes have drawn: what the reference makes of it."""

from __future__ import annotations

import numpy as np

from burnish.targets.runner.frames.by_reference import ReferenceFrames
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row

from .kit import of_text

MEAN = """
import std.frames.{FullScreen}

pass Stripes : FullScreen { target color : r32f = if uv.x < 0.25 then 0.5 else 0.125 }

kernel Mean {
    map source : texture2d with { filter = nearest, mip = none }
    result mean : float[1] = (sum i in 0..4 : source.load(ivec2(i, 0)).x) / 4
}

pass Shown : FullScreen {
    buffer means : float[]
    target color : r32f = means[0]
}

frame Measured {
    drawn = Stripes(screen)
    mean  = Mean() with { source = drawn.color }
    shown = Shown(screen) with { means = mean.mean }
    output picture = shown.color
}
"""


def test_a_buffer_has_what_its_kernel_finds_in_a_drawn_texture() -> None:
    drawing = ReferenceFrames(FrameHost(of_text(MEAN), in_a_row([], {}, "sphere"), (4, 4)))
    drawing.draw()
    shown = drawing.output("picture").levels[0][0, 0, :, :, 0]
    assert np.array_equal(shown, np.full((4, 4), (0.5 + 3 * 0.125) / 4))
