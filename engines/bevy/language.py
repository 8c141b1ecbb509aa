"""WGSL as Bevy 0.19 composes it: names that it imports, or has itself, stay free."""

from __future__ import annotations

from functools import cache

from ...compiler.ir.types import TEXTURES
from ...support.frozen import changed
from ...targets import registry
from ...targets.description.profile import Profile
from ...targets.description.reserved import Reserved
from ...targets.description.shading_language import Language
from ..values import Between
from .values import MODULES, TABLES

OWN = frozenset({
    *MODULES, "FragmentOutput", "Vertex", "VertexOutput", "coverage", "fragment", "out",
    "parameters", "pbr_input", "pixel", "vertex",
})  # fmt: skip
"""What the files have beside the functions. Imports are found by their names alone, anywhere."""

HANDED = tuple(row.name for row in TABLES.at_pixels.values() if isinstance(row, Between))
"""Names of values between vertices and pixels that are not the material's own."""


@cache
def language() -> tuple[Language, Profile]:
    """The language, and its only profile."""
    wgsl, webgpu = registry.select("wgsl")
    profile = changed(
        webgpu,
        name="bevy",
        doc="WGSL in extensions of Bevy's standard material.",
        textures=frozenset(each for each in TEXTURES if each.sample != "depth"),
        checkers=(),
    )
    fixed = (*wgsl.fixed_names, *HANDED)
    own = changed(wgsl, name="bevy", reserved=_reserved, profiles=(profile,), fixed_names=fixed)
    return own, profile


def _reserved() -> Reserved:
    """The words of WGSL, and those of the files."""
    wgsl, _profile = registry.select("wgsl")
    words = wgsl.reserved()
    return Reserved(words.words | OWN, words.pattern)
