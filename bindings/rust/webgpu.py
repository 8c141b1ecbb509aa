"""The tables of a binding in the types of the crate ``wgpu``, for hosts that have it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from ...compiler.documents.writing import to_json
from ..model import Binding, Bound, Material
from ..naming import pascal
from ..printer import single
from ..spelling import Spelling

PROFILE = "wgsl:webgpu"
_SAMPLES = {
    "float": "Float { filterable: true }",
    "unfilterable-float": "Float { filterable: false }",
    "depth": "Depth", "uint": "Uint", "sint": "Sint",
}  # fmt: skip
_DIMENSIONS = {
    "1d": "D1", "2d": "D2", "2d-array": "D2Array", "3d": "D3", "cube": "Cube",
    "cube-array": "CubeArray",
}  # fmt: skip


def profile_of(material: Material) -> int | None:
    """The number of the profile that wgpu draws with; ``None`` without texts in WGSL."""
    names = [each.name for each in material.profiles]
    return names.index(PROFILE) if PROFILE in names else None


def sized_blocks(materials: Iterable[Material]) -> frozenset[str]:
    """The names of the blocks whose sizes are in layouts; those of shared groups name none."""
    return frozenset(
        row.name
        for material in materials
        for profile in material.profiles
        for row in profile.bound
        if profile.name == PROFILE and row.kind == "uniform" and not row.is_shared
    )


def groups(spelling: Spelling, material: Material) -> list[list[str]]:
    """The entries of each bind group of a material's WGSL; none without such texts."""
    bound = [
        row
        for each in material.profiles
        if each.name == PROFILE
        for row in each.bound
        if row.binding is not None
    ]
    last = max((row.group or 0 for row in bound), default=-1)
    found: list[list[str]] = [[] for _ in range(last + 1)]
    for row in bound:
        stages = ".union(".join(f"ShaderStages::{stage.upper()}" for stage in row.stages)
        stages += ")" * (len(row.stages) - 1)
        found[row.group or 0].append(
            f"entry({row.binding}, {stages}, {_type(spelling, material, row)})"
        )
    return found


def _type(spelling: Spelling, material: Material, row: Bound) -> str:
    """The call of the skeleton's that makes the type of what is bound."""
    if row.kind == "uniform":
        size = "0" if row.is_shared else f"size_of::<{spelling.type(row.name)}>()"
        return f"uniform({size})"
    if row.kind in ("storage", "result"):
        return f"storage({str(row.type == 'read-only-storage').lower()})"
    if row.kind == "image":
        (target,) = [each for each in material.reflection.targets if each.name == row.name]
        return f"image(TextureFormat::{_format(to_json(target)['format'])})"
    if row.kind == "sampler":
        return f"BindingType::Sampler(SamplerBindingType::{_words(row.type)})"
    dimension = _DIMENSIONS[_layouts(material)[row.name]["viewDimension"]]
    sample = _SAMPLES[row.type]
    return f"texture(TextureSampleType::{sample}, TextureViewDimension::{dimension})"


def _layouts(material: Material) -> Mapping[str, Any]:
    return {each.name: to_json(each.layout) for each in material.reflection.textures}


def _format(name: str) -> str:
    """The name of a format: ``Rgba8UnormSrgb`` of ``rgba8unorm-srgb``."""
    head = name.rstrip("abcdefghijklmnopqrstuvwxyz-")
    return pascal([head, *name[len(head) :].split("-")])


def formats(binding: Binding) -> Iterator[tuple[str, str]]:
    """The formats of the textures of all frames, in WebGPU's words and in wgpu's."""
    rows = (to_json(each.row) for frame in binding.frames for each in frame.textures)
    for name in sorted({row["format"] for row in rows}):
        yield name, _format(name)


def _words(name: str) -> str:
    return pascal(name.split("-"))


def vertex_buffers(material: Material) -> Iterator[str]:
    """The layouts of vertex buffers, with a buffer for each input."""
    for row in material.reflection.vertex_inputs:
        if row.format is not None and row.location is not None:
            lanes = int(row.format.partition("x")[2] or 1)
            yield (
                f"buffer({4 * lanes}, VertexStepMode::{row.step.capitalize()}, "
                f"&[attribute({row.location}, VertexFormat::{row.format.capitalize()})])"
            )


def targets(material: Material) -> Iterator[str]:
    """The states of render targets, in the formats that the material declares."""
    for row in material.reflection.targets:
        found = to_json(row)
        blend = "None"
        if found["blend"] is not None:
            color, alpha = (_equation(found["blend"][part]) for part in ("color", "alpha"))
            blend = f"Some(BlendState {{ color: {color}, alpha: {alpha} }})"
        yield (
            f"Some(ColorTargetState {{ format: TextureFormat::{_format(found['format'])}, "
            f"blend: {blend}, write_mask: ColorWrites::{_mask(row.mask)} }})"
        )


