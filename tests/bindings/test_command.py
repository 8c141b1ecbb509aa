"""``burnish bind``: what it compiles, and the files that it writes or leaves alone."""

from __future__ import annotations

import json
import os
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from click.testing import CliRunner, Result

import burnish
from burnish.bindings.registry import names
from burnish.commands.group import burnish as group

from .kit import PLASTIC


def _run(*arguments: str) -> Result:
    return CliRunner().invoke(group, ["bind", *arguments])


def test_a_file_of_the_same_content_is_left_untouched(tmp_path: Path) -> None:
    out = tmp_path / "plastic_binding.py"
    arguments = (str(PLASTIC), "--lang", "python", "-t", "wgsl", "-o", str(out))
    assert _run(*arguments).exit_code == 0
    assert out.read_text("utf-8") == burnish.bind(PLASTIC, "python", "wgsl")
    os.utime(out, (1, 1))
    assert _run(*arguments).exit_code == 0
    assert out.stat().st_mtime == 1
    assert _run(*arguments, "--embed").exit_code == 0
    assert out.stat().st_mtime > 1


def test_without_a_file_it_is_printed() -> None:
    found = _run(str(PLASTIC), "--lang", "cpp", "-t", "wgsl", "--namespace", "scene::glass")
    expected = burnish.bind(PLASTIC, "cpp", "wgsl", namespace="scene::glass")
    assert (found.exit_code, found.output) == (0, expected)
    assert "namespace burnish::scene::glass {" in expected


def test_mistakes_are_told_and_nothing_is_written(tmp_path: Path) -> None:
    out = tmp_path / "binding.py"
    wrong = tmp_path / "wrong.burnish"
    wrong.write_text("material Wrong : Surface { color = blue }", "utf-8")
    found = _run(str(PLASTIC), str(wrong), "--lang", "python", "-o", str(out))
    assert found.exit_code == 1
    assert "blue" in found.output
    found = _run(str(PLASTIC), "--lang", "python", "--namespace", "scene", "-o", str(out))
    assert found.exit_code == 2
    assert "Python has no namespaces: a binding is a file of its own" in found.output
    found = _run(str(wrong), "--lang", "python", "-o", str(wrong))
    assert (found.exit_code, "it is FILE itself" in found.output) == (2, True)
    assert not out.exists()


def test_a_file_of_somebody_else_is_not_overwritten(tmp_path: Path) -> None:
    own = tmp_path / "main.cpp"
    own.write_text("int main() {}\n", "utf-8")
    found = _run(str(PLASTIC), "--lang", "cpp", "-t", "wgsl", "-o", str(own))
    assert found.exit_code == 1
    assert f"`{own}` would be overwritten, and `burnish bind` has not written it" in found.output
    assert own.read_text("utf-8") == "int main() {}\n"


def test_a_namespace_is_no_reserved_word(tmp_path: Path) -> None:
    source = tmp_path / "class.burnish"
    source.write_text("material Z { color = vec3(1) }\n", "utf-8")
    assert "namespace burnish::class_ {" in burnish.bind(source, "cpp", "wgsl")
    text = burnish.bind(source, "cpp", "wgsl", namespace="std::Glass")
    assert "namespace burnish::std_::glass {" in text


def test_comments_stay_as_they_are_beside_embedded_texts(tmp_path: Path) -> None:
    source = tmp_path / "z.burnish"
    source.write_text("material Z { param a : float = 1  /// A star @0@ @99@\n color = vec3(a) }\n")
    for language in names():
        text = burnish.bind(source, language, "wgsl", embed=True)
        assert "A star @0@ @99@" in text and "@fragment" in text and "\0" not in text


PLAIN = "material M { param tint : rgb = #b5651d  color = tint }\n"
RIGS = """
import std.lights.{Directional}
import std.terms.{lambert}
rig Day   { sun : Directional }
rig Night { moon : Directional }
material Wall { color = lambert(#8d8d86) }
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder, which is the current one, and a cache of its own."""
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")
    return tmp_path / "work"


def _module(text: str) -> Any:
    module = ModuleType("a_binding")
    exec(compile(text, "a_binding.py", "exec"), module.__dict__)
    return module


def test_texts_are_those_of_compile_with_the_same_options(folder: Path) -> None:
    """The binding fits the reflections that ``compile`` writes, and no others."""
    (folder / "m.burnish").write_text(PLAIN, "utf-8")
    (folder / "engine.toml").write_text("[first]\nview = 4\n", "utf-8")
    for options in (["--bindings", "engine.toml"], ["--single-file"], ["--flip-y"]):
        line = ["m.burnish", "-t", "wgsl", *options]
        found = _run(*line, "--lang", "python")
        assert found.exit_code == 0, found.output
        done = CliRunner().invoke(group, ["compile", *line, "-o", "out", "--force"])
        assert done.exit_code == 0, done.output
        material = _module(found.output).M
        reflection = json.loads((folder / "out" / "M.json").read_text("utf-8"))
        material.check(reflection)
        names = {each.file for each in material.profiles["wgsl:webgpu"].texts}
        assert names == {row["file"] for row in reflection["backends"]["wgsl:webgpu"]["files"]}
        plain = _module(_run("m.burnish", "-t", "wgsl", "--lang", "python").output).M
        if options != ["--flip-y"]:
            with pytest.raises(ValueError, match="is stale"):
                plain.check(reflection)


