"""Every document of the tests becomes materials that look like MaterialX's own pictures of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.materialx.fidelity.checker import Checker

from .kit import documents
from .suite_worker import compared

pytestmark = pytest.mark.xdist_group("materialx")  # One process draws for all.

DIFFERENT = {
    ("inheritance", "OldBrick"): (
        "A material inherits the inputs of another one by the specification; MaterialX's own "
        "generator does not look for them there, and draws black."
    ),
    ("image_set", "Squares"): (
        "MaterialX's own text draws the first file of a set on all squares, and goes on with its "
        "other side at their edges."
    ),
}
"""The renderables whose pictures are not alike, and whose mistake that is."""


@pytest.mark.parametrize("document", documents(), ids=lambda path: path.stem)
def test_materials_are_alike(checker: Checker, document: Path) -> None:
    rows = list(compared(checker, document))
    assert rows
    for row in rows:
        is_explained = (document.stem, row["renderable"]) in DIFFERENT
        wanted = "different" if is_explained else "alike"
        assert row["verdict"] == wanted, (row["renderable"], row["reason"])
