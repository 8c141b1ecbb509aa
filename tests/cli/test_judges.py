"""Processes that judge for ``burnish conform``: rows are the same, whatever becomes of them."""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from burnish.commands import conform_run, judges
from burnish.commands.compared import ConformRequest
from burnish.commands.group import burnish
from burnish.commands.judge import KEPT, Judge, Unit
from burnish.targets.conformance.rows import CaseResult, Row
from burnish.targets.conformance.scheduling import begun
from burnish.targets.conformance.trials import Trial
from burnish.targets.runner.routes import select
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain import Toolchain
from burnish.targets.toolchain.workers import Worker

from .kit import invoke
from .test_conform import UP, without

LITTLE = "vec3(fract(sin(dot(uv, vec2(12.9898, 78.233))) * 43758.5453))"
FILES = {
    "up": UP,
    "little": f"material Hash {{ color = {LITTLE} }}\n",
    "kernel": "kernel Two { result two : float[4] = 2 }\n",
    "captures": "material M { color = vec3(uv, 0) }\npass P { capture place : vec2 = uv }\n",
    "frame": (
        "material Lit { color = vec3(uv, 1) }\n"
        "frame Shown { models scene  shown = Forward(scene)  output picture = shown.color }\n"
    ),
}
ROUTES = ("lavapipe:glsl", "lavapipe:hlsl-glslang")
LINE = ("--routes", ",".join(ROUTES))


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with files of all kinds."""
    monkeypatch.chdir(tmp_path)
    for name, text in FILES.items():
        Path(f"{name}.burnish").write_text(text)
    return tmp_path


def conform(*names: str) -> tuple[int, str, str]:
    """The exit code and what is printed for some files, by default all."""
    result = invoke("conform", *(f"{name}.burnish" for name in names or FILES), *LINE)
    return result.exit_code, result.stdout, result.stderr


@pytest.fixture
def alone(monkeypatch: pytest.MonkeyPatch) -> Callable[..., tuple[int, str, str]]:
    """Judges in this process."""

    def judged(*names: str) -> tuple[int, str, str]:
        with monkeypatch.context() as patch:
            patch.setattr(conform_run, "SEVERAL", 1000)
            return conform(*names)

    return judged


@pytest.fixture
def one_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """Makes one process judge, one subject after the other."""
    monkeypatch.setattr(os, "cpu_count", lambda: 1)


def test_processes_judge_the_same(alone: Callable[..., tuple[int, str, str]]) -> None:
    """Also the reasons in the source are the same."""
    found = conform()
    assert found == alone()
    code, output, errors = found
    assert code == 0
    assert re.findall(r"^\S+\.burnish: .*", output, re.MULTILINE) == [
        "up.burnish: Up", "little.burnish: Hash", "kernel.burnish: Two",
        "captures.burnish: M", "captures.burnish: M × P", "frame.burnish: Shown",
    ]  # fmt: skip
    assert "magnifies rounding" in errors


def starting(text: str) -> Callable[..., Worker]:
    """Makes workers that run a text instead of their module."""
    return lambda *_arguments: Worker(lambda: [sys.executable, "-c", text])


@pytest.mark.parametrize(
    "text",
    [
        "pass", "raise SystemExit(3)", "print('{}', flush=True)", "print('no JSON', flush=True)",
        "import os; input(); os.kill(os.getpid(), 9)",
    ],
)  # fmt: skip
def test_what_a_process_leaves_is_done_here(
    text: str, alone: Callable[..., tuple[int, str, str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(judges, "Worker", starting(text))
    assert conform() == alone()


def test_a_process_that_hangs(
    alone: Callable[..., tuple[int, str, str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(judges, "TIME_LIMIT", 0.5)
    monkeypatch.setattr(judges, "Worker", starting("import time; time.sleep(600)"))
    assert conform() == alone()


LACKING = """
import json, os, sys
while line := sys.stdin.buffer.readline():
    sys.stdin.buffer.read(json.loads(line)["following"])
    with open({asked!r}, "a") as asked:
        print(os.getpid(), file=asked)
    print('{{"lacks_memory": true}}', flush=True)
"""
"""A process that never has enough memory; a file tells which process was asked."""


@pytest.mark.usefixtures("one_process")
def test_processes_that_lack_memory(
    folder: Path,
    alone: Callable[..., tuple[int, str, str]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A fresh one is asked once more, as the first may have kept much; then it is done here."""
    monkeypatch.setattr(judges, "Worker", starting(LACKING.format(asked=str(folder / "asked"))))
    assert conform() == alone()
    asked = (folder / "asked").read_text().split()
    assert len(asked) == len({*asked}) == judges.TRIES * (len(FILES) + 6)


