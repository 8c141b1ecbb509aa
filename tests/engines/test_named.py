"""Slots that somebody has named for values of an engine: ``--slots base_color=stain``."""

from __future__ import annotations

import pytest

from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.engines import known

from .files import files_of

OF_FUNCTIONS = [name for name in known.names() if known.load(name).is_offered]
"""The engines that are given values of a surface."""

WORN = """\
import std.models.{Principled}
material Worn : Principled { roughness = uv.x   sheen_tint = uv.y }
"""
TWICE = {
    "three": ("colorNode = vec3(slots.roughness);", "roughnessNode = slots.roughness;"),
    "godot": ("ALBEDO = vec3(worn_roughness(UV));", "ROUGHNESS = worn_roughness(UV);"),
    "filament": ("baseColor.rgb = vec3(worn_roughness(getUV0()));", "roughness = worn_roughness("),
    "bevy": ("vec3(worn_roughness(pixel.uv))", "perceptual_roughness = worn_rough"),
}


@pytest.mark.parametrize("engine", OF_FUNCTIONS)
def test_a_slot_that_is_named_stays_what_it_is(engine: str) -> None:
    named = {"base_color": "roughness", "metallic": "sheen_tint"}
    text = " ".join("\n".join(files_of(engine, WORN, "Worn", named).values()).split())
    for expected in TWICE[engine]:
        assert expected in text
    assert "worn_sheen_tint" in text and "worn_base_color" not in text.partition("fragment")[2]


BUMPED = """\
material Bumped {
    tint = rgb(uv, 1)
    bump = (vec3(uv, 1) as vector<tangent>)
    plain = vec3(uv, 1)
    up = (vec3(0, 1, 0) as normal<world>)
    wide = vec4(uv, 0, 1)
}
"""
WRONG = {
    ("normal", "bump"): "it is a vector<tangent>, and `normal` is a normal of the world",
    ("roughness", "plain"): "it is a vec3, and `roughness` is a number",
    ("is_hidden", "tint"): "it is a rgb, and `is_hidden` is a condition",
    ("object_position", "up"): (
        "it is a normal<world>, and `object_position` is a place of the object"
    ),
    ("normal", "wide"): "it is a vec4, and `normal` is a normal of the world",
}  # fmt: skip


@pytest.mark.parametrize("engine", OF_FUNCTIONS)
@pytest.mark.parametrize(("value", "slot"), WRONG)
def test_a_slot_has_to_be_of_the_kind_of_the_value(engine: str, value: str, slot: str) -> None:
    with pytest.raises(CompileError) as told:
        files_of(engine, BUMPED, "Bumped", {value: slot})
    expected = f"cannot draw `{slot}`: {WRONG[value, slot]}"
    assert expected in "\n".join(map(str, told.value.diagnostics))


@pytest.mark.parametrize("engine", OF_FUNCTIONS)
def test_normals_with_and_without_a_space_are_taken(engine: str) -> None:
    for slot in ("up", "plain"):
        text = "\n".join(files_of(engine, BUMPED, "Bumped", {"normal": slot}).values())
        assert f"bumped_{slot}(" in text
