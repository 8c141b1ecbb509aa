"""Explains a pixel of a scene: where its error comes from in the source.

``conform`` asks for it, for the pixels that people ask about and for those that prove little.
"""

from __future__ import annotations

from ...compiler.ir.shader import Shader
from ...compiler.reference.attribution import Explanation, explain
from ...compiler.reference.bounds import Errors
from ...compiler.reference.picture import RasterRules
from .reference import geometry_for, texels_of, values_for
from .scene_state import SceneState


def explained(
    shader: Shader, state: SceneState, rules: RasterRules, errors: Errors, x: int, y: int
) -> Explanation:
    """Explain the pixel (x, y) of the picture that ``reference.expected`` draws.

    Raises ``UncoveredError`` if nothing is drawn there.
    """
    return explain(
        shader,
        values_for(shader, state.instance),
        texels_of(state.instance),
        geometry_for(shader, state.geometry()),
        rules,
        errors,
        x,
        y,
    )
