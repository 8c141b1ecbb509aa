"""Warns of colours that are written as bytes: ``0xff8000``, ``rgb(255, 128, 0)``.

They mean amounts of light, of which a screen shows the largest as white.
"""

from __future__ import annotations

import re

from ...diagnostics import rules
from ...diagnostics.fixes import write
from ...diagnostics.source import Span
from ..state.context import Context

_HEX = re.compile(r"0[xX]([0-9a-fA-F]{6})")
_LANES = re.compile(r"(?:rgb|vec3)\(\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*\)")
_BRIGHT = 128
"""The least whole number that is taken for a byte, if all lanes are such numbers: lights may well
be a hundred times as bright as white."""


def warn_of_bytes(ctx: Context, span: Span) -> None:
    """Warn if what is written where a colour is wanted is nothing but its bytes."""
    if found := _HEX.fullmatch(span.text):
        _warn(ctx, span, found[1])
    elif found := _LANES.fullmatch(span.text):
        lanes = [int(text) for text in found.groups()]
        if _BRIGHT <= max(lanes) <= 255:
            _warn(ctx, span, "".join(f"{lane:02x}" for lane in lanes))


def _warn(ctx: Context, span: Span, digits: str) -> None:
    hint = write(span, f"#{digits}")
    ctx.report.add(rules.BYTES_OF_COLOR, span, written=span.text, hint=hint)
