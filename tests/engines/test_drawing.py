"""How engines draw a material: blended, with holes or opaque, and from which sides."""

from __future__ import annotations

import pytest

from .drawing import leaf
from .files import files_of

TURNED = "base_color = if front_facing then #ff0000 else #00ff00"

BLENDED = {
    "three": "this.opacityNode = ", "bevy": "AlphaMode::Blend", "godot": "ALPHA = ",
    "filament": "blending : fade",
}  # fmt: skip
HOLED = {
    "three": "this.maskNode = ", "bevy": "AlphaMode::Mask(0.5)", "godot": "discard;",
    "filament": "blending : masked",
}  # fmt: skip
BOTH = {
    "three": "this.side = DoubleSide;", "bevy": "cull_mode: None", "godot": "cull_disabled",
    "filament": "doubleSided : true",
}  # fmt: skip
ENGINES = sorted(BLENDED)
FACES = {
    "three": "this.side = FrontSide;", "bevy": "cull_mode: Some(Face::Back)",
    "godot": "cull_back", "filament": "culling : back",
}  # fmt: skip
WORDS = {
    "three": "this.side", "bevy": "cull_mode", "godot": "cull_", "filament": "culling",
}  # fmt: skip
"""What says which faces an engine leaves out."""


@pytest.mark.parametrize("engine", ENGINES)
def test_a_pass_with_holes_does_not_blend(engine: str) -> None:
    cut, mixed = leaf(engine, by="Cut"), leaf(engine, by="Mixed")
    assert HOLED[engine] in cut and BLENDED[engine] not in cut
    assert HOLED[engine] not in mixed and BLENDED[engine] in mixed


ADDED = {
    "three": "this.blending = AdditiveBlending;", "bevy": "AlphaMode::Add", "godot": "blend_add",
    "filament": "blending : add",
}  # fmt: skip
MULTIPLIED = {
    "three": "this.blending = MultiplyBlending;", "bevy": "AlphaMode::Multiply",
    "godot": "blend_mul", "filament": "blending : multiply",
}  # fmt: skip


@pytest.mark.parametrize("engine", ENGINES)
def test_light_is_added_and_multiplied_as_the_pass_does(engine: str) -> None:
    for alpha in ("1", "picture(uv).a"):
        assert ADDED[engine] in leaf(engine, by="Added", alpha=alpha)
        assert MULTIPLIED[engine] in leaf(engine, by="Multiplied", alpha=alpha)


@pytest.mark.parametrize("engine", ENGINES)
def test_without_a_pass_of_its_own_its_alpha_blends(engine: str) -> None:
    untied = leaf(engine)
    assert HOLED[engine] not in untied and BLENDED[engine] in untied
    assert BLENDED[engine] not in leaf(engine, alpha="1")


@pytest.mark.parametrize("engine", ENGINES)
def test_its_pass_says_which_faces_are_drawn(engine: str) -> None:
    assert BOTH[engine] in leaf(engine, by="Cut")
    assert FACES[engine] in leaf(engine, by="Cut", raster="raster { cull = back }")
    turned = "raster { cull = front, front = clockwise }"
    assert FACES[engine] in leaf(engine, by="Cut", raster=turned)


@pytest.mark.parametrize("engine", ENGINES)
def test_what_tells_its_sides_apart_is_drawn_from_both(engine: str) -> None:
    assert BOTH[engine] in leaf(engine, more=TURNED)
    assert WORDS[engine] not in leaf(engine)


def test_filament_turns_no_normal_that_functions_read() -> None:
    turning = "normal = if front_facing then inherited.normal else -inherited.normal"
    text = leaf("filament", more=turning)
    assert "culling : none" in text and "doubleSided" not in text


MASKED = """\
import std.models.{GltfSurface}
import std.gltf.{MetallicRoughness, Masked}
material Leaf : MetallicRoughness by Masked {}
"""


@pytest.mark.parametrize("engine", ENGINES)
def test_passes_of_the_library_have_holes_as_well(engine: str) -> None:
    text = "\n".join(files_of(engine, MASKED, "Leaf").values())
    assert HOLED[engine] in text and BLENDED[engine] not in text


COVERED = """\
raster { samples = 4, alpha_to_coverage = true }
"""


def test_an_alpha_that_covers_samples_does_so_in_engines_that_can() -> None:
    three, bevy = (leaf(engine, by="Cut", raster=COVERED) for engine in ("three", "bevy"))
    assert "this.alphaToCoverage = true;" in three and "this.transparent" not in three
    assert "AlphaMode::AlphaToCoverage" in bevy
