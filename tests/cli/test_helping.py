"""Processes that help another one to judge a frame: the rows are the same, whatever they do."""

from __future__ import annotations

import pickle
import random
from collections.abc import Callable
from concurrent.futures import Executor, Future
from functools import partial
from pathlib import Path
from threading import Event
from typing import Any, cast

import pytest

from burnish.commands import conform_run
from burnish.commands.helping import LentHelpers, Offers
from burnish.commands.judge import Judge, PartOf
from burnish.commands.judges import Judges
from burnish.compiler.reference.picture import RasterRules
from burnish.targets.runner.frames.helped import Given, LayerOf
from burnish.targets.runner.frames.subjects import is_frame
from burnish.targets.runner.routes import select
from burnish.targets.toolchain.pipe import Packet

from .kit import invoke
from .test_judges import request

FACES = """
import std.environments.{FaceOfCube}
import std.frames.{FullScreen}
fn far(x: float, n: int) -> float = sum i in 0..n up to 32 : sum j in 0..n up to 32 :
    sin(x + float(i + 11 * j)) + sin(x + float(i + 12 * j)) + sin(x + float(i + 13 * j)) +
    sin(x + float(i + 21 * j)) + sin(x + float(i + 22 * j)) + sin(x + float(i + 23 * j)) +
    sin(x + float(i + 31 * j)) + sin(x + float(i + 32 * j)) + sin(x + float(i + 33 * j)) +
    sin(x + float(i + 41 * j)) + sin(x + float(i + 42 * j)) + sin(x + float(i + 43 * j))
pass Sky : FaceOfCube {
    param n : int = 1
    target color : rgba16f = vec4(far(toward.x, n), toward)
}
pass Shown : FullScreen {
    map around : texture_cube with { filter = nearest, mip = none }
    target color : rgba16f = around(vec3(uv - 0.5, 0.3))
}
frame Faces {
    sky = each face in cube : Sky(screen, 8) with { face = face }
    shown = Shown(screen) with { around = sky.color }
    output picture = shown.color
}
"""
"""A frame that is believed to take long, as nobody knows how often its loops turn."""
LIMIT = 60.0


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr("os.cpu_count", lambda: 2)
    Path("faces.burnish").write_text(FACES)


def conform() -> tuple[int, str, str]:
    result = invoke("conform", "faces.burnish", "--routes", "lavapipe:glsl")
    return result.exit_code, result.stdout, result.stderr


@pytest.fixture
def alone(monkeypatch: pytest.MonkeyPatch) -> tuple[int, str, str]:
    """What is said if the process of the command judges, and what was drawn is forgotten."""
    with monkeypatch.context() as patch:
        patch.setattr(conform_run, "pays", lambda *_of: False)
        patch.setenv("BURNISH_CACHE", str(Path("elsewhere").absolute()))
        return conform()


@pytest.fixture
def parts(monkeypatch: pytest.MonkeyPatch) -> list[bytes | None]:
    """The parts that helpers have made; the process that offers waits until they begin."""
    made: list[bytes | None] = []
    has_begun = Event()
    of_others, taken = Judges._part, Offers._taken

    def part(self: Judges, *of: Any) -> bytes | None:
        has_begun.set()
        made.append(of_others(self, *of))
        return made[-1]

    def later(self: Offers) -> int | None:
        assert has_begun.wait(LIMIT)
        return taken(self)

    monkeypatch.setattr(Judges, "_part", part)
    monkeypatch.setattr(Offers, "_taken", later)
    return made


def test_a_single_frame_is_drawn_by_several(
    alone: tuple[int, str, str], parts: list[bytes | None]
) -> None:
    assert conform() == alone
    assert parts and all(parts)
    assert alone[0] == 0 and alone[1].endswith("\n1 agrees\n")


