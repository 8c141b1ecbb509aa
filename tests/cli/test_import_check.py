"""``burnish import --check``: verdicts about what was written, beside MaterialX's own pictures."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from burnish.materialx.fidelity import checking
from burnish.materialx.fidelity.checking import Checked

from ..materialx.kit import document
from .kit import invoke

pytestmark = pytest.mark.xdist_group("materialx")


def test_materials_that_are_alike_are_told(tmp_path: Path) -> None:
    said = invoke("import", document("image_plain"), "-o", tmp_path, "--check")
    assert said.exit_code == 0, said.output
    heading, row, last = said.stdout.splitlines()[-3:]
    assert heading.split() == ["material", "verdict", "pixels", "apart", "largest", "difference"]
    assert re.fullmatch(r"\w+ +alike +0 of \d+ +[\de.-]+", row)
    assert last == "beside MaterialX's own pictures: 1 alike"


def test_a_material_that_differs_fails(tmp_path: Path) -> None:
    """MaterialX itself does not follow materials that inherit others."""
    said = invoke("import", document("inheritance"), "-o", tmp_path, "--check")
    assert said.exit_code == 1
    assert re.search(r"^OldBrick  different  \d+ of \d+ +0\.\d+$", said.stdout, re.MULTILINE)
    assert said.stdout.endswith("2 alike, 1 different\n")
    assert (tmp_path / "inheritance.burnish").exists()


def test_what_cannot_be_compared_is_no_pass(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def without_driver(_checker: object, claim: checking.Claim) -> Checked:
        return Checked(claim.renderable, "not run", "there is no driver")

    monkeypatch.setattr(checking, "check", without_driver)
    said = invoke("import", document("unlit_constant"), "-o", tmp_path, "--check")
    assert said.exit_code == 1
    assert "Lamp      not run    there is no driver\n" in said.stdout
    assert said.stdout.endswith("beside MaterialX's own pictures: 1 not run\n")


def test_materials_are_compared_without_displacement_which_is_told(tmp_path: Path) -> None:
    said = invoke("import", document("displaced"), "-o", tmp_path, "--check")
    assert said.exit_code == 0, said.output
    row, _, last = said.stdout.splitlines()[-3:]
    assert row.startswith("Rock      alike      0 of ")
    assert last == "compared without displacement, which MaterialX's GLSL leaves out: Rock"
