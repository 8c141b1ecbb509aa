"""Graphs for Ninja, run by Ninja itself: it runs exactly what depends on a change."""

from __future__ import annotations

import re
import shlex
import sys
from pathlib import Path

import pytest

from burnish.compiler.watching import VARIABLE
from burnish.targets.toolchain.tools import program

from ..suite.processes import run
from .build_kit import FILES, LINE, TONES, write_project
from .kit import invoke, tree

PROGRAM = ("--program", shlex.join([sys.executable, "-m", "burnish"]))
UNCHANGED = "ninja: no work to do.\n"


@pytest.fixture(autouse=True)
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.delenv(VARIABLE)
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    write_project(tmp_path / "project")
    monkeypatch.chdir(tmp_path / "project")
    return tmp_path / "project"


def write_graph(*files: str) -> str:
    """Write a graph; returns its text."""
    done = invoke("build", *files, *LINE, *PROGRAM, "--ninja")
    assert (done.exit_code, done.stderr) == (0, "")
    return Path("build.ninja").read_text()


def ninja(*options: str, code: int = 0) -> str:
    """What Ninja prints."""
    tool = program("ninja", "ninja")
    assert tool is not None
    done = run([str(tool), *options])
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout


def ran() -> set[str]:
    """The folders of the actions that Ninja runs."""
    return {
        line.partition("] burnish ")[2]
        for line in ninja().splitlines()
        if re.match(r"\[\d+/\d+\] burnish (?!build --ninja)", line)
    }


def test_what_depends_on_a_change_is_run_and_nothing_else() -> None:
    text = write_graph("materials/a.burnish", "materials/b.burnish", "materials/c.burnish")
    with Path("more.ninja").open("w") as more:
        more.write("include build.ninja\nrule copy\n  command = cp $in $out\n")
        more.write("build copied.wgsl: copy build/materials/a/A.frag.wgsl\n")
    assert ran() == {f"build/materials/{name}" for name in "abc"}
    assert "copied.wgsl" in ninja("-f", "more.ninja", "-d", "explain")
    assert (ninja(), ninja("-n")) == (UNCHANGED, UNCHANGED)

    Path(TONES).write_text(FILES[TONES].replace("0.5", "0.7"))
    assert ran() == {"build/materials/a", "build/materials/b"}
    assert Path("build.ninja").read_text() == text
    assert "copied.wgsl" in ninja("-f", "more.ninja", "-d", "explain")

    Path(TONES).write_text(f"// A remark changes no output.\n{Path(TONES).read_text()}")
    assert ran() == {"build/materials/a", "build/materials/b"}
    assert ninja("-f", "more.ninja") == UNCHANGED, "what has the same bytes keeps its date"

    Path("build/materials/c/C.json").unlink()
    assert ran() == {"build/materials/c"}
    assert (ninja(), ninja("-n")) == (UNCHANGED, UNCHANGED)


def test_graphs_follow_their_files() -> None:
    """A file with another material has other outputs, and one that is gone has none."""
    write_graph("materials")
    assert ran() == {f"build/materials/{name}" for name in "abc"} | {
        "build/materials/metal/r/Day", "build/materials/metal/r/Night",
    }  # fmt: skip
    Path("materials/c.burnish").write_text("material D { color = vec3(0.2) }\n")
    Path("materials/a.burnish").unlink()
    assert ran() == {"build/materials/c"}
    assert Path("build/materials/c/D.frag.wgsl").is_file()
    assert "materials/a" not in Path("build.ninja").read_text()


def test_batches_are_run_by_one_process_each() -> None:
    """All that import the changed file are in one batch with some that do not."""
    write_graph("materials", "--batch", "1000")
    folders = [*(f"materials/{name}" for name in "abc"), "materials/metal/r/Day"]
    batch = " ".join(f"build/{name}" for name in (*folders, "materials/metal/r/Night"))
    assert ran() == {batch}
    Path(TONES).write_text(FILES[TONES].replace("0.5", "0.7"))
    assert ran() == {batch}
    assert ninja() == UNCHANGED


def test_names_are_escaped() -> None:
    """Blanks, colons and dollars in names, which mean something to Ninja and to the shell."""
    name = "a $b: 'c' & #d"
    Path(f"{name}.burnish").write_text(FILES["materials/c.burnish"])
    text = write_graph(f"{name}.burnish")
    assert "build build/a$ $$b$:$ 'c'$ &$ #d/C.frag.wgsl $\n" in text
    assert ran() == {f"build/{name}"}
    assert {f"build/{name}/C.json", f"build/{name}/C.frag.wgsl"} <= tree(Path.cwd())
    assert ninja() == UNCHANGED


