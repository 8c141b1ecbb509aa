"""``burnish conform --golden``: the folder that it writes, whole or not at all."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from burnish.commands import golden
from burnish.commands.judge import Judge

from .kit import PLAIN, invoke, tree

ROUTE = ("--routes", "vulkan:glsl")

FILES = {"lower.npy", "reference.npy", "upper.npy"}


@pytest.fixture(autouse=True)
def _here(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    Path("m.burnish").write_text(PLAIN)


def document() -> Any:
    """The document of the folder ``g``."""
    return json.loads(Path("g/golden.json").read_text("utf-8"))


def test_a_folder_is_written_and_judges(tmp_path: Path) -> None:
    result = invoke("conform", "m.burnish", "--golden", "g", *ROUTE)
    assert (result.exit_code, result.stderr) == (0, "")
    *lines, last = result.stdout.splitlines()
    assert last == "golden: g/golden.json"
    assert [line.split(": ")[0] for line in lines] == [
        "Plain/defaults", "Plain/stretched", "Plain/behind", "Plain/inside",
    ]  # fmt: skip
    assert lines[3] == "Plain/inside: color, 72 x 56 pixels, 2 undecided"
    assert document()["routes"] == ["vulkan:glsl"]
    for case in document()["cases"]:
        folder = tmp_path / "g" / case["folder"]
        there = {path.name for path in folder.iterdir()}
        assert there == {"undecided.npy", "color.png", "inputs", *(f"color.{e}" for e in FILES)}
        picture = folder / "color.reference.npy"
        assert invoke("judge", "g", picture, "--case", case["folder"]).exit_code == 0
        named = _paths(case["inputs"])
        assert named
        assert all((tmp_path / "g" / each).is_file() for each in named)
    assert not [name for name in tree(tmp_path / "g") if ".burnish-" in name]


def _paths(value: Any) -> list[str]:
    """Everything in the inputs that names a file."""
    if isinstance(value, dict):
        return [path for each in value.values() for path in _paths(each)]
    if isinstance(value, list):
        return [path for each in value for path in _paths(each)]
    return [value] if isinstance(value, str) and value.startswith("Plain/") else []


def test_by_default_the_bounds_are_those_of_all_promises() -> None:
    invoke("conform", "m.burnish", "--golden", "g")
    assert {name.partition(":")[0] for name in document()["routes"]} == {
        "vulkan", "opengl", "wgpu",
    }  # fmt: skip
    assert set(document()["cases"][0]["inputs"]["texts"]) == {
        "glsl:vulkan", "hlsl:sm6", "wgsl:webgpu", "glsl:gl330", "glsl:gl450", "glsl:es310",
    }  # fmt: skip


def test_the_same_command_writes_the_same_bytes() -> None:
    for name in ("a", "b"):
        invoke("conform", "m.burnish", "--golden", name, *ROUTE)
    assert tree(Path("a")) == tree(Path("b"))
    for name in sorted(tree(Path("a"))):
        if Path("a", name).is_file():
            assert Path("a", name).read_bytes() == Path("b", name).read_bytes(), name


def test_rigs_passes_and_equal_names_have_folders_of_their_own() -> None:
    Path("m.burnish").write_text(
        "pass Red { target color : rgba16f = vec4(color.r, 0, 0, 1) }\n"
        "pass Green { target color : rgba16f = vec4(0, color.g, 0, 1) }\n" + PLAIN
    )
    result = invoke("conform", "m.burnish", "--golden", "g", *ROUTE)
    assert result.exit_code == 0, result.stderr
    assert {case["subject"] for case in document()["cases"]} == {
        "Plain.Daylight.Forward", "Plain.Daylight.Red", "Plain.Daylight.Green",
    }  # fmt: skip


def test_an_older_folder_is_replaced_and_other_files_stay() -> None:
    invoke("conform", "m.burnish", "--golden", "g", *ROUTE)
    Path("g/notes.txt").write_text("mine")
    before = np.load("g/Plain/inside/color.lower.npy")
    Path("m.burnish").write_text("material Plain { color = vec3(0.25) }\n")
    assert invoke("conform", "m.burnish", "--golden", "g", *ROUTE).exit_code == 0
    assert (np.load("g/Plain/inside/color.lower.npy") != before).any()
    assert Path("g/notes.txt").read_text() == "mine"


def test_what_is_in_the_way_is_told_and_nothing_changes(tmp_path: Path) -> None:
    invoke("conform", "m.burnish", "--golden", "g", *ROUTE)
    path = tmp_path / "g" / "Plain" / "inside" / "color.upper.npy"
    path.unlink()
    path.mkdir()
    before = Path("g/Plain/defaults/color.lower.npy").read_bytes()
    Path("m.burnish").write_text("material Plain { color = vec3(0.25) }\n")
    result = invoke("conform", "m.burnish", "--golden", "g", *ROUTE)
    assert (result.exit_code, result.stdout) == (1, "")
    assert "g/Plain/inside/color.upper.npy" in result.stderr
    assert "it is a folder" in result.stderr
    assert Path("g/Plain/defaults/color.lower.npy").read_bytes() == before
    assert not [name for name in tree(tmp_path / "g") if ".burnish-" in name]


def test_folders_that_are_made_in_vain_are_taken_away(tmp_path: Path) -> None:
    Path("g/Plain").mkdir(parents=True)
    Path("g/Plain/inside").write_text("in the way")
    result = invoke("conform", "m.burnish", "--golden", "g", *ROUTE)
    assert result.exit_code == 1
    assert tree(tmp_path / "g") == {"Plain", "Plain/inside"}


def test_links_to_folders_are_not_followed(tmp_path: Path) -> None:
    Path("elsewhere").mkdir()
    Path("g").mkdir()
    Path("g/Plain").symlink_to(tmp_path / "elsewhere")
    result = invoke("conform", "m.burnish", "--golden", "g", *ROUTE)
    assert result.exit_code == 1
    assert "g/Plain" in result.stderr
    assert tree(tmp_path / "elsewhere") == set()


def test_a_folder_that_cannot_be_written_is_told_before_long_work(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def worked(*_arguments: object) -> None:
        pytest.fail("it has begun to draw")

    monkeypatch.setattr(Judge, "golden", worked)
    Path("g").write_text("a file")
    result = invoke("conform", "m.burnish", "--golden", "g", *ROUTE)
    assert result.exit_code == 1
    assert "`g` is a file, not a folder" in result.stderr


@pytest.mark.parametrize(
    "words",
    [
        ("--report", "r"), ("--strict",), ("--explain", "1,1"), ("--device", "nvidia"),
        ("--native-stages",),
    ],
)  # fmt: skip
def test_options_that_have_no_effect(words: tuple[str, ...]) -> None:
    result = invoke("conform", "m.burnish", "--golden", "g", *ROUTE, *words)
    assert result.exit_code == 2
    said = f"--golden draws nothing, so {words[0]} has no effect: leave out one of them"
    assert said in result.stderr
    assert not Path("g").exists()


def test_without_a_file() -> None:
    result = invoke("conform", "--golden", "g")
    assert result.exit_code == 2
    assert "Missing argument 'FILE…'." in result.stderr


def test_mistakes_are_shown_and_nothing_is_written() -> None:
    Path("m.burnish").write_text("material M { color = nothing }\n")
    result = invoke("conform", "m.burnish", "--golden", "g")
    assert result.exit_code == 1
    assert "B0" in result.stderr
    assert not Path("g").exists()


def test_a_case_in_which_nothing_is_compared_is_told() -> None:
    Path("m.burnish").write_text(
        "kernel Big { param big : float = 1e30  result all : float[4] = big * big }\n"
    )
    result = invoke("conform", "m.burnish", "--golden", "g", *ROUTE)
    assert result.exit_code == 0
    assert result.stdout.startswith("Big/first: all, 4 x 1 pixels, 4 undecided\n")
    said = "warning: Big/first: nothing is compared, as all pixels are undecided\n"
    assert result.stderr.startswith(said)


def test_cases_that_prove_little_are_told() -> None:
    Path("m.burnish").write_text(
        "material Hash {\n"
        "    color = vec3(fract(sin(dot(uv, vec2(12.9898, 78.233))) * 43758.5453))\n}\n"
    )
    result = invoke("conform", "m.burnish", "--golden", "g", *ROUTE)
    assert result.exit_code == 0
    said = re.findall(r"^warning: (.*): proves little: of \d+ pixels of the object, \d+ may have "
                      r"nearly any value, and \d+ are undecided$", result.stderr, re.M)  # fmt: skip
    assert said == [f"Hash/{case}" for case in ("defaults", "stretched", "behind", "inside")]
    (first, *_) = document()["cases"]
    assert first["wide"] > 0.5 * first["covered"] > 500


def test_elements_of_a_kernel_are_a_row_of_pixels() -> None:
    Path("m.burnish").write_text(
        "struct Pair { first : float  second : vec2 }\n"
        "kernel Both { result all : Pair[5] = Pair(float(index), vec2(1, 2)) }\n"
    )
    result = invoke("conform", "m.burnish", "--golden", "g", *ROUTE)
    assert result.exit_code == 0, result.stderr
    case = document()["cases"][0]
    assert (case["width"], case["height"]) == (5, 1)
    assert case["outputs"] == [
        {"name": "all.first", "lanes": 1,
         "stored": {"buffer": "all", "offset": 0, "stride": 16, "type": "<f4"}},
        {"name": "all.second", "lanes": 2,
         "stored": {"buffer": "all", "offset": 8, "stride": 16, "type": "<f4"}},
    ]  # fmt: skip
    assert case["inputs"]["extent"] == [5, 1, 1]
    first = np.load("g/Both/first/all.first.reference.npy")
    assert first[0, :, 0].tolist() == [0, 1, 2, 3, 4]
    # A stranger reads the bytes of the buffer by what the document says.
    words = np.zeros((5, 4), "<f4")
    words[:, 0], words[:, 2:] = np.arange(5), (1, 2)
    for row in case["outputs"]:
        at = row["stored"]["offset"] // 4
        np.save("p.npy", words[None, :, at : at + row["lanes"]])
        done = invoke("judge", "g", "p.npy", "--case", "first", "--output", row["name"])
        assert done.exit_code == 0, done.output


def test_a_frame_has_a_package(tmp_path: Path) -> None:
    Path("m.burnish").write_text(
        "import std.frames.{FullScreen}\n"
        "pass Ramp : FullScreen { target value : rgba32f = vec4(uv.x, uv.y, 0, 1) }\n"
        "frame Ramps { ramp = Ramp(screen)\n output picture = ramp.value }\n"
    )
    result = invoke("conform", "m.burnish", "--golden", "g", *ROUTE)
    assert result.exit_code == 0, result.stderr
    (case,) = document()["cases"]
    assert case["inputs"] == {
        "kind": "frame", "package": "Ramps/frame/package.json", "output": "picture", "frame": 0,
    }  # fmt: skip
    package = json.loads((tmp_path / "g/Ramps/frame/package.json").read_text("utf-8"))
    assert package["plan"]["frame"] == "Ramps"
    found = np.load("g/Ramps/picture/picture.reference.npy")
    assert found[0, :, 0] == pytest.approx((np.arange(72) + 0.5) / 72)


def test_processes_write_what_one_process_writes(monkeypatch: pytest.MonkeyPatch) -> None:
    names = [f"{name}.burnish" for name in "abcd"]
    for number, name in enumerate(names):
        Path(name).write_text(f"kernel Same {{ result all : float[3] = {number} / 7.0 }}\n")
    assert invoke("conform", *names, "--golden", "many", *ROUTE).exit_code == 0
    monkeypatch.setattr(golden, "SEVERAL", 99)
    assert invoke("conform", *names, "--golden", "one", *ROUTE).exit_code == 0
    assert tree(Path("many")) == tree(Path("one"))
    documents = [json.loads(Path(each, "golden.json").read_text()) for each in ("many", "one")]
    assert documents[0] == documents[1]
    subjects = {case["subject"]: case["folder"].split("/")[0] for case in documents[0]["cases"]}
    assert len(documents[0]["cases"]) == 12
    assert len({case["folder"] for case in documents[0]["cases"]}) == 12
    assert sorted(subjects) == ["Same", "Same-2", "Same-3", "Same-4"]


def test_subjects_without_bounds_are_all_told() -> None:
    Path("k.burnish").write_text("kernel Two { result two : float[4] = 2 }\n")
    result = invoke(
        "conform", "m.burnish", "k.burnish", "--golden", "g", "--routes", "opengl:gl330"
    )
    assert result.exit_code == 1
    assert result.stderr.startswith("error: k.burnish: Two: none of the routes can draw it: "), (
        result.stderr
    )
    assert not Path("g").exists()


def test_needs_no_tools(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is promised does not hang on what is installed."""
    monkeypatch.setattr(
        "burnish.targets.runner.runner.inspect_tools", lambda _routes: pytest.fail("it looks")
    )
    assert invoke("conform", "m.burnish", "--golden", "g").exit_code == 0
