"""The reference's pictures: rasterisation, filtering and blending in double precision.

``targets/runner/reference.py`` calls ``draw``. This package needs NumPy, so nothing that compiles
imports it.
"""

from . import formats
from .drawing import draw
from .scene import Expected, Geometry, RasterRules, Texels, instanced
from .stage_evaluation import compares_neighbours

__all__ = [
    "Expected",
    "Geometry",
    "RasterRules",
    "Texels",
    "compares_neighbours",
    "draw",
    "formats",
    "instanced",
]
