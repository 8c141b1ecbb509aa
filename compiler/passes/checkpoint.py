"""Checks every graph between two passes if the variable ``BURNISH_VERIFY`` is 1.

``pipeline.stage`` calls ``verified`` after each pass. The tests always set the variable; users do
not, because verifying a graph takes as long as a pass.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from ..ir.node import Roots

if TYPE_CHECKING:
    from ..ir.operations import Form
    from ..ir.shader import Result, Shader

VARIABLE = "BURNISH_VERIFY"
"""Set to ``1`` in all tests; off for users, since verifying costs as much as a pass."""


def verified(name: str, form: Form, roots: Roots) -> Roots:
    """``roots`` as pass ``name`` made them, verified where that is wanted."""
    if os.environ.get(VARIABLE) == "1":
        from ..ir.verify import InvalidGraphError, verify

        try:
            verify(roots, stage=form)
        except InvalidGraphError as error:
            error.add_note(f"after {name}")
            raise
    return roots


def verified_results(shader: Shader) -> tuple[Result, ...]:
    """What a shader delivers; where that is wanted, it is verified to fit the shader's stages."""
    if os.environ.get(VARIABLE) == "1":
        from ..ir.verify import verify_levels, verify_results

        verify_results(shader.results, shader.chain)
        verify_levels(shader)
    return shader.results
