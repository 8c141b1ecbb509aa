"""``burnish compile`` overwrites nothing silently: neither of one run nor of an earlier one."""

from __future__ import annotations

import json
import sys
from functools import partial
from pathlib import Path

import pytest

from ..suite.processes import at_once, run
from .kit import PLAIN, invoke, shell, tree

LIT = """\
rig Day {{ sun : Directional }}
rig Night {{ moon : Directional }}
pass Fog : Forward {{ target color : rgba16f = vec4(color * 0.5, 1) }}
material Wall {{ color = lambert({}) }}
"""
IMPORTS = "import std.lights.{Directional}\nimport std.terms.{lambert}\n"


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    monkeypatch.delenv("BURNISH_VERIFY", raising=False)
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")


def names(folder: str) -> set[str]:
    return tree(Path(folder))


def contents(folder: str) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in Path(folder).iterdir()}


def of(stem: str) -> set[str]:
    return {f"{stem}.{ending}" for ending in ("vert.wgsl", "frag.wgsl", "json")}


def test_passes_and_rigs_are_in_names_where_there_are_several() -> None:
    Path("m.burnish").write_text(IMPORTS + LIT.format("#888888"))
    line = ("compile", "m.burnish", "-t", "wgsl", "-o", "out")
    expected = set[str]()
    for options, stem in (
        (("--rig", "Day"), "Wall.Day"),
        (("--rig", "Night"), "Wall.Night"),
        (("--rig", "Night", "--pass", "Fog"), "Wall.Fog.Night"),
        (("--rig", "Night", "--pass", "Forward"), "Wall.Night"),
    ):
        done = invoke(*line, *options)
        assert (done.exit_code, done.stderr) == (0, "")
        assert done.stdout.startswith(f"Wall: 2 shaders and {stem}.json in out\n")
        expected |= of(stem)
        assert names("out") == expected
        reflection = json.loads(Path(f"out/{stem}.json").read_text())
        files = {row["file"] for row in reflection["backends"]["wgsl:webgpu"]["files"]}
        assert files == of(stem) - {f"{stem}.json"}


def test_what_would_be_chosen_anyway_is_not_in_names() -> None:
    text = LIT.format("#888888").replace("rig Night { moon : Directional }\n", "")
    Path("m.burnish").write_text(IMPORTS + text)
    for options in ((), ("--rig", "Day"), ("--pass", "Forward")):
        assert invoke("compile", "m.burnish", "-t", "wgsl", "-o", "out", *options).exit_code == 0
    assert names("out") == of("Wall")


FRAME = """
frame Shown {
    models scene : Wall
    drawn = Forward(scene)
    output picture = drawn.color
}
"""


def test_plans_of_frames_name_the_rig_and_the_files_of_shaders() -> None:
    Path("f.burnish").write_text(IMPORTS + LIT.format("#888888") + FRAME)
    for rig in ("Day", "Night"):
        done = invoke("compile", "f.burnish", "-t", "wgsl", "-o", "out", "--rig", rig)
        assert (done.exit_code, done.stderr) == (0, "")
        plan = json.loads(Path(f"out/Shown.{rig}.plan.json").read_text())
        assert [row["reflection"] for row in plan["shaders"]] == [f"Shown.Forward.Wall.{rig}.json"]
    shader = of("Shown.Forward.Wall.Day") | of("Shown.Forward.Wall.Night")
    assert names("out") == shader | {"Shown.Day.plan.json", "Shown.Night.plan.json"}


def test_names_that_are_one_on_many_disks() -> None:
    Path("m.burnish").write_text("material Wall { }\nmaterial WALL { }\n")
    done = invoke("compile", "m.burnish", "-t", "wgsl", "-o", "out")
    assert done.exit_code == 1
    assert done.stderr.endswith(
        "error[B0019]: `m.burnish` would be written to `Wall.vert.wgsl` and to `WALL.vert.wgsl`, "
        "which are one file on many disks\n"
        "  = help: Outputs are called by their materials and frames. On the disks of Windows and "
        "macOS, names that differ in capital letters only are the same: rename one, or compile "
        "each into a folder of its own, by `--material`.\n\n1 warning, 1 error\n"
    )
    assert "out" not in names(".")


