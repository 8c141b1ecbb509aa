"""What the sampler of a texture does, which follows from what the texture holds."""

from __future__ import annotations

from ...compiler.ir.leaves import Resource
from ...compiler.ir.types import Texture
from ...stdlib.builtins.row import SamplerUse


def texture_type(resource: Resource) -> Texture:
    """The type of a resource. All resources are textures."""
    assert isinstance(resource.type, Texture)
    return resource.type


def sampler_use(resource: Resource) -> SamplerUse:
    """What the sampler of a texture does."""
    return "comparison" if texture_type(resource).sample == "depth" else "filtering"
