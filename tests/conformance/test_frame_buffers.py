"""The errors that a device may make in a buffer that a kernel writes reach all that reads it.

Each frame writes a buffer whose elements rounding may change, and shows it as a picture. If its
elements were taken to be what they mean, no driver would agree; if they could be anything, no
mistake would be noticed.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import burnish
from burnish.api.entry_points import CompiledFrame
from burnish.targets.conformance import frames
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.conformance.summary import details
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row
from burnish.targets.runner.routes import ROUTES
from burnish.targets.web_host.drawing import draw_frames

from .kit import Floats, Studio

SIZE = (16, 4)
"""Each pixel shows one of 64 elements."""
HEAD = """
import std.frames.{FullScreen}
abstract pass Shown : FullScreen {
    here : int = int(frag_coord.x) + 16 * int(frag_coord.y)
    shown : float
    target value : rgba32f = vec4(shown, 0, 0, 1)
}
// A number, and a half; but on which side of 3, 19, 35 and 51 it lies is left to the device.
fn nearly(i: int) -> float = number * (sin(number) * sin(number) + cos(number) * cos(number))
where { number = float(i) + (if i mod 16 == 3 then 0 else 0.5) }
"""
ROUNDED = """
kernel Waves { result waves : float[64] = sin(float(index)) }
pass Seen : Shown { buffer waves : float[]  shown = waves[here] }
frame F {
    made = Waves()
    seen = Seen(screen) with { waves = made.waves }
    output value = seen.value
}
"""
MEMBERS = """
struct Pair { place : vec3  power : float  ways : vec2[3]  on : bvec2 }
kernel Pairs {
    wave = sin(float(index))
    ways = [vec2(5), vec2(6), vec2(7, wave)]
    result pairs : Pair[64] = Pair(vec3(1, 2, wave), 4, ways, bvec2(true))
}
kernel Taken {
    buffer pairs : Pair[]
    pair = pairs[index]
    side = if pair.on.y then pair.place else vec3(pair.power)
    result taken : mat3[64] = pair.ways[2].y * mat3(side, side, side)
}
pass Seen : Shown { buffer taken : mat3[]  shown = taken[here][2].z }
frame F {
    made = Pairs()
    both = Taken() with { pairs = made.pairs }
    seen = Seen(screen) with { taken = both.taken }
    output value = seen.value
}
"""
TIPPING = """
kernel Steps { result steps : Step[64] = Step(nearly(index) < float(index), int(nearly(index))) }
struct Step { below : bool  number : int }
pass Seen : Shown { buffer steps : Step[]
    shown = if steps[here].below then 0.5 else float(steps[here].number) }
frame F {
    made = Steps()
    seen = Seen(screen) with { steps = made.steps }
    output value = seen.value
}
"""
CHOSEN = """
kernel Steps { result steps : int[64] = int(nearly(index)) }
kernel Waves { buffer steps : int[]  result waves : float[64] = sin(float(steps[index])) }
pass Seen : Shown { buffer steps : int[]  buffer waves : float[]  shown = waves[steps[here]] }
frame F {
    first = Steps()
    made  = Waves() with { steps = first.steps }
    seen  = Seen(screen) with { waves = made.waves, steps = first.steps }
    output value = seen.value
}
"""
SCATTERED = """
kernel Counted {
    runs over 256
    scatter counts : uint[64] add uint(index) at int(0.25 * (nearly(index)))
}
pass Seen : Shown { buffer counts : uint[]  shown = float(counts[here]) }
frame F {
    made = Counted()
    seen = Seen(screen) with { counts = made.counts }
    output value = seen.value
}
"""
GROWING = """
kernel Sines { result grown : float[64] = sin(float(index)) }
kernel Grown { buffer before : float[]  result grown : float[64] = 1.5 * before[index] }
pass Seen : Shown { buffer grown : float[]  shown = grown[here] }
frame F {
    begun = Sines()
    once  = Grown() with { before = previous(grown.grown, begun.grown) }
    grown = iterate now from once up to 3 : Grown() with { before = now.grown }
    seen  = Seen(screen) with { grown = grown.grown }
    output value = seen.value
}
"""
PLACED = """
kernel Waves { result waves : float[64] = sin(float(index)) }
pass Seen : FullScreen {
    buffer waves : float[]
    wave  : float = @vertex waves[7 + int(vertex_index)]
    target value : rgba32f = vec4(wave, 0, 0, 1)
}
frame F {
    made = Waves()
    seen = Seen(screen) with { waves = made.waves }
    output value = seen.value
}
"""
CANCELLED = """
kernel Steps { result steps : int[64] = int(float(index) / 7 * 7) }
pass Seen : Shown { buffer steps : int[]  shown = float(steps[here]) }
frame F {
    made = Steps()
    seen = Seen(screen) with { steps = made.steps }
    output value = seen.value
}
"""
"""Texts do not compute the division, so that it cannot change their picture."""
UNDEFINED = """
kernel Made {
    away = normalize(nonzero(vec2(float(index mod 16), 0)))
    result roots : float[64] = away.x + unguarded(sqrt(float(index - 3)))
    result parts : int[64] = unguarded(600 / (index mod 20))
}
pass Seen : Shown {
    buffer roots : float[]
    buffer parts : int[]
    shown = roots[here] + float(parts[here])
}
frame F {
    made = Made()
    seen = Seen(screen) with { roots = made.roots, parts = made.parts }
    output value = seen.value
}
"""
"""A frame of which the elements 0, 1, 2, 16, 20, 32, 40, 48 and 60 are undefined."""
PAINTED = """
pass Painted : FullScreen {
    line = normalize(nonzero(vec2(0, floor(frag_coord.y) - 3)))
    target value : rgba32f = vec4(unguarded(sqrt(frag_coord.x - 2)) - line.y, 0, 0, 1)
}
kernel Roots {
    map painted : texture2d
    result roots : float[64] = 2 * painted.load(ivec2(index mod 16, index / 16)).x
}
pass Seen : Shown { buffer roots : float[]  shown = roots[here] }
frame F {
    painted = Painted(screen)
    made    = Roots() with { painted = painted.value }
    seen    = Seen(screen) with { roots = made.roots }
    output value = seen.value
}
"""
"""A frame of which the first two columns and the last row are undefined."""
FRAMES = {
    "rounded": ROUNDED, "members": MEMBERS, "tipping": TIPPING, "chosen": CHOSEN,
    "scattered": SCATTERED, "growing": GROWING, "placed": PLACED, "cancelled": CANCELLED,
    "undefined": UNDEFINED, "painted": PAINTED,
}  # fmt: skip


WRONG = {
    "rounded": ("sin(float(index))", "sin(float(index)) + 0.01"),
    "members": ("vec2(7, wave)", "vec2(7, wave + 0.01)"),
    "tipping": ("int(nearly(index))", "int(nearly(index)) + 1"),
    "chosen": ("int(nearly(index))", "int(nearly(index)) + 1"),
    "scattered": ("add uint(index)", "add uint(index + 1)"),
    "growing": ("1.5 *", "1.5002 *"),
    "cancelled": ("* 7)", "* 7) + 1"),
    "undefined": ("= away.x", "= 1.01 * away.x"),
    "painted": ("= 2 *", "= 2.01 *"),
    "placed": ("sin(float(index))", "sin(float(index)) + 0.01"),
}
"""A part of the text of each frame's kernel, and a text in its place that is slightly wrong."""
TIPPED = ("tipping", "chosen", "scattered")


