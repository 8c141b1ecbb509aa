"""Rounds colours to the formats of render targets, as far as a device may round them.

``canvas.py`` calls it for every fragment that is drawn, and ``resolve.py`` for means of samples.
What a host or a shader reads of a target afterwards is a number that the format has.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache

import numpy as np

from ....support.frozen import frozen
from ..transfer import decode_srgb, encode_srgb
from .scene import Floats, Stored

_CURVED = 0.1
"""The part of a step by which a device's sRGB curve may be off, besides rounding.

Direct3D allows 0.6 of a step in all (11.3 functional specification, 3.2.3.8). Elsewhere it is
assumed.
"""
_ON_STEP = 1e-9
"""The part of a step by which float64 may be off at a number that the format has."""
_READ = 2.0**-22
"""The error of a stored number that is read as a float32, relative to itself."""


@frozen
class Format:
    """A format of a target: how it stores numbers."""

    bits: int
    """The bits of a lane."""
    alpha_bits: int
    """The bits of the fourth lane."""
    is_float: bool
    is_srgb: bool

    @property
    def steps(self) -> Floats:
        """The number of steps from 0 to 1 of each lane, where these are equal."""
        return np.array([2.0**self.bits - 1] * 3 + [2.0**self.alpha_bits - 1])

    @property
    def stored(self) -> Stored:
        """The kind of its numbers."""
        if not self.is_float:
            return "fixed"
        return "half" if self.bits < 32 else "float"

    @property
    def kind(self) -> type[np.float16 | np.float32]:
        """The type of a float."""
        return np.float16 if self.bits == 16 else np.float32

    @property
    def least(self) -> float:
        """Floats below it may be flushed to zero."""
        return float(np.finfo(self.kind).tiny)


@cache
def format_of(name: str) -> Format:
    """A format by the language's name for it, such as ``rgba8_srgb`` or ``rg16f``."""
    numbers = [int(number) for number in re.findall(r"\d+", name)]
    return Format(numbers[0], numbers[-1], name.endswith("f"), name.endswith("srgb"))


def lanes_of(name: str) -> int:
    """The number of lanes that a format stores: its name begins with a letter for each."""
    letters = re.match(r"[a-z]+", name)
    assert letters is not None
    return len(letters[0])


def clamped(name: str, colours: Floats) -> Floats:
    """Colours (…, 4) in the range of a format."""
    return colours if format_of(name).is_float else np.clip(colours, 0.0, 1.0)


def rounded(name: str, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """Between which numbers of a format those are that a device stores for colours (…, 4).

    Vulkan allows both neighbours of a number (its section on conversions to normalized formats; for
    floats, "Representation and Computation").
    """
    form = format_of(name)
    if not form.is_float:
        return _fixed(form, low, high)
    return _outer(form, low, -np.inf), _outer(form, high, np.inf)


def step(name: str, colours: Floats) -> Floats:
    """The distance of neighbouring numbers of a format at these colours (…, 4)."""
    form = format_of(name)
    if form.is_float:
        with np.errstate(all="ignore"):
            spacing = np.spacing(np.maximum(np.abs(colours), form.least).astype(form.kind))
        return np.asarray(spacing, np.float64)
    if not form.is_srgb:
        return np.broadcast_to(1.0 / form.steps, colours.shape)
    encoded = _bent(encode_srgb, np.clip(colours, 0.0, 1.0))
    return _bent(decode_srgb, encoded + 1.0 / form.steps) - _bent(decode_srgb, encoded)


def _fixed(form: Format, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """Rounds to a format in fixed point.

    NaN says that nothing is known; then at least the ends of the range are.
    """
    low = np.clip(np.nan_to_num(low, nan=0.0), 0.0, 1.0)
    high = np.clip(np.nan_to_num(high, nan=1.0), 0.0, 1.0)
    slack = np.full(4, -_ON_STEP)
    if form.is_srgb:
        slack[:3] = _CURVED
        low, high = _bent(encode_srgb, low), _bent(encode_srgb, high)
    low = np.clip(np.floor(low * form.steps - slack) / form.steps, 0.0, 1.0)
    high = np.clip(np.ceil(high * form.steps + slack) / form.steps, 0.0, 1.0)
    if form.is_srgb:
        low, high = _bent(decode_srgb, low), _bent(decode_srgb, high)
    return low * (1.0 - _READ), high * (1.0 + _READ)


def _bent(curve: Callable[[Floats], Floats], colours: Floats) -> Floats:
    """Colours with the transfer function applied to all lanes but alpha."""
    return np.concatenate([curve(colours[..., :3]), colours[..., 3:]], axis=-1)


def _outer(form: Format, end: Floats, outside: float) -> Floats:
    """The next float of a format that is not on the inner side of an interval's end."""
    with np.errstate(all="ignore"):
        near = end.astype(form.kind)
        further = np.nextafter(near, form.kind(outside)).astype(np.float64)
        nearest: Floats = near.astype(np.float64)
        inner = nearest > end if outside < 0 else nearest < end
        found = np.where(inner, further, nearest)
    flushed = np.minimum(found, 0.0) if outside < 0 else np.maximum(found, 0.0)
    return np.where(np.abs(found) < form.least, flushed, found)
