"""``burnish compile --set``: mistakes of the command line, and of names and values."""

from __future__ import annotations

from pathlib import Path

import pytest

from .kit import invoke

ROOT = Path(__file__).parents[2]

SOURCE = """
material Paint {
    param weight : float in 0..1 = 1
    param gloss  : float in 0..1 = 0.2
    map coat : texture2d
    shine = if gloss > 0.6 then pow(saturate(normal.y), 40) else 0
    color = vec3(shine) + weight * coat(uv).rgb
}
"""


@pytest.fixture
def words(tmp_path: Path) -> list[str]:
    file = tmp_path / "paint.burnish"
    file.write_text(SOURCE)
    return ["compile", str(file), "-t", "glsl", "-o", "-"]


def test_values_and_ranges_narrow_what_is_written(words: list[str]) -> None:
    plain = invoke(*words).stdout
    assert "coat" in plain and "pow" in plain
    result = invoke(*words, "--set", "weight=0", "--set=gloss=0..0.6")
    assert result.exit_code == 0
    assert "coat" not in result.stdout and "pow" not in result.stdout


def test_a_value_is_given_once_and_with_a_name(words: list[str]) -> None:
    twice = invoke(*words, "--set", "weight=1", "--set", "weight=0")
    assert twice.exit_code == 2 and "'weight' is set twice, to 1 and to 0" in twice.output
    nameless = invoke(*words, "--set", "weight")
    assert nameless.exit_code == 2 and "'weight' is not NAME=VALUE" in nameless.output


def test_a_wrong_name_or_value_is_a_mistake_of_the_input(words: list[str]) -> None:
    wrong = invoke(*words, "--set", "wieght=0")
    assert wrong.exit_code == 1 and "did you mean `weight`?" in wrong.output


def test_reasons_are_printed_with_places(words: list[str], tmp_path: Path) -> None:
    *start, _dash = words
    result = invoke(*start, tmp_path / "out", "--set", "weight=0", "--why")
    assert result.exit_code == 0
    said = "`weight` is 0, so `weight * coat(uv).xyz` is 0. Nothing reads the map `coat`"
    assert f"paint.burnish:7:27: {said}" in result.stdout
    plain = invoke(*start, tmp_path / "out", "--why")
    assert "No value of a parameter makes anything dead." in plain.stdout
    printed = invoke(*words, "--why")
    assert printed.exit_code == 2 and "not with -o -" in printed.output


def test_a_version_is_compared_with_the_whole_material(words: list[str]) -> None:
    narrowed = ["--set", "weight=0", "--set", "gloss=0..0.6"]
    result = invoke("conform", words[1], "--routes", "lavapipe:glsl", *narrowed)
    assert (result.exit_code, result.stderr) == (0, "")
    assert "lavapipe:glsl  agrees" in result.stdout


def test_conform_tells_where_a_version_cannot_be_compared(words: list[str], tmp_path: Path) -> None:
    explained = invoke("conform", words[1], "--set", "weight=0", "--explain", "3,3")
    assert explained.exit_code == 2 and "--set makes a version" in explained.output
    golden = invoke("conform", words[1], "--set", "weight=0", "--golden", tmp_path / "golden")
    assert golden.exit_code == 2 and "--set has no effect" in golden.output
    wrong = invoke("conform", words[1], "--set", "wieght=0")
    assert wrong.exit_code == 1 and "did you mean `weight`?" in wrong.output


def test_a_version_of_a_frame_is_not_compared() -> None:
    file = ROOT / "examples/frames/cascades.burnish"
    given = ["--routes", "lavapipe:glsl", "--set", "Posts.base=#ffffff"]
    result = invoke("conform", str(file), *given)
    assert result.exit_code == 2 and "`Cascades` is a frame" in result.output


def test_a_graph_shows_the_program_of_a_version(words: list[str]) -> None:
    whole = invoke("graph", words[1], "--program").stdout
    version = invoke("graph", words[1], "--program", "--set", "weight=0").stdout
    assert "coat" in whole and "coat" not in version
    proofs = invoke("graph", words[1], "--why", "--set", "gloss=0..0.6").stdout
    assert "pow(" not in proofs
    equations = invoke("graph", words[1], "--set", "weight=0")
    assert equations.exit_code == 2 and "add --program or --why" in equations.output


def test_a_picture_shows_one_value(words: list[str]) -> None:
    for command in ("render", "view"):
        result = invoke(command, words[1], "--set", "weight=0..0.5")
        assert result.exit_code == 2 and "a picture shows one value" in result.output
