"""The transfer function of sRGB (IEC 61966-2-1), for arrays of lanes in 0..1."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_KNEE = 0.04045
"""Encoded values up to this are on the straight part of the curve."""


def decode_srgb(encoded: Floats) -> Floats:
    """The linear light of encoded values."""
    curve: Floats = np.where(encoded <= _KNEE, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    return curve


def encode_srgb(linear: Floats) -> Floats:
    """The encoded values of linear light."""
    bent = 1.055 * np.maximum(linear, 0.0) ** (1 / 2.4) - 0.055
    curve: Floats = np.where(linear <= _KNEE / 12.92, linear * 12.92, bent)
    return curve
