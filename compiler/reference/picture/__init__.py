"""Whole pictures by the reference: rasterisation, filtering and blending in double precision.

Needs NumPy, so nothing on the way of a compile imports it.
"""

from .drawing import draw
from .scene import Expected, Geometry, RasterRules, Texels, instanced

__all__ = ["Expected", "Geometry", "RasterRules", "Texels", "draw", "instanced"]
