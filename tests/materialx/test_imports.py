"""Documents become files that a person likes to read: their texts, for a few kinds of documents."""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.materialx.importing import imported

from ..golden import assert_golden
from .kit import documents

HERE = Path(__file__).parent
READ = (
    "graph_interface", "image_wraps", "inheritance", "lama_layers", "open_pbr_varnish",
    "own_definition", "own_multioutput", "primvars", "surface_mix", "units",
)  # fmt: skip
"""Documents whose files are kept, so that a person sees what changes."""


@pytest.mark.parametrize("name", READ)
def test_the_file_of_a_document(name: str) -> None:
    found = imported(HERE / "documents" / f"{name}.mtlx")
    assert_golden(found.files[found.main].decode(), HERE / "imports" / f"{name}.burnish")


@pytest.mark.parametrize("document", documents(), ids=lambda path: path.stem)
def test_all_of_a_document_is_converted(document: Path) -> None:
    problems = [problem for problem in imported(document).problems if problem.is_error]
    assert not problems


def test_two_imports_of_a_document_are_the_same() -> None:
    """The files of one document do not depend on what was imported before."""
    path = HERE / "documents" / "graph_interface.mtlx"
    first = imported(path)
    imported(HERE / "documents" / "lama_layers.mtlx")
    assert imported(path) == first


def test_a_document_of_a_model_has_an_equation_for_each_input_that_it_sets() -> None:
    found = imported(HERE / "documents" / "open_pbr_varnish.mtlx")
    lines = found.files[found.main].decode().splitlines()
    equations = [line for line in lines if line.startswith("    ") and " = " in line]
    assert len(equations) == 9
