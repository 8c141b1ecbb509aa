"""Kernels over images as full-screen passes: what the texts have, and which profiles have them."""

from __future__ import annotations

import numpy as np

import burnish
from burnish.compiler.ir.full_screen import full_screen
from burnish.compiler.ir.stages import CLIP_POSITION, RASTERISED, TARGET
from burnish.compiler.ir.verify import verify_results
from burnish.compiler.reference.picture import RasterRules
from burnish.targets.runner.kernels import drawable, full_screen_state
from burnish.targets.runner.reference import expected

from .kit import shader

PLACES = "kernel K { result i : image2d<rgba32f>[ivec2(7, 5)] = vec4(vec2(texel), 0, 1) }"
DRAWN = "kernel K { result i : image2d<rg16f>[ivec2(7, 5)] = vec2(texel) }"
"""A kernel that all profiles draw by a full-screen pass: none is sure to write its format."""


def test_a_triangle_covers_all_texels_and_each_knows_its_place() -> None:
    (kernel,) = burnish.compile(PLACES, ("wgsl",)).materials
    state = full_screen_state(kernel.instance())
    picture = expected(drawable(kernel.shader), state, RasterRules(state.width, state.height))
    assert picture.covered.all() and not picture.undecided.any()
    y, x = np.mgrid[0:5, 0:7]
    assert np.array_equal(picture.targets[0][..., 0], x)
    assert np.array_equal(picture.targets[0][..., 1], y)


def test_images_become_targets_in_their_order() -> None:
    text = PLACES.replace("}", " result j : image2d<r8>[ivec2(7, 5)] = 0.5 }")
    drawn = full_screen(shader(text))
    verify_results(drawn.results, RASTERISED)
    assert drawn.chain == RASTERISED
    assert [result.kind for result in drawn.results] == [CLIP_POSITION, TARGET, TARGET]
    assert [r.state.format for r in drawn.results if r.state] == ["rgba32f", "r8"]


def test_what_only_the_size_reads_is_in_no_text() -> None:
    text = "kernel K { param n : int = 4  result i : image2d<r8>[ivec2(n, n)] = float(texel.x) }"
    (kernel,) = burnish.compile(text, "all").materials
    assert not kernel.reflection.blocks
    assert kernel.instance().image_size() == (4, 4)


def test_the_images_of_a_kernel_are_never_turned_over() -> None:
    for profile in ("glsl:gl330", "wgsl"):
        usual, flipped = (
            burnish.compile(DRAWN, profile, flip_y=flip)["K"] for flip in (False, True)
        )
        assert [file.text for file in usual.files] == [file.text for file in flipped.files]
        assert usual.reflection.backends == flipped.reflection.backends


def test_every_statement_has_its_place_in_the_source() -> None:
    (kernel,) = burnish.compile(PLACES, ("glsl:es300",)).materials
    for file in kernel.files:
        lines = file.text.splitlines()
        statements = [n for n, line in enumerate(lines, 1) if line.startswith("    ")]
        assert statements and set(statements) & file.spans.keys()
