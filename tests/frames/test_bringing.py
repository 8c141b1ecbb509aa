"""Lights that bring textures by steps of their own, such as a shadow map: which steps a frame gets,
and what is said where one is missing."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

import burnish
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.documents.plan import ResultSource

from .kit import inputs_of, of_text

HEAD = """
import std.lights.{Directional}
import std.shadows.{DepthOnly, ShadowedSpot}
import std.terms.{lambert}

material Clay { color = lambert(#a08060) }
"""

FRAME = """
frame Still {
    models scene
    drawn = Forward(scene)
    output picture = drawn.color
}
"""


MISSING = """error[B0806]: `Forward` needs `sun.shadow`
  --> <text>:14:13
   |
 8 |     map shadow : depth2d
   |         ------ declared here, without a default
...
14 |     drawn = Forward(scene)
   |             ^^^^^^^^^^^^^^
   = help: A texture of a pass or a kernel that has no default"""


def steps_of(text: str) -> Mapping[str, list[str]]:
    """The results that each step of a frame reads, by the step's name."""
    plan = of_text(HEAD + text).plan
    return {
        step.name: [
            row.source.result for row in inputs_of(step) if isinstance(row.source, ResultSource)
        ]
        for step in plan.steps
    }


def said_of(text: str) -> str:
    """The errors of a text, as a person reads them."""
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(HEAD + text, ("wgsl",))
    return render_all(caught.value.diagnostics)


def test_each_light_has_steps_of_its_own() -> None:
    found = steps_of("rig Night { a : ShadowedSpot, b : ShadowedSpot }" + FRAME)
    assert found == {
        "a.seen": [], "b.seen": [], "drawn": ["a.seen.depth", "b.seen.depth"],
    }  # fmt: skip


def test_steps_are_drawn_once_however_many_read_them() -> None:
    text = """rig Night { lamp : ShadowedSpot }
    frame Still {
        models scene
        one = Forward(scene)
        two = Forward(scene, 32)
        output a = one.color
        output b = two.color
    }"""
    assert list(steps_of(text)) == ["lamp.seen", "one", "two"]


def test_a_frame_sets_what_a_light_would_bring() -> None:
    text = """rig Night { lamp : ShadowedSpot }
    frame Still {
        models scene
        other = DepthOnly(scene, 64)
        drawn = Forward(scene) with { lamp.shadow = other.depth }
        output picture = drawn.color
    }"""
    assert steps_of(text) == {"other": [], "drawn": ["other.depth"]}


def test_what_no_shader_reads_is_not_drawn() -> None:
    text = """rig Night { lamp : ShadowedSpot }
    material Flat { color = #808080 }
    frame Still {
        models scene : Flat
        drawn = Forward(scene)
        output picture = drawn.color
    }"""
    assert list(steps_of(text)) == ["drawn"]


def test_without_a_frame_the_host_binds_what_a_light_would_bring() -> None:
    (made,) = burnish.compile(HEAD + "rig Night { lamp : ShadowedSpot }", ("wgsl",)).materials
    assert [row.name for row in made.reflection.textures] == ["lamp.shadow"]


def test_a_light_without_its_texture() -> None:
    text = """light Shadowed : Directional {
    map shadow : depth2d
    falloff = shadow(vec2(0), 0.5)
}
rig Day { sun : Shadowed }"""
    said = said_of(text + FRAME)
    assert said.startswith(MISSING)
    assert said.count("error") == 1


def test_a_light_that_is_drawn_in_its_own_light() -> None:
    text = """light Shadowed : Directional {
    seen = Forward(scene, 64)
    map shadow : depth2d = seen.depth
    falloff = shadow(vec2(0), 0.5)
}
rig Day { sun : Shadowed }"""
    said = said_of(text + FRAME)
    assert "error[B0814]: `sun.shadow` needs itself: sun.shadow → sun.shadow" in said
    assert said.count("error") == 1


def test_a_light_that_asks_for_models_which_the_frame_has_not() -> None:
    text = """light Shadowed : Directional {
    seen = DepthOnly(others, 64)
    map shadow : depth2d = seen.depth
    falloff = shadow(vec2(0), 0.5)
}
rig Day { sun : Shadowed }"""
    said = said_of(text + FRAME)
    assert "error[B0804]: a pass cannot draw this" in said
    assert "there is `scene`, `screen`, `vertices(n)`" in said
    assert said.count("error") == 1
