"""``burnish compile`` with several files: it writes what each of them becomes, or nothing."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

import pytest

from burnish.commands import compiled_files
from burnish.commands.compiled_files import SEVERAL
from burnish.compiler.watching import VARIABLE

from ..suite.processes import started, until
from .kit import invoke, shell, tree

MATERIAL = "/// Number {0}.\nmaterial M{0} {{ param color : rgb = vec3({0} / 100.0) }}\n"
WRONG = "material Wrong { color = nothing }\n"
COUNT = SEVERAL + 3
ON_TWO = "import os; os.cpu_count = lambda: 2; from burnish.commands.cli import main; main()"
"""Runs a command line as on two processors."""


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Tests verify all passes, which other processes do not do for this one."""
    monkeypatch.delenv(VARIABLE)
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")


def write(count: int) -> list[str]:
    """Write files with a material each; returns their names."""
    names = [f"m{number:02}.burnish" for number in range(count)]
    for number, name in enumerate(names):
        Path(name).write_text(MATERIAL.format(number))
    return names


def contents(folder: str) -> dict[str, str]:
    return {path.name: path.read_text() for path in Path(folder).iterdir()}


@pytest.mark.parametrize("processors", [1, 3])
def test_they_become_what_each_becomes(processors: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "cpu_count", lambda: processors)
    names = write(COUNT)
    done = invoke("compile", *names, "-t", "wgsl", "-o", "all")
    assert (done.exit_code, done.stderr) == (0, "")
    lines = [f"M{number}: 2 shaders and M{number}.json in all" for number in range(COUNT)]
    assert done.stdout.splitlines() == lines
    for name in (names[0], names[-1]):
        assert invoke("compile", name, "-t", "wgsl", "-o", "one").exit_code == 0
    assert contents("one").items() <= contents("all").items()
    assert len(contents("all")) == 3 * COUNT
    printed = invoke("compile", *names, "-t", "wgsl", "-o", "-").stdout
    for name, text in contents("all").items():
        assert name.endswith(".json") or f"// ======== {name}\n{text}" in printed


def test_one_that_is_wrong_leaves_nothing_of_all() -> None:
    """All mistakes are told, in the order of the files."""
    names = write(COUNT)
    Path("wrong.burnish").write_text(WRONG)
    done = shell("compile", "wrong.burnish", *names, "none.burnish", "-o", "out", folder=Path.cwd())
    assert (done.returncode, done.stdout) == (1, "")
    assert (
        done.stderr
        == """\
error[B0201]: unknown name `nothing`
 --> wrong.burnish:1:26
  |
1 | material Wrong { color = nothing }
  |                          ^^^^^^^
  = help: nothing declares it: `nothing = …` does, or `param nothing : type` if the host sets it

error[B0001]: there is no file `none.burnish`
  = help: Check the path: it is taken relative to the folder the command is run in.

2 errors
"""
    )
    assert "out" not in tree(Path.cwd())


@pytest.mark.parametrize("other", ["M0", "m0"])
def test_two_files_that_would_write_one(other: str) -> None:
    write(1)
    Path("other.burnish").write_text(f"material {other} {{ }}")
    done = invoke("compile", "m00.burnish", "other.burnish", "-t", "wgsl", "-o", "out")
    assert done.exit_code == 1
    assert done.stderr.startswith(
        f"error[B0018]: `m00.burnish` and `other.burnish` would both write `{other}.vert.wgsl`\n"
    )
    assert "out" not in tree(Path.cwd())


def test_a_file_that_is_named_twice_is_compiled_once() -> None:
    write(1)
    done = invoke("compile", "m00.burnish", "m00.burnish", "-t", "wgsl", "-o", "out")
    assert (done.exit_code, done.stdout) == (0, "M0: 2 shaders and M0.json in out\n")


def test_the_same_again_is_not_compiled() -> None:
    names = write(3)
    first = shell("compile", *names, "-o", "out", folder=Path.cwd())
    before = contents("out")
    Path("out/M1.json").unlink()
    again = shell("compile", *names, "-o", "out", folder=Path.cwd())
    assert (again.returncode, again.stdout) == (0, first.stdout)
    assert contents("out") == before
    (tmp,) = Path(os.environ["BURNISH_CACHE"]).rglob("result/*")
    assert "M1.json" in tmp.read_bytes().decode("latin-1")
    Path(names[1]).write_text(MATERIAL.format(77))
    changed = shell("compile", *names, "-o", "out", folder=Path.cwd())
    assert changed.stdout == first.stdout.replace("M1", "M77")


def test_processes_that_die_cost_only_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compiled_files, "_PROCESS", "burnish.no_such_module")
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    done = invoke("compile", *write(COUNT), "-t", "wgsl", "-o", "out")
    assert (done.exit_code, len(contents("out"))) == (0, 3 * COUNT)


@pytest.mark.usefixtures("interruptible")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_an_interrupted_run_leaves_nothing(number: signal.Signals) -> None:
    names = write(200)
    command = [sys.executable, "-c", ON_TWO, "compile", *names, "-o", "out"]
    with started(command, cwd=Path.cwd()) as program:
        until(lambda: "compile_process" in str(program.family()), "processes that compile")
        program.signal(number)
        assert program.exit_code() in (128 + number, -number)
        until(lambda: not program.family(), "the end of all processes")
        said = program.ended()
    assert "Traceback" not in said.stderr
    assert tree(Path.cwd()) == set(names)
