"""Whole frames on every route that executes them, against values that are known from elsewhere.

Both sides of a comparison execute the same plan, so a test must not believe it.
"""

from __future__ import annotations

import numpy as np
import pytest

import burnish
from burnish.api.entry_points import CompiledFrame
from burnish.compiler.documents.plan import DrawStep
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.summary import details
from burnish.targets.runner.frames.by_reference import ReferenceFrames
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row
from burnish.targets.runner.routes import ROUTES
from burnish.targets.web_host.drawing import draw_frames

from ..targets.standings import routes
from .kit import PROFILES, REFERENCE, Floats, Studio

SIZE = (8, 4)


HEAD = """
import std.frames.{FullScreen}
"""

NUMBERS = f"""{HEAD}
pass Numbered : FullScreen {{
    target value : rgba32f = vec4(floor(frag_coord.x), floor(frag_coord.y), uv.x, uv.y)
}}
pass Shifted : FullScreen {{
    map source : texture2d with {{ filter = nearest, mip = none, wrap = clamp }}
    target value : rgba32f = source.load(ivec2(frag_coord.xy) + ivec2(1, 2)) + vec4(100, 0, 0, 0)
}}
pass Added : FullScreen blend add {{
    map source : texture2d with {{ filter = nearest, mip = none }}
    param times : float = 1
    target value : rgba16f = times * source.load(ivec2(frag_coord.xy))
}}
"""

RAMP = np.stack(np.meshgrid(np.arange(SIZE[0]), np.arange(SIZE[1])), axis=-1).astype(float)
"""(height, width, 2): the column and the row of each pixel."""


def outputs(text: str, where: str, studio: Studio, count: int = 1) -> list[dict[str, Floats]]:
    """The outputs of some frames, drawn by a route or the reference."""
    (frame,) = burnish.compile(text, PROFILES, partial=True).frames
    host = _host(frame)
    if where != REFERENCE:
        return draw_frames(host, ROUTES[where], studio.runner, studio.toolchain, count)
    drawing = ReferenceFrames(host)
    names = [row.name for row in frame.plan.outputs]
    found = []
    for _ in range(count):
        drawing.draw()
        found.append({name: drawing.output(name).levels[0][0].copy() for name in names})
    return found


def _host(frame: CompiledFrame) -> FrameHost:
    return FrameHost(frame, in_a_row([], {}, "sphere"), SIZE)


EVERYWHERE = pytest.mark.parametrize("where", [REFERENCE, *ROUTES])
_WITHOUT_BUFFERS = routes("absent", "kernels over buffers")
WITH_BUFFERS = [REFERENCE, *(name for name in ROUTES if name not in _WITHOUT_BUFFERS)]


@EVERYWHERE
def test_a_step_reads_what_another_has_left_with_its_first_row_at_the_top(
    studio: Studio, where: str
) -> None:
    text = f"""{NUMBERS}
    frame F {{
        one = Numbered(screen)
        two = Shifted(screen) with {{ source = one.value }}
        output value = two.value
    }}"""
    (found,) = outputs(text, where, studio)
    (layer,) = found["value"]
    wanted = np.minimum(np.add(RAMP, [1, 2]), np.subtract(SIZE, 1))
    assert layer[..., 0] == pytest.approx(wanted[..., 0] + 100)
    assert layer[..., 1] == pytest.approx(wanted[..., 1])
    assert layer[..., 3] == pytest.approx((wanted[..., 1] + 0.5) / SIZE[1], abs=1e-6)


@EVERYWHERE
def test_drawing_over_leaves_what_was_there_to_others(studio: Studio, where: str) -> None:
    text = f"""{NUMBERS}
    frame F {{
        one = Numbered(screen)
        two = Added(screen) with {{ source = one.value }}
        three = Added(screen, two) with {{ source = one.value, times = 2 }}
        output before = two.value
        output after = three.value
    }}"""
    (found,) = outputs(text, where, studio)
    assert found["before"][0][..., :2] == pytest.approx(RAMP)
    assert found["after"][0][..., :2] == pytest.approx(3 * RAMP)


