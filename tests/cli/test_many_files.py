"""``burnish compile`` with several files: it writes what each of them becomes, or nothing."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from burnish.commands import compiled_files, kept_files, many_files, results
from burnish.commands.compile_options import CompileRequest
from burnish.commands.compiled_record import Compiled
from burnish.commands.group import burnish
from burnish.commands.many_files import SEVERAL
from burnish.compiler import cache
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


def test_a_name_that_files_do_not_have_is_told_of_each() -> None:
    names = write(2)
    done = invoke("compile", *names, "--material", "Q", "-o", "all", "--format", "line")
    assert (done.exit_code, done.stdout) == (1, "")
    assert done.stderr == (
        "m00.burnish:1:1: error: B0201: unknown material `Q`; there is M0\n"
        "m01.burnish:1:1: error: B0201: unknown material `Q`; there is M1\n"
    )


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


def compiles(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of the files that are compiled from now on, by this process."""
    seen: list[str] = []
    compile_one = compiled_files.compiled

    def compiled(request: CompileRequest) -> Compiled:
        seen.extend(map(str, request.files))
        return compile_one(request)

    monkeypatch.setattr(many_files, "compiled", compiled)
    return seen


def ask(*words: str) -> Result:
    """Run a command line, whose output as a whole is not kept."""
    question = results.ask(list(words))
    assert question is not None or "--no-cache" in words
    return CliRunner().invoke(burnish, words, obj=question, catch_exceptions=False)


def test_only_what_has_changed_is_compiled_again(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = compiles(monkeypatch)
    Path("tints.burnish").write_text("fn tint(at: float) = at + 0.25")
    tinted = 'import "tints.burnish".{{tint}}\nmaterial T{0} {{ color = vec3(tint(0.{0})) }}\n'
    names = write(3)
    for number in (7, 8):
        Path(f"t{number}.burnish").write_text(tinted.format(number))
        names.append(f"t{number}.burnish")
    warns = "material Warns { colour = vec3(1)\n color = vec3(1) }"
    line = ("compile", *names, "-t", "wgsl", "-o", "out")
    first = ask(*line)
    assert (first.exit_code, seen) == (0, names)
    before = contents("out")
    del seen[:]
    assert ask(*line).stdout == first.stdout
    assert (seen, contents("out")) == ([], before)
    Path("tints.burnish").write_text("fn tint(at: float) = at + 0.75")
    assert ask(*line).stdout == first.stdout
    assert seen == ["t7.burnish", "t8.burnish"]
    assert {name for name, text in contents("out").items() if before[name] != text} == {
        "T7.frag.wgsl", "T8.frag.wgsl"
    }  # fmt: skip
    del seen[:]
    Path(names[1]).write_text(WRONG)
    assert ask(*line).exit_code == 1
    Path(names[1]).write_text(warns)
    for _ in range(2):
        assert "nothing reads `colour`" in ask(*line).stderr
    assert seen == [names[1]] * 3
    del seen[:]
    assert ask(*line[:-3], "glsl", "-o", "out").exit_code == 0
    assert seen == names
    del seen[:]
    assert ask(*line, "--no-cache").exit_code == 0
    assert seen == names


def test_what_processes_make_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    names = write(COUNT)
    line = ("compile", *names, "-t", "wgsl", "-o", "out")
    first, before = ask(*line), contents("out")
    seen = compiles(monkeypatch)
    Path(names[3]).write_text(MATERIAL.format(77))
    again = ask(*line)
    assert again.stdout == first.stdout.replace("M3:", "M77:").replace("M3.json", "M77.json")
    assert seen == [names[3]]
    assert before.items() <= contents("out").items()


def test_entries_are_pruned_once_behind_all(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kept_files, "MOST", 4)
    looked: list[str] = []
    files = cache.private_files

    def counted(place: str) -> list[tuple[str, os.stat_result]]:
        looked.append(Path(place).name)
        return files(place)

    monkeypatch.setattr(cache, "private_files", counted)
    seen = compiles(monkeypatch)
    line = ("compile", *write(6), "-t", "wgsl", "-o", "out")
    assert ask(*line).exit_code == 0
    assert looked.count("file") == 1
    assert len(list(Path(os.environ["BURNISH_CACHE"]).rglob("file/*"))) == 4
    del seen[:]
    assert ask(*line).exit_code == 0
    assert len(seen) == 2


def test_damaged_entries_are_not_used(monkeypatch: pytest.MonkeyPatch) -> None:
    seen = compiles(monkeypatch)
    names = write(4)
    line = ("compile", *names, "-t", "wgsl", "-o", "out")
    first = ask(*line)
    entries = sorted(Path(os.environ["BURNISH_CACHE"]).rglob("file/*"))
    entries[0].write_bytes(b"short")
    cache.store("file", entries[1].name, b"[]")
    cache.store("file", entries[2].name, b"{}")
    entries[3].chmod(0o644)  # Others could have written there.
    del seen[:]
    assert ask(*line).stdout == first.stdout
    assert seen == names


def test_processes_that_die_cost_only_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(many_files, "_PROCESS", "burnish.no_such_module")
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
