"""Sizes that only the values of a frame decide, and what is said of those that cannot be."""

from __future__ import annotations

import pytest

from burnish.targets.runner.frames.by_reference import ReferenceFrames
from burnish.targets.runner.frames.checking import PlanError
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row

from .kit import of_text

HEAD = """
import std.frames.{FullScreen}
pass One : FullScreen { target one : rgba16f = vec4(1) }
pass Other : FullScreen { target other : rgba16f = vec4(1) }
pass Both : FullScreen {
    target one   : rgba16f = vec4(1)
    target other : rgba16f = vec4(1)
}
"""


def said(frame: str, **values: str) -> str:
    """The error that is raised when a frame is drawn with some values, as text."""
    host = FrameHost(of_text(f"{HEAD}frame F {{\n{frame}\n}}"), in_a_row([], {}, "sphere"), (8, 8))
    for name, text in values.items():
        host.set_text(name, text)
    with pytest.raises(PlanError) as raised:
        ReferenceFrames(host).draw()
    return str(raised.value)


def test_what_is_drawn_at_once_has_one_size() -> None:
    frame = """
    param width : int in 1..64 = 4
    small = One(screen, 4)
    large = Other(screen, ivec2(width, 4))
    both  = Both(screen, [small, large])
    output picture = both.one"""
    assert said(frame, width="6") == (
        "F, both: it draws to `both.one` with 4 x 4 and `both.other` with 6 x 4 texels: all have "
        "to have one size"
    )


@pytest.mark.parametrize("side", [0, -3, 100_000])
def test_textures_have_sizes_that_devices_have(side: int) -> None:
    frame = """
    param side : int = 4
    one = One(screen, side)
    output picture = one.one"""
    assert said(frame, side=str(side)) == (
        f"one.one: the size would be {side} x {side}, and a side has 1 to 16384 texels"
    )


def test_faces_are_squares() -> None:
    frame = """
    sky = each face in cube : One(screen)
    output picture = sky.one"""
    assert said(frame, size="8,4") == ("sky.one: the faces of a cube are squares, and not 8 x 4")


def test_there_are_no_levels_below_one_texel() -> None:
    frame = """
    param height : int = 2
    chain = each level in mips(5) : One(screen, ivec2(8, height))
    output picture = chain.one"""
    assert said(frame) == "chain.one: there are 5 mip levels, and 8 x 2 texels have 4"
