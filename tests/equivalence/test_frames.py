"""Frames are the same if their plans are, and each two of their shaders."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from ..cli.kit import invoke

FRAME = """burnish 1
material Clay {
    param base : rgb = #804020
    param gain : float in 0..1 = 0.5
    color = base * gain
}
frame Scene {
    models things : Clay
    lit = Forward(things, 64)
    output picture = lit.color
}
"""
ALIKE = "same  frame Scene: the plans are alike, with 1 step; 1 of 1 shader proven to be the same"


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.burnish").write_text(FRAME)


@pytest.mark.parametrize(
    ("old", "new", "code", "said"),
    [
        ("base * gain", "base - base * (1 - gain)", 0, ALIKE),
        ("base * gain", "base * gain * gain", 1, "Scene.Forward.Clay differs: color."),
        ("(things, 64)", "(things, 65)", 3, "open  frame Scene: the plans differ at values.0."),
        ("#804020", "#804021", 0, ALIKE),
    ],
    ids=["other words", "another shader", "another state", "another default"],
)  # fmt: skip
def test_frames_are_compared_by_plans_and_shaders(old: str, new: str, code: int, said: str) -> None:
    Path("b.burnish").write_text(FRAME.replace(old, new))
    result = invoke("same", "a.burnish", "b.burnish")
    assert (result.exit_code, said in result.stdout) == (code, True), result.output


def test_frames_are_rows_of_the_document() -> None:
    answer = json.loads(invoke("same", "a.burnish", "a.burnish", "--format", "json").stdout)
    rows = answer["result"]["comparisons"]
    assert rows[-1] == {
        "frame": "Scene", "verdict": "same", "steps": 1, "plans_differ_at": None,
        "shaders": {"Scene.Forward.Clay": "same"},
    }  # fmt: skip


def test_frames_are_left_out_where_one_material_is_chosen() -> None:
    assert "frame" not in invoke("same", "a.burnish#Clay", "a.burnish#Clay").stdout
