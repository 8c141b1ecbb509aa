"""Materials in three.js, drawn by both of its renderers, and judged by the bounds of their slots."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page

from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.testing import assert_in_bounds

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

EXAMPLES = Path(__file__).parents[2] / "examples"
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
CANNOT = {"B0905", "B0906", "B0206", "B0701", "B0909"}
"""Why an example is not drawn: it makes vertices, needs lights, has no material, or needs what
functions of WebGL 2 or of three.js cannot have."""
FILES = sorted(EXAMPLES.glob("*.burnish"))


@pytest.mark.xdist_group("three")
def test_all_examples_are_lit_by_both_renderers(page: Page, site: Path) -> None:
    drawn, wrong = 0, []
    for file in FILES:
        try:
            modules = [(each, module_of(each, site)) for each in functions(file)]
        except CompileError as error:
            codes = {found.rule.code for found in error.diagnostics if found.severity == "error"}
            assert codes <= CANNOT, f"{file.name}: {error}"
            continue
        for compiled, module in modules:
            given = {
                "module": f"./{module}", "material": f"{compiled.name}Material", "size": SIZE,
                "attributes": attributes_of(compiled),
            }  # fmt: skip
            for backend in BACKENDS:
                before = len(complaints(page))
                pixels = page.evaluate(
                    "([given, backend]) => lit(given, backend)", [given, backend]
                )
                told = [text for text in complaints(page)[before:] if "deprecated" not in text]
                colors = np.unique(np.array(pixels).reshape(-1, 4)[:, :3], axis=0)
                if told or len(colors) < 2:
                    wrong.append(f"{file.name} {compiled.name} {backend}: {told[:1]}")
                drawn += 1
    assert not wrong, "\n".join(wrong)
    assert drawn > 100
