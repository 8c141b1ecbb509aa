"""Draws slots in three.js, and says between which bounds their numbers may lie.

The bounds are those of a golden folder: of a pass whose targets have the slots' values. A page has
the same mesh, camera, values and textures, and calls the functions of the generated module.
"""

from __future__ import annotations

import json
import shutil
import struct
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from weakref import WeakKeyDictionary

from playwright.sync_api import Page

import burnish
from burnish.api.compiled_functions import CompiledFunctions
from burnish.api.compiling_engines import functions_for
from burnish.compiler.diagnostics.diagnostic import CompileError, Report
from burnish.compiler.documents.functions import ArgumentRow, Functions
from burnish.engines import known
from burnish.engines.three.inputs import attribute_name, of_renderer
from burnish.targets.toolchain.tools import tool_named

from ..cli.kit import invoke
from ..suite import browsers

HERE = Path(__file__).parent
ENGINE = known.load("three")
ADDRESS = "https://burnish.invalid/"
LANES = {"float": 1, "vec2": 2, "vec3": 3, "vec4": 4, "uvec4": 4, "uint": 1}


def module_of(compiled: CompiledFunctions, folder: Path) -> str:
    """Write the module of a material; the name of its file."""
    report = Report()
    emissions = {f"{each.target}:{each.profile}": each.emission for each in compiled.files}
    files = ENGINE.write(compiled.document, emissions, report)
    if report.failed:
        raise CompileError(report.diagnostics)
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    return next(name for name in files if name.endswith(".js"))


def site_in(folder: Path, page: str = "draw.html") -> Path:
    """A folder with three.js and a page."""
    found = tool_named("three").find()
    assert found is not None
    (folder / "three").symlink_to(found[0].parent / "build")
    shutil.copy(HERE / page, folder / "index.html")
    return folder


@contextmanager
def page_of(site: Path) -> Iterator[Page]:
    """The page in a browser."""
    with browsers.browser() as browser:
        page = browser.new_page()
        told = _COMPLAINTS[page] = []
        page.on("console", lambda message: told.append(message.text))
        browsers.serve(page, site)
        page.goto(ADDRESS)
        page.wait_for_function("window.ready === true")
        yield page


_COMPLAINTS: WeakKeyDictionary[Page, list[str]] = WeakKeyDictionary()


def complaints(page: Page) -> list[str]:
    """What the page has written to its console."""
    return _COMPLAINTS[page]


def attributes_of(compiled: CompiledFunctions) -> list[dict[str, Any]]:
    """The attributes of a geometry that functions read."""
    return [
        {
            "name": attribute_name(row.given),
            "lanes": LANES[row.representation],
            "whole": row.representation.startswith("u"),
        }
        for row in compiled.document.arguments
        if row.source == "attribute"
    ]


def golden_of(source: Path, material: str, slots: Mapping[str, int], folder: Path) -> Path:
    """A golden folder of the numbers of some slots, by their number of lanes."""
    fills = {1: "vec4(vec3({0}), 1)", 2: "vec4({0}, 0, 1)", 3: "vec4({0}, 1)", 4: "{0}"}
    targets = "".join(
        f"    target {name}_ : rgba32f = {fills[lanes].format(f'material.{name}')}\n"
        for name, lanes in slots.items()
    )
    copied = folder / source.name
    text = source.read_text(encoding="utf-8")
    copied.write_text(f"{text}\npass Probe {{\n{targets}}}\n", encoding="utf-8")
    made = folder / "golden"
    result = invoke(
        "conform", copied, "--pass", "Probe", "--golden", made, "--routes", "webgpu,webgl2",
        "-I", source.parent,
    )  # fmt: skip
    assert result.exit_code == 0, result.output
    assert material
    return made


def given_for(case: Mapping[str, Any], golden: Path, document: Functions) -> dict[str, Any]:
    """What the page has to draw: the inputs of a case."""
    found = case["inputs"]
    reflection = json.loads((golden / found["reflection"]).read_text(encoding="utf-8"))
    (draw,) = found["draws"]
    values = dict(_values(reflection, draw["blocks"], golden))
    roles = {row["role"]: row["name"] for row in reflection["parameters"] if row["role"]}
    formats = {row["name"]: row["format"] for row in reflection["vertex_inputs"]}
    samplers = {row["texture"]: row["state"] for row in reflection["samplers"]}
    intents = {row["name"]: row["intent"] for row in reflection["textures"]}
    identity = [float(row == column) for row in range(4) for column in range(4)]
    wanted = [row for row in document.arguments if _is_set(row)]
    read = {row.name for row in document.textures}
    return {
        "width": case["width"],
        "height": case["height"],
        "indices": f"golden/{draw['indices']}",
        "attributes": [
            {
                "name": attribute_name(name), "file": f"golden/{file}",
                "lanes": int(formats[name][-1]) if formats[name][-1].isdigit() and "x" in
                formats[name] else 1,
                "whole": "int" in formats[name],
            }
            for name, file in draw["vertices"].items()
        ],
        "objectToWorld": values.get(roles.get("object_to_world", ""), identity),
        "viewProjection": values[roles["world_to_clip"]],
        "eye": values.get(roles.get("eye", ""), [0, 0, 5]),
        "values": {row.name: _given(values, row) for row in wanted},
        "textures": {
            name: {
                "width": row["width"], "height": row["height"],
                "levels": [f"golden/{level}" for level in row["levels"]],
                "srgb": row["format"].endswith("-srgb"),
                "wrap": samplers[name]["wrap"], "filter": samplers[name]["filter"],
                "intent": intents[name],
            }
            for name, row in found["textures"].items() if name in read
        },
    }  # fmt: skip


def _is_set(row: ArgumentRow) -> bool:
    return row.source == "parameter" and not of_renderer(row)


def _given(values: Mapping[str, Any], row: ArgumentRow) -> Any:
    value = values[row.given]
    return bool(value) if row.representation == "bool" else value


def _values(
    reflection: Mapping[str, Any], blocks: Mapping[str, str], golden: Path
) -> Iterator[tuple[str, Any]]:
    """The values of plain parameters in the bytes of blocks."""
    words = {"float": "f", "int": "i", "uint": "I", "bool": "I"}
    data = {name: (golden / file).read_bytes() for name, file in blocks.items()}
    for row in reflection["parameters"]:
        layout = row["layout"]
        if row["block"] not in data or "count" in layout or layout.get("kind") not in words:
            continue
        columns, stride = layout.get("columns", 1), layout.get("column_stride", 0)
        lanes: list[Any] = []
        for column in range(columns):
            form = f"<{layout['lanes']}{words[layout['kind']]}"
            start = row["offset"] + column * stride
            lanes += struct.unpack_from(form, data[row["block"]], start)
        yield row["name"], lanes[0] if len(lanes) == 1 else lanes


def functions(source: Path, **options: Any) -> Sequence[CompiledFunctions]:
    """The functions of a file for three.js: as the command line has them, or some slots of it."""
    if not options:
        return functions_for(ENGINE, source).materials
    return burnish.functions(source, ENGINE.targets, **options).materials
