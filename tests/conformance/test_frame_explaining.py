"""Explanations of a pixel of a frame: the step that made it, and what carries the error to it.

No driver is needed: the reference draws with the rounding that a route's device may have.
"""

from __future__ import annotations

import pytest

import burnish
from burnish.targets.conformance.explaining import made_lines
from burnish.targets.conformance.frames import FrameTrial
from burnish.targets.runner.drivers.device import Device
from burnish.targets.runner.frames.pixel_origins import BEFORE, Carried, Origin
from burnish.targets.runner.routes import ROUTES

SIZE = (8, 4)
ROUTE = ROUTES["lavapipe:glsl"]
DEVICE = Device("", "", subpixel_bits=8, subtexel_bits=8, mip_bits=8)

PASSES = """
import std.frames.{FullScreen}

pass Rough : FullScreen { target value : rgba32f = vec4(sin(uv.x)) }
pass Exact : FullScreen { target value : rgba32f = vec4(1) }
pass Both : FullScreen {
    map one : texture2d with { filter = nearest, mip = none }
    map two : texture2d with { filter = nearest, mip = none }
    target value : rgba32f = one.load(ivec2(frag_coord.xy)) * 1000 + two.load(ivec2(frag_coord.xy))
}
pass Copied : FullScreen {
    map source : texture2d with { filter = nearest, mip = none }
    target value : rgba32f = source.load(ivec2(frag_coord.xy))
}
pass Many : FullScreen {
    raster { samples = 4 }
    map source : texture2d with { filter = nearest, mip = none }
    target value : rgba16f = source.load(ivec2(frag_coord.xy)) * 1000
}
pass Added : FullScreen blend add {
    map source : texture2d with { filter = nearest, mip = none }
    target value : rgba16f = source.load(ivec2(frag_coord.xy)) + 1
}
"""


def made(frame: str, pixel: tuple[int, int] = (3, 1), case: str = "value") -> Origin | None:
    """The explanation of a pixel of the output ``value``."""
    (found,) = burnish.compile(f"{PASSES}\nframe F {{ {frame} }}", "glsl:vulkan").frames
    return FrameTrial("F", found, SIZE).made(case, ROUTE, DEVICE, "guaranteed", pixel)


def test_which_input_carries_the_error() -> None:
    found = made("""
        rough = Rough(screen)
        exact = Exact(screen)
        both  = Both(screen) with { one = rough.value, two = exact.value }
        output value = both.value
    """)
    assert found is not None
    assert found.step == "both"
    assert [(one.name, one.result) for one in found.carried] == [
        ("one", "rough.value"), ("two", "exact.value"),
    ]  # fmt: skip
    rough, exact = found.carried
    # A sine may be off by 2^-11 in Vulkan, which is multiplied by 1000; numbers near 1000 have
    # steps of 2^-14.
    assert found.apart == pytest.approx(2 * 1000 * 2**-11, rel=0.1)
    assert rough.apart < 2**-12
    assert exact.apart == found.apart
    assert found.alone == rough.apart
    assert found.explanation is not None
    assert found.explanation.contributions[0].text == "one.load(ivec2(frag_coord.xy))"


def test_what_is_drawn_over_is_an_input() -> None:
    found = made("""
        rough = Rough(screen)
        exact = Exact(screen)
        first = Added(screen) with { source = rough.value }
        after = Added(screen, first) with { source = exact.value }
        output value = after.value
    """)
    assert found is not None
    assert (found.step, [one.result for one in found.carried]) == (
        "after", [BEFORE, "exact.value"],
    )  # fmt: skip
    assert found.carried[0].apart < found.apart == found.carried[1].apart


FOLLOWED = {
    "a step that leaves the pixel is not the one that made it": ("""
        first = Added(screen) with { source = exact.value }
        after = Added(screen, first) with { source = exact.value, scissor = ivec4(4, 0, 4, 4) }
        output value = after.value
    """, "first"),
    "where it draws, it is": ("""
        first = Added(screen) with { source = exact.value }
        after = Added(screen, first) with { source = exact.value, scissor = ivec4(0, 0, 4, 4) }
        output value = after.value
    """, "after"),
    "what others read is kept by a copy": ("""
        first = Added(screen) with { source = exact.value }
        after = Added(screen, first) with { source = exact.value, scissor = ivec4(4, 0, 4, 4) }
        output before = first.value
        output value  = after.value
    """, "first"),
    "a step may only clear": ("""
        first = Copied(screen) with { source = exact.value, scissor = ivec4(4, 0, 4, 4) }
        output value = first.value
    """, "first"),
}  # fmt: skip


@pytest.mark.parametrize("what", FOLLOWED)
def test_the_step_that_made_a_pixel(what: str) -> None:
    frame, step = FOLLOWED[what]
    found = made(f"exact = Exact(screen) {frame}")
    assert found is not None
    assert found.step == step
    assert (found.explanation is None) == (what == "a step may only clear")


def test_what_the_last_frame_has_left() -> None:
    frame = """
        first = Copied(screen) with { source = rough.value }
        grown = Copied(screen) with { source = previous(grown.value, first.value) }
        rough = Rough(screen)
        output value = grown.value
    """
    read = {"value, frame 1": "first.value", "value, frame 2": "previous(grown.value)"}
    for case, result in read.items():
        found = made(frame, case=case)
        assert found is not None
        (carried,) = found.carried
        assert (found.step, carried.name, carried.result) == ("grown", "source", result)
        assert carried.apart < found.apart / 1000


def test_layers_of_an_output_stand_one_below_the_other() -> None:
    frame = """
        exact = Exact(screen)
        layered = each i in 0..2 : Rough(screen)
        output value = layered.value
    """
    found = [made(frame, (3, row)) for row in (1, 5)]
    assert all(one is not None and one.step.startswith("layered") for one in found)


def test_of_several_samples_the_mean_is_followed() -> None:
    frame = """
        rough = Rough(screen)
        many  = Many(screen) with { source = rough.value }
        output value = many.value
    """
    found = made(frame)
    assert found is not None
    assert (found.step, [one.result for one in found.carried]) == ("many", ["rough.value"])
    assert found.carried[0].apart < found.apart / 2
    assert found.explanation is not None


def test_the_words() -> None:
    read = (Carried("map", "deep.color", 2e-4), Carried("", BEFORE, 0.25))
    text = list(made_lines(Origin("lit", 0.25, read, 1e-7, None)))
    assert text == [
        "the step `lit` has made it, and its bounds are 0.25 apart",
        "",
        "how far apart they would be without the error of:",
        "  2.0e-04  `map`, which is `deep.color`",
        "  0.25     what was there before",
        "  1.0e-07  all of these",
    ]
