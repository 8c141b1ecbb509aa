"""MaterialX's own text draws every document of the tests."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from burnish.materialx.fidelity.checker import Checker
from burnish.materialx.fidelity.comparing import drawn

from .kit import documents

pytestmark = pytest.mark.xdist_group("materialx")  # One process draws for all.

ONE_COLOR = {
    ("unlit_constant", "Lamp"): "it says one colour",
    ("looks", "Red"): "it says one colour",
    ("document_input", "bare/out"): "it has no surface",
    ("graph_defaults", "IMP_pattern/out"): "it names no file",
    ("inheritance", "OldBrick"): "MaterialX's own text does not follow `inherit` of materials",
}
"""The renderables that are of one colour all over, and why."""
MISSING = {"image_missing": ("images/lost.png",)}
"""The files that documents name although they are not there."""


@pytest.mark.parametrize("document", documents(), ids=lambda path: path.stem)
def test_each_document_is_drawn(checker: Checker, document: Path) -> None:
    names = checker.renderables(document)
    assert names
    for name in names:
        found = checker.draw(document, name)
        seen = found.picture[drawn(found.picture)]
        assert len(seen) > 100, name
        assert np.isfinite(seen).all(), name
        is_of_one_color = len(np.unique(seen, axis=0)) == 1
        assert is_of_one_color == ((document.stem, name) in ONE_COLOR), name
        assert tuple(found.missing) == MISSING.get(document.stem, ()), name
