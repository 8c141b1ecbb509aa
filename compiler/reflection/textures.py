"""The textures' side of the reflection, with the entry of a WebGPU layout for each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

from ..documents.drawing import SamplerRow, SamplerState, TextureLayout, TextureRow
from ..ir.default_textures import OF_SAMPLES
from ..ir.leaves import Texture
from ..ir.program import Program
from ..ir.shader import TextureInfo
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

    def _sampler_type(
        self, texture: Texture
    ) -> Literal["filtering", "non-filtering", "comparison"] | None:
        """GPUSamplerBindingType."""
        if not self._has_sampler(texture):
            return None
        if _type(texture).sample == "depth":
            return "comparison"
        return "filtering" if _filters(texture) else "non-filtering"

    def _sample_type(
        self, texture: Texture
    ) -> Literal["float", "unfilterable-float", "depth", "sint", "uint"]:
        """GPUTextureSampleType; a texture that nothing filters may have an unfilterable format."""
        match _type(texture).sample:
            case "int":
                return "sint"
            case "float":
                filtered = self._has_sampler(texture) and _filters(texture)
                return "float" if filtered else "unfilterable-float"
            case other:
                return other


def _type(texture: Texture) -> TextureType:
    assert isinstance(texture.type, TextureType)
    return texture.type


def sampler_state(texture: Texture) -> SamplerState:
    state: dict[str, Any] = dict(texture.state)
    if "anisotropy" in state:
        state["anisotropy"] = int(state["anisotropy"])
    return SamplerState(**{"compare": None, **state})


def _filters(texture: Texture) -> bool:
    state = dict(texture.state)
    return "linear" in (state["filter"], state["mip"])
