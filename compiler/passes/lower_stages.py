"""Does with the stages of all targets what else takes stages that not every target has.

``api.py`` calls ``lower_stages`` before all passes, unless the stages themselves are wanted.
"""

from __future__ import annotations

from ..ir.shader import Shader
from .lower_capture import lower_capture
from .lower_expansion import lower_expansion
from .lower_tessellation import lower_tessellation


def lower_stages(shader: Shader) -> Shader:
    """The shader without the stages that not every target has, where that can be."""
    return lower_capture(lower_tessellation(lower_expansion(shader)))
