"""Finds how a texture's sampler works: it compares depths, and filters other textures."""

from __future__ import annotations

from ...compiler.ir.leaves import Texture
from ...compiler.ir.types import TextureType
from ...stdlib.builtins.row import SamplerUse


def texture_type(texture: Texture) -> TextureType:
    """The type of a texture. All textures are textures."""
    assert isinstance(texture.type, TextureType)
    return texture.type


def sampler_use(texture: Texture) -> SamplerUse:
    """The use of a texture's sampler: it filters or compares."""
    return "comparison" if texture_type(texture).sample == "depth" else "filtering"