def test_a_second_source_does_not_overwrite_what_the_first_has_become() -> None:
    Path("a").mkdir()
    Path("b").mkdir()
    Path("a/m.burnish").write_text(PLAIN)
    Path("b/m.burnish").write_text("/// Another one.\nmaterial Plain { color = vec3(0.5) }\n")
    line = ("-t", "wgsl", "-o", "out")
    assert shell("compile", "a/m.burnish", *line, folder=Path.cwd()).returncode == 0
    before = contents("out")
    done = shell("compile", "b/m.burnish", *line, folder=Path.cwd())
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == (
        "error[B0020]: `out/Plain.vert.wgsl` would be overwritten, and `a/m.burnish` was compiled "
        "to it, not `b/m.burnish`\n"
        "  = help: Nothing was written. Compile into another folder, rename the material or the "
        "frame, or overwrite all that is in the way by `--force`. What is changed by hand in an "
        "output belongs into its source.\n\n1 error\n"
    )
    assert contents("out") == before
    assert shell("compile", "b/m.burnish", *line, "--force", folder=Path.cwd()).returncode == 0
    after = contents("out")
    assert after.keys() == before.keys()
    assert after != before
    for _ in range(2):  # The second time, the result is known.
        assert shell("compile", "b/m.burnish", *line, folder=Path.cwd()).returncode == 0
    refused = shell("compile", "a/m.burnish", *line, folder=Path.cwd())
    assert "`b/m.burnish` was compiled to it" in refused.stderr
    assert contents("out") == after


def test_a_source_that_is_gone_has_no_outputs() -> None:
    Path("old.burnish").write_text(PLAIN)
    assert invoke("compile", "old.burnish", "-t", "wgsl", "-o", "out").exit_code == 0
    Path("old.burnish").rename("new.burnish")
    Path("new.burnish").write_text(PLAIN.replace("ffffff", "808080"))
    done = invoke("compile", "new.burnish", "-t", "wgsl", "-o", "out")
    assert (done.exit_code, done.stderr) == (0, "")


def test_outputs_that_were_checked_out_are_replaced() -> None:
    """Nobody knows what has become of them, but they are Burnish's."""
    Path("m.burnish").write_text(PLAIN)
    assert invoke("compile", "m.burnish", "-t", "all", "-o", "out").exit_code == 0
    for path in Path("out").iterdir():
        path.write_text(path.read_text().replace("1.0", "0.5") + " ")
    (kept,) = (Path("..") / "cache").rglob("written/*")
    kept.unlink()
    done = invoke("compile", "m.burnish", "-t", "all", "-o", "out")
    assert (done.exit_code, done.stderr) == (0, "")


@pytest.mark.parametrize("command", ["compile", "build"])
def test_what_somebody_has_changed_by_hand_is_not_overwritten(command: str) -> None:
    Path("m.burnish").write_text(PLAIN)
    line = (command, "m.burnish", "-t", "wgsl", "-o", "out")
    assert invoke(*line).exit_code == 0
    (output,) = Path("out").rglob("Plain.frag.wgsl")
    output.write_text(output.read_text().replace("1.0", "0.9"))
    mine = contents(str(output.parent))
    done = invoke(*line)
    assert done.exit_code == 1
    assert done.stderr.startswith(
        f"error[B0020]: `{output}` would be overwritten, and it is not as it was written "
        "here last: somebody changed it, or wrote it elsewhere\n"
    )
    assert contents(str(output.parent)) == mine
    assert invoke(*line, "--force").exit_code == 0
    assert contents(str(output.parent)) != mine
    Path("m.burnish").write_text(PLAIN.replace("ffffff", "808080"))
    done = invoke(*line)
    assert (done.exit_code, done.stderr) == (0, ""), "what was forced is known as well"


@pytest.mark.parametrize("name", ["Plain.frag.wgsl", "Plain.json"])
def test_files_of_other_programs_are_not_overwritten(name: str) -> None:
    Path("m.burnish").write_text(PLAIN)
    Path("out").mkdir()
    Path("out", name).write_text("// By hand.\n")
    done = invoke("compile", "m.burnish", "-t", "wgsl", "-o", "out")
    assert done.exit_code == 1
    assert done.stderr.startswith(
        f"error[B0020]: `out/{name}` would be overwritten, and it is no file that Burnish has "
        "written\n"
    )
    assert contents("out") == {name: b"// By hand.\n"}
    Path("out", name).write_text("")
    assert invoke("compile", "m.burnish", "-t", "wgsl", "-o", "out").exit_code == 0


def test_of_two_builds_at_once_one_is_told() -> None:
    for name in ("red", "blue"):
        Path(f"{name}.burnish").write_text(f"/// {name * 5000}\nmaterial Plain {{ }}")
        assert shell("compile", f"{name}.burnish", "-o", name, folder=Path.cwd()).returncode == 0
    command = [sys.executable, "-m", "burnish", "compile", "-o", "both"]
    commands = [[*command, f"{name}.burnish"] for name in ("red", "blue")]
    done = at_once([partial(run, each, cwd=Path.cwd()) for each in commands])
    assert sorted(each.returncode for each in done) == [0, 1]
    (refused,) = (each for each in done if each.returncode)
    assert "was compiled to it, not" in refused.stderr
    won = "red" if done[1].returncode else "blue"
    assert contents("both") == contents(won)
