"""The textures' side of the reflection, with the entry of a WebGPU layout for each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ..documents.drawing import SamplerRow, SamplerState, TextureLayout, TextureRow
from ..ir.default_textures import OF_SAMPLES
from ..ir.leaves import Texture
from ..ir.program import Program
from ..ir.shader import TextureInfo
from ..ir.texture_bindings import SamplerType, SampleType, sample_type, sampler_type
from ..ir.types import TextureType


class TextureRows:
    """Describes the declared textures of one program, and their samplers."""

    def __init__(self, infos: Sequence[TextureInfo], program: Program) -> None:
        self._infos = infos
        self._stages = {stage.name: frozenset(stage.textures) for stage in program.stages}
        self._loaded = frozenset(program.textures) - program.sampled

    def textures(self) -> tuple[TextureRow, ...]:
        """A row for each declared texture."""
        return tuple(map(self._row, self._infos))

    def samplers(self) -> tuple[SamplerRow, ...]:
        """The states of all samplers, by texture."""
        return tuple(
            SamplerRow(texture=info.leaf.name, state=sampler_state(info.leaf))
            for info in self._infos
            if self._has_sampler(info.leaf)
        )

    def _row(self, info: TextureInfo) -> TextureRow:
        texture, type_ = info.leaf, _type(info.leaf)
        return TextureRow(
            name=texture.name,
            type=str(type_),
            dimension=type_.dimension,
            sample=type_.sample,
            intent=info.intent or "data",
            layout=TextureLayout(
                view_dimension=type_.dimension,
                sample_type=self._sample_type(texture),
                sampler=self._sampler_type(texture),
            ),
            group=texture.group,
            default=texture.default,
            default_texel=OF_SAMPLES[type_.sample][texture.default],
            stages=tuple(name for name, read in self._stages.items() if texture in read),
            doc=info.doc,
            library=info.library or None,
            declared_by=info.declared_by or None,
            brought=info.is_brought,
        )

    def _has_sampler(self, texture: Texture) -> bool:
        """True if a host has to make a sampler: not for textures that are only loaded."""
        return bool(texture.state) and texture not in self._loaded

    def _sampler_type(self, texture: Texture) -> SamplerType | None:
        """GPUSamplerBindingType."""
        return sampler_type(texture) if self._has_sampler(texture) else None

    def _sample_type(self, texture: Texture) -> SampleType:
        """GPUTextureSampleType."""
        return sample_type(texture, is_filtered=self._has_sampler(texture))


def _type(texture: Texture) -> TextureType:
    assert isinstance(texture.type, TextureType)
    return texture.type


def sampler_state(texture: Texture) -> SamplerState:
    state: dict[str, Any] = dict(texture.state)
    if "anisotropy" in state:
        state["anisotropy"] = int(state["anisotropy"])
    return SamplerState(**{"compare": None, **state})
