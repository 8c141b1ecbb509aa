"""Draws whole materials by three.js's ``WebGLRenderer``, and says whether they are in bounds.

The bounds are those of a golden folder, whose inputs a page gives the generated material: what
three.js has itself in three.js's way, and all other values by the material's uniforms.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from playwright.sync_api import Page

from burnish.api.compiled import CompiledMaterial
from burnish.api.compiling_engines import shader_files, shaders_for
from burnish.bindings.fields import Field, Structure
from burnish.bindings.gathering import Compiled, gathered
from burnish.compiler.diagnostics.diagnostic import CompileError, Report
from burnish.engines import known
from burnish.engines.three_webgl.module import of_renderer
from burnish.engines.three_webgl.uniforms import Uniform, uniforms_of
from burnish.testing import assert_in_bounds

from ..cli.kit import invoke

ENGINE = known.load("three-webgl")
PASS = "\npass Probe : Forward {\n    target color : rgba32f = vec4(color, alpha)\n}\n"
"""The pass that all materials are drawn by: the library's, with numbers that nobody rounds."""
_WORDS = {"float": "f", "int": "i", "uint": "I", "bool": "I"}


def copied(source: Path, folder: Path) -> Path:
    """The file with the pass."""
    copy = folder / source.name
    copy.write_text(source.read_text(encoding="utf-8") + PASS, encoding="utf-8")
    return copy


def materials(copy: Path, source: Path, rig: str | None = None) -> Sequence[CompiledMaterial]:
    """The materials of a file under the pass. Raises ``CompileError``."""
    return shaders_for(ENGINE, copy, pass_="Probe", rig=rig, search_path=(source.parent,)).materials


def module_in(folder: Path, material: CompiledMaterial) -> str:
    """Write the module of a material; the name of its file. Raises ``CompileError``."""
    report = Report()
    files = shader_files(ENGINE, material, report)
    if report.failed:
        raise CompileError(report.diagnostics)
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return next(name for name in files if name.endswith(".js"))


def golden_in(folder: Path, copy: Path, source: Path, *options: str) -> Path:
    """The golden folder of a file under the pass.

    It has the values of all parameters, as the shaders of it compute what follows from them.
    """
    made = folder / "golden"
    result = invoke(
        "conform", copy, "--pass", "Probe", "--golden", made, "--routes", "webgl2",
        "--no-hoist", "-I", source.parent, *options,
    )  # fmt: skip
    assert result.exit_code == 0, result.output
    return made


def cases_of(golden: Path, material: str) -> Iterator[Mapping[str, Any]]:
    """The cases of a material."""
    for case in json.loads((golden / "golden.json").read_text(encoding="utf-8"))["cases"]:
        if case["subject"].split(".")[0] == material:
            yield case


def assert_drawn(
    page: Page, at: str, material: CompiledMaterial, golden: Path, case: Mapping[str, Any]
) -> None:
    """Draw a case by the page, which has the folder ``at`` an address, and compare it."""
    given = given_for(material, golden, case)
    drawn = page.evaluate("given => draw(given)", given | {
        "module": f"./{at}/{material.name}.three-webgl.js", "material": f"{material.name}Material",
        "at": f"{at}/golden/",
    })  # fmt: skip
    picture = np.array(drawn, dtype=np.float32).reshape(case["height"], case["width"], 4)
    assert_in_bounds(
        picture, golden, output="color", flip=True, case=f"{case['subject']}/{case['case']}"
    )


