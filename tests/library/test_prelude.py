"""What every file sees: the changes from pixel to pixel, the rig of files without one, frames."""

from __future__ import annotations

import numpy as np
import pytest

from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.evaluate import evaluate
from burnish.targets.runner.frames.by_reference import ReferenceFrames
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row

from ..frames.kit import of_text
from ..semantics.kit import leaves, shader
from .kit import MESH, NORMAL_IN_WORLD, close, shown
from .truth import truth


@truth("std.prelude.fwidth")
def test_changes_in_both_directions_are_added() -> None:
    """In a quad of pixels, ``uv`` changes by -0.25 across and by 0.125 down."""
    whole = shader("material M { color = vec3(fwidth(uv.x), fwidth(-2 * uv)) }")
    u = np.array([[[0.75, 0.5], [0.875, 0.625]]])
    v = np.array([[[0.1, 0.1], [0.6, 0.6]]])
    (target,) = whole.results_of(TARGET)
    crossing = leaves(whole, {**MESH, "vertex_uv": (u, v)})
    found = evaluate(target.value, crossing, np)
    assert [float(np.ravel(lane)[0]) for lane in found[:3]] == close((0.375, 0.75, 1.0))


@truth("std.prelude.Surface", "std.prelude.Forward")
def test_a_surface_without_equations_is_grey() -> None:
    assert shown("material M {}") == close((0.8, 0.8, 0.8))


@truth("std.prelude.Daylight", "std.prelude.Light")
def test_a_file_without_a_rig_is_lit_from_above() -> None:
    found = shown("import std.terms.{lambert}\nmaterial M { color = lambert(vec3(0.25, 0.5, 1)) }")
    assert found == close(NORMAL_IN_WORLD[1] * np.array((0.25, 0.5, 1)))


@truth("std.prelude.Viewport")
def test_a_frame_knows_the_size_of_its_picture_and_its_number() -> None:
    text = """
    import std.frames.{FullScreen}
    pass Told : FullScreen {
        param told : vec4
        target t : rgba32f = told
    }
    frame F {
        told = Told(screen) with { told = vec4(vec2(size), float(number), 1) }
        output t = told.t
    }
    """
    drawing = ReferenceFrames(FrameHost(of_text(text), in_a_row([], {}, "sphere"), (6, 4)))
    for number in range(2):
        drawing.draw()
        (level,) = drawing.output("t").levels
        assert level[0].shape[1:3] == (4, 6)
        assert level[0, 0, 0, 0] == pytest.approx((6, 4, number, 1))
