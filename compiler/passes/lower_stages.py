"""Rewrites geometry, tessellation and stream-output stages as stages that every target has.

These are vertex, fragment and compute stages. Several views become draws of their own, too.
``compiling.py`` calls ``lower_stages`` before all
passes or, if the stages themselves are wanted, ``keep_stages``.
"""

from __future__ import annotations

from ..ir.shader import Shader


def lower_stages(shader: Shader) -> Shader:
    """The shader without the stages that not every target has, where that can be.

    Most shaders have none of these, and then nothing is loaded that rewrites them.
    """
    if shader.views:
        from .lower_views import lower_views

        shader = lower_views(shader)
    if shader.expansion is None and shader.tessellation is None and shader.capture is None:
        return shader
    from .lower_capture import lower_capture
    from .lower_expansion import lower_expansion
    from .lower_tessellation import lower_tessellation

    return lower_capture(lower_tessellation(lower_expansion(shader)))


def keep_stages(shader: Shader) -> Shader:
    """The shader with its stages and views, and with the ranges of the numbers of them."""
    if shader.views:
        from .lower_views import count_views

        shader = count_views(shader)
    from .emit_strips import count_strips
    from .patch_vertices import count_captured

    return count_captured(count_strips(shader))
