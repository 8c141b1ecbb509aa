"""Makes the descriptors of a pipeline of WebGPU, which a host hands over as they are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ...compiler.documents.drawing import TargetRow
from ...compiler.documents.writing import to_json
from ..model import Bound, Material, Profile

PROFILE = "wgsl:webgpu"
_STAGES = {"vertex": 1, "fragment": 2, "compute": 4}
_MASK = {"r": 1, "g": 2, "b": 4, "a": 8}


def sampler(material: Material, texture: str) -> Mapping[str, Any] | None:
    """The sampler of a texture as a ``GPUSamplerDescriptor``; none if nothing reads it."""
    rows = (each for each in material.reflection.samplers if each.texture == texture)
    if (row := next(rows, None)) is None:
        return None
    state = to_json(row.state)
    found: dict[str, Any] = {"magFilter": state["filter"], "minFilter": state["filter"]}
    if state["mip"] != "none":
        found["mipmapFilter"] = state["mip"]
    else:
        found["lodMaxClamp"] = 0
    for axis in "uvw":
        found[f"addressMode{axis.upper()}"] = state.get(f"wrap_{axis}", state["wrap"])
    if state.get("compare") is not None:
        found["compare"] = state["compare"]
    if "anisotropy" in state:
        found["maxAnisotropy"] = state["anisotropy"]
    return found


def pipeline(material: Material) -> Mapping[str, Any]:
    """The descriptors of a material's pipeline."""
    profile = next(each for each in material.profiles if each.name == PROFILE)
    state = to_json(material.reflection.render_state)
    topology = to_json(material.reflection.draw)["topology"]
    return {
        "bindGroupLayouts": list(_groups(material, profile)),
        "vertexBuffers": list(_buffers(material)),
        "targets": [_target(row) for row in material.reflection.targets],
        "primitive": {
            "topology": topology, "frontFace": profile.row.front_face, "cullMode": state["cull"],
        },
        "depthStencil": _depth_stencil(state, topology),
        "multisample": {
            "count": state["samples"], "alphaToCoverageEnabled": state["alpha_to_coverage"],
        },
    }  # fmt: skip


def _groups(material: Material, profile: Profile) -> Iterator[Mapping[str, Any]]:
    """The layouts of bind groups by their numbers; a number that is left out has no entries."""
    last = max((each.group or 0 for each in profile.bound), default=-1)
    for number in range(last + 1):
        bound = [each for each in profile.bound if (each.group or 0) == number]
        yield {"entries": [_entry(material, each) for each in bound]}


def _entry(material: Material, bound: Bound) -> Mapping[str, Any]:
    visibility = sum(_STAGES.get(stage, 0) for stage in bound.stages)
    return {"binding": bound.binding, "visibility": visibility, **_resource(material, bound)}


def _resource(material: Material, bound: Bound) -> Mapping[str, Any]:
    if bound.kind in ("uniform", "storage", "result"):
        size = {"minBindingSize": bound.size} if bound.size and not bound.is_shared else {}
        return {"buffer": {"type": bound.type, **size}}
    if bound.kind == "image":
        (row,) = [each for each in material.reflection.targets if each.name == bound.name]
        return {"storageTexture": {"access": "write-only", "format": to_json(row)["format"]}}
    (texture,) = [each for each in material.reflection.textures if each.name == bound.name]
    layout = to_json(texture.layout)
    if bound.kind == "sampler":
        return {"sampler": {"type": bound.type}}
    return {"texture": {"sampleType": bound.type, "viewDimension": layout["viewDimension"]}}


def _buffers(material: Material) -> Iterator[Mapping[str, Any]]:
    """The layouts of vertex buffers, with a buffer for each input."""
    for row in material.reflection.vertex_inputs:
        if row.format is not None and row.location is not None:
            lanes = int(row.format.partition("x")[2] or 1)
            attribute = {"format": row.format, "offset": 0, "shaderLocation": row.location}
            yield {"arrayStride": 4 * lanes, "stepMode": row.step, "attributes": [attribute]}


def _target(row: TargetRow) -> Mapping[str, Any]:
    found = to_json(row)
    mask = sum(_MASK.get(letter, 0) for letter in row.mask) if row.mask != "none" else 0
    state: dict[str, Any] = {"format": found["format"], "writeMask": mask}
    if found["blend"] is not None:
        state["blend"] = {part: _equation(found["blend"][part]) for part in ("color", "alpha")}
    return state


def _equation(equation: Mapping[str, str]) -> Mapping[str, str]:
    source, destination = equation["source"], equation["destination"]
    return {"srcFactor": source, "dstFactor": destination, "operation": equation["operation"]}


def _depth_stencil(state: Mapping[str, Any], topology: str) -> Mapping[str, Any] | None:
    """The state of depths and of the stencil, without a format; none if neither is used."""
    depth, stencil = state["depth"], state["stencil"]
    if stencil is None and depth["compare"] == "always" and not depth["write"]:
        return None
    found: dict[str, Any] = {
        "depthCompare": depth["compare"], "depthWriteEnabled": depth["write"],
    }  # fmt: skip
    if topology.startswith("triangle") and (depth["bias"] or depth["slope_bias"]):
        found["depthBias"] = depth["bias"]
        found["depthBiasSlopeScale"] = depth["slope_bias"]
        found["depthBiasClamp"] = depth["bias_clamp"]
    if stencil is not None:
        found["stencilFront"] = _side(stencil["front"])
        found["stencilBack"] = _side(stencil["back"])
        found["stencilReadMask"] = stencil["read_mask"]
        found["stencilWriteMask"] = stencil["write_mask"]
    return found


def _side(side: Mapping[str, str]) -> Mapping[str, str]:
    return {
        "compare": side["compare"], "failOp": side["fail_op"],
        "depthFailOp": side["depth_fail_op"], "passOp": side["pass_op"],
    }  # fmt: skip
