"""Output is written whole or not at all, and under the names that are promised."""

from __future__ import annotations

import json
import os
import sys
from functools import partial
from pathlib import Path

import pytest

from burnish.commands import output
from burnish.compiler.diagnostics.diagnostic import CompileError

from ..suite.processes import Background, at_once, run
from .kit import PLAIN, invoke, shell, tree

OLD = "what was there before"


@pytest.fixture
def material(tmp_path: Path) -> Path:
    file = tmp_path / "m.burnish"
    file.write_text(PLAIN)
    return file


def test_names_of_the_files(material: Path, tmp_path: Path) -> None:
    result = invoke("compile", material, "-t", "hlsl,glsl:es300", "-t", "wgsl", "-o", tmp_path)
    assert result.exit_code == 0, result.stderr
    assert result.stderr == ""
    assert tree(tmp_path) == {
        "m.burnish", "Plain.json",
        "Plain.vert.hlsl", "Plain.frag.hlsl", "Plain.vert.wgsl", "Plain.frag.wgsl",
        "Plain.es300.vert.glsl", "Plain.es300.frag.glsl",
    }  # fmt: skip
    reflection = json.loads((tmp_path / "Plain.json").read_text("utf-8"))
    assert reflection["material"] == "Plain"


def test_by_default_all_targets(material: Path, tmp_path: Path) -> None:
    result = invoke("compile", material, "-o", tmp_path / "a" / "b")
    assert result.exit_code == 0
    assert len(tree(tmp_path / "a" / "b")) == 7
    assert result.stdout == f"Plain: 6 shaders and Plain.json in {tmp_path / 'a' / 'b'}\n"


def test_single_file(material: Path, tmp_path: Path) -> None:
    invoke("compile", material, "-t", "wgsl", "--single-file", "-o", tmp_path)
    text = (tmp_path / "Plain.wgsl").read_text("utf-8")
    assert "fn vs_main" in text
    assert "fn fs_main" in text


