"""Finds how a texture's sampler works: it compares depths, and filters other textures."""

from __future__ import annotations

from ...compiler.ir.leaves import Resource
from ...compiler.ir.types import Texture
from ...stdlib.builtins.row import SamplerUse


def texture_type(resource: Resource) -> Texture:
    """The type of a resource. All resources are textures."""
    assert isinstance(resource.type, Texture)
    return resource.type


def sampler_use(resource: Resource) -> SamplerUse:
    """The use of a texture's sampler: it filters or compares."""
    return "comparison" if texture_type(resource).sample == "depth" else "filtering"
