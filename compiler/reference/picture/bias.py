"""Moves faces away from the eye by the bias of a pass, before their depths are tested.

``assembly.py`` calls ``biased``. APIs agree on the formula, slope * m + constant * r, but not on
everything in it. Sources: Vulkan, "Depth Bias"; OpenGL 4.6, 14.6.5; Direct3D 11.3 functional
specification, 15.10, which WebGPU follows.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...ir.render_state import DepthState
from ..bounds.bounded import Bounded
from .faces import Faces
from .scene import Floats

MANTISSA = 23
"""The binary places of a depth's mantissa in the format ``depth32f``."""
_ROUNDINGS = 2.0**-21
"""The error of computing a bias with float32, relative to the bias."""


def biased(faces: Faces, state: DepthState) -> Faces:
    """The faces with depths that are moved as a pass asks for."""
    if not state.is_biased:
        return faces
    bias = _added(_times(_slopes(faces), state.slope_bias), _times(_steps(faces), state.bias))
    low, value, high = (
        _clamped(end, state.bias_clamp) for end in (bias.low, bias.value, bias.high)
    )
    off = np.maximum(high - value, value - low) + _ROUNDINGS * np.maximum(-low, high)
    off = np.nan_to_num(off, nan=np.inf)
    return replace(faces, z=faces.z + value[:, None], z_off=faces.z_off + off)


def _clamped(bias: Floats, most: float) -> Floats:
    if most == 0:
        return bias
    return np.minimum(bias, most) if most > 0 else np.maximum(bias, most)


def _slopes(faces: Faces) -> Bounded:
    """The change of depths from one pixel to the next: m.

    Direct3D takes the larger one of both directions. Vulkan and OpenGL take the length of the
    gradient, or this instead of it.
    """
    x, y, z = faces.plane_x, faces.plane_y, faces.z
    sides = [
        (x[:, corner] - x[:, 0], y[:, corner] - y[:, 0], z[:, corner] - z[:, 0])
        for corner in (1, 2)
    ]
    (ax, ay, az), (bx, by, bz) = sides
    # Both ends of a side may be elsewhere, and so may their depths.
    moved = 2.0 * faces.moved.max(axis=1)
    off = 2.0 * (faces.z_off + _ROUNDINGS * np.abs(z).max(axis=1))
    area = np.abs(ax * by - ay * bx)
    area_off = moved * (np.abs(ax) + np.abs(ay) + np.abs(bx) + np.abs(by) + 2.0 * moved)
    rise_off = moved * (np.abs(az) + np.abs(bz) + 2.0 * off)
    right, down = np.abs(az * by - bz * ay), np.abs(bz * ax - az * bx)
    right_off, down_off = (
        rise_off + off * (np.abs(ay) + np.abs(by)),
        rise_off + off * (np.abs(ax) + np.abs(bx)),
    )
    least, most = area + area_off, np.maximum(area - area_off, 0.0)
    low = np.maximum(np.maximum(right - right_off, down - down_off), 0.0) / least
    high = np.hypot(right + right_off, down + down_off) / most
    return Bounded(np.maximum(right, down) / area, low, np.nan_to_num(high, nan=np.inf))


def _steps(faces: Faces) -> Bounded:
    """The smallest steps of depths as large as the largest of each face: r.

    Of a face that is clipped, a device may look at the corners before that, none of which has a
    depth over 1 in the drawn part.
    """
    most = np.abs(faces.z).max(axis=1)
    off = faces.z_off + _ROUNDINGS * most
    low, value, high = (_step(most + by * off) for by in (-1.0, 0.0, 1.0))
    return Bounded(value, low, np.where(faces.whole, high, np.maximum(high, _step(np.ones(1)))))


def _step(depth: Floats) -> Floats:
    _, exponent = np.frexp(np.maximum(depth, np.finfo(np.float32).tiny))
    step: Floats = np.ldexp(1.0, np.minimum(exponent, 2) - 1 - MANTISSA)
    return step


def _times(value: Bounded, factor: float) -> Bounded:
    if factor == 0:
        zero = np.zeros_like(value.value)
        return Bounded(zero, zero, zero)
    low, high = value.low * factor, value.high * factor
    return Bounded(value.value * factor, np.minimum(low, high), np.maximum(low, high))


def _added(one: Bounded, other: Bounded) -> Bounded:
    return Bounded(one.value + other.value, one.low + other.low, one.high + other.high)
