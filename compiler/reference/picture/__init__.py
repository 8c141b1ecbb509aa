"""The reference's pictures: rasterisation, filtering and blending in double precision.

``targets/runner/reference.py`` calls ``draw``, and ``targets/runner/frames`` draws several times on
one ``Canvas``. This package needs NumPy, so nothing that compiles
imports it.
"""

from . import formats
from .canvas import NOWHERE, Canvas
from .copies import Places
from .drawing import draw, draw_onto, written_by
from .hulls import Hulls
from .resolve import expected_on
from .scene import Expected, Geometry, RasterRules, Texels, instanced
from .stage_evaluation import compares_neighbours

__all__ = [
    "NOWHERE",
    "Canvas",
    "Expected",
    "Geometry",
    "Hulls",
    "Places",
    "RasterRules",
    "Texels",
    "compares_neighbours",
    "draw",
    "draw_onto",
    "expected_on",
    "formats",
    "instanced",
    "written_by",
]
