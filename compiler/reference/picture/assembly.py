"""Primitive assembly: turns the vertices of a picture into faces.

``drawing.py`` calls ``faces_of`` after the vertex stage, and so does the explanation of a pixel.
"""

from __future__ import annotations

import numpy as np

from ...ir.render_state import RenderState
from .bias import biased
from .edges import edges_of
from .faces import Faces, culled, triangles_of
from .lines import lines_of
from .scene import Floats, Ints, RasterRules

LINE = 2
"""The vertices of a line."""
USUAL = RenderState()
"""The state for a pass that says nothing."""


def faces_of(
    positions: Floats,
    primitives: Ints,
    rules: RasterRules,
    off: Floats | None = None,
    state: RenderState = USUAL,
) -> Faces:
    """The faces of triangles or lines whose vertices have these clip positions, (vertices, 4).

    ``off`` says by how much a device's positions may differ. Triangles are culled and moved away
    from the eye as the pass asks for, and their edges are drawn or all of them; a line has no back,
    and stays where it is.
    """
    known = np.zeros_like(positions) if off is None else off
    if primitives.shape[1] == LINE:
        return lines_of(positions, primitives, rules, known)
    triangles = triangles_of(positions, primitives, rules, known, state.front)
    moved = culled(biased(triangles, state.depth), state.cull)
    if state.fill == "lines":
        return edges_of(moved, culled(triangles, state.cull), positions, rules, known)
    return moved
