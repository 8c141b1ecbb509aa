"""The textures' side of the reflection, with the entry of a WebGPU layout for each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

from ..documents.drawing import SamplerRow, SamplerState, TextureLayout, TextureRow
from ..ir.default_textures import OF_SAMPLES
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

    def textures(self) -> tuple[TextureRow, ...]:
        """A row for each declared texture."""
        return tuple(map(self._row, self._infos))

    def samplers(self) -> tuple[SamplerRow, ...]:
        """The states of all samplers, by texture."""
        return tuple(
            SamplerRow(texture=info.resource.name, state=_state(info.resource))
            for info in self._infos
            if self._has_sampler(info.resource)
        )

    def _row(self, info: ResourceInfo) -> TextureRow:
        resource, type_ = info.resource, _type(info.resource)
        return TextureRow(
            name=resource.name,
            type=str(type_),
            dimension=type_.dimension,
            sample=type_.sample,
            intent=info.intent or "data",
            layout=TextureLayout(
                view_dimension=type_.dimension,
                sample_type=self._sample_type(resource),
                sampler=self._sampler_type(resource),
            ),
            group=resource.group,
            default=resource.default,
            default_texel=OF_SAMPLES[type_.sample][resource.default],
            stages=tuple(name for name, read in self._stages.items() if resource in read),
            doc=info.doc,
            library=info.library or None,
            brought=info.is_brought,
        )

    def _has_sampler(self, resource: Resource) -> bool:
        """True if a host has to make a sampler: not for textures that are only loaded."""
        return bool(resource.state) and resource not in self._loaded

    def _sampler_type(
        self, resource: Resource
    ) -> Literal["filtering", "non-filtering", "comparison"] | None:
        """GPUSamplerBindingType."""
        if not self._has_sampler(resource):
            return None
        if _type(resource).sample == "depth":
            return "comparison"
        return "filtering" if _filters(resource) else "non-filtering"

    def _sample_type(
        self, resource: Resource
    ) -> Literal["float", "unfilterable-float", "depth", "sint", "uint"]:
        """GPUTextureSampleType; a texture that nothing filters may have an unfilterable format."""
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


def _state(resource: Resource) -> SamplerState:
    state: dict[str, Any] = dict(resource.state)
    return SamplerState(**{"compare": None, **state})


def _filters(resource: Resource) -> bool:
    state = dict(resource.state)
    return "linear" in (state["filter"], state["mip"])