@EVERYWHERE
def test_what_only_the_first_frame_draws_over_what_all_need(studio: Studio, where: str) -> None:
    """The first frame copies what it draws over; later frames find its texture as they should."""
    text = f"""{NUMBERS}
    pass Counted : FullScreen {{
        map before : texture2d with {{ filter = nearest, mip = none }}
        target value : rgba16f = before.load(ivec2(frag_coord.xy)) + 1
    }}
    frame F {{
        one   = Numbered(screen)
        base  = Added(screen) with {{ source = one.value }}
        first = Added(screen, base) with {{ source = one.value }}
        count = Counted(screen) with {{ before = previous(count.value, first.value) }}
        again = Added(screen) with {{ source = base.value, times = 3 }}
        output value = count.value
        output other = base.value
        output thrice = again.value
    }}"""
    (frame,) = burnish.compile(text, ("wgsl",)).frames
    steps = {step.name: step.only_first for step in frame.plan.steps}
    assert {name for name, is_rare in steps.items() if is_rare} == {"a copy", "first"}
    for number, found in enumerate(outputs(text, where, studio, 3)):
        assert found["value"][0][..., :2] == pytest.approx(2 * RAMP + number + 1)
        assert found["other"][0][..., :2] == pytest.approx(RAMP)
        assert found["thrice"][0][..., :2] == pytest.approx(3 * RAMP)


@EVERYWHERE
def test_steps_that_draw_on_are_one_render_pass(studio: Studio, where: str) -> None:
    text = f"""{NUMBERS}
    frame F {{
        one = Numbered(screen)
        two = Added(screen) with {{ source = one.value }}
        three = Added(screen, two) with {{ source = one.value, times = 2 }}
        output value = three.value
    }}"""
    (frame,) = burnish.compile(text, ("wgsl",)).frames
    steps = [step for step in frame.plan.steps if isinstance(step, DrawStep)]
    assert [step.continues for step in steps] == [False, False, True]
    (found,) = outputs(text, where, studio)
    assert found["value"][0][..., :2] == pytest.approx(3 * RAMP)


@EVERYWHERE
def test_steps_draw_into_a_part_over_what_they_say(studio: Studio, where: str) -> None:
    """The clip volume is drawn into the viewport, where `uv` goes from 0 to 1, and places are
    counted from the corner of the whole. Blending by a constant is told by hand."""
    text = f"""{NUMBERS}
    pass Taken : FullScreen {{
        target value : rgba16f = vec4(8) blend {{
            source = constant, destination = one, operation = reverse_subtract, mask = rb
        }}
    }}
    pass Copied : FullScreen {{
        map source : texture2d with {{ filter = nearest, mip = none }}
        target value : rgba16f = source.load(ivec2(frag_coord.xy))
    }}
    frame F {{
        param left : int = 4
        numbered = Numbered(screen) with {{
            viewport = ivec4(left, 1, size.x / 2, 2), clear.value = vec4(-1, -2, -3, -4)
        }}
        copied = Copied(screen) with {{ source = numbered.value }}
        taken = Taken(screen, copied) with {{
            scissor = ivec4(5, -2, 2, 5), blend_constant = vec4(2, 3, 0.5, 0.25)
        }}
        output value = taken.value
    }}
    """
    (found,) = outputs(text, where, studio)
    columns, rows = RAMP[..., 0], RAMP[..., 1]
    whole = np.stack([columns, rows, (columns - 3.5) / 4, (rows - 0.5) / 2], axis=-1)
    inside = (columns >= 4) & (rows >= 1) & (rows < 3)
    expected = np.where(inside[..., None], whole, (-1.0, -2.0, -3.0, -4.0))
    taken = (columns >= 5) & (columns < 7) & (rows < 3)
    expected = expected - np.where(taken[..., None], (16.0, 0.0, 4.0, 0.0), 0.0)
    assert (found["value"][0] == expected).all()


@EVERYWHERE
def test_layers_levels_and_faces_are_drawn_one_by_one(studio: Studio, where: str) -> None:
    text = f"""{HEAD}
    pass Filled : FullScreen {{
        param filled : float
        target value : rgba16f = vec4(filled, 0, 0, 1)
    }}
    pass Read : FullScreen {{
        map layers : texture2d_array with {{ filter = nearest, mip = nearest }}
        map faces  : texture_cube with {{ filter = nearest, mip = nearest }}
        target value : rgba32f = vec4(
            layers.load(ivec2(0), 2).r, faces.level(vec3(0, 1, 0), 0).r,
            faces.level(vec3(0, 0, -1), 1).r, layers.load(ivec2(0), 0).r
        )
    }}
    frame F {{
        layers = each i in 0..3 : Filled(screen, 4) with {{ filled = float(i) + 1 }}
        faces  = each level in mips(2) : each face in cube :
            Filled(screen, 4) with {{ filled = float(10 * level + face) }}
        read   = Read(screen) with {{ layers = layers.value, faces = faces.value }}
        output value = read.value
        output all = layers.value
    }}"""
    (found,) = outputs(text, where, studio)
    assert found["value"][0][0, 0].tolist() == [3, 2, 15, 1]
    assert found["all"][:, 0, 0, 0].tolist() == [1, 2, 3]


