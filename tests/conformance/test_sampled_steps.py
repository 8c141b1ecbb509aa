"""Frames with four samples for each pixel, against values that are worked out by hand.

All that is drawn is left of an upright edge, which cuts the pixels of one column. The samples of a
pixel are 1, 3, 5 and 7 eighths from its left side, so that an edge between these covers quarters of
it.
"""

from __future__ import annotations

import numpy as np
import pytest

from burnish.targets.runner.routes import ROUTES

from .kit import REFERENCE, Floats, Studio
from .test_frames import SIZE, outputs

CUT = 3
"""The column that edges cut."""

PASSES = f"""
import std.frames.{{FullScreen}}

abstract pass LeftOf : FullScreen {{
    param edge  : float = 100                      /// In pixels from the left
    param shade : float = 1
    beside : float = 2 * edge / {SIZE[0]} - 1
    across : float = if vertex_index == 1u then -100 else beside
    above  : float = if vertex_index == 0u then 100 else if vertex_index == 1u then 0 else -100
}}
pass Smooth : LeftOf {{
    raster {{ samples = 4 }}
    target value : rgba8 = vec4(shade)
}}
pass Added : Smooth blend add {{}}
pass Single : LeftOf blend add {{
    target value : rgba8 = vec4(shade)
}}
pass Bright : LeftOf {{
    raster {{ samples = 4 }}
    target value : rgba16f = vec4(8 * shade)
}}
pass Sloped : LeftOf {{
    raster {{ samples = 4 }}
    target value : rgba16f = vec4({SIZE[0]} * uv.x)
}}
pass Tilted {{
    raster {{ samples = 4 }}
    param slope : vec2                                  /// Of depths, from side to side
    param near  : float = 0
    column : float = if vertex_index == 1u then 3 else -1
    row    : float = if vertex_index == 2u then 3 else -1
    depth  : float = near + dot(slope, vec2(0.5 + 0.5 * column, 0.5 - 0.5 * row))
    clip_position = vec4(column, row, depth, 1)
    target value : rgba16f = vec4(near)
}}
pass Box {{
    raster {{ samples = 4 }}
    param corner : vec2
    column : float = if vertex_index mod 2u == 0u then -1 else corner.x
    row    : float = if vertex_index < 2u or vertex_index == 3u then 1 else corner.y
    clip_position = vec4(column, row, 0.5, 1)
    target value : rgba16f = vec4(1)
}}
pass Hiding : LeftOf {{
    raster {{ samples = 4 }}
    depth {{ compare = less, write = true }}
    param away : float = 0.5
    clip_position = @vertex (vec4(across, above, away, 1) as point<clip>)
    target value : rgba8 = vec4(shade)
}}
pass Faded : FullScreen {{
    map source : texture2d with {{ filter = nearest, mip = none }}
    map before : texture2d with {{ filter = nearest, mip = none }}
    target value : rgba16f =
        source.load(ivec2(frag_coord.xy)) + 0.5 * before.load(ivec2(frag_coord.xy))
}}
pass Shown : FullScreen {{
    map source : texture2d with {{ filter = nearest, mip = none }}
    target value : rgba16f = source.load(ivec2(frag_coord.xy))
}}
pass Second : FullScreen {{
    map source : texture2d with {{ filter = nearest }}
    target value : rgba16f = source.level(uv, 1)
}}
"""

EVERYWHERE = pytest.mark.parametrize("where", [REFERENCE, *ROUTES])


def shown(studio: Studio, where: str, steps: str, name: str = "picture", count: int = 1) -> Floats:
    """The lane red of an output of a frame, in which all rows are alike: one number for each
    column."""
    frame = f"{PASSES}\nframe F {{ {steps} }}"
    (picture,) = outputs(frame, where, studio, count)[-1][name][..., 0]
    assert (picture == picture[0]).all()
    row: Floats = picture[0]
    return row


def columns(left: float, cut: float, right: float = 0.0) -> Floats:
    """The columns before the one that is cut, this one, and those behind it."""
    values = np.full(SIZE[0], right)
    values[:CUT], values[CUT] = left, cut
    return values


STEP = 1 / 255


PLACES = np.array(((0.375, 0.125), (0.875, 0.375), (0.125, 0.625), (0.625, 0.875)))
"""The places of the samples in a pixel, from the left and from the top."""
CORNERS = [(2.25, 1.5), (2.5, 2.25), (5.75, 0.5), (3.0, 2.0), (7.5, 3.75)]
"""Corners of triangles between columns and between rows of samples, in pixels."""


@EVERYWHERE
def test_a_pixel_has_the_mean_of_the_samples_that_are_covered(studio: Studio, where: str) -> None:
    """All that is to the left of a corner and above it, which tells each place apart."""
    width, height = SIZE
    steps = "\n".join(
        f"""box{number} = Box(vertices(6)) with {{
            corner = vec2({2 * right / width - 1}, {1 - 2 * bottom / height})
        }}
        output shown{number} = box{number}.value"""
        for number, (right, bottom) in enumerate(CORNERS)
    )
    (found,) = outputs(f"{PASSES}\nframe F {{ {steps} }}", where, studio)
    pixels = np.stack(np.meshgrid(np.arange(width), np.arange(height)), axis=-1)
    for number, corner in enumerate(CORNERS):
        covered = (pixels[:, :, None] + PLACES < corner).all(axis=-1).mean(axis=-1)
        assert np.array_equal(found[f"shown{number}"][0, ..., 0], covered), corner


