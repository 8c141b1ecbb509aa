"""Documents become files that a person likes to read: their texts, for a few kinds of documents."""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.materialx.importing import imported

from ..golden import assert_golden
from .kit import documents

HERE = Path(__file__).parent
READ = (
    "comments", "graph_interface", "image_wraps", "inheritance", "lama_layers", "lights", "looks",
    "open_pbr_varnish",
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


def test_a_light_of_another_kind_is_left_out_and_told(tmp_path: Path) -> None:
    text = (HERE / "documents" / "lights.mtlx").read_text("utf-8")
    path = tmp_path / "lights.mtlx"
    path.write_text(text.replace("directional_light", "moon_light"), "utf-8")
    found = imported(path)
    (problem,) = found.problems
    assert str(problem).endswith("sun: moon_light is no light of Burnish: it is left out")
    assert not problem.is_error
    lights = found.files[found.main].decode().partition("rig DocumentLights {")[2]
    assert [word for word in ("sun :", "bulb :", "torch :") if word in lights] == [
        "bulb :", "torch :",
    ]  # fmt: skip


def test_of_a_set_of_files_the_first_is_copied_and_told() -> None:
    found = imported(HERE / "documents" / "image_set.mtlx")
    (problem,) = found.problems
    assert not problem.is_error
    assert problem.text.startswith("of the files `images/set.<UDIM>.png` for the squares")
    copied = (HERE / "documents" / "images" / "set.1001.png").read_bytes()
    assert found.files["textures/set.1001.png"] == copied


def test_a_displacement_is_left_out_and_told() -> None:
    found = imported(HERE / "documents" / "displaced.mtlx")
    (problem,) = found.problems
    assert (problem.path, problem.text) == ("Rock", "its `displacementshader` is left out")
    assert not problem.is_error
