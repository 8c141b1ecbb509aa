"""The render states of passes: how settings are read and inherited, and errors about them."""

from __future__ import annotations

import pytest

from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.ir.render_state import (
    DepthState,
    RenderState,
    StencilSide,
    StencilState,
)
from burnish.stdlib.builtins.state_words import word_here

from .kit import shader

MATERIAL = "mark = 3\nmaterial M { color = #b5651d }\n"


def state(members: str, more: str = "") -> RenderState:
    """The render state of a pass with these members."""
    text = f"{MATERIAL}{more}pass P : {'Base' if more else 'Forward'} {{ {members} }}"
    return shader(text, pass_="P").render_state


def test_a_pass_that_says_nothing_has_the_defaults() -> None:
    assert state("") == RenderState()
    assert not state("").stencil.is_used
    assert not state("").depth.is_biased


def test_settings_are_words_and_constants() -> None:
    assert state("raster { cull = back, front = clockwise }") == RenderState(
        cull="back", front="clockwise"
    )
    found = state("depth { compare = always write = false; bias = -2, slope_bias = mark / 2.0 }")
    assert found.depth == DepthState("always", write=False, bias=-2, slope_bias=1.5)
    assert not found.depth.is_used
    assert found.depth.is_biased
    assert state("raster { samples = mark + 1 }") == RenderState(samples=4)
    found = state("stencil { compare = equal, reference = mark, read_mask = 0x0f }")
    equal = StencilSide("equal")
    assert found.stencil == StencilState(equal, equal, 3, read_mask=15)
    assert found.stencil.tests and not found.stencil.writes


@pytest.mark.parametrize(
    ("settings", "is_invariant"),
    [
        ("", False),
        ("depth { compare = equal }", True),
        ("depth { compare = less_equal }", True),
        ("depth { compare = not_equal }", True),
        ("depth { compare = greater_equal }", True),
        ("depth { compare = greater }", False),
        ("depth { compare = always }", False),
        ("raster { invariant = true }", True),
        ("depth { compare = equal } raster { invariant = false }", False),
    ],
)
def test_positions_are_invariant_where_equal_depths_decide_or_the_pass_says_so(
    settings: str, is_invariant: bool
) -> None:
    assert state(settings).is_invariant == is_invariant


def test_a_setting_of_one_side_counts_more_than_one_of_both_wherever_it_stands() -> None:
    found = state("stencil { back.pass = invert, pass = replace, depth_fail = zero }").stencil
    assert found.front == StencilSide(depth_fail_op="zero", pass_op="replace")
    assert found.back == StencilSide(depth_fail_op="zero", pass_op="invert")


def test_each_setting_is_inherited_by_itself() -> None:
    base = (
        "pass Base : Forward { stencil { front.pass = invert, compare = less, reference = 1 } "
        "depth { bias = 4 } raster { cull = back } }\n"
    )
    found = state("stencil { pass = replace } depth { write = false }", base)
    assert found.stencil.front == found.stencil.back == StencilSide("less", pass_op="replace")
    assert found.stencil.reference == 1
    assert found.depth == DepthState(write=False, bias=4)
    assert found.cull == "back"


@pytest.mark.parametrize(
    ("settings", "writes"),
    [
        ("compare = never", False),
        ("fail = invert", True),
        ("back.depth_fail = invert", True),
        ("pass = replace, write_mask = 0", False),
    ],
)
def test_when_values_are_written(settings: str, writes: bool) -> None:
    assert state(f"stencil {{ {settings} }}").stencil.writes == writes


WRONG = """\
material M { color = #b5651d }
pass Masked : Forward {
    raster { cull = 3, front = clokwise, cull = back }
    depth { bias = 0.5, slope_bias = x }
    stencil { reference = 256, front.reference = 3, front.pas = replace, pass = red + 1 }
}
"""

