"""Drivers draw frame jobs: every texel of these small ones is known beforehand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from burnish.compiler.documents.plan import TextureState
from burnish.targets.runner.drivers.frame_job import Attachment, Barrier, FrameDraw, FrameStep
from burnish.targets.runner.drivers.render_state import RenderTarget, TargetFormat

from .blends import named
from .frame_kit import (
    ALL,
    BLUE,
    CLEAR,
    GREEN,
    LEFT,
    RED,
    SIZE,
    TOP,
    TWICE,
    Area,
    Driver,
    Floats,
    back,
    draw_of,
    drawn_first,
    job,
    painted,
    reading,
    slot,
    step,
    texture,
)

MIRROR = """layout(binding = 0) uniform sampler2D before;
layout(location = 0) out vec4 target;
void main() { target = texelFetch(before, ivec2(3, 3) - ivec2(gl_FragCoord.xy), 0); }
"""


def quarters(
    top_left: Sequence[float],
    top_right: Sequence[float],
    low_left: Sequence[float],
    low_right: Sequence[float],
) -> Floats:
    """A picture of four squares of one colour each."""
    found = np.empty((SIZE, SIZE, 4), np.float32)
    half = SIZE // 2
    found[:half, :half], found[:half, half:] = top_left, top_right
    found[half:, :half], found[half:, half:] = low_left, low_right
    return found


def test_a_step_reads_what_an_earlier_one_has_drawn(driver: Driver) -> None:
    mirror = driver.pipeline(MIRROR, textures=(slot(),))
    first, second = driver.draw(
        job(
            [texture(), texture()],
            [driver.painting(), mirror],
            step(0, painted(RED, LEFT), painted(GREEN, TOP), barriers=drawn_first(0)),
            step(1, reading(1, 0), barriers=(Barrier(0, "target", "sampled"), *drawn_first(1))),
            back(0, before="sampled"),
            back(1),
        )
    )
    drawn = quarters(GREEN, GREEN, RED, CLEAR)
    np.testing.assert_array_equal(first[0], drawn)
    np.testing.assert_array_equal(second[0], drawn[::-1, ::-1])


@pytest.mark.parametrize("loads", [True, False])
def test_a_step_keeps_or_clears_what_is_there(driver: Driver, *, loads: bool) -> None:
    (found,) = driver.draw(
        job(
            [texture()],
            [driver.painting()],
            step(0, painted(RED, LEFT), barriers=drawn_first(0), clear=BLUE),
            step(
                0,
                painted(GREEN, TOP),
                barriers=[Barrier(0, "target", "target")],
                loads=loads,
                clear=CLEAR,
            ),
            back(0),
        )
    )
    low = (RED, BLUE) if loads else (CLEAR, CLEAR)
    np.testing.assert_array_equal(found[0], quarters(GREEN, GREEN, *low))


def test_draws_of_one_step_share_its_depths(driver: Driver) -> None:
    """The nearer one is drawn first, with another pipeline than the farther one, that adds."""
    adding = driver.painting(RenderTarget("rgba32float", named("add")))
    steps = FrameStep(
        (*drawn_first(0), Barrier(1, "undefined", "depth")),
        (Attachment(0, clear=BLUE),),
        Attachment(1, clear=(1.0, 0.0, 0.0, 0.0)),
        (painted(RED, replace(LEFT, depth=0.25)), painted(GREEN, ALL, pipeline=1)),
    )
    textures = [texture(), texture(format="depth32float")]
    picture, depths = driver.draw(
        job(textures, [driver.painting(), adding], steps, back(0), back(1, before="depth"))
    )
    cyan = (0.0, 1.0, 1.0, 2.0)
    np.testing.assert_array_equal(picture[0], quarters(RED, cyan, RED, cyan))
    np.testing.assert_array_equal(depths[0, 0, :, 0], [0.25, 0.25, 0.5, 0.5])


def test_a_step_without_targets_draws_depths_that_another_reads(driver: Driver) -> None:
    text = """layout(binding = 0) uniform sampler2D before;