def given_for(material: CompiledMaterial, golden: Path, case: Mapping[str, Any]) -> dict[str, Any]:
    """What the page has to draw: the inputs of a case, for the uniforms of a material."""
    found = case["inputs"]
    reflection = json.loads((golden / found["reflection"]).read_text(encoding="utf-8"))
    (draw,) = found["draws"]
    values = dict(_values(reflection, draw["blocks"], golden))
    roles = {row["role"]: row["name"] for row in reflection["parameters"] if row["role"]}
    inputs = {row["name"]: row for row in reflection["vertex_inputs"]}
    (backend,) = material.reflection.backends.values()
    identity = np.eye(4).ravel().tolist()
    return {
        "width": case["width"],
        "height": case["height"],
        "indices": draw["indices"],
        "instances": draw["instance_count"],
        "primitive": reflection["draw"]["primitive"],
        "attributes": [
            {
                "name": backend.vertex_inputs[name].identifier, "file": file,
                "lanes": _lanes(inputs[name]["format"]), "whole": "int" in inputs[name]["format"],
                "step": inputs[name]["step"],
            }
            for name, file in draw["vertices"].items() if name in backend.vertex_inputs
        ],
        "objectToWorld": values.get(roles.get("object_to_world", ""), identity),
        "viewProjection": values.get(roles.get("world_to_clip", ""), identity),
        "eye": values.get(roles.get("eye", ""), [0, 0, 5]),
        "values": {
            each.name: _as_in_text(each.field, values[each.field.name])
            for each in uniforms(material)
            if each.field.name in values and _is_set(each, of_renderer(material.reflection))
        },
        "textures": {
            backend.textures[name].identifier: _texture(row, reflection, name)
            for name, row in found["textures"].items() if name in backend.textures
        },
    }  # fmt: skip


def _as_in_text(field: Field, value: Any) -> Any:
    """A value whose members are called as in the text."""
    if isinstance(value, list):
        return [_as_in_text(field, each) for each in value]
    if not isinstance(value, dict):
        return value
    assert isinstance(field.type, Structure)
    members = {each.name: each for each in field.type.fields}
    return {members[k].word: _as_in_text(members[k], each) for k, each in value.items()}


def uniforms(material: CompiledMaterial) -> Iterator[Uniform]:
    """The uniforms of a material."""
    reflection = material.reflection
    binding = gathered([Compiled(reflection=reflection, texts={})], [], (), "")
    (backend,) = reflection.backends.values()
    yield from uniforms_of(binding.materials[0], backend)


def _is_set(each: Uniform, renderers: Mapping[str, str]) -> bool:
    """True if the page has to set it: bones, too, as no mesh there has a skeleton."""
    return not each.field.computed and renderers.get(each.field.name, "pose") == "pose"


def _lanes(format_: str) -> int:
    return int(format_.partition("x")[2] or 1)


def _texture(row: Mapping[str, Any], reflection: Mapping[str, Any], name: str) -> dict[str, Any]:
    dimension = next(r["dimension"] for r in reflection["textures"] if r["name"] == name)
    format_ = row["format"]
    lanes = len(format_) - len(format_.lstrip("rgba"))
    words = {"8unorm": "unorm8", "16float": "float16", "8uint": "uint8", "8sint": "sint8",
             "32uint": "uint32", "32sint": "sint32"}  # fmt: skip
    kind = next((words[each] for each in words if each in format_), "float32")
    return {
        "width": row["width"], "height": row["height"], "levels": row["levels"],
        "isDepth": format_.startswith("depth"),
        "srgb": format_.endswith("-srgb"), "lanes": lanes, "kind": kind, "dimension": dimension,
        "parts": 6 if dimension == "cube" else row["depth"],
    }  # fmt: skip


def _values(
    reflection: Mapping[str, Any], blocks: Mapping[str, str], golden: Path
) -> Iterator[tuple[str, Any]]:
    """The values of parameters in the bytes of blocks."""
    data = {name: (golden / file).read_bytes() for name, file in blocks.items()}
    for row in reflection["parameters"]:
        if row["block"] in data:
            yield row["name"], _read(row, data[row["block"]], row["offset"])


def _read(row: Mapping[str, Any], data: bytes, start: int) -> Any:
    """A value: a number, the numbers of a vector, a mapping of members, or a list of these."""
    layout = row["layout"]
    if "count" not in layout:
        return _one(row, data, start)
    return [_one(row, data, start + each * layout["stride"]) for each in range(layout["count"])]


def _one(row: Mapping[str, Any], data: bytes, start: int) -> Any:
    if row["members"]:
        return {each["name"]: _read(each, data, start + each["offset"]) for each in row["members"]}
    layout = row["layout"]
    columns, stride = layout.get("columns", 1), layout.get("column_stride", 0)
    lanes: list[Any] = []
    for column in range(columns):
        form = f"<{layout['lanes']}{_WORDS[layout['kind']]}"
        lanes += struct.unpack_from(form, data, start + column * stride)
    return lanes[0] if len(lanes) == 1 else lanes
