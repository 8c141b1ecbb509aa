"""``--validate``: what the real compilers say is told at the Burnish text it is about."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.api.validating import validate
from burnish.compiler.diagnostics.render import render_all
from burnish.support.frozen import changed

from .kit import PLAIN, invoke, tree

SOURCE = "material M { tint = sin(vec3(uv, 1))\n color = tint * tint.x }"


def broken() -> tuple[burnish.OutputFile, int]:
    """A fragment shader with a line spoilt that computes ``tint``, and that line's number."""
    (material,) = burnish.compile(SOURCE, ["wgsl"]).materials
    file = next(file for file in material.files if file.stage == "fragment")
    number = next(line for line, span in file.spans.items() if str(span).startswith("<text>:1:"))
    lines = file.text.splitlines()
    lines[number - 1] = "    let tint = nonsense(1.0);"
    return changed(file, text="\n".join(lines) + "\n"), number


def test_everything_is_accepted(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(PLAIN)
    targets = "hlsl,glsl,glsl:gl330,glsl:gl450,glsl:es300,glsl:es310,wgsl"
    result = invoke("compile", file, "-t", targets, "--validate", "-o", tmp_path / "out")
    assert (result.exit_code, result.stderr) == (0, "")
    assert len(tree(tmp_path / "out")) == 15


def test_a_refusal_is_told_at_the_material() -> None:
    file, line = broken()
    found = validate([file])
    assert {diagnostic.rule.code for diagnostic in found} == {"B0703"}
    assert {diagnostic.message.split()[0] for diagnostic in found} == {"naga", "tint"}
    shown = render_all(found)
    assert " --> <text>:1:21\n" in shown
    assert f"::: M.frag.wgsl:{line}:16\n" in shown
    assert "let tint = nonsense(1.0);" in shown


def test_without_a_source_map_the_emitted_line_is_shown() -> None:
    file, line = broken()
    found = validate([changed(file, spans={})])
    assert {str(diagnostic.span) for diagnostic in found} == {f"M.frag.wgsl:{line}:16"}


def test_what_has_no_line_directives_is_told(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(PLAIN)
    result = invoke("compile", file, "-t", "glsl,wgsl", "--line-directives", "-o", tmp_path / "out")
    assert result.exit_code == 0
    assert "warning[B0450]: wgsl has no line directives" in result.stderr
    assert "#line" in (tmp_path / "out" / "Plain.frag.glsl").read_text("utf-8")
    assert "#line" not in (tmp_path / "out" / "Plain.frag.wgsl").read_text("utf-8")


@pytest.mark.parametrize("target", ["glsl", "glsl:es300", "hlsl"])
def test_texts_with_line_directives_are_accepted(target: str) -> None:
    (material,) = burnish.compile(SOURCE, [target], line_directives=True)
    assert all("#line" in file.text for file in material.files)
    assert validate(material.files) == ()


@pytest.mark.parametrize("target", ["glsl", "glsl:es300", "hlsl"])
def test_a_refusal_of_a_text_with_line_directives_is_told_at_the_material(target: str) -> None:
    (material,) = burnish.compile(SOURCE, [target], line_directives=True)
    file = next(file for file in material.files if file.stage == "fragment")
    spoilt = file.text.replace("sin(", "nonsense(")
    assert spoilt != file.text
    found = validate([changed(file, text=spoilt)])
    assert {diagnostic.rule.code for diagnostic in found} == {"B0703"}
    assert {str(diagnostic.span) for diagnostic in found} == {"<text>:1:21"}


def test_a_missing_tool_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BURNISH_TOOLS", str(tmp_path / "none"))
    monkeypatch.setenv("PATH", "")
    file = tmp_path / "m.burnish"
    file.write_text(PLAIN)
    result = invoke("compile", file, "-t", "wgsl", "--validate", "-o", tmp_path / "out")
    assert result.exit_code == 1
    assert "error[B0706]: naga cannot be run: naga is missing" in result.stderr
    assert "python -m burnish.targets.toolchain.install naga" in result.stderr
    assert tree(tmp_path) == {"m.burnish"}
