"""The host in a browser: a package made by hand, and packages that it refuses."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from burnish.targets.runner.drivers.browser.driver import Browser
from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.frame_job import FrameTexels

PROFILE = "wgsl:webgpu"
WIDTH, HEIGHT = 3, 2

_CORNERS = """
@vertex fn main(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
  return vec4f(f32(i & 1) * 4 - 1, f32(i >> 1) * 4 - 1, 0, 1);
}"""
_FILLED = """
struct Given { glow: f32 }
@group(0) @binding(0) var<uniform> given: Given;
@fragment fn main(@builtin(position) at: vec4f) -> @location(0) vec4f {
  return vec4f(given.glow, floor(at.x), floor(at.y), 1);
}"""
_DOUBLED = """
@group(0) @binding(0) var<storage, read_write> numbers: array<f32>;
@compute @workgroup_size(2) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x < 3) { numbers[id.x] = 2 * f32(id.x); }
}"""
_ADDED = """
@group(0) @binding(0) var filled: texture_2d<f32>;
@group(0) @binding(1) var before: texture_2d<f32>;
@group(0) @binding(2) var<storage, read> numbers: array<f32>;
@fragment fn main(@builtin(position) at: vec4f) -> @location(0) vec4f {
  let texel = vec2i(at.xy);
  return textureLoad(filled, texel, 0) + 0.5 * textureLoad(before, texel, 0) + vec4f(numbers[2]);
}"""


def place(binding: int) -> dict[str, Any]:
    return {"identifier": "", "group": 0, "binding": binding}


def parameter(name: str, representation: str, lanes: int, **further: Any) -> dict[str, Any]:
    kind = "int" if representation[0] == "i" else "float"
    return {
        "name": name, "type": representation, "representation": representation, "range": None,
        "default": None, "block": None, "offset": None, "count": None, "members": [],
        "layout": {"stored": representation, "kind": kind, "lanes": lanes}, **further,
    }  # fmt: skip


def shader(
    texts: dict[str, str], backend: dict[str, Any], slots: list[dict[str, Any]], **further: Any
) -> dict[str, Any]:
    none: dict[str, Any] = {
        kind: {}
        for kind in ("blocks", "buffers", "images", "textures", "samplers", "vertex_inputs")
    }
    reflection = {
        "format": 1, "material": "Hand", "rig": None, "blocks": [], "parameters": [],
        "derived": [], "lights": [], "buffers": [], "results": [], "extent": None,
        "work_group": [1, 1, 1], "textures": [], "samplers": [], "vertex_inputs": [],
        "targets": [], "draw": {
            "primitive": "triangle", "corners": 3, "expanded_by": None, "vertices": None,
            "topology": "triangle", "tessellation": None, "layers": None,
        },
        "render_state": {
            "samples": 1, "cull": "none", "front": "counter_clockwise", "fill": "faces",
            "stencil": None,
            "depth": {"compare": "less", "write": True, "bias": None},
        },
        "backends": {PROFILE: {"front_face": "ccw", **none, **backend}}, **further,
    }  # fmt: skip
    given = {stage: {"text": text, "entry": "main"} for stage, text in texts.items()}
    empty: dict[str, Any] = {
        kind: {} for kind in ("values", "roles", "lights", "textures", "texture_roles", "buffers")
    }
    pipeline = {
        "groups": [slots], "buffers": [], "targets": [{"writeMask": 15} for _ in TARGET],
        "primitive": {"topology": "triangle-list"},
        "depthStencil": {"depthWriteEnabled": True, "depthCompare": "less"},
    }  # fmt: skip
    return {
        "reflection": reflection, "texts": {PROFILE: given}, "levels": None, "webgpu": pipeline,
        **empty,
    }  # fmt: skip


def slot(binding: int, kind: str, name: str, stage: int, **layout: Any) -> dict[str, Any]:
    """A row of a bind group's layout: a resource at a binding, for the stages with these bits."""
    place = {"binding": binding, "visibility": stage, **layout}
    return {"kind": kind, "name": name, "number": 0, "layout": place}


FRAGMENT, COMPUTE = 2, 4
LOADED = {"texture": {"viewDimension": "2d", "sampleType": "unfilterable-float"}}