def _equation(equation: Mapping[str, str]) -> str:
    factors = (f"BlendFactor::{_words(equation[side])}" for side in ("source", "destination"))
    return f"equation({', '.join(factors)}, BlendOperation::{_words(equation['operation'])})"


def _mask(mask: str) -> str:
    """The lanes that are written: ``RED.union(ColorWrites::GREEN)``."""
    if mask in ("rgba", "none"):
        return {"rgba": "ALL", "none": "empty()"}[mask]
    first, *others = (_LANES[letter] for letter in mask)
    return first + "".join(f".union(ColorWrites::{each})" for each in others)


_LANES = {"r": "RED", "g": "GREEN", "b": "BLUE", "a": "ALPHA"}


def samplers(material: Material) -> Iterator[str]:
    """The descriptors of samplers, each with the name of its texture."""
    for row in material.reflection.samplers:
        members = ", ".join(_sampler(to_json(row.state)))
        yield f'("{row.texture}", SamplerDescriptor {{ {members} }})'


def _sampler(state: Mapping[str, Any]) -> Iterator[str]:
    yield "label: None"
    for axis in "uvw":
        wrap = _words(state.get(f"wrap_{axis}", state["wrap"]))
        yield f"address_mode_{axis}: AddressMode::{wrap}"
    for kind in ("mag", "min"):
        yield f"{kind}_filter: FilterMode::{_words(state['filter'])}"
    has_levels = state["mip"] != "none"
    mip = _words(state["mip"]) if has_levels else "Nearest"
    yield f"mipmap_filter: MipmapFilterMode::{mip}"
    yield f"lod_min_clamp: 0.0, lod_max_clamp: {'32.0' if has_levels else '0.0'}"
    compare = state.get("compare")
    yield f"compare: {f'Some(CompareFunction::{_words(compare)})' if compare else 'None'}"
    yield f"anisotropy_clamp: {state.get('anisotropy', 1)}"
    border = state.get("border")
    yield f"border_color: {f'Some(SamplerBorderColor::{_BORDERS[border]})' if border else 'None'}"


_BORDERS = {"transparent": "TransparentBlack", "black": "OpaqueBlack", "white": "OpaqueWhite"}


def state(material: Material) -> Mapping[str, str]:
    """The states of a pipeline, by the names of members."""
    row = to_json(material.reflection.render_state)
    depth, stencil = row["depth"], row["stencil"]
    profile = material.profiles[profile_of(material) or 0].row
    topology = to_json(material.reflection.draw)["topology"]
    cull = "None" if row["cull"] == "none" else f"Some(Face::{_words(row['cull'])})"
    fill = {"faces": "Fill", "lines": "Line"}[row["fill"]]
    has_bias = topology.startswith("triangle")
    bias, slope, clamp = (
        (depth["bias"], depth["slope_bias"], depth["bias_clamp"]) if has_bias else (0, 0.0, 0.0)
    )
    return {
        "primitive": (
            f"PrimitiveState {{ topology: PrimitiveTopology::{_words(topology)}, "
            f"strip_index_format: None, front_face: FrontFace::{_words(profile.front_face)}, "
            f"cull_mode: {cull}, unclipped_depth: false, polygon_mode: PolygonMode::{fill}, "
            "conservative: false }"
        ),
        "depth_stencil": (
            "DepthStencilState { format: TextureFormat::Depth32Float, "
            f"depth_write_enabled: Some({str(depth['write']).lower()}), "
            f"depth_compare: Some(CompareFunction::{_words(depth['compare'])}), "
            f"stencil: {_stencil(stencil)}, bias: DepthBiasState {{ constant: {bias}, "
            f"slope_scale: {single(slope)}, clamp: {single(clamp)} }} }}"
        ),
        "multisample": (
            f"MultisampleState {{ count: {row['samples']}, mask: !0, "
            f"alpha_to_coverage_enabled: {str(row['alpha_to_coverage']).lower()} }}"
        ),
    }


def _stencil(stencil: Mapping[str, Any] | None) -> str:
    if stencil is None:
        sides = "front: StencilFaceState::IGNORE, back: StencilFaceState::IGNORE"
        return f"StencilState {{ {sides}, read_mask: 0, write_mask: 0 }}"
    front, back = (_side(stencil[side]) for side in ("front", "back"))
    masks = f"read_mask: {stencil['read_mask']}, write_mask: {stencil['write_mask']}"
    return f"StencilState {{ front: {front}, back: {back}, {masks} }}"


def _side(side: Mapping[str, str]) -> str:
    operations = (side[f"{when}_op"] for when in ("fail", "depth_fail", "pass"))
    names = ", ".join(f"StencilOperation::{_words(each)}" for each in operations)
    return f"side(CompareFunction::{_words(side['compare'])}, {names})"