def test_one_material_of_several(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text("material A { }\nmaterial B { }\nabstract material C { }")
    invoke("compile", file, "--material", "B", "-t", "wgsl", "-o", tmp_path / "b")
    assert tree(tmp_path / "b") == {"B.vert.wgsl", "B.frag.wgsl", "B.json"}
    invoke("compile", file, "-t", "wgsl", "-o", tmp_path / "all")
    assert {name.partition(".")[0] for name in tree(tmp_path / "all")} == {"A", "B"}


def test_one_shader_is_printed_bare(material: Path) -> None:
    result = invoke("compile", material, "-t", "wgsl", "--single-file", "-o", "-")
    assert result.stdout.startswith("// Plain: vertex and fragment shaders")
    assert result.stdout.endswith("}\n")


def test_several_shaders_are_printed_with_headings(material: Path) -> None:
    printed = invoke("compile", material, "-t", "glsl", "-o", "-").stdout
    headings = [line for line in printed.splitlines() if line.startswith("// ====")]
    assert headings == ["// ======== Plain.vert.glsl", "// ======== Plain.frag.glsl"]


def test_a_poor_terminal_gets_the_same_shader(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text("/// Größe → 大\nmaterial Plain { }\n", "utf-8")
    command = [sys.executable, "-X", "utf8=0", "-m", "burnish", "compile", str(file), "-o", "-"]
    printed = run(command, env={"PYTHONIOENCODING": "ascii"}, check=True).stdout
    assert "// Größe → 大" in printed


def test_a_file_in_the_way_of_the_folder(material: Path, tmp_path: Path) -> None:
    taken = tmp_path / "taken"
    taken.write_text(OLD)
    for folder in (taken, taken / "below"):
        result = invoke("compile", material, "-o", folder)
        assert result.stderr.startswith(f"error[B0009]: cannot write to `{folder}`: ")
        assert (result.exit_code, result.stdout) == (1, "")
    assert taken.read_text() == OLD


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="a folder that even root cannot write to")
def test_a_folder_that_refuses(material: Path) -> None:
    result = invoke("compile", material, "-o", "/proc/burnish")
    assert result.stderr.startswith("error[B0009]: cannot write to `/proc/burnish`: ")
    assert result.exit_code == 1


def test_a_folder_in_the_way_of_a_file(material: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    (out / "Plain.vert.wgsl").mkdir(parents=True)
    (out / "Plain.frag.wgsl").write_text(OLD)
    result = invoke("compile", material, "-o", out)
    assert "error[B0009]: cannot write to" in result.stderr
    assert "it is a folder" in result.stderr
    assert tree(out) == {"Plain.vert.wgsl", "Plain.frag.wgsl"}
    assert (out / "Plain.frag.wgsl").read_text() == OLD


def test_errors_leave_the_old_output_alone(material: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    invoke("compile", material, "-o", out)
    before = {path: path.read_bytes() for path in out.iterdir()}
    material.write_text("material Plain { color = vec3(0) }\nmaterial Other { color = vec3(x) }")
    assert invoke("compile", material, "-o", out).exit_code == 1
    assert {path: path.read_bytes() for path in out.iterdir()} == before


def test_a_full_disk_leaves_the_old_output_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a").write_text(OLD)

    opened = os.open
    count = 0

    def full(path: str, flags: int, *mode: int, dir_fd: int | None = None) -> int:
        nonlocal count
        count += bool(flags & os.O_CREAT)
        if count == 2:
            raise OSError(28, "No space left on device")
        return opened(path, flags, *mode, dir_fd=dir_fd)

    monkeypatch.setattr(os, "open", full)
    with pytest.raises(CompileError, match="No space left on device"):
        output.write_all(tmp_path, {"a": "new", "b": "new", "c": "new"})
    assert tree(tmp_path) == {"a"}
    assert (tmp_path / "a").read_text() == OLD


COUNTING = """
import sys
from burnish.commands import cli
from burnish.api import entry_points as api

compile = api.compile

def counted(*arguments, **options):
    print("compiled", file=sys.stderr)
    return compile(*arguments, **options)

api.compile = counted
cli.main()
"""


def test_a_reader_that_has_left_does_not_start_another_compile(
    material: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """For ``burnish compile m.burnish -o - | head``, the output is known the second time."""
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    monkeypatch.delenv("BURNISH_VERIFY", raising=False)  # Nothing is known again where it is set.
    command = [sys.executable, "-c", COUNTING, "compile", str(material), "-o", "-"]
    known = run([*command, "-t", "wgsl"], check=True)
    assert known.stderr == "compiled\n"
    for target, said in (("glsl", "compiled\n"), ("wgsl", "")):
        reading, writing = os.pipe()
        os.close(reading)
        with os.fdopen(writing, "wb") as left:
            ended = run([*command, "-t", target], stdout=left)
        assert (ended.returncode, ended.stderr) == (1, said), target


def test_two_compiles_at_once(tmp_path: Path) -> None:
    """Each file in the end is one of the two, and nothing else lies there."""
    names = ("red", "blue")
    for name in names:
        (tmp_path / f"{name}.burnish").write_text(f"/// {name * 5000}\nmaterial Plain {{ }}")
        assert shell("compile", f"{name}.burnish", "-o", name, folder=tmp_path).returncode == 0
    command = [sys.executable, "-m", "burnish", "compile", "--force", "-o", "both"]
    for _ in range(3):
        commands = [[*command, f"{name}.burnish"] for name in names]
        done = at_once([partial(run, each, cwd=tmp_path) for each in commands])
        assert [each.returncode for each in done] == [0, 0]
        assert tree(tmp_path / "both") == tree(tmp_path / "red")
        for path in (tmp_path / "both").iterdir():
            whole = [(tmp_path / name / path.name).read_bytes() for name in names]
            assert path.read_bytes() in whole


def test_a_link_among_the_outputs_is_replaced(material: Path, tmp_path: Path) -> None:
    other = tmp_path / "other"
    other.write_text(OLD)
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "Plain.json").symlink_to(other)
    assert invoke("compile", material, "-o", tmp_path / "out").exit_code == 0
    assert other.read_text() == OLD
    assert not (tmp_path / "out" / "Plain.json").is_symlink()


@pytest.mark.parametrize("target", ["real.dot", "none", ".", "/dev/null"])
def test_a_link_with_the_name_of_an_output_is_replaced(
    target: str, material: Path, tmp_path: Path
) -> None:
    """The link may lead anywhere: it may have come with a cloned repository."""
    (tmp_path / "real.dot").write_text(OLD)
    link = tmp_path / "link.dot"
    link.symlink_to(target)
    assert invoke("graph", material, "-o", link).exit_code == 0
    assert not link.is_symlink()
    assert link.read_text().startswith("digraph")
    assert (tmp_path / "real.dot").read_text() == OLD
    assert not (tmp_path / "none").exists()


def test_a_pipe_that_nobody_reads_is_not_waited_for(material: Path, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.dot")
    done = shell("graph", material, "-o", "pipe.dot", folder=tmp_path)
    assert done.returncode == 1
    assert "error[B0009]: cannot write to `pipe.dot`: nobody reads this pipe\n" in done.stderr


@pytest.mark.parametrize(
    "arguments", [("graph", "--format", "dot"), ("render", "--size", "4")], ids=lambda each: each[0]
)
def test_a_device_is_written_to(arguments: tuple[str, ...], material: Path, tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.png"
    os.mkfifo(pipe)
    name, *options = arguments
    reading = Background(pipe.read_bytes)
    assert shell(name, material, "-o", pipe, *options, folder=tmp_path).returncode == 0
    written = reading.returned()
    assert written.startswith((b"digraph", b"\x89PNG"))
    assert pipe.is_fifo()
    assert tree(tmp_path) == {"m.burnish", "pipe.png"}


def test_files_of_other_names_stay(material: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    invoke("compile", material, "-t", "wgsl", "-o", out)
    material.write_text("material Other { }")
    invoke("compile", material, "-t", "wgsl", "-o", out)
    assert {"Plain.json", "Plain.frag.wgsl", "Other.json", "Other.frag.wgsl"} <= tree(out)