layout(location = 0) out vec4 target;
void main() { target = vec4(texelFetch(before, ivec2(gl_FragCoord.xy), 0).r); }
"""
    only_depths = driver.pipeline("void main() {}\n", targets=())
    reader = driver.pipeline(text, textures=(slot(sample="depth"),))
    near = FrameDraw(0, (), (), draw_of(replace(TOP, depth=0.25)))
    (found,) = driver.draw(
        job(
            [texture(format="depth32float"), texture()],
            [only_depths, reader],
            FrameStep(
                (Barrier(0, "undefined", "depth"),),
                depth=Attachment(0, clear=(0.75, 0.0, 0.0, 0.0)),
                draws=(near,),
            ),
            step(1, reading(1, 0), barriers=(Barrier(0, "depth", "sampled"), *drawn_first(1))),
            back(1),
        )
    )
    expected = quarters(*[[0.25] * 4] * 2, *[[0.75] * 4] * 2)
    np.testing.assert_array_equal(found[0], expected)


LAYERS = """layout(binding = 0) uniform sampler2DArray before;
layout(location = 0) out vec4 target;
void main() { target = texelFetch(before, ivec3(0, 0, int(gl_FragCoord.x) % 3), 0); }
"""
LEVELS = """layout(binding = 0) uniform sampler2D before;
layout(location = 0) out vec4 target;
void main() { target = textureLod(before, vec2(0.5), floor(gl_FragCoord.x)); }
"""
FACES = """layout(binding = 0) uniform samplerCube before;
layout(location = 0) out vec4 target;
void main() {
    int axis = int(gl_FragCoord.x);
    vec3 way = vec3(axis == 0, axis == 1, axis == 2);
    target = textureLod(before, gl_FragCoord.y < 2.0 ? way : -way, 0.0);
}
"""


def shade(number: int) -> tuple[float, float, float, float]:
    """A colour for each layer, level or face."""
    return (number / 8, 1 - number / 8, 0.5, 1.0)


def test_steps_draw_to_layers(driver: Driver) -> None:
    reader = driver.pipeline(LAYERS, textures=(slot(dimension="2d_array"),))
    every, found = driver.draw(
        job(
            [texture(layers=3, dimension="2d_array"), texture()],
            [driver.painting(), reader],
            FrameStep(drawn_first(0, 1)),
            *(step(0, painted(shade(layer)), layer=layer) for layer in range(3)),
            step(1, reading(1, 0), barriers=[Barrier(0, "target", "sampled")]),
            back(0, before="sampled"),
            back(1),
        )
    )
    assert [tuple(texels[-1, -1]) for texels in every] == [shade(layer) for layer in range(3)]
    assert [tuple(texel) for texel in found[0, 0]] == [shade(layer) for layer in (0, 1, 2, 0)]


def test_steps_draw_to_mip_levels(driver: Driver) -> None:
    """Each level has half the sides of the one before."""
    reader = driver.pipeline(LEVELS, textures=(slot(),))
    levels = 3
    (found,) = driver.draw(
        job(
            [texture(levels=levels), texture()],
            [driver.painting(), reader],
            FrameStep(drawn_first(0, 1)),
            *(step(0, painted(shade(level)), level=level) for level in range(levels)),
            step(1, reading(1, 0), barriers=[Barrier(0, "target", "sampled")]),
            back(1),
        )
    )
    assert [tuple(texel) for texel in found[0, 0, :levels]] == [*map(shade, range(levels))]


def test_steps_draw_to_the_faces_of_a_cube(driver: Driver) -> None:
    reader = driver.pipeline(FACES, textures=(slot(dimension="cube"),))
    every, found = driver.draw(
        job(
            [texture(layers=6, dimension="cube"), texture()],
            [driver.painting(), reader],
            FrameStep(drawn_first(0, 1)),
            *(step(0, painted(shade(face)), layer=face) for face in range(6)),
            step(1, reading(1, 0), barriers=[Barrier(0, "target", "sampled")]),
            back(0, before="sampled"),
            back(1),
        )
    )
    assert [tuple(texels[0, 0]) for texels in every] == [shade(face) for face in range(6)]
    assert [tuple(texel) for texel in found[0, 0, :3]] == [shade(face) for face in (0, 2, 4)]
    assert [tuple(texel) for texel in found[0, 3, :3]] == [shade(face) for face in (1, 3, 5)]


def test_two_textures_take_turns(driver: Driver) -> None:
    """Each step doubles what the one before has left."""
    rounds = 4
    steps = [step(0, painted((0.125, 0.25, 0.5, 1.0)), barriers=drawn_first(0))]
    for number in range(rounds):
        source, target = number % 2, 1 - number % 2
        use: TextureState = "undefined" if number == 0 else "sampled"
        barriers = (Barrier(source, "target", "sampled"), Barrier(target, use, "target"))
        steps.append(step(target, reading(1, source), barriers=barriers))
    twice = driver.pipeline(TWICE, textures=(slot(),))
    (found,) = driver.draw(job([texture(), texture()], [driver.painting(), twice], *steps, back(0)))
    np.testing.assert_array_equal(found[0, 0, 0], [2.0, 4.0, 8.0, 16.0])


def test_a_copy_is_of_its_own(driver: Driver) -> None:
    """Later draws to the texture that was copied do not change the copy."""
    first, second = driver.draw(
        job(
            [texture(), texture()],
            [driver.painting()],
            step(0, painted(RED, LEFT), barriers=drawn_first(0)),
            FrameStep(
                (Barrier(0, "target", "copied_from"), Barrier(1, "undefined", "copied_to")),
                copied=(0, 1),
            ),
            step(0, painted(GREEN), barriers=[Barrier(0, "copied_from", "target")], loads=True),
            back(0),
            back(1, before="copied_to"),
        )
    )
    np.testing.assert_array_equal(first[0], quarters(GREEN, GREEN, GREEN, GREEN))
    np.testing.assert_array_equal(second[0], quarters(RED, CLEAR, RED, CLEAR))


def test_what_is_read_before_it_is_drawn_is_black_or_far(driver: Driver) -> None:
    textures = [texture(is_black=True), texture(format="depth32float", is_black=True)]
    black, far = driver.draw(
        job(textures, [], back(0, before="sampled"), back(1, before="sampled"))
    )
    np.testing.assert_array_equal(black[0], quarters(CLEAR, CLEAR, CLEAR, CLEAR))
    np.testing.assert_array_equal(far[0, :, :, 0], np.ones((SIZE, SIZE)))


def test_results_are_rounded_to_their_formats(driver: Driver) -> None:
    """A later step reads what the format holds, not what was computed."""
    paint = (0.4, 1.7, -0.5, 1.0)
    formats: tuple[TargetFormat, ...] = ("rgba8unorm", "rgba16float")
    draws = [
        step(
            number,
            painted(paint, pipeline=number),
            barriers=drawn_first(number),
        )
        for number in range(len(formats))
    ]
    pipelines = [driver.painting(RenderTarget(format_)) for format_ in formats]
    textures = [texture(format=format_) for format_ in formats]
    small, half = driver.draw(job(textures, pipelines, *draws, back(0, 1)))
    np.testing.assert_allclose(small[0, 0, 0], [102 / 255, 1.0, 0.0, 1.0], rtol=1e-7)
    np.testing.assert_array_equal(half[0], np.float16(half[0]))
    np.testing.assert_allclose(half[0, 0, 0], paint, atol=2**-10)


def test_several_targets_of_one_step(driver: Driver) -> None:
    text = """layout(location = 0) out vec4 one;
layout(location = 1) out vec4 other;
void main() { one = vec4(gl_FragCoord.xy, 0.0, 1.0); other = vec4(0.25); }
"""
    both = driver.pipeline(text, targets=(RenderTarget("rgba32float"),) * 2)
    drawn = FrameStep(drawn_first(0, 1), (Attachment(0), Attachment(1)), None, (reading(0),))
    one, other = driver.draw(job([texture(), texture()], [both], drawn, back(0, 1)))
    assert tuple(one[0, 0, 1]) == (1.5, 0.5, 0.0, 1.0)  # the first row is the top one
    np.testing.assert_array_equal(other[0], np.full((SIZE, SIZE, 4), 0.25))


def test_areas_are_where_they_should_be(driver: Driver) -> None:
    """In clip space y points up, and the first row of a texture is the top one."""
    drawn = step(0, painted(RED, Area(0.0, 0.5, 0.5, 1.0)), barriers=drawn_first(0))
    (found,) = driver.draw(job([texture()], [driver.painting()], drawn, back(0)))
    assert np.argwhere(found[0, :, :, 0]).tolist() == [[0, 2]]
