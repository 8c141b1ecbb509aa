"""Documents that were imported are exported, and read back as the same text or the same meaning."""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish import same
from burnish.materialx.importing import Imported, imported

from ..materialx.kit import document
from .kit import MATERIALS, declarations, exported, read_back, written

SAME_TEXT = (
    "bumps", "closure_emission", "closure_sheen", "closure_transmission", "conditions",
    "image_alpha", "image_spaces", "image_wraps", "math_arithmetic",
    "noise_solid", "own_definition", "spaces",
)  # fmt: skip
SAME_MEANING = (
    "channels", "closure_film", "compositing", "graph_interface", "image_hexagons", "math_matrices",
    "own_multioutput", "several_outputs", "surface_mix", "units", "upgraded_1_36",
)  # fmt: skip
"""Documents whose text changes, such as ``.w`` in place of ``.a``: units are computed, and titles
of folders are comments, which are not exported."""


def there_and_back(name: str, folder: Path) -> tuple[Path, Path, Imported]:
    """A document as it is imported, and as it is imported after it was exported."""
    found = imported(document(name))
    first = written(found, folder / "first")
    return first, read_back(exported(first), folder / "second", name), found


@pytest.mark.parametrize("name", SAME_TEXT)
def test_a_document_reads_back_as_the_same_text(name: str, tmp_path: Path) -> None:
    first, second, _found = there_and_back(name, tmp_path)
    assert declarations(second) == declarations(first)


@pytest.mark.parametrize("name", SAME_MEANING)
def test_a_document_reads_back_as_the_same_meaning(name: str, tmp_path: Path) -> None:
    first, second, found = there_and_back(name, tmp_path)
    for material in found.materials:
        assert same(first, second, material=material.name).verdict == "same", material.name


@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # Of values without bounds.
def test_each_operator_and_builtin_means_the_same_afterwards(tmp_path: Path) -> None:
    """Tangents have no bounds, so this is no proof: it is compared at many points."""
    first = MATERIALS / "numbers.burnish"
    found = same(first, read_back(exported(first), tmp_path, "numbers"), boxes=8)
    assert found.verdict != "different", found.witness
    assert found.points > 500
    assert found.seen < 1.0


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_difference_would_be_found(tmp_path: Path) -> None:
    first = MATERIALS / "numbers.burnish"
    document = exported(first)
    assert 'value="0.7"' in document
    wrong = read_back(document.replace('value="0.7"', 'value="0.71"', 1), tmp_path, "numbers")
    assert same(first, wrong, boxes=8).verdict == "different"
