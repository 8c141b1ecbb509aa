"""Structures of one name and with different members have names of their own in a text."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish

RIG = """
light Lit : Light {
    param steps : int in 0..5
    param towards : vec3
    to_light = normalize(towards * float(steps) + vec3(0, 1, 0))
}
material M { color = lambert(#fff) }
term lambert(k: rgb) per light = k * light.diffuse * saturate(dot(normal, light.to_light))
rig R {
    some : Lit[<= 3] { steps = 3 }
    all_ : Lit[2]
    more : Lit[2]
}
"""
TARGETS = ("wgsl", "hlsl", "glsl:vulkan", "glsl:gl330")


def declared(text: str) -> list[str]:
    """The names of a text's structures, in order."""
    words = text.replace("{", " ").split()
    return [words[i + 1] for i, word in enumerate(words) if word == "struct"]


@pytest.mark.parametrize("target", TARGETS)
def test_lights_of_which_the_rig_sets_a_parameter(target: str, tmp_path: Path) -> None:
    file = tmp_path / "lit.burnish"
    file.write_text(RIG, encoding="utf-8")
    text = burnish.compile(file, targets=(target,))["M"].text(target, "fragment")
    names = [name for name in declared(text) if name.startswith("Lit")]
    assert names == ["Lit", "Lit_2"]


@pytest.mark.parametrize("target", TARGETS)
def test_structures_of_two_files(target: str, tmp_path: Path) -> None:
    (tmp_path / "a.burnish").write_text(
        "struct Layer { tint : rgb }\n"
        "mixin One { param one : Layer  color = inherited.color * one.tint }",
        encoding="utf-8",
    )
    (tmp_path / "b.burnish").write_text(
        "struct Layer { n : int }\n"
        "mixin Two { param two : Layer[3]  color = inherited.color * float(two[1].n) }",
        encoding="utf-8",
    )
    file = tmp_path / "both.burnish"
    file.write_text(
        'import "a.burnish"\nimport "b.burnish"\nstruct Layer_2 { x : vec3 }\n'
        "material M : Surface + One + Two { param own : Layer_2  color = inherited.color * own.x }",
        encoding="utf-8",
    )
    text = burnish.compile(file, targets=(target,), hoist=False)["M"].text(target, "fragment")
    names = [name for name in declared(text) if name.startswith("Layer")]
    assert len(names) == len(set(names)) == 3
