"""The pattern of triangles or lines into which tessellation divides a patch.

Direct3D specifies it to the bit (11.3 functional specification, "Tessellator Stage"); Vulkan and
OpenGL leave the triangles inside of a patch open, but drivers make the same ones. The numbers here
are Direct3D's: places are in units of 2^-16, and every rounding is the one that it prescribes.
"""

from .levels import ONE
from .patterns import Pattern, divided, isolines, quad, triangle

__all__ = ["ONE", "Pattern", "divided", "isolines", "quad", "triangle"]
