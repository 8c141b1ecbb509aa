"""Frames are the same, whoever draws which layers of their steps."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

import burnish
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.picture import RasterRules
from burnish.targets.conformance import frames
from burnish.targets.conformance.frame_pictures import FramePictures, dumped
from burnish.targets.conformance.frames import FrameTrial
from burnish.targets.runner.frames.subjects import FrameSubject

EXAMPLES = Path(burnish.__file__).parent / "examples" / "frames"
SIZE = (12, 8)
RULES = RasterRules(*SIZE)
ERRORS = Errors(("vulkan",))
PROFILE = "glsl:vulkan"

FRAME = """
import std.environments.{FaceOfCube}
import std.frames.{FullScreen}
pass Grown : FullScreen {
    map last : texture2d with { filter = nearest, mip = none }
    target value : rgba16f = last.load(ivec2(0)) + vec4(uv, 1, 1)
}
pass Sky : FaceOfCube { target color : rgba16f = vec4(sin(7 * toward), 1) }
pass Deep : Forward { }
pass Shown : FullScreen {
    map around : texture_cube with { filter = nearest, mip = none }
    map grown  : texture2d with { filter = nearest, mip = none }
    map deep   : texture2d with { filter = nearest, mip = none }
    target color : rgba16f = around(vec3(uv - 0.5, 0.3)) + grown(uv) * deep(uv)
}
material Lit { color = vec3(uv, 1) }
frame F {
    models scene
    grown = Grown(screen, 8) with { last = previous(grown.value) }
    sky = each face in cube : Sky(screen, 8) with { face = face }
    deep = Deep(scene)
    shown = Shown(screen) with { around = sky.color, grown = grown.value, deep = deep.color }
    output picture = shown.color
    output depths = deep.depth
}
"""


class Offered:
    """Parts of which another trial of the same frame, with others, draws some."""

    def __init__(self, own: Sequence[int], drawn: Sequence[bytes | None]) -> None:
        self._own, self._drawn = list(own), drawn

    def take(self) -> int | None:
        return self._own.pop() if self._own else None

    def gather(self) -> Sequence[bytes | None]:
        return self._drawn


class Helping:
    """Helpers that draw the parts that ``chosen`` says; they fail with others of these."""

    def __init__(self, other: FrameTrial, chosen: Callable[[], str]) -> None:
        self._other, self._chosen = other, chosen
        self.helped = 0

    def offer(self, common: bytes, count: int) -> Offered:
        who = [self._chosen() for _ in range(count)]
        drawn = [self._other.part(common, n) if one == "other" else None
                 for n, one in enumerate(who)]  # fmt: skip
        self.helped += sum(data is not None for data in drawn)
        return Offered([n for n, one in enumerate(who) if one == "own"], drawn)


def by(who: str) -> Callable[[], str]:
    """Chooses who draws a part: one for all, or at random."""
    chance = random.Random(0)
    return lambda: chance.choice(["own", "other", "nobody"]) if who == "any" else who


def subject_of(source: str | Path) -> FrameSubject:
    (frame,) = burnish.compile(source, [PROFILE], keep_graphs=True).frames
    return frame


@pytest.fixture(autouse=True)
def all_pays(monkeypatch: pytest.MonkeyPatch) -> None:
    """Everything is offered that can be, however small it is."""

    def pays(_host: object, numbers: Sequence[int]) -> bool:
        return len(numbers) > 1

    monkeypatch.setattr(frames, "help_pays", pays)


@pytest.mark.parametrize("who", ["own", "other", "nobody", "any"])
@pytest.mark.parametrize("errors", [None, ERRORS], ids=["values", "bounds"])
@pytest.mark.parametrize(
    "source", [FRAME, EXAMPLES / "impostors.burnish"], ids=["small", "impostors"]
)
def test_pictures_are_the_same(source: str | Path, errors: Errors | None, who: str) -> None:
    subject = subject_of(source)
    profile = None if errors is None else PROFILE
    alone = FrameTrial("F", subject, SIZE)._drawn(profile, RULES, errors)
    helping = Helping(FrameTrial("F", subject, SIZE), by(who))
    helped = FrameTrial("F", subject, SIZE, helpers=helping)._drawn(profile, RULES, errors)
    assert dumped(FramePictures(helped, frozenset())) == dumped(FramePictures(alone, frozenset()))
    assert (helping.helped > 4) == (who in ("other", "any"))
