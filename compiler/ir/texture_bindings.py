"""The types of bindings of textures and samplers, in WebGPU's words.

The reflection says them of textures, and of the entries of bind groups.
"""

from __future__ import annotations

from typing import Literal

from .leaves import Texture
from .types import TextureType

SamplerType = Literal["filtering", "non-filtering", "comparison"]
SampleType = Literal["float", "unfilterable-float", "depth", "sint", "uint"]


def sampler_type(texture: Texture) -> SamplerType:
    """GPUSamplerBindingType of the sampler that a texture declares."""
    if _type(texture).sample == "depth":
        return "comparison"
    return "filtering" if _filters(texture) else "non-filtering"


def sample_type(texture: Texture, *, is_filtered: bool) -> SampleType:
    """GPUTextureSampleType; a texture that nothing filters may have an unfilterable format.

    ``is_filtered`` is True if a sampler reads the texture, whatever it does.
    """
    match _type(texture).sample:
        case "int":
            return "sint"
        case "float":
            filters = is_filtered and bool(texture.state) and _filters(texture)
            return "float" if filters else "unfilterable-float"
        case other:
            return other


def _filters(texture: Texture) -> bool:
    state = dict(texture.state)
    return "linear" in (state["filter"], state["mip"])


def _type(texture: Texture) -> TextureType:
    assert isinstance(texture.type, TextureType)
    return texture.type
