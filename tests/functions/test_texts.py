"""The texts and documents of functions, to be read in review."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import burnish
from burnish.compiler.documents.functions import Functions
from burnish.compiler.documents.reading import read
from burnish.compiler.documents.writing import to_text

from ..golden import assert_golden

FOLDER = Path(__file__).parent
EXAMPLES = FOLDER.parents[1] / "examples"
GOLDEN = FOLDER / "golden"
TARGETS = ("wgsl", "glsl:es300", "hlsl", "msl")


@pytest.mark.parametrize("name", ["plastic", "normal_map", "water"])
def test_text(name: str) -> None:
    for material in burnish.functions(EXAMPLES / f"{name}.burnish", TARGETS):
        for file in material.files:
            assert_golden(file.text, GOLDEN / file.name)
        assert_golden(to_text(material.document), GOLDEN / f"{material.name}.functions.json")


def test_slots_together() -> None:
    (plastic,) = burnish.functions(
        EXAMPLES / "plastic.burnish", "wgsl,hlsl", slots=["tint", "normal", "object_position",
        "object_normal"], together=True, prefix="shop_floor",
    )  # fmt: skip
    for file in plastic.files:
        assert_golden(file.text, GOLDEN / f"together.{file.name}")


def test_a_document_can_be_read_again() -> None:
    (water,) = burnish.functions(EXAMPLES / "water.burnish", "wgsl")
    assert read(Functions, json.loads(to_text(water.document))) == water.document


def test_texts_of_two_materials_share_no_name() -> None:
    found = burnish.functions(EXAMPLES / "normal_map.burnish", "wgsl")
    names = [
        {part.name for part in (*file.emission.helpers, *(f.part for f in file.emission.functions))}
        for material in found
        for file in material.files
    ]
    assert len(names) == 2 and not names[0] & names[1]


TWO_SLOTS = """
material M {
    param uv_scale : float in 0..4 = 1
    near = gradient_noise(uv * uv_scale)
    far  = gradient_noise(uv * uv_scale * 2) + near
    is_dark : bool = far < 0.5
}
import std.noise.{gradient_noise}
"""


def test_what_several_functions_call_is_printed_once() -> None:
    (made,) = burnish.functions(TWO_SLOTS, "glsl:es300")
    (file,) = made.files
    names = [part.name for part in file.emission.helpers]
    assert len(names) == len(set(names)) and all(name.startswith("m_") for name in names)
    by_name = {each.name: each for each in file.emission.functions}
    assert set(by_name) == {"near", "far", "is_dark"}
    assert by_name["near"].part.needs
    assert set(by_name["near"].part.needs) <= set(by_name["is_dark"].part.needs)
    assert by_name["is_dark"].returns == "bool"


def test_varyings_are_functions_for_vertices() -> None:
    text = """
    material M {
        heat : float = @vertex length(vec3(vertex_position))
        glow = heat * heat
    }
    """
    (made,) = burnish.functions(text, "wgsl", slots=["glow"])
    rows = {row.name: row for row in made.document.functions}
    assert {name: row.stage for name, row in rows.items()} == {"glow": "fragment", "heat": "vertex"}
    (argument,) = (row for row in made.document.arguments if row.source == "varying")
    assert (argument.name, argument.given) == ("heat", "heat")
    assert rows["glow"].arguments == ("heat",)
    assert rows["heat"].arguments == ("vertex_position",)


def test_values_of_parameters_are_left_out() -> None:
    (made,) = burnish.functions(EXAMPLES / "plastic.burnish", "wgsl", values={"base": (1, 1, 1)})
    (row,) = made.document.functions
    assert row.arguments == ("uv",)
