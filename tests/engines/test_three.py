"""Materials in three.js, drawn by both of its renderers, and judged by their slots' bounds."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page

from burnish.api.compiled_functions import CompiledFunctions
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.engines.three.slots import PHYSICAL, SHARED, UNLIT
from burnish.testing import assert_in_bounds

from ..cli.kit import invoke
from ..golden import assert_golden
from .kit import (
    attributes_of,
    complaints,
    functions,
    given_for,
    golden_of,
    module_of,
    page_of,
    site_in,
)
from .typed import complaints as complaints_of_types

EXAMPLES = Path(__file__).parents[2] / "examples"
GOLDEN = Path(__file__).parent / "golden"
BACKENDS = ("webgpu", "webgl")
JUDGED = {
    "plastic": ("Plastic", {"tint": 3}),
    "normal_map": ("TangentSpaceBumps", {"normal": 3, "bump": 3}),
    "water": ("Water", {"normal": 3, "glancing": 1}),
}
"""Examples with the slots that are compared, and their numbers of lanes."""
PLACED = ("position", "object_position")
"""Slots that say where vertices are, which all materials have."""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return site_in(tmp_path_factory.mktemp("three"))


@pytest.fixture(scope="module")
def page(site: Path) -> Iterator[Page]:
    with page_of(site) as opened:
        yield opened


@pytest.mark.xdist_group("three")
@pytest.mark.parametrize("name", JUDGED)
def test_slots_are_within_their_bounds(name: str, page: Page, site: Path, tmp_path: Path) -> None:
    material, slots = JUDGED[name]
    (compiled,) = functions(
        EXAMPLES / f"{name}.burnish", material=material, slots=[*slots, *PLACED]
    )
    module = module_of(compiled, site)
    golden = golden_of(EXAMPLES / f"{name}.burnish", material, slots, tmp_path)
    link = site / "golden"
    link.unlink(missing_ok=True)
    link.symlink_to(golden)
    cases = json.loads((golden / "golden.json").read_text(encoding="utf-8"))["cases"]
    cases = [case for case in cases if case["subject"].split(".")[0] == material]
    assert cases
    for case in cases:
        given = given_for(case, golden, compiled.document)
        given |= {"module": f"./{module}", "material": f"{material}Material"}
        for slot, lanes in slots.items():
            for backend in BACKENDS:
                drawn = page.evaluate(
                    "([given, backend]) => draw(given, backend)",
                    [{**given, "slot": slot, "lanes": lanes}, backend],
                )
                picture = np.array(drawn).reshape(case["height"], case["width"], 4)
                # Nothing is drawn where the alpha is 0.
                picture = np.where(picture[:, :, 3:] == 0, -8.0, picture)
                flip = backend == "webgl"
                assert_in_bounds(
                    picture.astype(np.float32), golden, output=f"{slot}_", flip=flip,
                    case=f"{case['subject']}/{case['case']}",
                )  # fmt: skip


SIZE = 48
CANNOT = {"B0904", "B0905", "B0906", "B0206", "B0701", "B0909"}
"""Why an example is not drawn: buffers place vertices, it makes vertices, needs lights, has no
material, or needs what functions of WebGL 2 or of three.js cannot have."""
FILES = sorted(EXAMPLES.glob("*.burnish"))


@pytest.fixture(scope="module")
def modules(site: Path) -> Mapping[Path, Sequence[tuple[CompiledFunctions, str]]]:
    """The materials of all examples with their modules, each file in a folder of its own."""
    return {file: made(file, site) for file in FILES}


@pytest.mark.xdist_group("three")
@pytest.mark.parametrize("backend", BACKENDS)
def test_examples_are_lit(
    backend: str, page: Page, modules: Mapping[Path, Sequence[tuple[CompiledFunctions, str]]]
) -> None:
    """Each renderer draws the half of them, and has nothing to say."""
    drawn, wrong = 0, []
    for file in FILES[BACKENDS.index(backend) :: 2]:
        for compiled, module in modules[file]:
            given = {
                "module": f"./{module}", "material": f"{compiled.name}Material", "size": SIZE,
                "attributes": attributes_of(compiled),
            }  # fmt: skip
            before = len(complaints(page))
            pixels = page.evaluate("([given, backend]) => lit(given, backend)", [given, backend])
            told = complaints(page)[before:]
            colors = np.unique(np.array(pixels).reshape(-1, 4)[:, :3], axis=0)
            if told or len(colors) < 2:
                wrong.append(f"{file.name} {compiled.name}: {told[:1]}")
            drawn += 1
    assert not wrong, "\n".join(wrong)
    assert drawn > 40


def made(file: Path, site: Path) -> list[tuple[CompiledFunctions, str]]:
    """The materials of a file with their modules; none if three.js cannot draw one of them."""
    folder = site / file.stem
    folder.mkdir()
    try:
        return [(each, f"{file.stem}/{module_of(each, folder)}") for each in functions(file)]
    except CompileError as error:
        codes = {found.rule.code for found in error.diagnostics if found.severity == "error"}
        assert codes <= CANNOT, f"{file.name}: {error}"
        return []


PROGRAM = """\
import { Color, Texture } from "three/webgpu";
import { PlasticMaterial } from "./plastic/Plastic.three.js";

