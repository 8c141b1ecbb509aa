"""Invariant positions: the shaders of a frame that draw to the same depths place vertices alike."""

from __future__ import annotations

from .kit import of_text

FRAME = """
material Clay  { color = #b5651d }
material Slate { color = #445566 }

pass Early : Forward {
    target nothing : r8 = 0
    %(early)s
}
pass Late  : Forward { target color : rgba8 = vec4(color, 1)  depth { %(late)s } }
pass Apart : Forward { target color : rgba8 = vec4(color, 1) }

frame F {
    models scene
    models some : Slate
    early = Early(scene)
    late  = Late(some, [early.depth])
    apart = Apart(scene)
    output picture = late.color
    output other   = apart.color
}
"""


def invariant(late: str, early: str = "") -> set[str]:
    """The shaders with invariant positions, without the name of the frame."""
    frame = of_text(FRAME % {"late": late, "early": early})
    return {
        shader.name.removeprefix("F.")
        for shader in frame.shaders
        if shader.reflection.invariant_position
    }


def test_whatever_draws_to_depths_that_are_compared_for_being_equal() -> None:
    for compare in ("equal", "less_equal", "not_equal", "greater_equal"):
        assert invariant(f"compare = {compare}") == {"Early.Clay", "Early.Slate", "Late.Slate"}


def test_a_model_that_is_drawn_twice_to_the_same_depths() -> None:
    """With a comparison for being nearer, a model must not be in front of itself by rounding."""
    assert invariant("compare = less") == {"Early.Slate", "Late.Slate"}


def test_a_pass_may_go_without() -> None:
    assert invariant("compare = equal", "raster { invariant = false }") == {"Late.Slate"}


def test_a_pass_may_ask_for_it_and_others_that_draw_there_follow() -> None:
    assert invariant("compare = less", "raster { invariant = true }") == {
        "Early.Clay", "Early.Slate", "Late.Slate",
    }  # fmt: skip


def test_depths_that_nobody_draws_over_ask_for_nothing() -> None:
    text = (FRAME % {"late": "compare = less", "early": ""}).replace(", [early.depth]", "")
    frame = of_text(text)
    assert not any(shader.reflection.invariant_position for shader in frame.shaders)
