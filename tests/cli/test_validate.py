"""``--validate``: what the real compilers say is told at the Burnish text it is about."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

import burnish
from burnish.commands.validate import validate
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.diagnostics.source import Source, Span

from .kit import PLAIN, invoke, tree

SOURCE = Source("m.burnish", "material M {\n    color = vec3(1)\n}\n")
COLOR = Span(SOURCE, 17, 32)


def emitted() -> burnish.OutputFile:
    (material,) = burnish.compile("material M { color = vec3(uv, 1) }", ["wgsl"]).materials
    return next(file for file in material.files if file.stage == "fragment")


def broken(file: burnish.OutputFile) -> tuple[burnish.OutputFile, int]:
    """The file with its last statement spoilt, and that statement's line."""
    lines = file.text.splitlines()
    number = max(n for n, line in enumerate(lines, 1) if line.strip().endswith(";"))
    lines[number - 1] = "    nonsense(1.0);"
    return replace(file, text="\n".join(lines) + "\n"), number


def test_everything_is_accepted(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(PLAIN)
    targets = "hlsl,glsl,glsl:gl330,glsl:es300,wgsl"
    result = invoke("compile", file, "-t", targets, "--validate", "-o", tmp_path / "out")
    assert (result.exit_code, result.stderr) == (0, "")
    assert len(tree(tmp_path / "out")) == 11


def test_a_refusal_is_told_at_the_material() -> None:
    file, line = broken(emitted())
    found = validate([replace(file, spans={line: COLOR})])
    assert {diagnostic.rule.code for diagnostic in found} == {"B0703"}
    assert {diagnostic.message.split()[0] for diagnostic in found} == {"naga", "tint"}
    shown = render_all(found)
    assert " --> m.burnish:2:5\n" in shown
    assert f"::: M.frag.wgsl:{line}:5\n" in shown
    assert "nonsense(1.0);" in shown


def test_without_a_source_map_the_emitted_line_is_shown() -> None:
    file, line = broken(emitted())
    found = validate([replace(file, spans={})])
    assert {str(diagnostic.span) for diagnostic in found} == {f"M.frag.wgsl:{line}:5"}


def test_a_missing_tool_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BURNISH_TOOLS", str(tmp_path / "none"))
    monkeypatch.setenv("PATH", "")
    file = tmp_path / "m.burnish"
    file.write_text(PLAIN)
    result = invoke("compile", file, "-t", "wgsl", "--validate", "-o", tmp_path / "out")
    assert result.exit_code == 1
    assert "error[B0706]: naga cannot check anything: naga is missing" in result.stderr
    assert "python -m burnish.targets.toolchain.install naga" in result.stderr
    assert tree(tmp_path) == {"m.burnish"}
