"""A package made by hand, as its document is declared: a frame of two passes and a kernel."""

from __future__ import annotations

from typing import Any

PROFILE = "wgsl:webgpu"
WIDTH, HEIGHT = 3, 2
FRAGMENT, COMPUTE = 2, 4
"""WebGPU's bits of the stages."""

Document = dict[str, Any]

CORNERS = """
@vertex fn main(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
  return vec4f(f32(i & 1) * 4 - 1, f32(i >> 1) * 4 - 1, 0, 1);
}"""
FILLED = """
struct Given { glow: f32 }
@group(0) @binding(0) var<uniform> given: Given;
@fragment fn main(@builtin(position) at: vec4f) -> @location(0) vec4f {
  return vec4f(given.glow, floor(at.x), floor(at.y), 1);
}"""
DOUBLED = """
@group(0) @binding(0) var<storage, read_write> numbers: array<f32>;
@compute @workgroup_size(2) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x < 3) { numbers[id.x] = 2 * f32(id.x); }
}"""
ADDED = """
@group(0) @binding(0) var filled: texture_2d<f32>;
@group(0) @binding(1) var before: texture_2d<f32>;
@group(0) @binding(2) var<storage, read> numbers: array<f32>;
@fragment fn main(@builtin(position) at: vec4f) -> @location(0) vec4f {
  let texel = vec2i(at.xy);
  return textureLoad(filled, texel, 0) + 0.5 * textureLoad(before, texel, 0) + vec4f(numbers[2]);
}"""


NOWHERE = {"file": "hand.burnish", "line": 1, "column": 1, "length": 1}
"""The place of everything: no file has it."""
WAITS: Document = {"barriers": [], "buffer_barriers": []}
"""A step of a host for WebGPU, where devices wait by themselves."""
TARGET = {
    "name": "color", "representation": "vec4", "location": 0, "format": "rgba32float",
    "encoding": "linear", "blend": None, "mask": "rgba", "clear": None, "doc": "",
}  # fmt: skip
NUMBERS: Document = {
    "name": "numbers", "type": "float[]", "representation": "float[]", "group": "material",
    "stride": 4, "layout": {"stored": "float", "kind": "float", "lanes": 1}, "members": [],
    "structs": [], "doc": "",
}  # fmt: skip
LOADED = {"texture": {"viewDimension": "2d", "sampleType": "unfilterable-float"}}
"""The layout of a texture that nothing filters."""


def package() -> Document:
    """A frame that adds what it fills, half of what it has drawn before, and what a kernel writes.

    What is filled is three in the first lane, and its column and row in the next ones.
    """
    return {
        "package": 2, "plan": _plan(), "shaders": [_filled(), _doubled(), _added()],
        "size": [WIDTH, HEIGHT], "formats": ["rgba32float"] * 4, "pipelines": [
            {"shader": 0, "targets": ["rgba32float"], "depth": None},
            {"shader": 1, "targets": [], "depth": None},
            {"shader": 2, "targets": ["rgba32float"], "depth": None},
        ],
        "camera": {"view_projection": [], "eye": [0, 0, 0]}, "values": {"glow": 3},
        "roles": {"size": "size"}, "models": [], "geometries": [], "given": [],
        "textures": {}, "buffers": {}, "pictures": [],
    }  # fmt: skip


# --- the plan ------------------------------------------------------------------------------------


