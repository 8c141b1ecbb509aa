"""The reference's pictures: rasterisation, filtering and blending in double precision.

``targets/runner/reference.py`` calls ``draw``, and ``targets/runner/frames`` draws several times on
one ``Canvas``. This package needs NumPy, so nothing that compiles
imports it.
"""

from . import formats
from .canvas import NOWHERE, Canvas
from .canvas import size_of as canvas_size
from .copies import Places
from .drawing import draw, draw_onto, written_by
from .hulls import Hulls
from .resolve import depth_ends, expected_on, samples_on
from .scene import Counted, Expected, Geometry, RasterRules, Stored, Texels, instanced
from .stage_evaluation import PIXELS_AT_ONCE

__all__ = [
    "NOWHERE",
    "PIXELS_AT_ONCE",
    "Canvas",
    "Counted",
    "Expected",
    "Geometry",
    "Hulls",
    "Places",
    "RasterRules",
    "Stored",
    "Texels",
    "canvas_size",
    "depth_ends",
    "draw",
    "draw_onto",
    "expected_on",
    "formats",
    "instanced",
    "samples_on",
    "written_by",
]
