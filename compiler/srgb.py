"""Converts colours from sRGB, as people write them, to linear light for computing."""

from __future__ import annotations


def linear(channel: int) -> float:
    """An 8-bit sRGB channel as linear light in 0..1 (IEC 61966-2-1)."""
    value = channel / 255
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4
