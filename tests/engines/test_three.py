"""Materials in three.js, drawn by both of its renderers, and judged by bounds of their slots."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page

from burnish.testing import assert_in_bounds

from .kit import functions, given_for, golden_of, module_of, page_of, site_in

EXAMPLES = Path(__file__).parents[2] / "examples"
BACKENDS = ("webgpu", "webgl")
JUDGED = {
    "plastic": ("Plastic", {"tint": 3}),
    "normal_map": ("TangentSpaceBumps", {"normal": 3, "bump": 3}),
    "water": ("Water", {"normal": 3, "glancing": 1}),
}
"""Examples with the slots that are compared, and their numbers of lanes."""


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
    (compiled,) = functions(EXAMPLES / f"{name}.burnish", material=material, slots=list(slots))
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
        given |= {"module": f"./{module}", "maker": f"make{material}"}
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