@EVERYWHERE
def test_what_is_kept_may_be_drawn_over_something(studio: Studio, where: str) -> None:
    text = f"""{HEAD}
    pass Fives : FullScreen {{ target value : rgba16f = vec4(5) }}
    pass Added : FullScreen blend add {{
        map source : texture2d with {{ filter = nearest, mip = none }}
        target value : rgba16f = source.load(ivec2(frag_coord.xy))
    }}
    frame F {{
        ground = Fives(screen)
        added  = Added(screen, ground) with {{ source = previous(added.value) }}
        output value = added.value
    }}"""
    found = outputs(text, where, studio, 3)
    assert [each["value"][0, 0, 0, 0] for each in found] == [5, 10, 15]


WRITTEN = f"""{HEAD}
pass Written : FullScreen {{
    param one : int
    target value : rgba16f = vec4(float(one), 0, 0, 1)
}}
"""


@EVERYWHERE
def test_frames_are_told_how_many_were_drawn_before(studio: Studio, where: str) -> None:
    text = f"""{WRITTEN}
    frame F {{
        written = Written(screen) with {{ one = 10 * number }}
        output value = written.value
    }}"""
    found = outputs(text, where, studio, 3)
    assert [each["value"][0, 0, 0, 0] for each in found] == [0, 10, 20]


@EVERYWHERE
def test_a_frame_may_say_its_size_and_number_itself(studio: Studio, where: str) -> None:
    text = f"""{WRITTEN}
    frame F {{
        size    = ivec2(3, 2)
        number  = 7
        written = Written(screen) with {{ one = number }}
        output value = written.value
    }}"""
    found = outputs(text, where, studio, 2)
    assert [each["value"].shape for each in found] == [(1, 2, 3, 4)] * 2
    assert [each["value"][0, 0, 0, 0] for each in found] == [7, 7]


@EVERYWHERE
def test_a_frame_finds_what_the_last_one_left(studio: Studio, where: str) -> None:
    text = f"""{NUMBERS}
    pass Counted : FullScreen {{
        map before : texture2d with {{ filter = nearest, mip = none }}
        target value : rgba16f = before.load(ivec2(frag_coord.xy)) + 1
    }}
    frame F {{
        first = Numbered(screen)
        count = Counted(screen) with {{ before = previous(count.value, first.value) }}
        plain = Counted(screen) with {{ before = previous(plain.value) }}
        output value = count.value
        output other = plain.value
    }}"""
    frames = outputs(text, where, studio, 3)
    assert [frame["value"][0][1, 2, 0] for frame in frames] == [3, 4, 5]
    assert [frame["other"][0][1, 2, 0] for frame in frames] == [1, 2, 3]


@EVERYWHERE
def test_what_is_drawn_in_the_first_frame_only_is_there_in_later_ones(
    studio: Studio, where: str
) -> None:
    text = f"""{NUMBERS}
    pass Table : FullScreen {{
        param scale : float
        target value : rgba16f = scale * uv.x * vec4(1)
    }}
    pass Next : FullScreen {{
        map table  : texture2d with {{ filter = nearest, mip = none }}
        map before : texture2d with {{ filter = nearest, mip = none }}
        place = ivec2(frag_coord.xy)
        target value : rgba16f = table.load(place) + before.load(place)
    }}
    frame F {{
        table = Table(screen, ivec2(8, 4)) with {{ scale = 8 }}
        again = Next(screen, ivec2(8, 4)) with {{ table = table.value, before = table.value }}
        count = Next(screen) with {{ table = again.value, before = previous(count.value) }}
        output value = count.value
    }}"""
    (frame,) = burnish.compile(text, PROFILES, partial=True).frames
    assert [step.only_first for step in frame.plan.steps] == [True, True, False]
    frames = outputs(text, where, studio, 3)
    wanted = 2 * (RAMP[0, :, 0] + 0.5)
    for number, found in enumerate(frames):
        assert found["value"][0][1, :, 0] == pytest.approx((number + 1) * wanted)


