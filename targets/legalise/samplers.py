"""Finds how a texture's sampler works, and which textures share one.

A sampler compares depths, and filters other textures. ``bindings.py`` and ``limits.py`` ask.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping

from ...compiler.ir.leaves import Texture
from ...compiler.ir.program import Program, Stage
from ...compiler.ir.types import TextureType
from ...stdlib.builtins.row import SamplerUse
from ..description.profile import Profile


def texture_type(texture: Texture) -> TextureType:
    """The type of a texture. All textures are textures."""
    assert isinstance(texture.type, TextureType)
    return texture.type


def sampler_use(texture: Texture) -> SamplerUse:
    """The use of a texture's sampler: it filters or compares."""
    return "comparison" if texture_type(texture).sample == "depth" else "filtering"


def sampler_owners(program: Program, profile: Profile) -> Mapping[str, str]:
    """The texture whose sampler reads each texture, by name: mostly its own.

    If a stage reads more textures than every device of the profile has samplers, all textures of
    the program whose samplers have the same state share that of the first one. A program that does
    not need it keeps a sampler for each texture, and its bindings.
    """
    is_apart = not profile.samplers.combined
    is_shared = is_apart and any(
        len(_sampled(stage)) > profile.limits.samplers for stage in program.stages
    )
    first: dict[Hashable, str] = {}
    sampled = program.sampled
    return {
        texture.name: first.setdefault(_kind(texture), texture.name) if is_shared else texture.name
        for texture in program.textures
        if texture in sampled
    }


def sampler_count(stage: Stage, owners: Mapping[str, str]) -> int:
    """The number of samplers that a stage reads textures by."""
    return len({owners[texture.name] for texture in _sampled(stage)})


def _sampled(stage: Stage) -> frozenset[Texture]:
    return frozenset(read.texture for read in stage.reads if read.samples)


def _kind(texture: Texture) -> Hashable:
    """All that tells samplers apart."""
    return sampler_use(texture), texture.state
