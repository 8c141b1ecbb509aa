"""Computes the errors that rounding to a render target's format may cause."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..runner.binding import FORMATS
from ...compiler.reference.transfer import encode_srgb

Floats = NDArray[np.float64]

LAYERS = 4
"""How often a pixel of the cases is rounded at most: once for each fragment that is blended."""


def as_stored(targets: Sequence[Floats], formats: Sequence[str]) -> tuple[Floats, ...]:
    """Values in the scale in which a format's steps are equal: clamped, and encoded as sRGB if it
    is."""
    return tuple(
        _stored(values, FORMATS[name]) for values, name in zip(targets, formats, strict=True)
    )


def format_steps(stored: Sequence[Floats], formats: Sequence[str]) -> list[Floats]:
    """By how much rounding to each format may change the values of ``as_stored``."""
    pairs = zip(stored, formats, strict=True)
    return [_steps(values, FORMATS[name]) for values, name in pairs]


def _stored(values: Floats, name: str) -> Floats:
    if "unorm" not in name:
        return values
    clamped = np.clip(values, 0.0, 1.0)
    if name.endswith("srgb"):
        clamped[..., :3] = encode_srgb(clamped[..., :3])
    return clamped


def _steps(stored: Floats, name: str) -> Floats:
    if "unorm" in name:
        return np.full_like(stored, LAYERS * 0.6 / 255)
    half = LAYERS * 2.0**-11 * np.maximum(np.abs(stored), 1.0)
    return half if "16" in name else np.zeros_like(stored)
