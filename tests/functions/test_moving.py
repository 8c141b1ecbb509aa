"""What the engine has of a surface is not taken for what a material makes of it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import pytest

import burnish
from burnish.compiler.documents.functions import ArgumentRow, Functions

BENT = """
    rest = inherited.object_shape
    object_shape = MeshPoint(
        rest.position + vec3(0.1), -rest.normal, rest.tangent, rest.handedness, rest.motion
    )
"""
CASES: Mapping[str, tuple[str, Mapping[str, str]]] = {
    "nothing": ("", {"position": "surface", "normal": "surface", "tangent": "surface"}),
    "its shape": (BENT, {"position": "surface", "normal": "varying", "tangent": "varying"}),
    "its normals": (
        "object_normal = -vertex_normal",
        {"position": "surface", "normal": "varying", "tangent": "surface"},
    ),
    "its points": (
        "object_position = vertex_position + vec3(0.1)",
        {"position": "surface", "normal": "surface", "tangent": "surface"},
    ),
    "its tangents": (
        "object_tangent = vertex_tangent.yzx",
        {"position": "surface", "normal": "surface", "tangent": "varying"},
    ),
    "its place in the world, at the pixels": (
        "position = inherited.position + vec3(0.1)",
        {"position": "varying", "normal": "surface", "tangent": "surface"},
    ),
}  # fmt: skip
"""What a material moves, and whether the engine has the values then."""


def made(text: str, **options: object) -> Functions:
    source = (
        "import std.motion.{MeshPoint}\nimport std.tangents.{Tangents}\n"
        f"material M : Surface + Tangents {{\n{text}\n"
        "    shown = vec3(position) + normal + tangent\n}\n"
    )
    (found,) = burnish.functions(source, "wgsl", **options)  # type: ignore[arg-type]
    return found.document


@pytest.mark.parametrize("moved", CASES)
def test_engines_have_what_a_material_does_not_move(moved: str) -> None:
    text, expected = CASES[moved]
    document = made(text, slots=["shown"])
    arguments = {row.name: row for row in document.arguments}
    (shown,) = (row for row in document.functions if row.name == "shown")
    sources = {
        word: _source(word, map(arguments.__getitem__, shown.arguments)) for word in expected
    }
    assert sources == expected and len(shown.arguments) == 3


def _source(word: str, arguments: Iterable[ArgumentRow]) -> str:
    """Where a function gets a value from: an argument whose name has its word."""
    return next(row.source for row in arguments if word in row.name.split("_"))


def test_functions_say_where_a_bent_mesh_is() -> None:
    """Also where only structures are given, which no function returns."""
    stages = {row.name: row.stage for row in made(BENT).functions}
    assert (stages["position"], stages["normal"]) == ("vertex", "fragment")
    assert "position" not in {row.name for row in made("").functions}


def test_a_place_that_vertices_get_is_the_engines() -> None:
    text = "rest = inherited.position\n    position = @vertex (rest + vec3(0.1))"
    document = made(text, slots=["shown", "rest"])
    arguments = {row.name: row.source for row in document.arguments}
    rows = {row.name: row for row in document.functions}
    assert [arguments[name] for name in rows["rest"].arguments] == ["varying"]
    assert arguments[rows["shown"].arguments[0]] == "surface"


CUT = """
pass Cut : Forward {
    param threshold : float in 0..1 = 0.5
    discard when alpha < threshold
}
material Leaf by Cut { map leaf : texture2d   tint = leaf(uv).rgb   alpha = leaf(uv).a }
"""


@pytest.mark.parametrize("slots", [[], ["is_hidden"]])
def test_a_tied_pass_hides_pixels(slots: list[str]) -> None:
    (leaf,) = burnish.functions(CUT, "glsl:es300", slots=slots)
    (hidden,) = (row for row in leaf.document.functions if row.name == "is_hidden")
    assert (hidden.arguments, hidden.textures) == (("uv", "threshold"), ("leaf",))
    assert "return alpha < threshold;" in leaf.files[0].text


def test_a_pass_hides_besides_what_the_material_hides() -> None:
    text = CUT.replace("alpha = leaf(uv).a", "alpha = leaf(uv).a   is_hidden = uv.x < 0.1")
    (leaf,) = burnish.functions(text, "glsl:es300", slots=["is_hidden"])
    assert "return uv.x < 0.1 || leaf_.w < threshold;" in leaf.files[0].text


def test_the_usual_pass_hides_nothing_of_its_own() -> None:
    text = CUT.replace("material Leaf by Cut", "material Leaf")
    (leaf,) = burnish.functions(text, "wgsl")
    assert [row.name for row in leaf.document.functions] == ["alpha", "tint"]
