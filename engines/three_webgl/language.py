"""GLSL ES 3.00 as ``WebGLRenderer`` takes it: loose uniforms, and three.js's names for its own.

It is no target: the texts have no line with the version, which three.js writes.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from ...support.frozen import changed
from ...targets import registry
from ...targets.description.profile import Profile
from ...targets.description.shading_language import Language

ATTRIBUTES: Mapping[str, str] = {
    "vertex_position": "position",
    "vertex_normal": "normal",
    "vertex_tangent": "tangent",
    "vertex_uv": "uv",
    "vertex_uv2": "uv1",
    "vertex_color": "color",
    "vertex_joints": "skinIndex",
    "vertex_weights": "skinWeight",
}
"""The names of a geometry's attributes, by those of vertex inputs; others keep their names."""

UNIFORMS: Mapping[str, str] = {"object_to_world": "modelMatrix", "eye": "cameraPosition"}
"""The names of the renderer's own uniforms, by those of parameters."""


@cache
def language() -> tuple[Language, Profile]:
    """The language, and its only profile."""
    glsl, es = registry.select("glsl:es300")
    assert es.types is None
    profile = changed(
        es,
        name="three",
        doc="GLSL ES 3.00 for three.js's WebGLRenderer.",
        preamble=es.preamble[1:],
        # three.js sets square matrices only. A stored matrix of two or three columns has more rows
        # than are read, so a square one has all of them.
        types=changed(glsl.types, rectangular_matrix="mat{columns}"),
        forms=changed(glsl.forms, product_of_stored="vec4({matrix:factor} * {vector:p}, {zeros})"),
        rectangular_matrices=False,
        skeleton=glsl.skeleton.with_name("loose.glsl.j2"),
        loose_uniforms=True,
        attributes_of_floats=True,
        checkers=(),
    )
    own = changed(glsl, profiles=(profile,), host_names={**ATTRIBUTES, **UNIFORMS})
    return own, profile