@EVERYWHERE
@pytest.mark.parametrize("across", [True, False])
def test_depths_are_those_of_the_places(studio: Studio, where: str, across: bool) -> None:
    """Something at one depth is drawn over something that goes away to the right, or downwards: it
    is seen where that is behind it."""
    axis = 0 if across else 1
    slope = "vec2(0.25, 0)" if across else "vec2(0, 0.25)"
    cuts = (1.25, 1.5, 1.75)
    steps = f"tilted = Tilted(screen) with {{ slope = {slope} }}\n" + "\n".join(
        f"""tilted{n} = Tilted(screen) with {{ slope = {slope} }}
        level{n} = Tilted(screen, tilted{n}) with {{
            slope = vec2(0), near = {0.25 * cut / SIZE[axis]}
        }}
        output shown{n} = level{n}.value"""
        for n, cut in enumerate(cuts)
    )
    (found,) = outputs(f"{PASSES}\nframe F {{ {steps} }}", where, studio)
    pixels = np.stack(np.meshgrid(np.arange(SIZE[0]), np.arange(SIZE[1])), axis=-1)
    for n, cut in enumerate(cuts):
        seen = ((pixels[:, :, None] + PLACES)[..., axis] > cut).mean(axis=-1)
        picture = found[f"shown{n}"][0, ..., 0] / (0.25 * cut / SIZE[axis])
        assert np.abs(picture - seen).max() < 0.01


@EVERYWHERE
@pytest.mark.parametrize("quarters", [1, 3])
def test_values_are_those_of_the_centre(studio: Studio, where: str, quarters: int) -> None:
    """The centre counts even if it lies outside of the triangle."""
    sloped = f"sloped = Sloped(screen) with {{ edge = {CUT + quarters / 4} }}"
    frame = f"{PASSES}\nframe F {{ {sloped} output picture = sloped.value }}"
    found = outputs(frame, where, studio)[-1]["picture"][0, ..., 0]
    centres = np.where(np.arange(SIZE[0]) < CUT, np.arange(SIZE[0]) + 0.5, 0)
    centres[CUT] = quarters / 4 * (CUT + 0.5)
    assert np.abs(found - centres).max() <= 0.01


@EVERYWHERE
def test_others_read_the_mean(studio: Studio, where: str) -> None:
    found = shown(studio, where, f"""
        smooth = Bright(screen) with {{ edge = {CUT + 0.25} }}
        read   = Shown(screen) with {{ source = smooth.value }}
        output picture = read.value
    """)  # fmt: skip
    assert np.array_equal(found, columns(8, 2))


OVER = f"""
    first  = Smooth(screen) with {{ edge = {CUT + 0.5} }}
    second = Added(screen, first) with {{ edge = {CUT + 0.75}, shade = 0.5 }}
    third  = Single(screen, second) with {{ edge = {CUT + 0.75}, shade = 0.25 }}
    output early   = first.value
    output picture = second.value
    output late    = third.value
"""


@EVERYWHERE
def test_what_draws_over_samples_finds_each_of_them(studio: Studio, where: str) -> None:
    """Two samples of the column have 1, to which nothing can be added in this format, and one gets
    a half. The means of the first step would get a half, too."""
    found = shown(studio, where, OVER)
    assert np.abs(found - columns(1, 2.5 / 4)).max() <= STEP
    assert np.abs(shown(studio, where, OVER, "early") - columns(1, 0.5)).max() <= STEP


@EVERYWHERE
def test_a_step_with_one_sample_draws_over_means(studio: Studio, where: str) -> None:
    """The later step's edge is right of the pixel's centre, so that it covers the whole column."""
    found = shown(studio, where, OVER, "late")
    assert np.abs(found - columns(1, 2.5 / 4 + 0.25)).max() <= 2 * STEP


@EVERYWHERE
def test_the_depths_of_samples_hide_what_another_step_draws(studio: Studio, where: str) -> None:
    found = shown(studio, where, f"""
        near = Hiding(screen) with {{ edge = {CUT + 0.25}, away = 0.25, shade = 1 }}
        far  = Hiding(screen, near) with {{ edge = {CUT + 0.75}, away = 0.5, shade = 0.5 }}
        output picture = far.value
    """)  # fmt: skip
    assert np.abs(found - columns(1, (1 + 2 * 0.5) / 4)).max() <= STEP


@EVERYWHERE
def test_the_next_frame_finds_means(studio: Studio, where: str) -> None:
    """Each frame adds half of what the last one has shown."""
    found = shown(studio, where, f"""
        smooth = Smooth(screen) with {{ edge = {CUT + 0.25}, shade = 0.5 }}
        sum    = Faded(screen) with {{ source = smooth.value, before = previous(sum.value) }}
        output picture = sum.value
    """, count=2)  # fmt: skip
    assert np.abs(found - columns(0.75, 0.1875)).max() <= STEP


@EVERYWHERE
def test_faces_and_levels_have_means_of_their_own(studio: Studio, where: str) -> None:
    """Each is drawn with samples that no other has. The second level is half as wide as the first,
    and its edge half as far from the left."""
    (found,) = outputs(f"""{PASSES}
        frame F {{
            cube  = each face in cube : Bright(screen, {SIZE[0]}) with {{
                edge = {CUT} + 0.25 * float(face mod 3 + 1), shade = float(face)
            }}
            chain = each level in mips(2) : Bright(screen, {SIZE[0]}) with {{ edge = {CUT}.5 }}
            read  = Second(screen, {SIZE[0]} / 2) with {{ source = chain.value }}
            output faces  = cube.value
            output second = read.value
        }}
    """, where, studio)  # fmt: skip
    for face, picture in enumerate(found["faces"][..., 0]):
        expected = columns(8 * face, 2 * face * (face % 3 + 1))
        assert (picture == expected).all(), face
    expected = np.array([8, 8 * 3 / 4, 0, 0])
    assert np.array_equal(found["second"][0, ..., 0], np.tile(expected, (SIZE[0] // 2, 1)))
