"""``burnish compile --bindings``: a file that is read again when it changes, and its mistakes."""

from __future__ import annotations

from pathlib import Path

import pytest

from .kit import PLAIN, invoke, tree


@pytest.fixture
def words(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    monkeypatch.chdir(tmp_path)
    Path("plain.burnish").write_text(PLAIN, encoding="utf-8")
    return ["compile", "plain.burnish", "-t", "wgsl", "--bindings", "engine.toml", "-o"]


def test_texts_follow_the_file_whenever_it_changes(words: list[str]) -> None:
    for number in (3, 4):
        Path("engine.toml").write_text(f"[first]\nview = {number}\n", encoding="utf-8")
        result = invoke(*words, "-")
        assert result.exit_code == 0
        assert f"@group(0) @binding({number}) var<uniform> view: View;" in result.stdout


def test_mistakes_are_told_and_nothing_is_written(words: list[str]) -> None:
    Path("engine.toml").write_text("[sets]\ndraw = -1\n", encoding="utf-8")
    result = invoke(*words, "out")
    assert result.exit_code == 1
    assert result.stderr.startswith(
        "error[B0708]: engine.toml: `sets.draw` is a whole number from 0 to 65535\n"
    )
    Path("engine.toml").unlink()
    result = invoke(*words, "out")
    assert result.exit_code == 1
    assert result.stderr.startswith("error[B0001]: there is no file `engine.toml`\n")
    assert tree(Path.cwd()) == {"plain.burnish"}
