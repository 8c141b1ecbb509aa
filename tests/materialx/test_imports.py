"""Documents become files that a person likes to read: their texts, for a few kinds of documents."""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.materialx.expressions import number_text
from burnish.materialx.importing import imported

from ..golden import assert_golden
from .kit import documents

HERE = Path(__file__).parent
READ = (
    "comments", "displaced_wood", "graph_interface", "image_wraps", "inheritance", "lama_layers",
    "lights", "looks", "mixed_models", "open_pbr_varnish",
    "own_definition", "own_mixture", "own_multioutput", "primvars", "surface_mix", "units",
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


def test_a_mix_of_two_models_has_a_slot_for_each_side() -> None:
    """The file has the names of the document's nodes, and only what these set."""
    found = imported(HERE / "documents" / "mixed_models.mtlx")
    car = found.files[found.main].decode().partition("material Car :")[2].partition("}\n\n")[0]
    assert len(car.splitlines()) <= 12
    slots = [line.split()[0] for line in car.splitlines() if " = " in line and "map" not in line]
    assert slots == ["rust", "paint", "car", "color", "alpha"]


def test_the_terms_of_a_model_stand_in_one_file_whichever_mix_reads_them() -> None:
    """So documents that are imported into one folder agree on it."""
    found = imported(HERE / "documents" / "mixed_models.mtlx")
    path = "materialx/mixed_standard_surface.burnish"
    text = found.files[path].decode()
    assert text.count("\nterm ") == 3
    assert "metalness: float = 0" in text
    assert "specular_roughness: float = 0.2" in text
    assert "normal: vec3 = normal_world" in text


def test_a_part_that_a_term_reads_as_well_stays_a_slot(tmp_path: Path) -> None:
    """Closures stand in terms behind the material, and read its slots."""
    path = tmp_path / "bumpy.mtlx"
    path.write_text(BUMPY, "utf-8")
    found = imported(path)
    text = found.files[found.main].decode()
    assert "    displacement = bumps" in text
    assert "roughness = bumps" in text
    assert text.count("fractal3d(") == 1


BUMPY = """<materialx version="1.39">
<fractal3d name="bumps" type="float"/>
<convert name="grey" type="color3"><input name="in" type="float" nodename="bumps"/></convert>
<oren_nayar_diffuse_bsdf name="b" type="BSDF">
  <input name="color" type="color3" nodename="grey"/>
  <input name="roughness" type="float" nodename="bumps"/>
</oren_nayar_diffuse_bsdf>
<surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
<displacement name="d" type="displacementshader">
  <input name="displacement" type="float" nodename="bumps"/>
</displacement>
<surfacematerial name="M" type="material">
  <input name="surfaceshader" type="surfaceshader" nodename="s"/>
  <input name="displacementshader" type="displacementshader" nodename="d"/>
</surfacematerial>
</materialx>
"""


def test_a_material_with_the_name_of_a_function_has_an_ending(tmp_path: Path) -> None:
    """Names that differ only by case count as one."""
    text = (HERE / "documents" / "surface_diffuse.mtlx").read_text("utf-8")
    path = tmp_path / "mixed.mtlx"
    path.write_text(text.replace('"Chalk"', '"Mixed"'), "utf-8")
    assert [each.name for each in imported(path).materials] == ["MixedMaterial"]


def test_numbers_of_programs_with_32_bits_are_as_short_as_people_write_them() -> None:
    assert [number_text(value) for value in (0.20000000298023224, 0.1234567890123, 1 / 3)] == [
        "0.2", "0.1234567890123", "0.3333333333333333",
    ]  # fmt: skip


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


def test_a_back_is_left_out_and_told(tmp_path: Path) -> None:
    text = (HERE / "documents" / "surface_diffuse.mtlx").read_text("utf-8")
    path = tmp_path / "back.mtlx"
    side = 'name="{}surfaceshader"'
    path.write_text(text.replace(side.format(""), side.format("back")), "utf-8")
    (problem,) = imported(path).problems
    assert (problem.path, problem.text) == ("Chalk", "its `backsurfaceshader` is left out")
    assert not problem.is_error
