"""Godot's shading language: GLSL ES 3.00 with names of its own, and without what that has beside.

It is no target of whole shaders: Godot writes the stages, and takes functions.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

from ...compiler.ir.types import TEXTURES
from ...support.frozen import changed
from ...targets import registry
from ...targets.description.profile import Profile
from ...targets.description.reserved import Reserved, read_reserved
from ...targets.description.shading_language import Language
from ...targets.description.spellings import Read, Spellings
from .values import TABLES

CONSTANTS = "[A-Z][A-Z0-9_]*$"
"""A pattern of the names of Godot's own values: ``ALBEDO``, ``UV2``, ``PI``. None can be hidden."""

NATIVES: Spellings = {
    # Both operands of an operator have one type.
    "shift_left": "({0:p} << {type}({1}))",
    "shift_right": "({0:p} >> {type}({1}))",
    # A constructor takes no lanes of another kind.
    "sample": Read("texture({0}, {1})", "texture({0}, vec3({1}, float({2})))"),
    "sample_bias": Read("texture({0}, {1}, {2})", "texture({0}, vec3({1}, float({2})), {3})"),
    "sample_level": Read(
        "textureLod({0}, {1}, {2})", "textureLod({0}, vec3({1}, float({2})), {3})"
    ),
    "sample_grad": Read(
        "textureGrad({0}, {1}, {2}, {3})", "textureGrad({0}, vec3({1}, float({2})), {3}, {4})"
    ),
}


@cache
def language() -> tuple[Language, Profile]:
    """The language, and its only profile."""
    glsl, es = registry.select("glsl:es300")
    profile = changed(
        es,
        name="godot",
        doc="Godot's shading language.",
        # There are no depths to compare with, and no arrays of cubes on all renderers.
        textures=frozenset(
            each for each in TEXTURES if each.sample != "depth" and each.dimension != "cube_array"
        ),
        rectangular_matrices=False,
        natives={**es.natives, **NATIVES},
        checkers=(),
    )
    own = changed(
        glsl, name="godot", reserved=_reserved, profiles=(profile,), fixed_names=TABLES.variables
    )
    return own, profile


def _reserved() -> Reserved:
    """The words of both languages: a name must not hide a builtin function either."""
    glsl, _profile = registry.select("glsl:es300")
    own = read_reserved(Path(__file__).with_name("reserved.txt"), CONSTANTS)
    return Reserved(own.words | glsl.reserved().words, own.pattern)