@pytest.mark.parametrize("where", WITH_BUFFERS)
def test_kernels_and_passes_feed_each_other(studio: Studio, where: str) -> None:
    text = f"""{NUMBERS}
    kernel Doubled {{
        map source : texture2d
        result image : image2d<rgba16f>[source.size()] = 2 * source.load(texel)
    }}
    kernel Squares {{ result squares : float[16] = float(index * index) }}
    kernel Sums {{
        buffer squares : float[]
        result sums : float[squares.count] = squares[index] + squares[index - 1]
    }}
    kernel Shown {{
        buffer sums : float[]
        map doubled : texture2d
        result image : image2d<rgba32f>[ivec2(16, 1)] = vec4(
            sums[texel.x], doubled.load(ivec2(texel.x mod 8, 3)).xy, 0
        )
    }}
    frame F {{
        one     = Numbered(screen)
        doubled = Doubled() with {{ source = one.value }}
        squares = Squares()
        sums    = Sums() with {{ squares = squares.squares }}
        shown   = Shown() with {{ sums = sums.sums, doubled = doubled.image }}
        output image = shown.image
    }}"""
    (found,) = outputs(text, where, studio)
    numbers = np.arange(16)
    row = found["image"][0][0]
    assert row[:, 0] == pytest.approx(numbers**2 + np.maximum(numbers - 1, 0) ** 2)
    assert row[:, 1] == pytest.approx(2 * (numbers % 8))
    assert row[:, 2] == pytest.approx(6)


@EVERYWHERE
def test_depths_are_kept_and_read(studio: Studio, where: str) -> None:
    text = f"""{HEAD}
    material Slope {{ color = vec3(1) }}
    pass Sloped {{
        at : vec2 = @vertex position.xy
        clip_position = @vertex (vec4(at, 0.25, 1) as point<clip>)
        target seen : r8 = 1
    }}
    pass Compared : FullScreen {{
        map depths : depth2d with {{ filter = nearest }}
        target value : rgba8 = vec4(depths(uv, 0.2), depths(uv, 0.3), 0, 1)
    }}
    frame F {{
        models scene
        drawn = Sloped(scene)
        compared = Compared(screen) with {{ depths = drawn.depth }}
        output value = compared.value
        output depth = drawn.depth
    }}"""
    (frame,) = burnish.compile(text, PROFILES, partial=True).frames
    host = FrameHost(frame, in_a_row(["Slope"], {}, "plane"), SIZE)
    if where == REFERENCE:
        drawing = ReferenceFrames(host)
        drawing.draw()
        found = {name: drawing.output(name).levels[0][0] for name in ("value", "depth")}
    else:
        (found,) = draw_frames(host, ROUTES[where], studio.runner, studio.toolchain)
    middle = SIZE[1] // 2, SIZE[0] // 2
    assert found["depth"][0][middle][0] == pytest.approx(0.25)
    assert found["value"][0][middle][:2].tolist() == [1, 0]


BARS = """
fn column(number: int, corner: vec2) -> point<clip> =
    (vec4((2 * float(number) + 2 * corner.x) / 8 - 1, 2 * corner.y - 1, 0.5, 1) as point<clip>)

/// Two triangles for each column of pixels.
pass Bars {
    number = int(vertex_index / 6u)
    corner = [vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 0), vec2(1, 1), vec2(0, 1)]
    clip_position = @vertex column(number, corner[int(vertex_index mod 6u)])
    shade : float = @vertex float(number + 1)
    depth { compare = always, write = false }
    target value : rgba32f = vec4(shade, 0, 0, 1)
}

/// A point for each column of pixels.
pass Points {
    shade : float
    expand point {
        strip of 4 as i {
            clip_position = column(int(vertex_index), vec2(float(i / 2), float(i mod 2)))
            shade = float(vertex_index) + 1
        }
    }
    target value : rgba32f = vec4(shade, 0, 0, 1)
}
"""


@EVERYWHERE
@pytest.mark.parametrize("drawn", ["Bars(vertices(6 * many + 2))", "Points(vertices(many))"])
def test_vertices_are_drawn_that_no_model_has(studio: Studio, where: str, drawn: str) -> None:
    text = f"""{HEAD}{BARS}
    frame F {{
        param many : int in 0..100 = 3
        one = {drawn}
        output value = one.value
    }}"""
    (found,) = outputs(text, where, studio)
    shades = found["value"][0][..., 0]
    assert shades.tolist() == [[1, 2, 3, 0, 0, 0, 0, 0]] * SIZE[1]


