"""Godot's own parser takes the shaders of all examples, and what it draws is inside the bounds."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from ..golden import assert_golden
from .files import EXAMPLES, files_of, summary, texts_of
from .godot import MISSING, drawn, is_there, parsed
from .probes import probes_of

GOLDEN = Path(__file__).parent / "golden"
HAS_GODOT = pytest.mark.skipif(not is_there(), reason=MISSING)
pytestmark = pytest.mark.xdist_group("godot")

DRAWN = {
    "plastic": "Plastic", "metal_rough": "Gold", "water": "Water", "texture_array": "Terrain",
    "gltf_material": "Painted", "cube_map": "Shade", "foliage": "Leaf",
}  # fmt: skip
"""Examples with textures, layers and cubes; with colours and tangents; that move; with holes."""


@pytest.mark.parametrize(("name", "material"), [
    ("plastic", "Plastic"), ("gltf_material", "Painted"), ("water", "Water"),
])  # fmt: skip
def test_text(name: str, material: str) -> None:
    files = files_of("godot", EXAMPLES / f"{name}.burnish", material)
    for file, text in files.items():
        assert_golden(text, GOLDEN / file)


@HAS_GODOT
def test_godot_takes_the_shaders_of_all_examples(tmp_path: Path) -> None:
    texts, reasons = texts_of("godot")
    assert_golden(summary(texts, reasons), GOLDEN / "godot.txt")
    said = parsed(
        {**texts, "wrong": "shader_type spatial;\nvoid fragment() { ALBEDO = bass; }"}, tmp_path
    )
    assert said.pop("wrong") == "Unknown identifier in expression: 'bass'."
    assert not {name: text for name, text in said.items() if text}


@HAS_GODOT
def test_values_are_inside_their_bounds(tmp_path: Path) -> None:
    probes = [
        probe
        for name, material in DRAWN.items()
        for probe in probes_of(EXAMPLES / f"{name}.burnish", material)
    ]
    gold = next(probe for probe in probes if probe.label.endswith("Gold.ROUGHNESS"))
    shader = gold.picture.shader.replace("ROUGHNESS = roughness;", "ROUGHNESS = 1.01 * roughness;")
    assert shader != gold.picture.shader
    changed = replace(gold.picture, name="changed", shader=shader)
    pictures = drawn([*(probe.picture for probe in probes), changed], tmp_path)
    compared = {probe.label: probe.judged(pictures[probe.label]) for probe in probes}
    assert not {label: found.worst for label, found in compared.items() if not found.agrees}
    assert min(found.covered for found in compared.values()) > 100
    assert sum(found.proven for found in compared.values()) > 0.8 * sum(
        found.covered for found in compared.values()
    )
    assert not gold.judged(pictures["changed"]).agrees
