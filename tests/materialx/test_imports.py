"""Documents become files that a person likes to read: their texts, for a few kinds of documents."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from burnish.materialx.constants import OF_OTHERS
from burnish.materialx.expressions import number_text
from burnish.materialx.importing import Imported, imported
from burnish.materialx.outline import DocumentError

from ..golden import assert_golden
from .kit import documents
from .texts import converted, document

HERE = Path(__file__).parent
READ = (
    "comments", "displaced_wood", "graph_interface", "image_set", "image_wraps", "inheritance",
    "lama_layers", "lights", "looks", "mixed_models", "open_pbr_varnish", "own_definition",
    "own_mixture", "own_multioutput", "primvars", "structures", "surface_mix", "units",
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


MEASURED = """<nodedef name="ND_wide" node="wide">
<input name="width" type="float" value="5" unittype="distance" unit="millimeter"/>
<output name="out" type="float"/></nodedef>
<nodegraph name="NG_wide" nodedef="ND_wide">
<multiply name="m" type="float"><input name="in1" type="float" interfacename="width"/>
<input name="in2" type="float" value="3"/></multiply>
<output name="out" type="float" nodename="m"/></nodegraph>
<wide name="a" type="float"/>
<wide name="b" type="float"><input name="width" type="float" value="5"/></wide>
<output name="one" type="float" nodename="a"/>
<output name="other" type="float" nodename="b"/>"""


def test_the_default_of_a_definition_has_its_unit(tmp_path: Path) -> None:
    text = converted(tmp_path, document(MEASURED)).files["doc.burnish"].decode()
    assert "fn wide(width: float = 5mm)" in text
    # A number without a unit is in metres.
    assert "wide(5mm)" in text
    assert "wide(5)" in text


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


def of_set(folder: Path, files: Mapping[str, str], node: str, file: str) -> Imported:
    """A document that reads a set of files, which lie beside it in a folder."""
    for name, original in files.items():
        (folder / name).write_bytes((HERE / "documents" / "images" / original).read_bytes())
    path = folder / "set.mtlx"
    path.write_text(
        f'<materialx version="1.39"><{node} name="n" type="color3">'
        f'<input name="file" type="filename" value="{file}"/></{node}>'
        '<output name="shown" type="color3" nodename="n"/></materialx>'
    )
    return imported(path)


BOTH = {"a.1001.png": "set.1001.png", "a.1013.png": "set.1002.png"}


def test_all_files_of_a_set_are_copied(tmp_path: Path) -> None:
    found = of_set(tmp_path, {**BOTH, "a.0999.png": "few.png"}, "image", "a.&lt;UDIM&gt;.png")
    assert not found.problems
    assert {name for name in found.files if name.endswith("png")} == {
        f"textures/{name}" for name in BOTH
    }
    text = found.files[found.main].decode()
    assert "udim_set(a, st, [1001, 1013], vec4(0))" in text
    assert "--set a=textures/a.1001.png,textures/a.1013.png" in text


def test_sets_are_read_by_graphs_of_images(tmp_path: Path) -> None:
    """They are written out, since functions take one picture."""
    found = of_set(tmp_path, BOTH, "tiledimage", "a.&lt;UDIM&gt;.png")
    assert not found.problems
    assert "udim_set(a, st, [1001, 1013], vec4(0))" in found.files[found.main].decode()


def test_files_of_a_set_are_named_by_their_columns_and_rows(tmp_path: Path) -> None:
    files = {"b_u10_v1.png": "set.1001.png", "b_u2_v3.png": "set.1002.png"}
    found = of_set(tmp_path, files, "image", "b_&lt;UVTILE&gt;.png")
    assert "udim_set(b, st, [1010, 1022], " in found.files[found.main].decode()


def test_of_a_set_that_is_no_image_the_first_is_drawn_and_told(tmp_path: Path) -> None:
    found = of_set(tmp_path, BOTH, "hextiledimage", "a.&lt;UDIM&gt;.png")
    (problem,) = found.problems
    assert not problem.is_error
    assert problem.text.startswith("of the files `a.<UDIM>.png` for the squares of a chart")
    assert "textures/a.1001.png" in found.files
    assert "textures/a.1013.png" not in found.files


def test_a_set_without_files_is_told(tmp_path: Path) -> None:
    found = of_set(tmp_path, {}, "image", "a.&lt;UDIM&gt;.png")
    (problem,) = found.problems
    assert "the picture `a.<UDIM>.png` is not in the document's folder" in problem.text


def test_pictures_that_are_too_large_are_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = (HERE / "documents" / "images" / "set.1001.png").stat().st_size
    monkeypatch.setattr("burnish.materialx.pictures.LARGEST_TOGETHER", first)
    found = of_set(tmp_path, BOTH, "image", "a.&lt;UDIM&gt;.png")
    (problem,) = found.problems
    assert "the picture `a.1013.png` is too large to be copied" in problem.text
    assert "textures/a.1001.png" in found.files


def test_a_large_first_picture_of_a_set_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("burnish.materialx.pictures.LARGEST", 10)
    found = of_set(tmp_path, BOTH, "hextiledimage", "a.&lt;UDIM&gt;.png")
    (problem,) = found.problems
    assert "the picture `a.<UDIM>.png` is too large to be copied" in problem.text


def test_a_picture_that_fits_in_another_folder_is_copied(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    small = HERE / "documents" / "images" / "set.1001.png"
    (tmp_path / "small").mkdir()
    (tmp_path / "small" / "a.png").write_bytes(small.read_bytes())
    monkeypatch.setattr("burnish.materialx.pictures.LARGEST", small.stat().st_size)
    (tmp_path / "a.png").write_bytes(bytes(small.stat().st_size + 1))
    of_set(tmp_path, {}, "image", "a.png")
    found = imported(tmp_path / "set.mtlx", image_folders=[tmp_path / "small"])
    assert not found.problems
    assert found.files["textures/a.png"] == small.read_bytes()


def test_files_of_a_set_outside_of_the_folder_are_not_seen(tmp_path: Path) -> None:
    """Neither which of them are there: the set is the one that the folder has under this name."""
    inside = tmp_path / "inside"
    inside.mkdir()
    for name, original in {"a.1005.png": "set.1001.png", **BOTH}.items():
        place = tmp_path if name == "a.1005.png" else inside
        place.joinpath(name).write_bytes((HERE / "documents" / "images" / original).read_bytes())
    found = of_set(inside, {}, "image", "../a.&lt;UDIM&gt;.png")
    assert not found.problems
    assert "[1001, 1013]" in found.files[found.main].decode()


VOLUMES = """<materialx version="1.39">
<standard_surface name="s" type="surfaceshader"/>
<absorption_vdf name="v" type="VDF"/>
<volume name="fog" type="volumeshader"><input name="vdf" type="VDF" nodename="v"/></volume>
<surfacematerial name="Clay" type="material">
<input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
<volumematerial name="Fog" type="material">
<input name="volumeshader" type="volumeshader" nodename="fog"/></volumematerial>
</materialx>"""


def test_volumes_are_told_and_the_rest_is_converted(tmp_path: Path) -> None:
    path = tmp_path / "volumes.mtlx"
    path.write_text(VOLUMES)
    found = imported(path)
    assert [str(problem) for problem in found.problems] == [
        "volumes.mtlx:7: Fog: volumematerial is no surface that Burnish draws"
    ]
    assert found.problems[0].is_error
    assert [material.name for material in found.materials] == ["Clay"]


HEIRS = """<materialx version="1.39"><standard_surface name="a" type="surfaceshader">
<input name="specular" type="float" value="0.5"/><input name="coat" type="float" value="0.5"/>
</standard_surface><standard_surface name="b" type="surfaceshader" inherit="a">
<input name="specular" type="float" {}/></standard_surface>
<surfacematerial name="A" type="material">
<input name="surfaceshader" type="surfaceshader" nodename="a"/></surfacematerial>
<surfacematerial name="B" type="material" doc="The heir">
<input name="surfaceshader" type="surfaceshader" nodename="b"/></surfacematerial>
<constant name="half" type="float"><input name="value" type="float" value="0.5"/></constant>
</materialx>"""


@pytest.mark.parametrize(
    ("specular", "expected"),
    [
        ('value="0.2"', "/// The heir\nmaterial B : A {\n    specular = 0.2\n}\n"),
        ('nodename="half"', "/// The heir\nmaterial B : A {}\n"),
        # The default of the model is not written, so this one has fewer slots.
        ('value="1"', "/// The heir\nmaterial B : StandardSurface {\n    coat = 0.5\n}\n"),
    ],
)
def test_of_an_heir_only_what_differs_is_written(
    specular: str, expected: str, tmp_path: Path
) -> None:
    path = tmp_path / "heirs.mtlx"
    path.write_text(HEIRS.format(specular))
    found = imported(path)
    assert found.files[found.main].decode().endswith(expected)


def test_all_names_of_color_spaces_are_known(tmp_path: Path) -> None:
    """Of constants and of files; OpenColorIO takes no heed of capital letters."""
    rows = [(name, function) for function, names in OF_OTHERS.items() for name in names]
    nodes = "".join(
        f'<output name="o{place}" type="color3" nodename="n{place}"/>'
        f'<constant name="n{place}" type="color3"><input name="value" type="color3" '
        f'value="0.1, 0.2, 0.3" colorspace="{name.upper()}"/></constant>'
        for place, (name, _) in enumerate(rows)
    )
    path = tmp_path / "spaces.mtlx"
    path.write_text(f'<materialx version="1.39">{nodes}</materialx>')
    found = imported(path)
    assert not found.problems
    text = found.files[found.main].decode()
    for place, (_, function) in enumerate(rows):
        material = text.partition(f"material O{place} :")[2].partition("}")[0]
        assert f"{function}(rgb(0.1, 0.2, 0.3))" in material


def test_a_back_is_left_out_and_told(tmp_path: Path) -> None:
    text = (HERE / "documents" / "surface_diffuse.mtlx").read_text("utf-8")
    path = tmp_path / "back.mtlx"
    side = 'name="{}surfaceshader"'
    path.write_text(text.replace(side.format(""), side.format("back")), "utf-8")
    (problem,) = imported(path).problems
    assert (problem.path, problem.text) == ("Chalk", "its `backsurfaceshader` is left out")
    assert not problem.is_error


def test_pictures_of_one_name_in_two_folders_are_two_maps(tmp_path: Path) -> None:
    """Also in two materials, since the file's command sets a map by its name."""
    nodes = ""
    for folder, original in (("a", "few.png"), ("b", "mask.png")):
        (tmp_path / folder).mkdir()
        content = (HERE / "documents" / "images" / original).read_bytes()
        (tmp_path / folder / "wood.png").write_bytes(content)
        nodes += (
            f'<image name="{folder}" type="color3"><input name="file" type="filename" '
            f'value="{folder}/wood.png"/></image>'
            f'<output name="{folder}_shown" type="color3" nodename="{folder}"/>'
        )
    path = tmp_path / "two.mtlx"
    path.write_text(f'<materialx version="1.39">{nodes}</materialx>')
    found = imported(path)
    assert [set(material.files) for material in found.materials] == [{"wood"}, {"wood_2"}]
    pictures = [content for name, content in found.files.items() if name.endswith("png")]
    assert sorted(map(len, pictures)) == sorted(
        (tmp_path / folder / "wood.png").stat().st_size for folder in "ab"
    )


def test_more_materials_than_a_file_may_have_are_told(tmp_path: Path) -> None:
    rows = "".join(
        f'<constant name="c{number}" type="color3"/>'
        f'<output name="o{number}" type="color3" nodename="c{number}"/>'
        for number in range(257)
    )
    path = tmp_path / "many.mtlx"
    path.write_text(f'<materialx version="1.39">{rows}</materialx>')
    with pytest.raises(DocumentError) as raised:
        imported(path)
    assert str(raised.value) == (
        "many.mtlx:1: error: 257 materials or outputs are drawn, and a file of Burnish has at most "
        "256: divide the document"
    )