@EVERYWHERE
def test_a_frame_gives_arrays_of_numbers_and_of_matrices(studio: Studio, where: str) -> None:
    text = f"""{HEAD}
    pass Chosen : FullScreen {{
        param weights : float[3]
        param turns   : mat2[2]
        column = int(frag_coord.x)
        target value : rgba32f = vec4(weights[column mod 3], turns[column mod 2] * vec2(1, 10), 0)
    }}
    frame F {{
        param n : float = 2
        turns  = [mat2(vec2(n, 0), vec2(1, 0)), mat2(vec2(0, n), vec2(0, 1))]
        chosen = Chosen(screen) with {{ weights = [n, 2 * n, 7], turns = turns }}
        output value = chosen.value
    }}"""
    (found,) = outputs(text, where, studio)
    row = found["value"][0][0]
    assert row[:, 0].tolist() == [2, 4, 7, 2, 4, 7, 2, 4]
    assert row[:, 1].tolist() == [12, 0] * 4
    assert row[:, 2].tolist() == [0, 12] * 4


@EVERYWHERE
def test_lights_bring_what_their_steps_leave(studio: Studio, where: str) -> None:
    """Each light has steps of its own; a rig may say others."""
    text = f"""{HEAD}
    import std.lights.{{Directional}}
    pass Filled : FullScreen {{
        param filled : float
        target value : rgba32f = vec4(filled, 0, 0, 1)
    }}
    pass Doubled : FullScreen {{
        map source : texture2d with {{ filter = nearest, mip = none }}
        target value : rgba32f = 2 * source.load(ivec2(0))
    }}
    light Screened : Directional {{
        param share : float = 3
        share_left  = 10 * share
        first       = Filled(screen, 2) with {{ filled = share_left }}
        cookie_made = Doubled(screen, 2) with {{ source = first.value }}
        map cookie : texture2d = cookie_made.value with {{ filter = nearest, mip = none }}
        falloff = cookie.load(ivec2(1)).r
    }}
    rig Two {{
        one : Screened
        two : Screened {{ share_left = 7, cookie_made = inherited.first }}
    }}
    term arriving() -> rgb per light = vec3(light.falloff)
    pass Lit : FullScreen {{
        target value : rgba32f = vec4(arriving(), 1)
    }}
    pass Added : FullScreen blend add {{
        target value : rgba16f = vec4(arriving(), 1)
    }}
    frame F {{
        all  = Lit(screen)
        each_one = sum lamp in rig : Added(screen)
        output value = all.value
        output added = each_one.value
    }}"""
    (found,) = outputs(text, where, studio)
    assert found["value"][0][0, 0, 0] == 2 * 30 + 7
    assert found["added"][0][0, 0, 0] == 2 * 30 + 7


@EVERYWHERE
def test_stencil_values_go_from_pass_to_pass(studio: Studio, where: str) -> None:
    """Five columns are counted once, and three of them twice; both counts are looked at later."""
    text = f"""{HEAD}{BARS}
    pass Counting : Bars {{ stencil {{ pass = increment_wrap }} }}
    pass Marked : FullScreen {{
        stencil {{ compare = equal, reference = 1 }}
        target value : rgba32f = vec4(9, 0, 0, 1)
    }}
    frame F {{
        once   = Counting(vertices(6 * 5))
        twice  = Counting(vertices(6 * 3), once)
        late  = Marked(screen, twice)
        early = Marked(screen, once)
        output single = late.value
        output first  = early.value
    }}"""
    (frame,) = burnish.compile(text, PROFILES, partial=True).frames
    assert {row.format for row in frame.plan.textures} == {"rgba32f", "depth32f_stencil8"}
    (found,) = outputs(text, where, studio)
    rows = {name: found[name][0][..., 0].tolist() for name in ("single", "first")}
    assert rows["single"] == [[1, 2, 3, 9, 9, 0, 0, 0]] * SIZE[1]
    assert rows["first"] == [[9, 9, 9, 9, 9, 0, 0, 0]] * SIZE[1]


