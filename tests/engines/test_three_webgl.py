"""Materials of whole shaders for three.js's WebGLRenderer, which draws them inside the bounds."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page

from burnish.api.compiling_engines import functions_for, shaders_for
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.engines import known

from ..cli.kit import invoke
from ..golden import assert_golden
from . import webgl
from .files import EXAMPLES
from .kit import module_of, page_of, site_in
from .typed import complaints

GOLDEN = Path(__file__).parent / "golden"
DRAWN = (
    "plastic",
    "skinned",
    "texture_array",
    "instances",
    "indexed",
    "volume",
    "transforms",
    "own_light",
)
"""Lights and derived values, bones and tangents, layers, values of instances, whole numbers in
textures, volumes, and values that only derived ones need.

All examples are drawn by ``webgl_suite.py``."""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return site_in(tmp_path_factory.mktemp("webgl"), "draw_webgl.html")


@pytest.fixture(scope="module")
def page(site: Path) -> Iterator[Page]:
    with page_of(site) as opened:
        yield opened


@pytest.mark.xdist_group("three")
@pytest.mark.parametrize("name", DRAWN)
def test_materials_are_within_their_bounds(name: str, page: Page, site: Path) -> None:
    source, folder = EXAMPLES / f"{name}.burnish", site / name
    folder.mkdir()
    copy = webgl.copied(source, folder)
    golden = webgl.golden_in(folder, copy, source)
    for material in webgl.materials(copy, source):
        webgl.module_in(folder, material)
        cases = list(webgl.cases_of(golden, material.name))
        assert cases
        for case in cases:
            webgl.assert_drawn(page, name, material, golden, case)


PROGRAM = """\
import { Color, Texture, Vector3 } from "three";
import { PlasticMaterial } from "./Plastic.three-webgl.js";

const lamps = [{ place: new Vector3() }];
const material = new PlasticMaterial({ base: new Color("#2266aa"), lamps });
material.uniforms.power.value = 20;
material.set({ albedo: new Texture() }).transparent = true;
// @ts-expect-error A number is no vector.
material.set({ sun_direction: 3 });
// @ts-expect-error A lamp has a place.
material.set({ lamps: [{ position: new Vector3() }] });
"""


def test_the_files_are_as_they_were(tmp_path: Path) -> None:
    source = EXAMPLES / "plastic.burnish"
    result = invoke("compile", source, "--engine", "three-webgl", "-o", tmp_path)
    assert result.exit_code == 0 and result.stdout == (
        f"Plastic: 2 files for three.js's WebGLRenderer in {tmp_path}\n"
    )
    for name in ("Plastic.three-webgl.js", "Plastic.three-webgl.d.ts"):
        assert_golden((tmp_path / name).read_text(encoding="utf-8"), GOLDEN / name)


def test_types_are_those_of_three(tmp_path: Path) -> None:
    """A strict tsc takes declarations with all kinds of uniforms, and a program by some of them."""
    for name in ("plastic", "skinned", "texture_array", "cube_map", "splatting"):
        for material in shaders_for(webgl.ENGINE, EXAMPLES / f"{name}.burnish").materials:
            webgl.module_in(tmp_path, material)
    webgl.module_in(tmp_path, shaders_for(webgl.ENGINE, EXAMPLES / "plastic.burnish").materials[0])
    (tmp_path / "program.ts").write_text(PROGRAM, encoding="utf-8")
    assert complaints(tmp_path) == []


UNFIT = {
    "frames/shadows": "cannot draw `Shadows`: it is a frame of several passes",
    "gaussian": "cannot draw `Across`: it is a kernel, and WebGL has none",
    "thorns": "cannot draw `Cactus`: it makes vertices of its own",
    "cloth": "glsl:three has no storage buffers in the vertex stage",
}


@pytest.mark.parametrize("name", UNFIT)
def test_what_three_cannot_draw_is_told_and_nothing_is_written(name: str, tmp_path: Path) -> None:
    out = tmp_path / "out"
    result = invoke("compile", EXAMPLES / f"{name}.burnish", "--engine", "three-webgl", "-o", out)
    assert (result.exit_code, UNFIT[name] in result.stderr) == (1, True), result.stderr
    assert not out.exists()


WRONG = {
    ("--slots", "tint"): "--slots does not go with --engine three-webgl",
    ("--validate",): "--validate does not go with --engine three-webgl",
    ("--emit", "spirv"): "--emit spirv does not go with --engine three-webgl",
    ("--target", "glsl"): "--engine says the targets itself: leave --target out",
}


@pytest.mark.parametrize("given", WRONG)
def test_options_that_do_not_fit_are_told(given: tuple[str, ...], tmp_path: Path) -> None:
    out = tmp_path / "out"
    result = invoke(
        "compile", EXAMPLES / "plastic.burnish", "--engine", "three-webgl", *given, "-o", out
    )
    assert (result.exit_code, WRONG[given] in result.stderr) == (2, True), result.stderr
    assert not out.exists()


def test_a_name_of_three_is_never_another_value() -> None:
    """A user's parameter may be called as three.js calls an attribute: that one keeps its name."""
    source = (
        "material Named {\n    param skinIndex : float = 0.5\n    color = vec3(skinIndex, uv)\n}"
    )
    (material,) = shaders_for(webgl.ENGINE, source).materials
    text = material.text("glsl", "fragment")
    assert "uniform float skinIndex_;" in text
    with pytest.raises(CompileError, match="nothing"):
        shaders_for(webgl.ENGINE, source, values=(("nothing", "1"),))


def test_members_of_structures_are_called_as_in_the_text(tmp_path: Path) -> None:
    """three.js sets them by these names. A member `set` is another word in the text."""
    source = """
        struct Layer { set : int  turn : angle }
        material Named {
            param layer : Layer
            color = vec3(cos(layer.turn), float(layer.set) * uv.x, cos(0.1 * float(layer.set)))
        }
    """
    (material,) = shaders_for(webgl.ENGINE, source).materials
    text = (tmp_path / webgl.module_in(tmp_path, material)).read_text(encoding="utf-8")
    assert "layer: { value: { set_: 0, turn: 0 } }" in text
    assert "u.layer.value.set_" in text
    assert "u.layer.value.set)" not in text


def test_a_stored_matrix_multiplies_a_whole_sum() -> None:
    (material,) = shaders_for(webgl.ENGINE, EXAMPLES / "morphing.burnish").materials
    assert "vec4(normal_matrix * (normal + 0.75 * (side - normal)), 0.0)" in material.text(
        "glsl", "vertex"
    )


def test_a_transform_of_the_user_is_not_the_cameras(tmp_path: Path) -> None:
    """Its type says what it may be, and still nobody but the user sets it."""
    source = (
        "material Seen {\n    param from_lamp : transform<world, clip>\n"
        "    color = vec3((from_lamp * vec4(position, 1)).z)\n}\n"
    )
    (material,) = shaders_for(webgl.ENGINE, source).materials
    text = (tmp_path / webgl.module_in(tmp_path, material)).read_text(encoding="utf-8")
    assert "setWorldToClip(u.view_projection.value, camera);" in text
    assert text.count("u.from_lamp") == 0
    (compiled,) = functions_for(known.load("three"), source).materials
    assert "from_lamp: uniform(new Matrix4()" in (
        tmp_path / module_of(compiled, tmp_path)
    ).read_text(encoding="utf-8")
