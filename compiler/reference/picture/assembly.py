"""Turns the vertices of a picture into faces, whatever primitives these make.

``drawing.py`` calls ``faces_of`` after the vertex stage, and so does what explains a pixel.
"""

from __future__ import annotations

import numpy as np

from .faces import Faces, triangles_of
from .lines import lines_of
from .scene import Floats, Ints, RasterRules

LINE = 2
"""The vertices of a line."""


def faces_of(
    positions: Floats, primitives: Ints, rules: RasterRules, off: Floats | None = None
) -> Faces:
    """The faces of triangles or lines whose vertices have these clip positions, (vertices, 4).

    ``off`` says by how much a device's positions may differ.
    """
    known = np.zeros_like(positions) if off is None else off
    made = lines_of if primitives.shape[1] == LINE else triangles_of
    return made(positions, primitives, rules, known)