REPORTS = """\
error[B0201]: unknown value for `cull` `3`
 --> <test>:3:21
  |
3 |     raster { cull = 3, front = clokwise, cull = back }
  |                     ^
  = help: one of `none`, `back`, `front`

error[B0201]: unknown value for `front` `clokwise`
 --> <test>:3:32
  |
3 |     raster { cull = 3, front = clokwise, cull = back }
  |                                ^^^^^^^^
  = help: did you mean `clockwise`?

error[B0202]: `cull` is declared twice
 --> <test>:3:42
  |
3 |     raster { cull = 3, front = clokwise, cull = back }
  |                                          ^^^^
  |              ---- first defined here
  = help: Equations have no order, so a second one for the same name would contradict the first.

error[B0301]: expected int, found float
 --> <test>:4:20
  |
4 |     depth { bias = 0.5, slope_bias = x }
  |                    ^^^ this is `float`
  = help: it has to be a whole number

error[B0201]: unknown name `x`
 --> <test>:4:38
  |
4 |     depth { bias = 0.5, slope_bias = x }
  |                                      ^
  = help: nothing declares it: `x = …` does, or `param x : type` if the host sets it

error[B0536]: `reference` is 256, and only 0 to 255 are possible
 --> <test>:5:27
  |
5 |     stencil { reference = 256, front.reference = 3, front.pas = replace, pass = red + 1 }
  |                           ^^^
  = help: Stencil values and their masks have eight bits. A bias is counted in the smallest steps \
of depths, of which floats have 2^24 between two powers of two. Every API draws with 1 or 4 \
samples for each pixel, and not every one with another number.

error[B0201]: unknown stencil setting `front.reference`
 --> <test>:5:32
  |
5 |     stencil { reference = 256, front.reference = 3, front.pas = replace, pass = red + 1 }
  |                                ^^^^^^^^^^^^^^^
  = help: did you mean `reference`?

error[B0201]: unknown stencil setting `front.pas`
 --> <test>:5:53
  |
5 |     stencil { reference = 256, front.reference = 3, front.pas = replace, pass = red + 1 }
  |                                                     ^^^^^^^^^
  = help: did you mean `front.pass`?

error[B0201]: unknown value for `pass` `red + 1`
 --> <test>:5:81
  |
5 |     stencil { reference = 256, front.reference = 3, front.pas = replace, pass = red + 1 }
  |                                                                                 ^^^^^^^
  = help: one of `keep`, `zero`, `replace`, `invert`, `increment_clamp`, `decrement_clamp`, \
`increment_wrap`, `decrement_wrap`"""


def test_what_is_wrong_with_settings() -> None:
    with pytest.raises(CompileError) as caught:
        shader(WRONG, pass_="Masked")
    assert render_all(caught.value.diagnostics) == REPORTS


@pytest.mark.parametrize(
    ("elsewhere", "here"),
    [
        ("GL_LEQUAL", "less_equal"),
        ("LESS_EQUAL", "less_equal"),
        ("less-equal", "less_equal"),
        ("VK_COMPARE_OP_GREATER_OR_EQUAL", "greater_equal"),
        ("D3D12_COMPARISON_FUNC_NOT_EQUAL", "not_equal"),
        ("D3D11_BLEND_INV_SRC_ALPHA", "one_minus_src_alpha"),
        ("GL_ONE_MINUS_DST_COLOR", "one_minus_dst"),
        ("VK_BLEND_FACTOR_SRC_ALPHA_SATURATE", "src_alpha_saturated"),
        ("VK_BLEND_OP_REVERSE_SUBTRACT", "reverse_subtract"),
        # OpenGL clamps where it says no more, and Direct3D wraps.
        ("GL_INCR", "increment_clamp"),
        ("D3D12_STENCIL_OP_INCR", "increment_wrap"),
        ("D3D12_STENCIL_OP_INCR_SAT", "increment_clamp"),
        ("VK_STENCIL_OP_DECREMENT_AND_WRAP", "decrement_wrap"),
        ("VK_CULL_MODE_FRONT_BIT", "front"),
        ("GL_MIRRORED_REPEAT", "mirror"),
        ("depthWriteEnabled", "write"),
        ("sample_count", "samples"),
        ("anything", "anything"),
    ],
)
def test_words_of_other_apis_are_known(elsewhere: str, here: str) -> None:
    assert word_here(elsewhere) == here