def compiled(text: str, route: str) -> CompiledFrame:
    (frame,) = burnish.compile(HEAD + text, (ROUTES[route].profile,)).frames
    return frame


def judged(studio: Studio, text: str, route: str) -> Row:
    """The row of ``conform`` for a frame."""
    rows = conform(
        [("F", compiled(text, route))], [ROUTES[route]], studio.runner, studio.toolchain, size=SIZE
    )
    return rows[0]


@pytest.mark.parametrize("route", ["lavapipe:glsl", "chromium:webgpu"])
@pytest.mark.parametrize("name", FRAMES)
def test_what_rounding_may_change_agrees(studio: Studio, name: str, route: str) -> None:
    row = judged(studio, FRAMES[name], route)
    assert row.status == "agrees", "\n".join(details(row)) or row.problem
    assert row.proven > 0.6 * row.covered > 0


def draw_instead(monkeypatch: pytest.MonkeyPatch, text: str, route: str) -> None:
    """Have routes draw another frame than the one that is judged."""
    frame = compiled(text, route)

    def drawn(_host: FrameHost, *rest: Any) -> list[dict[str, Floats]]:
        return draw_frames(FrameHost(frame, in_a_row([], {}, "sphere"), SIZE), *rest)

    monkeypatch.setattr(frames, "draw_frames", drawn)


@pytest.mark.parametrize("name", FRAMES)
def test_what_is_wrong_differs(studio: Studio, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    text, route = FRAMES[name], "lavapipe:glsl"
    before, after = WRONG[name]
    assert before in text
    draw_instead(monkeypatch, text.replace(before, after), route)
    assert judged(studio, text, route).status == "differs"


@pytest.mark.parametrize("step", ["+ 0.00001", "- 0.00001"])
@pytest.mark.parametrize("name", TIPPED)
def test_a_device_may_round_to_either_side(
    studio: Studio, name: str, step: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    text, route = FRAMES[name], "lavapipe:glsl"
    draw_instead(monkeypatch, text.replace("nearly(index)", f"nearly(index) {step}"), route)
    row = judged(studio, text, route)
    assert row.status == "agrees", "\n".join(details(row)) or row.problem


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        (UNDEFINED, [0, 1, 2, 16, 20, 32, 40, 48, 60]),
        (PAINTED, [0, 1, 16, 17, 32, 33, *range(48, 64)]),
    ],
    ids=["buffers", "textures"],
)
def test_pixels_that_read_what_is_undefined_are_undecided(
    studio: Studio, text: str, wanted: list[int]
) -> None:
    (result,) = judged(studio, text, "lavapipe:glsl").results
    assert np.flatnonzero(result.expected.undecided).tolist() == wanted