@EVERYWHERE
def test_depth_tests_that_fail_are_counted_by_their_side(studio: Studio, where: str) -> None:
    """The faces behind a wall are counted: two of the first three columns are backs."""
    text = f"""{HEAD}{BARS}
    pass Behind : Bars {{
        at : vec2 = corner[int(vertex_index mod 6u)]
        clip_position = @vertex column(number, if number < 2 then at.yx else at)
        depth {{ compare = less }}
        stencil {{
            front.depth_fail = increment_wrap, back.depth_fail = decrement_wrap, pass = zero
        }}
    }}
    pass Wall : FullScreen {{
        clip_position = @vertex (vec4(across, above, 0.25, 1) as point<clip>)
        depth  {{ write = true }}
        target value : rgba32f = vec4(0, 0, 0, 1)
    }}
    pass Marked : FullScreen {{
        param mark : float = 0
        target value : rgba32f = vec4(mark, 0, 0, 1)
    }}
    pass Fronts : Marked {{ stencil {{ compare = equal, reference = 1 }} }}
    pass Backs : Marked {{ stencil {{ compare = equal, reference = 255 }} }}
    frame F {{
        wall   = Wall(screen)
        behind = Behind(vertices(6 * 3), wall)
        fronts = Fronts(screen, behind) with {{ mark = 5 }}
        backs  = Backs(screen, fronts) with {{ mark = 7 }}
        output value = backs.value
    }}"""
    (found,) = outputs(text, where, studio)
    assert found["value"][0][..., 0].tolist() == [[7, 7, 5, 0, 0, 0, 0, 0]] * SIZE[1]


NAMED_TWICE = f"""{HEAD}
import std.lights.{{Point}}
import std.terms.{{lambert}}

rig Studio {{ lamps : Point[3] }}

pass Counted : FullScreen blend add {{
    param lamps : float = 1
    param wide  : float = 0
    position = vec3(uv, 0)
    normal   = vec3(0, 0, 1)
    target value : rgba16f = vec4(lamps + wide * lambert(vec3(1)), 1)
}}
frame F {{
    param lamps : float = 0.75
    counted = sum lamp in rig : Counted(screen) with {{ lamps = lamps }}
    output value = counted.value
}}
"""
"""A frame and its pass have a parameter that is called like lights of the rig."""


@EVERYWHERE
def test_a_parameter_may_be_called_like_lights(studio: Studio, where: str) -> None:
    (frame,) = burnish.compile(NAMED_TWICE, ("wgsl",)).frames
    assert [row.name for row in frame.plan.lights] == ["Studio.lamps"]
    (found,) = outputs(NAMED_TWICE, where, studio)
    assert np.array_equal(found["value"][..., :3], np.full((1, *SIZE[::-1], 3), 3 * 0.75))


LEVEL_EDGE = """
pass Lower {
    clip_position : point<clip> = vec4(
        if vertex_index == 1 then 3 else -1,
        if vertex_index == 2 then -3 else 0.25,
        0, 1
    )
    target value : rgba8 = vec4(1)
}
frame F {
    below = Lower(vertices(3))
    output value = below.value
}
"""
"""A triangle whose upper edge goes through the middle of the pixels of the second row."""


@pytest.mark.parametrize("route", ROUTES)
def test_faces_own_the_pixels_on_a_level_edge_as_the_reference_says(
    studio: Studio, route: str
) -> None:
    (frame,) = burnish.compile(LEVEL_EDGE, PROFILES, partial=True).frames
    (row,) = conform([("F", frame)], [ROUTES[route]], studio.runner, studio.toolchain, size=SIZE)
    assert row.status == "agrees", "\n".join(details(row)) or row.problem


@EVERYWHERE
def test_depths_and_stencil_values_are_empty_before_the_first_frame(
    studio: Studio, where: str
) -> None:
    """The second frame finds what the first one has left, but for stencil values."""
    text = f"""{HEAD}{BARS}
    pass Wall : FullScreen {{
        clip_position = @vertex (vec4(across, above, 0.25, 1) as point<clip>)
        depth   {{ write = true }}
        stencil {{ compare = equal, pass = increment_wrap }}
        target value : rgba32f = vec4(1)
    }}
    pass Shown : FullScreen {{
        map before : depth2d with {{ filter = nearest }}
        stencil {{ compare = equal, reference = 1 }}
        target value : rgba32f = vec4(2 + before(uv, 0.5), 0, 0, 1)
    }}
    frame F {{
        wall  = Wall(screen)
        shown = Shown(screen, wall) with {{ before = previous(wall.depth) }}
        output value = shown.value
    }}"""
    found = outputs(text, where, studio, count=2)
    assert [frame["value"][0][0, 0, 0] for frame in found] == [3, 2]