def texture_row(name: str) -> dict[str, Any]:
    layout = {"viewDimension": "2d", "sampleType": "unfilterable-float", "sampler": None}
    return {"name": name, "dimension": "2d", "layout": layout, "stages": ["fragment"]}


def constant(value: int) -> list[dict[str, Any]]:
    return [{"op": "constant", "type": "int", "value": value, "args": []}]


TARGET = [{"name": "color", "format": "rgba32f", "blend": None, "mask": "rgba"}]
NUMBERS = {"name": "numbers", "representation": "float[]", "stride": 4, "layout": {
    "stored": "float", "kind": "float", "lanes": 1,
}, "members": []}  # fmt: skip


def package() -> dict[str, Any]:
    """A frame that adds what it fills, half of what it has drawn before, and what a kernel
    writes."""

    def drawn(name: str, shader: int, texture: int, inputs: list[dict[str, Any]]) -> dict[str, Any]:
        target = {
            "name": "color", "texture": texture, "layer": 0, "level": 0, "load": "clear",
            "clear": None, "store": True, "resolve": None,
        }  # fmt: skip
        use = {"material": None, "shader": shader, "inputs": inputs}
        draw = {"models": None, "vertices": 1, "light": None, "uses": [use]}
        return {
            "kind": "draw", "name": name, "only_first": False, "targets": [target],
            "depth": None, "viewport": None, "scissor": None, "blend_constant": None,
            "draws": [draw],
        }  # fmt: skip

    def texture() -> dict[str, Any]:
        return {
            "format": "rgba32f", "dimension": "2d", "layers": 1, "levels": 1, "samples": 1,
            "uses": [], "size": {"value": 0, "extent_of": None, "level": 0},
        }  # fmt: skip

    glow = parameter("glow", "float", 1, block="Given", offset=0, range=[0, 10])
    counted = parameter("count", "int", 1)
    plan = {
        "plan": 1, "frame": "ByHand", "lights": [], "host_textures": [], "host_buffers": [],
        "parameters": [parameter("size", "ivec2", 2), parameter("glow", "float", 1)],
        "values": [
            {"representation": "ivec2", "steps": [
                {"op": "parameter", "type": "ivec2", "parameter": "size", "args": []},
            ]},
            {"representation": "int", "steps": constant(3)},
            {"representation": "float", "steps": [
                {"op": "parameter", "type": "float", "parameter": "glow", "args": []},
            ]},
        ],
        "textures": [texture() for _ in range(4)],
        "steps": [
            drawn("filled", 0, 0, [{"name": "glow", "value": 2}]),
            {"kind": "copy", "from": {"texture": 0}, "to": {"texture": 1}},
            {
                "kind": "run", "name": "doubled", "only_first": False, "shader": 1, "inputs": [],
                "images": [], "buffers": [{"name": "numbers", "result": "doubled.numbers"}],
            },
            drawn("added", 2, 2, [
                {"name": "filled", "result": "filled.color", "texture": 1},
                {"name": "before", "previous": "added.color", "texture": 3, "initially": None},
                {"name": "numbers", "result": "doubled.numbers", "texture": None},
            ]),
        ],
        "kept": [{"result": "added.color", "texture": 2, "previous": 3}],
        "outputs": [{"name": "picture", "result": "added.color", "texture": 2}],
    }  # fmt: skip
    filled = shader(
        {"vertex": _CORNERS, "fragment": _FILLED}, {"blocks": {"Given": place(0)}},
        [slot(0, "block", "Given", FRAGMENT, buffer={})],
        blocks=[{"name": "Given", "size": 16}], parameters=[glow], targets=TARGET,
    )  # fmt: skip
    doubled = shader(
        {"compute": _DOUBLED}, {"buffers": {"numbers": place(0)}},
        [slot(0, "buffer", "numbers", COMPUTE, buffer={"type": "storage"})], draw=None,
        work_group=[2, 1, 1], extent=constant(3),
        results=[{**NUMBERS, "count": constant(3), "initial": None}],
    )  # fmt: skip
    added = shader(
        {"vertex": _CORNERS, "fragment": _ADDED},
        {"textures": {"filled": place(0), "before": place(1)}, "buffers": {"numbers": place(2)}},
        [
            slot(0, "texture", "filled", FRAGMENT, **LOADED),
            slot(1, "texture", "before", FRAGMENT, **LOADED),
            slot(2, "buffer", "numbers", FRAGMENT, buffer={"type": "read-only-storage"}),
        ],
        parameters=[counted], buffers=[{**NUMBERS, "count": "count", "stages": ["fragment"]}],
        textures=[texture_row("filled"), texture_row("before")], targets=TARGET,
    )  # fmt: skip
    return {
        "package": 1, "plan": plan, "shaders": [filled, doubled, added], "size": [WIDTH, HEIGHT],
        "formats": ["rgba32float"] * 4, "pipelines": [
            {"shader": 0, "targets": ["rgba32float"], "depth": None},
            {"shader": 1, "targets": [], "depth": None},
            {"shader": 2, "targets": ["rgba32float"], "depth": None},
        ],
        "camera": {"view_projection": [], "eye": [0, 0, 0]}, "values": {"glow": 3},
        "roles": {"size": "size"}, "models": [], "geometries": [], "given": [],
        "textures": {}, "buffers": {}, "pictures": [],
    }  # fmt: skip


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    opened = Browser("webgpu")
    yield opened
    opened.close()