const material = new PlasticMaterial({ base: new Color("#2266aa"), albedo: new Texture() });
material.parameters.base.value.set("#b5651d");
material.colorNode = material.slots.tint;
material.roughness = 0.25;
// @ts-expect-error A colour is no number.
new PlasticMaterial({ base: 3 });
// @ts-expect-error It is called base.
material.parameters.basis;
"""


@pytest.mark.xdist_group("three")
def test_types_are_those_of_three(
    modules: Mapping[Path, Sequence[tuple[CompiledFunctions, str]]], site: Path, tmp_path: Path
) -> None:
    """A strict tsc takes the declarations of all examples, and a program by what they declare."""
    assert modules
    for file in site.glob("*/*.d.ts"):
        copy = tmp_path / file.relative_to(site)
        copy.parent.mkdir(exist_ok=True)
        shutil.copy(file, copy)
    (tmp_path / "program.ts").write_text(PROGRAM, encoding="utf-8")
    assert complaints_of_types(tmp_path) == []


def test_the_files_are_as_they_were(tmp_path: Path) -> None:
    source = EXAMPLES / "plastic.burnish"
    result = invoke("compile", source, "--engine", "three", "-o", tmp_path)
    assert result.exit_code == 0 and result.stdout == (
        "Plastic: 2 functions (tint, base) in files for three.js and "
        f"Plastic.three.functions.json in {tmp_path}\n"
    )
    for name in ("Plastic.three.js", "Plastic.three.d.ts"):
        assert_golden((tmp_path / name).read_text(encoding="utf-8"), GOLDEN / name)


WRONG = {
    ("--engine", "thre"): (1, "error[B0910]: no engine is called `thre`"),
    ("--engine", "three", "--target", "hlsl"): (2, "--engine says the targets itself"),
    ("--engine", "three", "--together"): (2, "leave --together out"),
    ("--engine", "three", "--slots", "ground"): (
        1, "error[B0909]: three.js cannot draw `ground`: no uniform is a Ground[4], as `kinds` is",
    ),
}  # fmt: skip


@pytest.mark.parametrize("given", WRONG)
def test_what_is_wrong_is_told_and_nothing_is_written(
    given: tuple[str, ...], tmp_path: Path
) -> None:
    out = tmp_path / "out"
    result = invoke("compile", EXAMPLES / "splatting.burnish", *given, "-o", out)
    code, expected = WRONG[given]
    assert (result.exit_code, expected in result.stderr) == (code, True), result.stderr
    assert not out.exists()


def test_a_slot_is_named_for_a_value(tmp_path: Path) -> None:
    source = tmp_path / "stained.burnish"
    source.write_text(STAINED, encoding="utf-8")
    result = invoke(
        "compile", source, "--engine", "three", "--slots", "base_color=stain", "-o", tmp_path
    )
    assert result.exit_code == 0, result.stderr
    text = (tmp_path / "Stained.three.js").read_text(encoding="utf-8")
    assert "this.colorNode = slots.stain;" in text


STAINED = """\
import std.terms.{lambert}

material Stained {
    stain = vec3(uv, 0.5)
    color = lambert(stain)
}
"""


def test_a_material_that_gives_nothing_is_told(tmp_path: Path) -> None:
    source = tmp_path / "stained.burnish"
    source.write_text(STAINED, encoding="utf-8")
    result = invoke(
        "compile", source, "--engine", "three", "--slots", "stain", "-o", tmp_path / "out"
    )
    assert result.exit_code == 1
    assert (
        "error[B0909]: three.js cannot draw `Stained`: none of its slots is a value that the "
        "engine takes; name one, as in `--slots base_color=…`" in result.stderr
    )
    assert not (tmp_path / "out").exists()


MOVED = """\
import std.terms.{lambert}

