"""The textures' side of the reflection, with what a WebGPU layout says of each."""

from __future__ import annotations

from typing import Any

from ..ir.leaves import Resource
from ..ir.program import Program
from ..ir.shader import ResourceInfo
from ..ir.types import Texture


def texture_row(info: ResourceInfo, program: Program) -> dict[str, Any]:
    """One declared texture."""
    resource, type_ = info.resource, _type(info.resource)
    return {
        "name": resource.name,
        "type": str(type_),
        "dimension": type_.dimension,
        "sample": type_.sample,
        "layout": {
            "viewDimension": type_.dimension.replace("_", "-"),
            "sampleType": _sample_type(resource, program),
            "sampler": _sampler_type(resource, program),
        },
        "group": resource.group,
        "default": resource.default,
        "stages": [stage.name for stage in program.stages if resource in stage.resources],
        "doc": info.doc,
    }


def sampler_rows(infos: tuple[ResourceInfo, ...], program: Program) -> list[dict[str, Any]]:
    """The states of all samplers, by texture."""
    return [
        {"texture": info.resource.name, "state": dict(info.resource.state)}
        for info in infos
        if _has_sampler(info.resource, program)
    ]


def _type(resource: Resource) -> Texture:
    assert isinstance(resource.type, Texture)
    return resource.type


def _has_sampler(resource: Resource, program: Program) -> bool:
    """Whether a host has to make one: not for textures that are only loaded."""
    used = resource in program.resources
    return bool(resource.state) and (not used or resource in program.sampled)


def _filters(resource: Resource) -> bool:
    state = dict(resource.state)
    return "linear" in (state["filter"], state["mip"])


def _sampler_type(resource: Resource, program: Program) -> str | None:
    """GPUSamplerBindingType."""
    if not _has_sampler(resource, program):
        return None
    if _type(resource).sample == "depth":
        return "comparison"
    return "filtering" if _filters(resource) else "non-filtering"


def _sample_type(resource: Resource, program: Program) -> str:
    """GPUTextureSampleType: what is never filtered may have a format that cannot be."""
    match _type(resource).sample:
        case "int":
            return "sint"
        case "float":
            filtered = _has_sampler(resource, program) and _filters(resource)
            return "float" if filtered else "unfilterable-float"
        case other:
            return other
