"""The command that compares a folder of documents: what it keeps, and what it counts."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from burnish.materialx.fidelity.checker import Checker
from burnish.materialx.importing import Imported
from burnish.materialx.problems import Problem

from . import suite_worker
from .kit import document
from .suite import rows_of, table
from .suite_worker import compared

pytestmark = pytest.mark.xdist_group("materialx")


def row(document: str, verdict: str, reason: str = "") -> dict[str, str]:
    return {"document": document, "renderable": "R", "verdict": verdict, "reason": reason}


def test_a_line_that_was_cut_off_is_no_result(tmp_path: Path) -> None:
    kept = tmp_path / "kept.jsonl"
    assert list(rows_of(kept)) == []
    whole = json.dumps(row("a.mtlx", "alike"))
    kept.write_text(f"{whole}\n{whole[:20]}", "utf-8")
    assert [each["document"] for each in rows_of(kept)] == ["a.mtlx"]


def test_verdicts_are_counted_and_reasons_are_told() -> None:
    rows = [row("a", "alike"), row("a", "not run", "no\nmore"), row("b", "not run", "no")]
    told = table(rows).splitlines()
    assert told[:3] == ["2 renderables of 2 documents", "     2 not run", "     1 alike"]
    assert told[3:] == ["", "not run:", "     2 no"]


def test_a_material_is_compared(checker: Checker) -> None:
    (found,) = compared(checker, document("unlit_constant"))
    assert (found["renderable"], found["verdict"]) == ("Lamp", "alike"), found["reason"]


def test_what_is_not_converted_is_not_run(
    checker: Checker, monkeypatch: pytest.MonkeyPatch
) -> None:
    told = Problem("Lamp", "unlit_constant.mtlx:9", "lamps are too bright")
    nothing = Imported({"lamp.burnish": b"burnish 1\n"}, "lamp.burnish", [], [told])
    monkeypatch.setattr(suite_worker, "imported", lambda _path, **_: nothing)
    (found,) = compared(checker, document("unlit_constant"))
    assert (found["renderable"], found["verdict"]) == ("Lamp", "not run")
    assert found["reason"] == "not converted: lamps are too bright"


def test_a_converter_that_fails_is_not_run(
    checker: Checker, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(_path: Path, **_: object) -> Imported:
        raise KeyError("luminance")

    monkeypatch.setattr(suite_worker, "imported", failing)
    (found,) = compared(checker, document("unlit_constant"))
    assert (found["verdict"], found["reason"]) == ("not run", "not imported: KeyError: 'luminance'")