def test_memory_that_nobody_has(
    folder: Path,
    alone: Callable[..., tuple[int, str, str]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The rows of this subject have failed; the others are as they are."""

    def results(self: Trial, *rest: Any) -> Iterator[CaseResult]:
        if self.label == "kernel.burnish: Two":
            raise MemoryError
        return of_others(self, *rest)

    of_others = Trial.results
    monkeypatch.setattr(Trial, "results", results)
    monkeypatch.setattr(judges, "Worker", starting(LACKING.format(asked=str(folder / "asked"))))
    code, output, errors = conform()
    assert (code, output.splitlines()[-1]) == (1, "8 agree, 2 prove little, 2 failed")
    assert errors.count("failed\n  there is not enough memory to draw this\n") == 2
    assert alone()[0] == 1 and alone()[2] == errors


@pytest.mark.usefixtures("one_process")
def test_a_bug_in_the_judge_of_one_subject(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The rows before it are printed and reported, and then the error is told."""

    def rows(self: Judge, unit: Unit) -> Sequence[Row]:
        assert unit.label != "kernel.burnish: Two", "a bug"
        return of_others(self, unit)

    of_others = Judge.rows
    monkeypatch.setattr(Judge, "rows", rows)
    monkeypatch.setattr(judges, "Worker", starting("pass"))
    command = ["conform", *(f"{name}.burnish" for name in FILES), *LINE, "--report", "report"]
    result = CliRunner().invoke(burnish, command)
    assert isinstance(result.exception, AssertionError)
    assert re.findall(r"^\S+\.burnish: .*", result.stdout, re.MULTILINE) == [
        "up.burnish: Up", "little.burnish: Hash",
    ]  # fmt: skip
    assert "\nunfinished, 4 of 12 rows: 2 agree, 2 prove little\n" in result.stdout
    report = json.loads((folder / "report" / "report.json").read_text())
    assert report["unfinished"] == {"known": 4, "of": 12} and len(report["rows"]) == 4


GROWN = """
import std.frames.{FullScreen}
pass Grown : FullScreen { target value : rgba32f = vec4(uv, 0, 1) }
frame F {
    param n : int
    grown = Grown(screen, ivec2(n, n))
    output picture = grown.value
}
"""


def test_a_frame_whose_size_nobody_has_set(
    folder: Path, alone: Callable[..., tuple[int, str, str]]
) -> None:
    """Its rows have failed; the others are as they are."""
    (folder / "frame.burnish").write_text(GROWN)
    found = conform()
    assert found == alone()
    code, output, errors = found
    assert code == 1 and output.endswith("\n8 agree, 2 prove little, 2 failed\n")
    told = "error: frame.burnish: F, {}: failed\n  F needs values for\n    `n` : int\n"
    assert errors.endswith("".join(map(told.format, ROUTES)))


def test_tools_are_looked_for_once(
    alone: Callable[..., tuple[int, str, str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Judges get to know what is missing here; the route is not run, whatever they would find."""
    without(monkeypatch, "glslang")
    found = conform()
    assert found == alone()
    assert "glslang is missing" in found[1] and found[1].endswith("\n12 not run\n")


def test_a_process_has_the_limits_of_the_command() -> None:
    result = invoke(
        "conform", *(f"{name}.burnish" for name in FILES), *LINE, "--budget", "memory=100000"
    )
    assert result.exit_code == 1
    assert result.stderr.count("and the limit is 100 kB: `--budget memory=") >= 8


def test_the_errors_of_all_files(folder: Path) -> None:
    """Nothing is drawn, and all are told in the order of the files."""
    (folder / "up.burnish").write_text("material Up { color = norml }")
    (folder / "frame.burnish").write_text("material Lit { color = uvw }")
    code, output, errors = conform()
    assert (code, output) == (1, "")
    assert [*re.findall("unknown name `(.*)`", errors)] == ["norml", "uvw"]


@pytest.mark.usefixtures("one_process")
@pytest.mark.parametrize("text", [UP.replace("0.5 +", "0.4 +"), UP.replace("normal", "norml"), ""])
def test_a_file_that_changes_meanwhile(
    text: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A process that has compiled it lately judges it as it was then; else its rows have failed."""
    names = [f"m{number}" for number in range(KEPT + 1)]
    for name in names:
        (folder / f"{name}.burnish").write_text(UP)

    def change(costs: Sequence[float], processes: int) -> list[int]:
        for name in names[0], names[-1]:
            (folder / f"{name}.burnish").write_text(text)
        number, *others = begun(costs, processes)
        return [others.pop(), number, *others]

    monkeypatch.setattr(conform_run, "begun", change)
    code, output, errors = conform(*names)
    assert (code, output.splitlines()[-1]) == (1, f"{2 * KEPT} agree, 2 failed")
    assert errors == "".join(
        f"error: m0.burnish: Up, {route}: failed\n  its file has changed meanwhile\n"
        for route in ROUTES
    )


def test_a_file_that_others_compile_anew(folder: Path) -> None:
    """A judge judges what it has compiled itself, even if the file has changed meanwhile."""
    routes = select([LINE[1]])
    with Runner(routes) as runner, Toolchain() as toolchain:
        judge, other, third = (
            Judge(request(folder / "up.burnish"), routes, runner, toolchain) for _ in range(3)
        )
        (unit,) = judge.contents(folder / "up.burnish").units
        assert {row.status for row in other.rows(unit)} == {"agrees"}
        (folder / "up.burnish").write_text(UP.replace("Up", "Down"))
        assert {row.status for row in judge.rows(unit)} == {"agrees"}
        assert {row.problem for row in third.rows(unit)} == {"its file has changed meanwhile"}


def request(file: Path) -> ConformRequest:
    """The command line that names a file, and otherwise nothing but routes."""
    return ConformRequest(
        files=(file,), routes=LINE[1], device="", report=None, strict=False, explain=None,
        case=None, seed=0, rig=None, pass_=None, search_path=(), hoist=True, native_stages=False,
    )  # fmt: skip
