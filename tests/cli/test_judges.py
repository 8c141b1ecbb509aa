"""Processes that judge for ``burnish conform``: rows are the same, whatever becomes of them."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from burnish.commands import conform_run, judges
from burnish.commands.compared import ConformRequest
from burnish.commands.judge import Judge
from burnish.targets.conformance.scheduling import begun
from burnish.targets.runner.routes import select
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain import Toolchain
from burnish.targets.toolchain.workers import Worker

from .kit import invoke

LITTLE = "vec3(fract(sin(dot(uv, vec2(12.9898, 78.233))) * 43758.5453))"
FILES = {
    "up": "material Up { color = 0.5 + 0.5 * normal }\n",
    "little": f"material Hash {{ color = {LITTLE} }}\n",
    "kernel": "kernel Two { result two : float[4] = 2 }\n",
    "captures": "material M { color = vec3(uv, 0) }\npass P { capture place : vec2 = uv }\n",
    "frame": (
        "material Lit { color = vec3(uv, 1) }\n"
        "frame Shown { models scene  shown = Forward(scene)  output picture = shown.color }\n"
    ),
}
LINE = ("--routes", "lavapipe:glsl,lavapipe:hlsl-glslang")


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


def test_a_process_that_lacks_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    answer = "print('{\"lacks_memory\": true}', flush=True)"
    monkeypatch.setattr(judges, "Worker", starting(answer))
    assert conform() == (
        1, "", "error: there is not enough memory to draw this: a smaller picture may do\n"
    )  # fmt: skip


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


def test_a_file_that_changes_meanwhile(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A process that has compiled it before judges what it was then; for others, it has failed."""

    def change(costs: Sequence[float], processes: int) -> list[int]:
        (folder / "up.burnish").write_text(FILES["up"].replace("Up", "Down"))
        return begun(costs, processes)

    monkeypatch.setattr(conform_run, "begun", change)
    code, output, errors = conform()
    heading = "error: up.burnish: Up, lavapipe:glsl: failed\n  it is not in its file any more\n"
    if code:
        assert heading in errors
        assert output.endswith("\n8 agree, 2 prove little, 2 failed\n")
    else:
        assert output.endswith("\n10 agree, 2 prove little\n")


def test_a_subject_that_is_not_there_any_more(folder: Path) -> None:
    routes = select([LINE[1]])
    with Runner(routes) as runner, Toolchain() as toolchain:
        judge = Judge(request(folder / "up.burnish"), routes, runner, toolchain)
        (unit,) = judge.contents(folder / "up.burnish").units
        (folder / "up.burnish").write_text(FILES["up"].replace("Up", "Down"))
        other = Judge(request(folder / "up.burnish"), routes, runner, toolchain)
        problems = {row.problem for row in other.rows(unit)}
        assert {row.status for row in judge.rows(unit)} == {"agrees"}
    assert problems == {"it is not in its file any more"}


def request(file: Path) -> ConformRequest:
    """The command line that names a file, and otherwise nothing but routes."""
    return ConformRequest(
        files=(file,), routes=LINE[1], device="", report=None, strict=False, explain=None,
        case=None, seed=0, rig=None, pass_=None, search_path=(), hoist=True, native_stages=False,
    )  # fmt: skip