def test_helpers_that_crash(
    alone: tuple[int, str, str], parts: list[bytes | None], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The process that judges the frame draws their parts."""
    usual = Judges._question

    def question(self: Judges, work: Callable[[Any], object], about: Any) -> Packet:
        if work.__name__ == "part":
            return Packet({}, b"no pickle")
        return usual(self, work, about)

    monkeypatch.setattr(Judges, "_question", question)
    assert conform() == alone
    assert parts and not any(parts)


@pytest.mark.usefixtures("parts")
def test_a_process_that_crashes_while_others_help(
    alone: tuple[int, str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nobody wants the parts any more, and the main process judges the frame."""
    withdrawn: list[Offers] = []
    withdraw = Offers.withdraw

    def answer(self: Offers, asked: Any, data: bytes) -> Packet:
        if asked["help"] == "gather":
            return Packet({}, b"no pickle")
        return usual(self, asked, data)

    def noticed(self: Offers) -> None:
        withdrawn.append(self)
        withdraw(self)

    usual = Offers.answer
    monkeypatch.setattr(Offers, "answer", answer)
    monkeypatch.setattr(Offers, "withdraw", noticed)
    assert conform() == alone
    assert all(part.done() for offers in withdrawn for part in offers._parts)


def test_a_judge_helps_only_with_the_frame_that_is_meant() -> None:
    """It makes the same part as any other judge; nothing if the file is another one now."""
    routes, file = select(["lavapipe:glsl"]), Path("faces.burnish")
    nothing = cast(Any, None)  # Only pictures of the reference are made.
    one, other = (Judge(request(file), routes, nothing, nothing) for _ in range(2))
    (unit,) = one.contents(file).units
    assert 0 < unit.shared < unit.cost
    ((_label, subject),) = one.forms(file).drawn
    assert is_frame(subject)
    steps = subject.plan_of_reference.steps
    layers = [LayerOf(n, 0) for n, step in enumerate(steps) if step.name.startswith("sky")]
    common = pickle.dumps((None, RasterRules(1, 1), None, pickle.dumps(Given(0, {}, layers))))
    made = [one.part(PartOf(unit, common, n)) for n in range(6)]
    assert all(made) and len({*made}) == 6
    assert other.part(PartOf(unit, common, 5)) == made[5]
    assert other.part(PartOf(unit._replace(read="another"), common, 5)) is None


class Line(Executor):
    """Does what it was given only when it is told to, one thing after the other."""

    def __init__(self) -> None:
        self._waiting: list[tuple[Future[Any], Callable[[], Any]]] = []

    def submit(self, fn: Callable[..., Any], /, *of: Any, **named: Any) -> Future[Any]:
        future: Future[Any] = Future()
        self._waiting.append((future, partial(fn, *of, **named)))
        return future

    def go_on(self) -> None:
        """Do the first thing that nobody has taken back."""
        while self._waiting:
            future, work = self._waiting.pop(0)
            if future.set_running_or_notify_cancel():
                future.set_result(work())
                return


@pytest.mark.parametrize("often", [0.0, 0.5, 0.9])
def test_every_part_is_made_once(often: float) -> None:
    """By helpers from the first one on, and by who offers from the last one on."""
    chance = random.Random(1)
    line, made = Line(), list[int]()

    def draw(common: bytes, number: int) -> bytes:
        made.append(number)
        return common + str(number).encode()

    offers = Offers(line, draw)
    offered = LentHelpers(lambda packet: offers.answer(packet.content, packet.data))
    offered.offer(b"part ", 50)
    own = []
    while (number := offered.take()) is not None:
        own.append(number)
        while chance.random() < often:
            line.go_on()
    found = offered.gather()
    assert own == sorted(own, reverse=True) and made == sorted(made)
    assert sorted([*own, *made]) == [*range(50)]
    assert [data is None for data in found] == [number in own for number in range(50)]
    assert all(data == b"part %d" % n for n, data in enumerate(found) if data is not None)


def test_nobody_begins_with_what_was_withdrawn() -> None:
    line = Line()
    offers = Offers(line, lambda _common, _number: b"drawn")
    offers.answer({"help": "offer", "count": 3}, b"")
    line.go_on()
    offers.withdraw()
    line.go_on()
    assert pickle.loads(offers.answer({"help": "gather"}, b"").data) == [b"drawn", None, None]
    assert offers.answer({"help": "take"}, b"").content == {"part": None}
