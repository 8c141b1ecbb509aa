"""Pictures of frames that the reference has drawn are found again, if nothing has changed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.api.entry_points import CompiledFrame
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.picture import RasterRules
from burnish.targets.conformance import frames
from burnish.targets.conformance.frame_pictures import FramePictures, dumped, loaded
from burnish.targets.conformance.frames import FrameTrial
from burnish.targets.runner.frames.helped import HelpedFrames
from burnish.targets.runner.store import Store

FRAME = """
import std.frames.{FullScreen}
pass Grown : FullScreen {
    param by : float = 1
    map last : texture2d with { filter = nearest, mip = none }
    target value : rgba16f = last.load(ivec2(0)) + by * vec4(uv, 1, 1)
}
pass Deep : Forward { }
material Lit { color = vec3(uv, 1) }
frame F {
    models scene
    grown = Grown(screen, 8) with { last = previous(grown.value) }
    deep = Deep(scene)
    output value = grown.value
    output picture = deep.color
    output depths = deep.depth
}
"""
SIZE = (12, 8)
RULES = RasterRules(*SIZE)
ERRORS = Errors(("vulkan",))


@pytest.fixture
def drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """A list to which each drawing of a frame adds something; no picture is kept before."""
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path))
    counted: list[int] = []

    class Counting(HelpedFrames):
        def draw(self, *of: Any) -> None:
            counted.append(self.frames)
            super().draw(*of)

    monkeypatch.setattr(frames, "HelpedFrames", Counting)
    return counted


def pictures(
    text: str = FRAME, errors: Errors | None = ERRORS, size: tuple[int, int] = SIZE
) -> FramePictures:
    """The pictures that a new trial expects, as if in another process."""
    (frame,) = burnish.compile(text, ["glsl:vulkan"]).frames
    assert isinstance(frame, CompiledFrame)
    trial = FrameTrial("F", frame, size, Store("pictures"))
    found = trial._drawn("glsl:vulkan", RULES, errors)
    return FramePictures(found, frozenset())


def same(one: FramePictures, other: FramePictures) -> bool:
    return dumped(one) == dumped(other)


def test_pictures_are_found_again(drawn: list[int]) -> None:
    """Depths and all frames are among them."""
    first = pictures()
    assert drawn == [0, 1]
    assert [sorted(frame) for frame in first.frames] == [["depths", "picture", "value"]] * 2
    assert same(pictures(), first)
    assert drawn == [0, 1]


@pytest.mark.parametrize(
    "change",
    [
        {"text": FRAME.replace("by : float = 1", "by : float = 2")},
        {"text": FRAME.replace("Grown(screen, 8)", "Grown(screen, 9)")},
        {"text": FRAME.replace("vec3(uv, 1)", "vec3(uv, 0)")},
        {"errors": None},
        {"size": (13, 8)},
    ],
)
def test_what_has_changed_is_drawn_anew(change: dict[str, Any], drawn: list[int]) -> None:
    first = pictures()
    assert not same(pictures(**change), first)
    assert drawn == [0, 1, 0, 1]


@pytest.mark.usefixtures("drawn")
def test_what_is_dumped_is_loaded() -> None:
    first = pictures()
    kept = loaded(dumped(FramePictures(first.frames, frozenset({("owns_bottom", 3)}))))
    assert kept.counted == {("owns_bottom", 3)}
    for frame, other in zip(first.frames, kept.frames, strict=True):
        assert frame.keys() == other.keys()
        for name, picture in frame.items():
            assert picture.format == other[name].format
            assert np.array_equal(picture.ends, other[name].ends, equal_nan=True)
            assert np.array_equal(picture.undecided, other[name].undecided)
