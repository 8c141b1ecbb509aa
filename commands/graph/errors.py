"""Finds the expressions that make a pixel inexact, for the colours of ``burnish graph --error``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from ...compiler.diagnostics.source import Span

if TYPE_CHECKING:
    from ...api.entry_points import CompiledMaterial

ROUTE = "lavapipe:glsl"
"""The route whose rules are used: those of Vulkan, which most others have, too."""


def parts(material: CompiledMaterial, pixel: tuple[int, int], case: str) -> Mapping[Span, float]:
    """The part of each expression in the error of a pixel of one of ``conform``'s scenes.

    Raises ``PixelError`` if there is nothing at the pixel.
    """
    from ...targets.conformance.explaining import check_pixel, explained_alone
    from ...targets.runner.routes import ROUTES

    check_pixel(pixel)
    found = explained_alone(material, ROUTES[ROUTE], pixel, case)
    shares: dict[Span, float] = {}
    for one in found.contributions:
        if one.span is not None:
            shares[one.span] = shares.get(one.span, 0.0) + one.contribution / found.error
    return shares
