"""The reflection's description of textures, in the words of WebGPU's layouts."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.documents.reading import read
from burnish.compiler.documents.reflection import Reflection
from burnish.compiler.documents.writing import to_json

LAYOUTS = {
    ("texture2d", "t(uv).rgb"): ("2d", "float", "filtering"),
    ("texture2d_array", "t(uv, 1).rgb"): ("2d-array", "float", "filtering"),
    ("texture3d", "t(position).rgb"): ("3d", "float", "filtering"),
    ("texture_cube", "t(normal).rgb"): ("cube", "float", "filtering"),
    ("texture_cube_array", "t(normal, 1).rgb"): ("cube-array", "float", "filtering"),
    ("depth_cube_array", "vec3(t(normal, 1, 0.5))"): ("cube-array", "depth", "comparison"),
    ("texture2d", "t.load(ivec2(0)).rgb"): ("2d", "unfilterable-float", None),
    ("depth2d", "vec3(t(uv, 0.5))"): ("2d", "depth", "comparison"),
    ("depth_cube", "vec3(t(normal, 0.5))"): ("cube", "depth", "comparison"),
    ("depth2d_array", "vec3(t.load(ivec2(0), 1))"): ("2d-array", "depth", None),
    ("itexture2d", "vec3(float(t.load(ivec2(0)).r))"): ("2d", "sint", None),
    ("utexture3d", "vec3(float(t.load(ivec3(0)).r))"): ("3d", "uint", None),
}


def reflection(type_: str, color: str, state: str = "") -> Reflection:
    source = f"material M {{ map t : {type_} {state} color = {color} }}"
    targets = ("wgsl", "glsl:vulkan" if "cube_array" in type_ else "glsl:es300")
    found = burnish.compile(source, targets)["M"].reflection
    assert read(Reflection, to_json(found)) == found
    return found


@pytest.mark.parametrize(("given", "expected"), LAYOUTS.items(), ids=str)
def test_a_layout_says_how_a_texture_is_read(
    given: tuple[str, str], expected: tuple[str, str, str | None]
) -> None:
    found = reflection(*given)
    (row,) = found.textures
    layout = row.layout
    shape, sample, sampler = expected
    assert to_json(layout) == {"viewDimension": shape, "sampleType": sample, "sampler": sampler}
    assert row.type == given[0]
    samplers = ["t"] if expected[2] else []
    assert [row.texture for row in found.samplers] == samplers
    assert list(found.backends["wgsl:webgpu"].samplers) == samplers


def test_what_nothing_mixes_may_have_a_format_that_cannot_be_mixed() -> None:
    nearest = reflection("texture2d", "t(uv).rgb", "with { filter = nearest, mip = none }")
    (row,) = nearest.textures
    assert to_json(row.layout) == {
        "viewDimension": "2d", "sampleType": "unfilterable-float", "sampler": "non-filtering",
    }  # fmt: skip


STATES: dict[str, dict[str, str | None]] = {
    "texture2d": {"filter": "linear", "mip": "linear", "wrap": "repeat", "compare": None},
    "texture_cube": {"filter": "linear", "mip": "linear", "wrap": "clamp-to-edge", "compare": None},
    "depth2d": {
        "filter": "linear",
        "mip": "none",
        "wrap": "clamp-to-edge",
        "compare": "less-equal",
    },
}
DEFAULTS = {
    "texture_cube": ("white", [1.0, 1.0, 1.0, 1.0]),
    "depth_cube": ("far", [1.0]),
    "utexture2d": ("zero", [0, 0, 0, 0]),
    "texture2d = flat_normal": ("flat_normal", [128 / 255, 128 / 255, 1.0, 1.0]),
}


@pytest.mark.parametrize(("type_", "state"), STATES.items())
def test_the_state_of_a_sampler_is_complete(type_: str, state: dict[str, str | None]) -> None:
    (row,) = reflection(type_, "vec3(0)").samplers
    assert to_json(row.state) == state


@pytest.mark.parametrize(("type_", "default"), DEFAULTS.items())
def test_every_kind_of_texture_has_a_default(type_: str, default: tuple[str, list[float]]) -> None:
    row = to_json(reflection(type_, "vec3(0)").textures[0])
    assert (row["default"], row["default_texel"]) == default


INTENTS = {
    # Texels that become a colour, in one way or another.
    "color = t(uv).rgb": "color",
    "param tint : rgb  color = tint * t(uv).rgb": "color",
    "color = if uv.x < 0.5 then t(uv).rgb else vec3(0)": "color",
    "color = vec3(0) + (sum i in 0..4 : t.level(uv, float(i)).rgb)": "color",
    "color = [t(uv).rgb, vec3(1)][int(uv.x)]": "color",
    "color = pow(t.load(ivec2(0)).bgr, 2)": "color",
    "flat : rgba = t(uv)  color = flat.rgb": "color",
    "looked = @vertex t.level(uv, 0)  color = looked.rgb": "color",
    # Numbers of other kinds.
    "color = vec3(t(uv).r)": "data",
    "color = vec3(t(uv).x, t(uv).y, 1)": "data",
    "color = mix(vec3(0), vec3(1), t(uv).rgb)": "data",
    "color = t.gather(uv, 0).rgb": "data",
    "normal = normalize(t(uv).xyz * 2 - 1)": "data",
    "bent : vector<world> = t(uv).xyz  color = vec3(bent)": "data",
    "alpha = t(uv).a": "data",
    # One that nothing reads.
    "color = vec3(0)": "data",
}


@pytest.mark.parametrize(("members", "intent"), INTENTS.items())
def test_what_becomes_a_colour_is_one(members: str, intent: str) -> None:
    (material,) = burnish.compile(f"material M {{ map t : texture2d  {members} }}", ("wgsl",))
    (row,) = material.reflection.textures
    assert row.intent == intent


def test_functions_hand_colours_on() -> None:
    source = """
        fn twice(t: texture2d, uv: vec2) -> vec4 = t(uv) + t(uv * 2)
        material M {
            map paint : texture2d
            map grain : texture2d
            color = twice(paint, uv).rgb * twice(grain, uv).r + twice(paint, -uv).rgb
        }
    """
    (material,) = burnish.compile(source, ("wgsl",))
    found = {row.name: row.intent for row in material.reflection.textures}
    assert found == {"paint": "color", "grain": "data"}


@pytest.mark.parametrize("intent", ["color", "data"])
def test_a_declaration_has_the_last_word(intent: str) -> None:
    found = reflection("texture2d", "t(uv).rgb", f"with {{ intent = {intent}, wrap = clamp }}")
    (row,), (sampler,) = found.textures, found.samplers
    assert row.intent == intent
    assert to_json(sampler.state) == {**STATES["texture2d"], "wrap": "clamp-to-edge"}


def test_a_map_that_holds_colours_says_so() -> None:
    for type_ in ("texture2d", "texture2d_array", "texture3d", "texture_cube"):
        for content in ("rgb", "rgba"):
            (row,) = reflection(f"{type_} of {content}", "vec3(0)").textures
            assert (row.type, row.intent) == (type_, "color")


def test_texels_of_a_map_that_holds_colours_are_colours() -> None:
    """They are no vectors, and what is gathered or counted of them is no colour."""
    for texel in ("t(uv)", "t.level(uv, 1)", "t.grad(uv, uv, uv)", "t.load(ivec2(0))"):
        with pytest.raises(burnish.CompileError, match="nothing between rgb and normal<world>"):
            reflection("texture2d of rgb", f"{texel}.rgb + normal")
    for numbers in ("t.load(ivec2(0)).xyz.zyx", "vec3(vec2(t.size()), 0)", "vec3(t(uv).a)"):
        reflection("texture2d of rgb", f"vec3({numbers} + normal)")


def test_functions_take_maps_that_hold_colours() -> None:
    """What a function reads of a ``texture2d`` are bare numbers, which fit everywhere."""
    source = """
        fn twice(t: texture2d, uv: vec2) -> vec4 = t(uv) + t(uv * 2)
        fn once<T: textures>(t: T) -> vec4 = t.load(ivec2(0))
        material M {
            map paint : texture2d of rgb
            map plain : texture2d
            color = (twice(paint, uv).rgb + once(paint).rgb) * plain(uv).r
        }
    """
    (material,) = burnish.compile(source, ("wgsl",))
    found = {row.name: row.intent for row in material.reflection.textures}
    assert found == {"paint": "color", "plain": "data"}


def test_the_words_of_a_map_do_not_change_its_text() -> None:
    def text(declared: str) -> str:
        source = f"material M {{ map t : {declared}  color = t(uv).rgb }}"
        (material,) = burnish.compile(source, ("wgsl",))
        return material.text("wgsl", "fragment")

    assert text("texture2d of rgb") == text("texture2d") == text("texture2d of rgba")


def test_axes_wrap_each_in_its_own_way() -> None:
    """One that is said to wrap as all do is like one that says nothing."""
    state = "with { wrap = clamp, wrap_u = clamp, wrap_w = mirror }"
    (sampler,) = reflection("texture3d", "t(position).rgb", state).samplers
    assert to_json(sampler.state) == {
        **STATES["texture2d"], "wrap": "clamp-to-edge", "wrap_w": "mirror-repeat",
    }  # fmt: skip


@pytest.mark.parametrize(
    ("state", "expected"),
    [("with { anisotropy = 8 }", {"anisotropy": 8}), ("with { anisotropy = 1 }", {})],
)
@pytest.mark.parametrize("type_", ["texture2d", "texture_cube"])
def test_an_anisotropy_is_a_number_for_hosts(
    type_: str, state: str, expected: dict[str, int]
) -> None:
    (sampler,) = reflection(
        type_, "t(normal).rgb" if "cube" in type_ else "t(uv).rgb", state
    ).samplers
    assert to_json(sampler.state) == {**STATES[type_], **expected}


BORDERS = {
    ("texture2d", "wrap = border"): ("clamp-to-border", "transparent"),
    ("texture2d", "wrap_v = border, border = white"): ("repeat", "white"),
    ("depth2d", "wrap = border"): ("clamp-to-border", "white"),
    ("depth2d", "wrap = border, border = near"): ("clamp-to-border", "black"),
}


@pytest.mark.parametrize(("said", "expected"), BORDERS.items(), ids=str)
def test_borders_have_a_colour(said: tuple[str, str], expected: tuple[str, str]) -> None:
    color = "vec3(t(uv, 0.5))" if said[0] == "depth2d" else "t(uv).rgb"
    source = f"material M {{ map t : {said[0]} with {{ {said[1]} }} color = {color} }}"
    (sampler,) = burnish.compile(source, ("glsl",))["M"].reflection.samplers
    found = to_json(sampler.state)
    assert (found["wrap"], found["border"]) == expected


@pytest.mark.parametrize(
    ("type_", "state", "message"),
    [
        ("texture2d", "border = black", "`border` does not apply to `texture2d with { wrap = repe"),
        ("texture2d", "wrap_w = clamp", "`wrap_w` does not apply to `texture2d`"),
        ("texture_cube", "wrap_u = clamp", "`wrap_u` does not apply to `texture_cube`"),
        ("texture2d", "addressModeV = clamp", "did you mean `wrap_v`"),
        ("texture2d", "wrap = clamp_to_border", "did you mean `border`"),
        ("texture2d", "anisotropy = 3", "one of `1`, `2`, `4`, `8`, `16`"),
        ("texture2d", "filter = 4", "one of `linear`, `nearest`"),
        ("texture2d", "maxAnisotropy = 4", "did you mean `anisotropy`"),
        ("depth2d", "anisotropy = 4", "`anisotropy` does not apply to `depth2d`"),
        (
            "texture2d",
            "anisotropy = 4, mip = none",
            "`anisotropy` does not apply to `texture2d with { mip = none }`",
        ),
        ("texture2d", "wrap = border, border = gray", "one of `transparent`, `black`, `white`"),
    ],
)
def test_settings_of_edges_that_mean_nothing(type_: str, state: str, message: str) -> None:
    with pytest.raises(burnish.CompileError) as raised:
        reflection(type_, "vec3(0)", f"with {{ {state} }}")
    assert message in render_all(raised.value.diagnostics)


def test_a_kernel_says_what_it_reads() -> None:
    (kernel,) = burnish.compile(
        "kernel K { map t : texture2d with { intent = color }  map u : texture2d\n"
        "result r : image2d<rgba8>[t.size()] = t.load(texel) + u.load(texel) }",
        ("wgsl",),
    )
    assert [row.intent for row in kernel.reflection.textures] == ["color", "data"]


def test_a_frames_texture_is_what_its_shaders_make_of_it() -> None:
    (frame,) = burnish.compile(
        """
        import std.frames.{FullScreen}
        pass Shown : FullScreen {
            map photo : texture2d
            map noise : texture2d
            map said  : texture2d
            drawn : rgb = photo(uv).rgb
            target color : rgba8 = vec4(drawn * noise(uv).r, said(uv).a)
        }
        frame F {
            map picture : texture2d
            map grain   : texture2d
            map page    : texture2d with { intent = color }
            shown = Shown(screen) with { photo = picture, noise = grain, said = page }
            output seen = shown.color
        }
        """,
        ("wgsl",),
    ).frames
    found = {row.name: row.intent for row in frame.plan.host_textures}
    assert found == {"picture": "color", "grain": "data", "page": "color"}


def test_only_textures_of_colours_have_an_intent() -> None:
    with pytest.raises(burnish.CompileError, match="`intent` does not apply to `depth2d`"):
        reflection("depth2d", "vec3(t(uv, 0.5))", "with { intent = data }")
    with pytest.raises(burnish.CompileError, match="unknown value for `intent` `colour`"):
        reflection("texture2d", "t(uv).rgb", "with { intent = colour }")
    with pytest.raises(burnish.CompileError, match="`of rgb` does not apply to `depth2d`"):
        reflection("depth2d of rgb", "vec3(t(uv, 0.5))")
    with pytest.raises(burnish.CompileError, match="`intent` does not apply to `texture2d of rgb`"):
        reflection("texture2d of rgb", "t(uv).rgb", "with { intent = data }")
    with pytest.raises(burnish.CompileError, match="unknown content of a texture `srgb`"):
        reflection("texture2d of srgb", "t(uv).rgb")