def test_a_file_of_several_rigs_is_bound_with_each(folder: Path) -> None:
    (folder / "wall.burnish").write_text(RIGS, "utf-8")
    found = _run("wall.burnish", "-t", "wgsl", "--lang", "python")
    assert found.output == burnish.bind("wall.burnish", "python", "wgsl")
    materials = _module(found.output).MATERIALS
    assert [each.name for each in materials] == ["Wall.Day", "Wall.Night"]
    texts = [each.profiles["wgsl:webgpu"].texts[1].file for each in materials]
    assert texts == ["Wall.Day.frag.wgsl", "Wall.Night.frag.wgsl"]
    only = _run("wall.burnish", "-t", "wgsl", "--lang", "python", "--rig", "Night")
    assert [each.name for each in _module(only.output).MATERIALS] == ["Wall"]


def test_several_languages_and_folders(folder: Path) -> None:
    (folder / "materials" / "deep").mkdir(parents=True)
    (folder / "materials" / "m.burnish").write_text(PLAIN, "utf-8")
    (folder / "materials" / "deep" / "n.burnish").write_text(PLAIN.replace("M", "N"), "utf-8")
    (folder / "materials" / "only.burnish").write_text("fn f(x : float) = x\n", "utf-8")
    line = ("materials", "-t", "wgsl", "--lang", "cpp", "--lang", "python", "--lang", "cpp")
    found = _run(*line, "-o", "out", "--format", "json", "--depfile", "out.d")
    assert found.exit_code == 0, found.output
    answer = json.loads(found.output)
    assert answer["result"]["outputs"] == [
        {"path": "out/materials.hpp", "language": "cpp"},
        {"path": "out/materials.py", "language": "python"},
    ]
    assert answer["written"] == ["out/materials.hpp", "out/materials.py", "out.d"]
    assert answer["result"]["read"][:2] == ["materials/m.burnish", "materials/deep/n.burnish"]
    names = [each.name for each in _module((folder / "out/materials.py").read_text()).MATERIALS]
    assert names == ["M", "N"]
    rule = (folder / "out.d").read_text("utf-8")
    assert rule.startswith("out/materials.hpp \\\n  out/materials.py: \\\n  materials/m.burnish")
    assert "only.burnish" not in rule
    told = _run("materials", "--lang", "cpp", "--lang", "python")
    assert "several languages are several files: -o names the folder for them" in told.output
    (folder / "empty").mkdir()
    told = _run("empty", "--lang", "cpp")
    assert "no file in `empty` declares a material, a kernel or a frame" in told.output


def test_a_language_has_a_file_in_a_folder_that_is_named(folder: Path) -> None:
    (folder / "m.burnish").write_text(PLAIN, "utf-8")
    (folder / "there").mkdir()
    for output in ("there", "not there yet/"):
        found = _run("m.burnish", "-t", "wgsl", "--lang", "python", "-o", output)
        assert (found.exit_code, found.output) == (0, f"{Path(output, 'm.py')}\n")
        text = (folder / output / "m.py").read_text("utf-8")
        assert text == burnish.bind("m.burnish", "python", "wgsl")


def test_materials_of_one_name_are_told(folder: Path) -> None:
    for name in ("a", "b"):
        (folder / f"{name}.burnish").write_text(PLAIN, "utf-8")
    line = ("a.burnish", "b.burnish", "-t", "wgsl", "--lang", "cpp", "-o", "m.hpp")
    found = _run(*line, "--format", "line")
    assert found.exit_code == 1
    assert "burnish: error: B0018: " in found.output and "M.vert.wgsl" in found.output
    assert not (folder / "m.hpp").exists()


def test_a_file_that_is_no_rule_is_not_overwritten(folder: Path) -> None:
    (folder / "m.burnish").write_text(PLAIN, "utf-8")
    (folder / "mine.c").write_text("int main() {}\n", "utf-8")
    for line in (
        ["bind", "m.burnish", "--lang", "cpp", "-o", "m.hpp"],
        ["compile", "m.burnish", "-o", "out"],
    ):
        found = CliRunner().invoke(group, [*line, "-t", "wgsl", "--depfile", "mine.c"])
        told = "`mine.c` would be overwritten, and it is no file that `--depfile` has written"
        assert (found.exit_code, told in found.output) == (1, True), found.output
        assert (folder / "mine.c").read_text("utf-8") == "int main() {}\n"
        assert not (folder / "m.hpp").exists() and not (folder / "out").exists()


def test_a_missing_language_is_told_with_those_that_there_are() -> None:
    found = _run(str(PLASTIC))
    assert found.exit_code == 2
    assert "Missing option '--lang'. Choose from:\n\tc,\n\tcpp,\n\tpython,\n" in found.output
