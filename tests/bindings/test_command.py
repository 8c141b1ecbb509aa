"""``burnish bind``: one file, which is left untouched if it has the same content already."""

from __future__ import annotations

import os
from pathlib import Path

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
