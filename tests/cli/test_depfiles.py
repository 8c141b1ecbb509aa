"""``--depfile`` and ``--list-outputs``: what a build system has to know of a compile."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from burnish.commands.depfiles import escaped
from burnish.compiler.frontend import current_library
from burnish.compiler.inputs import Inputs

from ..suite.processes import run
from .kit import PLAIN, invoke, shell, tree

TINTED = """\
import "tints.burnish".{tint}
import std.noise.{value_noise}
material T { color = tint(uv.x) }
"""
TINTS = 'import "deep/er.burnish".{half}\nfn tint(at: float) = vec3(half(at))\n'


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    monkeypatch.delenv("BURNISH_VERIFY", raising=False)
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")


def write_project() -> None:
    Path("inc/deep").mkdir(parents=True)
    Path("t.burnish").write_text(TINTED)
    Path("inc/tints.burnish").write_text(TINTS)
    Path("inc/deep/er.burnish").write_text("fn half(at: float) = at / 2.0\n")


def parts(text: str) -> tuple[list[str], list[str]]:
    """The targets and the prerequisites of a rule whose names have no special characters."""
    left, _, right = text.replace("\\\n", "").partition(":")
    return left.split(), right.split()


def test_all_files_that_were_read_are_in_it() -> None:
    write_project()
    line = ("compile", "t.burnish", "-I", "inc", "-t", "wgsl", "-o", "out", "--depfile", "t.d")
    done = invoke(*line)
    assert (done.exit_code, done.stderr) == (0, "")
    targets, read = parts(Path("t.d").read_text())
    assert targets == ["out/T.vert.wgsl", "out/T.frag.wgsl", "out/T.json"]
    own, library = read[:3], read[3:]
    assert own == ["t.burnish", "inc/tints.burnish", "inc/deep/er.burnish"]
    folder = current_library().folder
    assert {str(folder / name) for name in ("prelude.burnish", "noise.burnish")} <= set(library)
    assert all(Path(each).is_file() and Path(each).is_relative_to(folder) for each in library)
    assert str(folder / "cameras.burnish") not in library, "it was not imported"


def test_it_is_written_again_with_what_is_known() -> None:
    write_project()
    line = ("compile", "t.burnish", "-I", "inc", "-t", "wgsl", "-o", "out", "--depfile", "d/t.d")
    assert shell(*line, folder=Path.cwd()).returncode == 0
    before = Path("d/t.d").read_text()
    Path("d/t.d").unlink()  # As Ninja does.
    assert shell(*line, folder=Path.cwd()).returncode == 0
    assert Path("d/t.d").read_text() == before


def test_several_files_and_a_target_of_its_own() -> None:
    for name in ("a", "b"):
        Path(f"{name}.burnish").write_text(PLAIN.replace("Plain", name.upper()))
    line = ("compile", "a.burnish", "b.burnish", "-t", "wgsl")
    done = invoke(*line, "-o", "out", "--depfile", "all.d", "--depfile-target", "out/stamp")
    assert (done.exit_code, done.stderr) == (0, "")
    targets, read = parts(Path("all.d").read_text())
    assert (targets, read[:2]) == (["out/stamp"], ["a.burnish", "b.burnish"])
    known = invoke(*line, "-o", "-", "--depfile", "all.d", "--depfile-target", "shaders.txt")
    assert known.exit_code == 0
    assert parts(Path("all.d").read_text())[0] == ["shaders.txt"]


HARD = ["a b", "a#b", "a$b", "a:b", "a\\b", "a b\\ c", "ü", "a\tb", "a'b"]


@pytest.mark.skipif(os.name == "nt", reason="names that Windows does not allow")
@pytest.mark.parametrize("name", HARD)
def test_make_reads_any_name(name: str) -> None:
    """Make builds again if the file with this name is newer, and does not if it is older."""
    Path(name).touch()
    Path("Makefile").write_text(f"all: stamp\nstamp: {escaped(name)}\n\t@touch stamp; echo built\n")
    assert run(["make", "-s"], check=True).stdout == "built\n"
    assert run(["make", "-s"], check=True).stdout == ""
    os.utime(name, (4e9, 4e9))
    assert run(["make", "-s"], check=True).stdout == "built\n"


def test_a_name_that_no_rule_has() -> None:
    Path("line\nbreak.burnish").write_text(PLAIN)
    done = invoke("compile", "line\nbreak.burnish", "-o", "out", "--depfile", "x.d")
    assert done.exit_code == 1
    assert done.stderr.startswith(
        "error[B0009]: cannot write to `x.d`: it has a line break, which no rule of Make can name\n"
    )
    assert "out" not in tree(Path.cwd())


@pytest.mark.parametrize(
    ("path", "reason"),
    [
        ("m.burnish", "it is one of the files that were read"),
        ("out/Plain.json", "it is one of the outputs"),
        ("folder", "it is a folder"),
        ("m.burnish/x.d", "`m.burnish` is a file, not a folder"),
    ],
)
def test_a_depfile_that_would_be_in_the_way(path: str, reason: str) -> None:
    Path("m.burnish").write_text(PLAIN)
    Path("folder").mkdir()
    done = invoke("compile", "m.burnish", "-t", "wgsl", "-o", "out", "--depfile", path)
    assert done.exit_code == 1
    assert done.stderr.startswith(f"error[B0009]: cannot write to `{path}`: {reason}\n")
    assert tree(Path.cwd()) == {"m.burnish", "folder"}


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("-o - --depfile d", "--depfile with -o - has no outputs to speak of"),
        ("-o out --depfile -", "--depfile is a file: what is printed are the shaders"),
        ("-o out --depfile-target x", "--depfile-target is a name in the file of --depfile"),
        ("-o - --list-outputs", "--list-outputs names files: it goes with a folder, not with -o -"),
        ("-o out --list-outputs --why", "--list-outputs prints nothing else"),
        ("-o out --list-outputs --depfile d", "writes nothing: not with --depfile"),
    ],
)
def test_options_that_do_not_go_together(words: str, told: str) -> None:
    Path("m.burnish").write_text(PLAIN)
    done = invoke("compile", "m.burnish", *words.split())
    assert (done.exit_code, done.stdout) == (2, "")
    assert told in done.stderr
    assert tree(Path.cwd()) == {"m.burnish"}


def test_outputs_are_listed_and_not_written() -> None:
    write_project()
    line = ("compile", "t.burnish", "-I", "inc", "-t", "wgsl,glsl:es300", "-o", "out dir/sub")
    for _ in range(2):  # The second time, the result is known.
        listed = shell(*line, "--list-outputs", folder=Path.cwd())
        assert (listed.returncode, listed.stderr) == (0, "")
        assert "out dir" not in tree(Path.cwd())
    assert invoke(*line).exit_code == 0
    written = [str(path) for path in Path("out dir/sub").iterdir()]
    assert sorted(listed.stdout.splitlines()) == sorted(written)
    assert listed.stdout.splitlines()[-1] == "out dir/sub/T.json"


def test_two_files_with_one_output_are_told_when_outputs_are_listed() -> None:
    for name in ("a", "b"):
        Path(f"{name}.burnish").write_text(PLAIN)
    done = invoke("compile", "a.burnish", "b.burnish", "-o", "out", "--list-outputs")
    assert (done.exit_code, done.stdout) == (1, "")
    assert done.stderr.startswith("error[B0018]: ")


def test_inputs_of_several_compiles_have_all_files_of_the_library() -> None:
    one, two = Inputs(), Inputs()
    one.of_library([Path("/a"), Path("/b")])
    two.of_library([Path("/b"), Path("/c")])
    assert list(one.joined([two]).library) == ["/a", "/b", "/c"]
