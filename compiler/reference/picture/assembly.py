"""Turns the vertices of a picture into faces, whatever primitives these make.

``drawing.py`` calls ``faces_of`` after the vertex stage, and so does what explains a pixel.
"""

from __future__ import annotations

import numpy as np

from ...ir.render_state import Cull
from .faces import Faces, culled, triangles_of
from .lines import lines_of
from .scene import Floats, Ints, RasterRules

LINE = 2
"""The vertices of a line."""


def faces_of(
    positions: Floats,
    primitives: Ints,
    rules: RasterRules,
    off: Floats | None = None,
    cull: Cull = "none",
) -> Faces:
    """The faces of triangles or lines whose vertices have these clip positions, (vertices, 4).

    ``off`` says by how much a device's positions may differ. Triangles of which the side is seen
    that ``cull`` names are left out; a line has no back.
    """
    known = np.zeros_like(positions) if off is None else off
    if primitives.shape[1] == LINE:
        return lines_of(positions, primitives, rules, known)
    return culled(triangles_of(positions, primitives, rules, known), cull)