def drawn(browser: Browser, whole: dict[str, Any], count: int = 1) -> list[FrameTexels]:
    request = {"whole": whole, "count": count, "outputs": ["picture"]}
    return list(browser.draw_package(request))


def test_a_plan_made_by_hand(browser: Browser) -> None:
    one, two = drawn(browser, package(), 2)
    assert (one.width, one.height, one.layers) == (WIDTH, HEIGHT, 1)
    first = np.frombuffer(one.texels, "<f4").reshape(HEIGHT, WIDTH, 4)
    second = np.frombuffer(two.texels, "<f4").reshape(HEIGHT, WIDTH, 4)
    column, row = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    filled = np.stack([np.full_like(column, 3), column, row, np.ones_like(row)], -1)
    assert first.tolist() == (filled + 4).tolist()
    assert second.tolist() == (filled + 4 + 0.5 * (filled + 4)).tolist()


def changed(whole: dict[str, Any], path: str, value: Any) -> dict[str, Any]:
    """A copy in which one thing is different."""
    made = copy.deepcopy(whole)
    *steps, last = [int(step) if step.isdigit() else step for step in path.split("/")]
    at: Any = made
    for step in steps:
        at = at[step]
    at[last] = value
    return made


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        ("package", 2, "this host knows packages of version 1, and this one is of version 2"),
        ("plan/plan", 7, "this host knows plans of version 1, and this one is of version 7"),
        (
            "shaders/1/reflection/format", 2,
            "this host knows reflections of version 1, and this one is of version 2",
        ),
        ("shaders/0/texts", {}, "the package of ByHand has no texts for a browser"),
        ("values", {}, "ByHand needs a value for `glow`"),
        ("values/glow", 11, "`glow` is declared in 0..10: 11 is not"),
        ("size", [0, 2], "a texture of ByHand would have 0 x 2 texels"),
        ("plan/steps/2/buffers", [], "nobody gives Hand its `numbers`"),
        (
            "plan/steps/3/draws/0/uses/0/inputs/2/result", "doubled.others",
            "ByHand reads doubled.others, which nobody has written",
        ),
        ("plan/outputs/0/name", "other", "ByHand has no output `picture`"),
    ],
)  # fmt: skip
def test_packages_that_cannot_be_drawn(
    browser: Browser, path: str, value: Any, message: str
) -> None:
    with pytest.raises(DriverError) as error:
        drawn(browser, changed(package(), path, value))
    assert str(error.value) == message


def test_what_a_text_says_wrongly_is_told_with_its_place(browser: Browser) -> None:
    with pytest.raises(DriverError, match=r"the browser refuses a text of Hand:\n5:16: .*'glim'"):
        wrong = _FILLED.replace("given.glow", "glim")
        drawn(browser, changed(package(), "shaders/0/texts/wgsl:webgpu/fragment/text", wrong))


def test_what_the_device_complains_about_is_told(browser: Browser) -> None:
    """A texture that is drawn to while it is read."""
    wrong = changed(package(), "plan/steps/3/draws/0/uses/0/inputs/0/texture", 2)
    with pytest.raises(DriverError, match="usage"):
        drawn(browser, wrong)
