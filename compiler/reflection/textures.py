"""The textures' side of the reflection, with what a WebGPU layout says of each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..ir.leaves import Resource
from ..ir.program import Program
from ..ir.shader import ResourceInfo
from ..ir.types import Texture


class TextureRows:
    """Describes the declared textures of one program, and their samplers."""

    def __init__(self, infos: Sequence[ResourceInfo], program: Program) -> None:
        self._infos = infos
        self._stages = {stage.name: frozenset(stage.resources) for stage in program.stages}
        self._loaded = frozenset(program.resources) - program.sampled

    def textures(self) -> list[dict[str, Any]]:
        """A row for each declared texture."""
        return [self._row(info) for info in self._infos]

    def samplers(self) -> list[dict[str, Any]]:
        """The states of all samplers, by texture."""
        return [
            {"texture": info.resource.name, "state": dict(info.resource.state)}
            for info in self._infos
            if self._has_sampler(info.resource)
        ]

    def _row(self, info: ResourceInfo) -> dict[str, Any]:
        resource, type_ = info.resource, _type(info.resource)
        return {
            "name": resource.name,
            "type": str(type_),
            "dimension": type_.dimension,
            "sample": type_.sample,
            "layout": {
                "viewDimension": type_.dimension.replace("_", "-"),
                "sampleType": self._sample_type(resource),
                "sampler": self._sampler_type(resource),
            },
            "group": resource.group,
            "default": resource.default,
            "stages": [name for name, read in self._stages.items() if resource in read],
            "doc": info.doc,
            "library": info.library or None,
            "brought": info.is_brought,
        }

    def _has_sampler(self, resource: Resource) -> bool:
        """Whether a host has to make one: not for textures that are only loaded."""
        return bool(resource.state) and resource not in self._loaded

    def _sampler_type(self, resource: Resource) -> str | None:
        """GPUSamplerBindingType."""
        if not self._has_sampler(resource):
            return None
        if _type(resource).sample == "depth":
            return "comparison"
        return "filtering" if _filters(resource) else "non-filtering"

    def _sample_type(self, resource: Resource) -> str:
        """GPUTextureSampleType: what is never filtered may have a format that cannot be."""
        match _type(resource).sample:
            case "int":
                return "sint"
            case "float":
                filtered = self._has_sampler(resource) and _filters(resource)
                return "float" if filtered else "unfilterable-float"
            case other:
                return other


def _type(resource: Resource) -> Texture:
    assert isinstance(resource.type, Texture)
    return resource.type


def _filters(resource: Resource) -> bool:
    state = dict(resource.state)
    return "linear" in (state["filter"], state["mip"])