@pytest.mark.parametrize(("sign", "shown"), [("\n", r"'\n'"), ("|", "'|'"), ("\r", r"'\r'")])
def test_names_that_ninja_cannot_have_are_told(sign: str, shown: str) -> None:
    Path(f"a{sign}b.burnish").write_text(FILES["materials/c.burnish"])
    before = tree(Path.cwd())
    done = invoke("build", f"a{sign}b.burnish", "-t", "wgsl", "--ninja")
    assert (done.exit_code, done.stdout) == (1, "")
    assert done.stderr.startswith(f"error: a graph for Ninja cannot have {shown} in a name")
    assert tree(Path.cwd()) == before


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("material C { color = nothing }\n", "unknown name `nothing`"),
        ("material {\n", "error[B0101]"),
        ('import "late.burnish".{shade}\nmaterial C { color = shade() }\n', "error[B0"),
    ],
)
def test_a_mistake_is_told_by_its_own_action_and_keeps_no_other_from_being_built(
    text: str, message: str
) -> None:
    write_graph("materials")
    ran()
    Path("more.ninja").write_text(
        "include build.ninja\nrule copy\n  command = cp $in $out\n"
        "build copied.wgsl: copy build/materials/c/C.frag.wgsl\n"
    )
    right, day = Path("materials/c.burnish").read_text(), Path("materials/metal/r.burnish")
    Path("materials/c.burnish").write_text(text)
    day.write_text(day.read_text().replace("0.1", "0.3"))
    before = Path("build/materials/c/C.frag.wgsl").read_bytes()
    said = ninja("-k", "0", "-f", "more.ninja", code=1)
    assert said.count(message) == 1
    assert "FAILED: " in said and "build/materials/c/C.frag.wgsl" in said
    assert "0.3" in Path("build/materials/metal/r/Day/R.Day.frag.wgsl").read_text()
    assert Path("build/materials/c/C.frag.wgsl").read_bytes() == before
    assert not Path("copied.wgsl").exists(), "it would be made of an old output"
    Path("late.burnish").write_text("fn shade() -> rgb = vec3(0.4)\n")
    if "late" not in text:
        Path("materials/c.burnish").write_text(right.replace("0.2", "0.4"))
    ninja()
    ninja("-f", "more.ninja")
    assert "0.4" in Path("copied.wgsl").read_text()
    assert ninja("-f", "more.ninja") == UNCHANGED


def test_a_file_that_cannot_be_read_has_the_outputs_of_all_its_rigs() -> None:
    write_graph("materials")
    names = re.findall(r"build/materials/metal/r/\S+\.wgsl", Path("build.ninja").read_text())
    Path("materials/metal/r.burnish").write_text("rig {\n")
    Path("materials/new.burnish").write_text("material {\n")
    done = invoke("build", "materials", *LINE, *PROGRAM, "--ninja")
    assert (done.exit_code, done.stderr) == (0, "")
    assert done.stdout == (
        "build.ninja: 5 actions; `materials/new`, `materials/metal/r` will fail, and tell the "
        "mistake\n"
    )
    text = Path("build.ninja").read_text()
    assert names and all(each in text for each in names)
    assert "build build/materials/new/unknown-outputs: burnish_compile" in text


def test_another_burnish_runs_everything_again(monkeypatch: pytest.MonkeyPatch) -> None:
    write_graph("materials/c.burnish")
    assert ran() == {"build/materials/c"}
    Path("build/burnish-program.txt").write_text("another one\n")
    assert ran() == {"build/materials/c"}
    monkeypatch.setattr("os.cpu_count", lambda: 3)
    assert "depth = 3\n" in write_graph("materials/c.burnish", "-j", "3")


@pytest.mark.parametrize("kind", ["--ninja", "--actions"])
def test_no_graph_takes_the_place_of_a_source(kind: str) -> None:
    source = Path("materials/c.burnish")
    before = source.read_text()
    done = invoke("build", "materials", *LINE, kind, "--to", str(source))
    assert (done.exit_code, done.stdout) == (1, "")
    said = f"`{source}` would be overwritten, and `burnish build {kind}` has not written it"
    assert said in done.stderr
    assert source.read_text() == before
