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
from burnish.targets.runner.frames import helped
from burnish.targets.runner.frames.independent import independent_steps
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


def test_large_textures_stay_where_they_are(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(helped, "MOST_SENT", 20_000)
    subject = subject_of(FRAME)
    helping = Helping(FrameTrial("F", subject, SIZE), by("other"))
    found = FrameTrial("F", subject, SIZE, helpers=helping)._drawn(None, RULES, None)
    alone = FrameTrial("F", subject, SIZE)._drawn(None, RULES, None)
    assert not helping.helped
    assert dumped(FramePictures(found, frozenset())) == dumped(FramePictures(alone, frozenset()))


PASSES = """
import std.frames.{FullScreen}
pass One : FullScreen { target value : rgba16f = vec4(uv, 1, 1) }
pass Next : FullScreen {
    map last : texture2d with { filter = nearest, mip = none }
    target value : rgba16f = 2 * last(uv)
}
pass Deep : Forward { }
material Lit { color = vec3(uv, 1) }
frame F {
    models scene
    FRAME
}
"""


@pytest.mark.parametrize(
    ("frame", "groups"),
    [
        ("a = One(screen)  b = One(screen)  output x = a.value  output y = b.value", ["a b"]),
        (
            "a = One(screen)  b = Next(screen) with { last = a.value }  output x = b.value",
            ["a", "b"],
        ),
        ("a = Deep(scene)  output x = a.color", ["a"]),
        (
            "a = Deep(scene)  c = One(screen)  b = Deep(scene, a)  output x = b.color  "
            "output y = c.value",
            ["a", "a copy", "a copy", "b", "c"],
        ),
        (
            "a = One(screen)  b = One(screen)  c = Next(screen) with { last = previous(b.value) }  "
            "output x = a.value  output y = c.value",
            ["a c b"],
        ),
    ],
    ids=["apart", "in a row", "alone", "over depths", "what the last frame left"],
)
def test_steps_together_need_nothing_of_each_other(frame: str, groups: list[str]) -> None:
    plan = subject_of(PASSES.replace("FRAME", frame.replace("  ", "\n    "))).plan_of_reference
    found = independent_steps(plan, range(len(plan.steps)))
    assert [" ".join(plan.steps[number].name for number in group) for group in found] == groups
