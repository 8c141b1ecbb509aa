"""Finds the operations that make a pixel inexact, by how much, and where they are in the source.

``burnish conform --explain`` and the verdict ``proves little`` ask ``explain`` for one pixel. It
evaluates the shader for this pixel alone, again and again, each time with a small error in the
result of one operation, and looks at the change of the picture. It needs NumPy, so nothing that
compiles imports it.
"""

from .explanation import Explanation, explain
from .pixel import UncoveredError

__all__ = ["Explanation", "UncoveredError", "explain"]
