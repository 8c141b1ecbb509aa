"""A file becomes only so many shaders and steps, so each compile ends soon."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.compiler import frontend
from burnish.compiler.semantics.frames import steps

MANY = """import std.frames.{FullScreen}
material A { }
abstract material Unfinished { }
kernel B { result squares : float[4] = float(index * index) }
pass Sky : FullScreen { target color : rgba8 = vec4(uv, 0, 1) }
frame C { output o = Sky(screen).color }
"""


def complaint(source: str) -> str:
    """The only error of a text, with its place."""
    (found,) = burnish.check(source)
    return f"{found.span}: {found.rule.code} {found.message}"


def test_a_file_declares_only_so_many_programs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Those that are abstract are for others to build on, and passes are drawn by frames."""
    monkeypatch.setattr(frontend, "MOST_PROGRAMS", 3)
    assert burnish.check(MANY) == ()
    assert complaint(f"{MANY}material D {{ }}\n") == (
        "<text>:7:10: B0015 `<text>` declares 4 materials, kernels and frames, and 3 are possible"
    )


def test_what_is_imported_is_not_counted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(frontend, "MOST_PROGRAMS", 1)
    (tmp_path / "many.burnish").write_text(MANY, "utf-8")
    importing = 'import "many.burnish".{A}\nmaterial Mine : A { color = vec3(0.5) }\n'
    assert burnish.check(importing, search_path=(tmp_path,)) == ()


def test_all_frames_have_only_so_many_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(steps, "MOST_TOGETHER", 2)
    two = f"{MANY}frame D {{ output o = Sky(screen).color }}\n"
    assert burnish.check(two) == ()
    assert complaint(f"{two}frame E {{ output o = Sky(screen).color }}\n") == (
        "<text>:8:7: B0828 `E` has more than 2 steps together with the frames before it"
    )
