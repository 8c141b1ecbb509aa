"""GLSL as Filament's material definitions have it: ES 3.00 on phones, 4.1 and 4.5 elsewhere."""

from __future__ import annotations

from functools import cache

from ...compiler.ir.types import TEXTURES
from ...support.frozen import changed
from ...targets import registry
from ...targets.description.profile import Profile
from ...targets.description.reserved import Reserved
from ...targets.description.shading_language import Language
from .values import HELPERS, TABLES

MACROS = frozenset(
    f"{kind}{lanes}" for kind in ("bool", "int", "uint", "float") for lanes in (2, 3, 4)
) | {"float3x3", "float4x4", "saturate", "saturateMediump", "atan2", "sq"}
"""What Filament's own text defines as macros, or would be hidden from it."""
OWN = frozenset(call.partition("(")[0] for call in HELPERS)
"""The functions of definitions that are not the material's."""


@cache
def language() -> tuple[Language, Profile]:
    """The language, and its only profile."""
    glsl, es = registry.select("glsl:es300")
    profile = changed(
        es,
        name="filament",
        doc="GLSL in material definitions of Filament.",
        textures=frozenset(
            each for each in TEXTURES if each.sample != "depth" and each.dimension != "cube_array"
        ),
        checkers=(),
    )
    own = changed(
        glsl, name="filament", reserved=_reserved, profiles=(profile,), fixed_names=TABLES.variables
    )
    return own, profile


def _reserved() -> Reserved:
    """The words of GLSL, and those of Filament; its constants are capitals, such as ``PI``."""
    import re

    glsl, _profile = registry.select("glsl:es300")
    return Reserved(glsl.reserved().words | MACROS | OWN, re.compile("[A-Z][A-Z0-9_]*$|gl_|__"))