def _plan() -> Document:
    return {
        "plan": 2, "frame": "ByHand", "doc": "", "source": NOWHERE, "rig": "Daylight",
        "lights": [], "host_textures": [], "host_buffers": [], "sources": {}, "models": [],
        "parameters": [_parameter("size", "ivec2", 2), _parameter("glow", "float", 1)],
        "shaders": [_shader_row(name) for name in ("Filled", "Doubled", "Added")],
        "values": [
            {"representation": "ivec2", "steps": _parameter_steps("ivec2", "size")},
            {"representation": "int", "steps": _constant(3)},
            {"representation": "float", "steps": _parameter_steps("float", "glow")},
        ],
        "textures": [_texture() for _ in range(4)],
        "results": [],
        "steps": [
            _drawn("filled", 0, 0, [_given("glow", "value", value=2)]),
            {
                "kind": "copy", "copied": {"result": "filled.color", "texture": 0},
                "into": {"result": "filled.color", "texture": 1}, "only_first": False, **WAITS,
            },
            {
                "kind": "run", "name": "doubled", "only_first": False,
                "use": {"material": None, "shader": 1, "inputs": []},
                "images": [], "buffers": [{"name": "numbers", "result": "doubled.numbers"}],
                "source": NOWHERE, **WAITS,
            },
            _drawn("added", 2, 2, [
                _given("filled", "result", result="filled.color", texture=1),
                _given("before", "previous", previous="added.color", texture=3, initially=None),
                _given("numbers", "result", result="doubled.numbers", texture=None),
            ]),
        ],
        "end": WAITS,
        "kept": [{"result": "added.color", "texture": 2, "previous": 3}],
        "outputs": [
            {
                "name": "picture", "result": "added.color", "texture": 2, "doc": "",
                "source": NOWHERE,
            },
        ],
    }  # fmt: skip


def _shader_row(name: str) -> Document:
    return {"name": name, "reflection": f"{name}.json", "pass": None, "rig": None}


def _drawn(name: str, shader: int, texture: int, inputs: list[Document]) -> Document:
    """A step that draws a single vertex's primitive with a shader."""
    target = {
        "name": "color", "result": f"{name}.color", "texture": texture, "layer": 0, "level": 0,
        "load": "clear", "clear": None, "store": True, "resolve": None, "over": None,
        "stencil": None,
    }  # fmt: skip
    use = {"material": None, "shader": shader, "inputs": inputs}
    draw = {"models": None, "vertices": 1, "light": None, "uses": [use]}
    return {
        "kind": "draw", "name": name, "pass": "Hand", "only_first": False, "targets": [target],
        "depth": None, "viewport": None, "scissor": None, "blend_constant": None,
        "draws": [draw], "source": NOWHERE, "continues": False, **WAITS,
    }  # fmt: skip


def _given(name: str, kind: str, **source: Any) -> Document:
    return {"name": name, "source": {"kind": kind, **source}}


def _texture() -> Document:
    return {
        "format": "rgba32float", "dimension": "2d", "layers": 1, "levels": 1, "samples": 1,
        "uses": [], "kept": False, "results": [],
        "size": {"value": 0, "extent_of": None, "level": 0},
    }  # fmt: skip


def _constant(value: int) -> list[Document]:
    return [{"op": "constant", "type": "int", "value": value, "args": []}]


def _parameter_steps(type_: str, name: str) -> list[Document]:
    return [{"op": "parameter", "type": type_, "parameter": name, "args": []}]


def _parameter(name: str, representation: str, lanes: int, **further: Any) -> Document:
    kind = "int" if representation[0] == "i" else "float"
    return {
        "name": name, "type": representation, "representation": representation, "range": None,
        "default": None, "doc": "", "library": None, "role": None, "group": "material",
        "block": None, "offset": None, "size": 4 * lanes, "count": None, "members": [],
        "layout": {"stored": representation, "kind": kind, "lanes": lanes}, **further,
    }  # fmt: skip


# --- shaders -------------------------------------------------------------------------------------


def _filled() -> Document:
    members = [{"name": "glow", "type": "float", "offset": 0, "size": 4, "parameter": "glow"}]
    members += [
        {"name": f"pad_{n}", "type": "float", "offset": 4 * n, "size": 4, "parameter": None}
        for n in range(1, 4)
    ]
    block = {
        "name": "Given", "group": "material", "derived": False, "extern": False, "size": 16,
        "stages": ["fragment"], "layout_id": "0", "members": members, "structs": [],
    }  # fmt: skip
    return _shader(
        {"vertex": CORNERS, "fragment": FILLED},
        {"blocks": {"Given": {**_place(0), "members": {"glow": "glow"}}}},
        [_slot(0, "block", "Given", FRAGMENT, buffer={})],
        blocks=[block], targets=[TARGET],
        parameters=[_parameter("glow", "float", 1, block="Given", offset=0, range=[0, 10])],
    )  # fmt: skip


def _doubled() -> Document:
    return _shader(
        {"compute": DOUBLED}, {"buffers": {"numbers": _place(0)}},
        [_slot(0, "buffer", "numbers", COMPUTE, buffer={"type": "storage"})],
        work_group=[2, 1, 1], extent=_constant(3),
        results=[{**NUMBERS, "count": _constant(3), "scattered": None, "initial": None}],
    )  # fmt: skip