material Waving {
    param high : float = 0.1
    tint = vec3(0.5)
    object_position = vertex_position + high * sin(vertex_position.x) * vertex_normal
    object_normal = normalize(vec3(-high * cos(vertex_position.x), 1, 0))
    color = lambert(tint)
}
"""


def test_vertices_bring_their_normals(tmp_path: Path) -> None:
    """The place is computed of the mesh's own normal, before the new one stands in its place."""
    source = tmp_path / "waving.burnish"
    source.write_text(MOVED, encoding="utf-8")
    result = invoke("compile", source, "--engine", "three", "-o", tmp_path)
    assert result.exit_code == 0, result.stderr
    text = (tmp_path / "Waving.three.js").read_text(encoding="utf-8")
    place, normal = "const place = slots.object_position.toVar();", "slots.object_normal"
    lines = " ".join(text.split())
    assert f"{place} normalLocal.assign({normal}); return place;" in lines


BENT = """\
import std.motion.{MeshPoint}

material Bent {
    rest = inherited.object_shape
    object_shape = MeshPoint(
        rest.position + vec3(0, 0.3 * sin(3 * rest.position.x), 0), rest.normal.zyx, rest.tangent,
        rest.handedness, mat4(1)
    )
    tint = 0.5 + 0.5 * normal
    glow = 0.2 * abs(position)
}
"""
PUSHED = """\
material Pushed {
    object_position = vertex_position + 0.2 * vertex_normal.zxy
    object_normal = vertex_normal.yzx
    tint = 0.5 + 0.5 * normal
    glow = 0.2 * abs(position)
}
"""
WAYS = ("instance", "bone", "target")
"""How three.js moves a mesh before the material does."""


@pytest.mark.xdist_group("three")
@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("source", [BENT, PUSHED], ids=["shape", "position"])
def test_what_three_moves_the_material_moves_on(
    source: str, backend: str, page: Page, site: Path, tmp_path: Path
) -> None:
    """The picture is that of a mesh that has been moved before it is drawn."""
    file = tmp_path / "moved.burnish"
    file.write_text(source, encoding="utf-8")
    (compiled,) = functions(file)
    given = {
        "module": f"./{module_of(compiled, site)}", "material": f"{compiled.name}Material",
        "size": SIZE,
    }  # fmt: skip

    def drawn(way: str) -> np.ndarray:
        pixels = page.evaluate(
            "([given, backend]) => placed(given, backend)", [{**given, "way": way}, backend]
        )
        return np.array(pixels, float)

    before = drawn("geometry")
    assert len(np.unique(before.reshape(-1, 4), axis=0)) > SIZE
    for way in WAYS:
        assert np.abs(drawn(way) - before).max() <= 2, way


CLONED = """async (module) => {
  const made = await import(module);
  const first = new made.PlasticMaterial({ power: 8, albedo: null });
  const second = first.clone();
  second.parameters.base.value.setRGB(0, 0, 1);
  second.parameters.power.value = 64;
  const own_ = first.slots.base_color.mul(2);
  first.colorNode = own_;
  const third = first.clone();
  const plain = new (Object.getPrototypeOf(made.PlasticMaterial))();
  const other = new made.PlasticMaterial().copy(plain);
  first.dispose();
  const own = (each) => [each.parameters.power.value, each.parameters.base.value.getHex()];
  return {
    first: own(first), second: own(second), keepsDefault: Boolean(first.textures.albedo.value),
    sharesTextures: first.textures.albedo.value === second.textures.albedo.value,
    sharesNodes: first.colorNode === second.colorNode,
    keepsNodes: third.colorNode === own_, takesOthers: other.parameters.power.value,
    isOfType: second instanceof made.PlasticMaterial,
  };
}"""


@pytest.mark.xdist_group("three")
def test_a_clone_has_parameters_of_its_own(page: Page, site: Path, tmp_path: Path) -> None:
    source = (
        "material Plastic {\n    param base : rgb = #ff0000\n    param power : float = 2\n"
        "    map albedo : texture2d = white\n"
        "    base_color = base * albedo(uv).rgb * power\n}\n"
    )
    (tmp_path / "cloned.burnish").write_text(source, encoding="utf-8")
    (compiled,) = functions(tmp_path / "cloned.burnish")
    (site / "cloned").mkdir()
    module = module_of(compiled, site / "cloned")
    assert page.evaluate(CLONED, f"./cloned/{module}") == {
        "first": [8, 0xFF0000], "second": [64, 0x0000FF], "keepsDefault": True,
        "sharesTextures": True, "sharesNodes": False, "isOfType": True,
        "keepsNodes": True, "takesOthers": 2,
    }  # fmt: skip


def test_each_row_of_the_table_is_a_property_of_three(site: Path) -> None:
    """A misspelt property would be set in vain: JavaScript says nothing of it."""
    files = (site / "three" / f"three.{name}.js" for name in ("webgpu", "tsl"))
    text = "".join(file.read_text(encoding="utf-8") for file in files)
    for row in (*PHYSICAL, *UNLIT, *SHARED):
        assert f"this.{row.node} = null;" in text, row.node
