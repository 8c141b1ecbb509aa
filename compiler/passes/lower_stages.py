"""Draws by vertices and fragments alone what else takes geometry or tessellation stages.

``api.py`` calls ``lower_stages`` before all passes, unless the stages themselves are wanted.
"""

from __future__ import annotations

from ..ir.shader import Shader
from .lower_expansion import lower_expansion
from .lower_tessellation import lower_tessellation


def lower_stages(shader: Shader) -> Shader:
    """The shader without stages between the vertices and the fragments, where that can be."""
    return lower_tessellation(lower_expansion(shader))