def _added() -> Document:
    return _shader(
        {"vertex": CORNERS, "fragment": ADDED},
        {"textures": {"filled": _place(0), "before": _place(1)}, "buffers": {"numbers": _place(2)}},
        [
            _slot(0, "texture", "filled", FRAGMENT, **LOADED),
            _slot(1, "texture", "before", FRAGMENT, **LOADED),
            _slot(2, "buffer", "numbers", FRAGMENT, buffer={"type": "read-only-storage"}),
        ],
        parameters=[_parameter("count", "int", 1)], targets=[TARGET],
        buffers=[{**NUMBERS, "count": "count", "stages": ["fragment"]}],
        textures=[_texture_row("filled"), _texture_row("before")],
    )  # fmt: skip


def _shader(
    texts: dict[str, str], backend: Document, slots: list[Document], **further: Any
) -> Document:
    given = {stage: {"text": text, "entry": "main"} for stage, text in texts.items()}
    empty: Document = {
        kind: {} for kind in ("values", "roles", "lights", "textures", "texture_roles", "buffers")
    }
    pipeline = {
        "groups": [slots], "buffers": [], "targets": [{"writeMask": 15}],
        "primitive": {"topology": "triangle-list"},
        "depthStencil": {"depthWriteEnabled": True, "depthCompare": "less"},
    }  # fmt: skip
    return {
        "reflection": {**_REFLECTION, "backends": {PROFILE: {**_BACKEND, **backend}}, **further},
        "texts": {PROFILE: given}, "levels": None, "webgpu": pipeline, **empty,
    }  # fmt: skip


_REFLECTION: Document = {
    "format": 3, "material": "Hand", "pass": "Hand", "rig": "Daylight", "doc": "",
    "conventions": {
        "clip_space": "x right, y up, z in 0..w", "handedness": "right", "front_face": "ccw",
        "texture_origin": "top_left", "matrices": "column",
    },
    "blocks": [], "parameters": [], "derived": [], "promises": [], "lights": [], "buffers": [],
    "results": [], "extent": None, "work_group": None, "textures": [], "samplers": [],
    "draw": {
        "primitive": "triangle", "corners": 3, "expanded_by": None, "vertices": None,
        "topology": "triangle-list", "tessellation": None, "layers": None,
    },
    "invariant_position": False,
    "render_state": {
        "samples": 1, "alpha_to_coverage": False, "cull": "none", "front": "ccw", "fill": "faces",
        "stencil": None,
        "depth": {
            "compare": "less", "write": True, "clear": 1, "bias": 0, "slope_bias": 0,
            "bias_clamp": 0,
        },
    },
    "capture": None, "vertex_inputs": [], "pipeline_inputs": {}, "varyings": [], "targets": [],
}  # fmt: skip
_BACKEND: Document = {
    "language": "wgsl", "source_maps": {}, "clip_depth": "0..1", "clip_control": [],
    "flip_y": False, "front_face": "ccw", "first_row": "top", "files": [], "blocks": {},
    "buffers": {}, "images": {}, "textures": {}, "samplers": {}, "layouts": [],
    "binding_id": "0", "vertex_inputs": {},
    "stream_output": None, "captures": {}, "host_uniforms": [], "required_limits": {},
}  # fmt: skip


def _place(binding: int) -> Document:
    return {"identifier": "", "group": 0, "binding": binding, "register": None}


def _slot(binding: int, kind: str, name: str, stage: int, **layout: Any) -> Document:
    """A binding at a place, for the stages with these bits."""
    place = {"binding": binding, "visibility": stage, **layout}
    return {"kind": kind, "name": name, "number": 0, "layout": place}


def _texture_row(name: str) -> Document:
    layout = {"viewDimension": "2d", "sampleType": "unfilterable-float", "sampler": None}
    return {
        "name": name, "type": "texture2d", "dimension": "2d", "sample": "float", "intent": "data",
        "layout": layout, "group": "material", "default": "white",
        "default_texel": [1, 1, 1, 1], "stages": ["fragment"], "doc": "", "library": None,
        "brought": False,
    }  # fmt: skip
