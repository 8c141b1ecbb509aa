"""What rounding to a render target's format leaves to chance."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..runner.pipeline import FORMATS
from ..runner.textures.srgb import encode_srgb

Floats = NDArray[np.float64]

LAYERS = 4
"""So many times, at most, a pixel of the cases is rounded: once for each fragment blended."""


def as_stored(targets: Sequence[Floats], formats: Sequence[str]) -> tuple[Floats, ...]:
    """Values in the scale in which a format's steps are equal: clamped, and sRGB where it is."""
    return tuple(
        _stored(values, FORMATS[name]) for values, name in zip(targets, formats, strict=True)
    )


def format_steps(formats: Sequence[str]) -> list[float]:
    """How far rounding to each format may move a value of ``as_stored``."""
    return [_step(FORMATS[name]) for name in formats]


def _stored(values: Floats, name: str) -> Floats:
    if "unorm" not in name:
        return values
    clamped = np.clip(values, 0.0, 1.0)
    if name.endswith("srgb"):
        clamped[..., :3] = encode_srgb(clamped[..., :3])
    return clamped


def _step(name: str) -> float:
    if "unorm" in name:
        return LAYERS * 0.6 / 255
    return LAYERS * 2.0**-11 if "16" in name else 0.0
