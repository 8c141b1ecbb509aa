"""Warns of colours that are written as bytes: ``0xff8000``, ``rgb(255, 128, 0)``.

They mean amounts of light, of which a screen shows the largest as white.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from ...diagnostics import rules
from ...diagnostics.fixes import write
from ...diagnostics.source import Span
from ...syntax import ast
from ..state.context import Context

_HEX = re.compile(r"0[xX]([0-9a-fA-F]{6})")
_BRIGHT = 32
"""The least whole number that is taken for a byte, if all lanes are bytes."""


def warn_of_hex(ctx: Context, span: Span) -> None:
    """Warn if a number in base sixteen stands where a colour is wanted."""
    found = _HEX.fullmatch(span.text)
    if found is not None:
        _warn(ctx, span, found[1])


def warn_of_bytes(ctx: Context, written: Sequence[ast.Expression], span: Span) -> None:
    """Warn if the three lanes of a colour are written as bytes."""
    digits = [each.text for each in written if isinstance(each, ast.Number) and each.kind == "int"]
    if len(digits) == len(written) == 3:
        lanes = [int(text, 0) for text in digits]
        if _BRIGHT <= max(lanes) <= 255:
            _warn(ctx, span, "".join(f"{lane:02x}" for lane in lanes))


def _warn(ctx: Context, span: Span, digits: str) -> None:
    hint = write(span, f"#{digits}")
    ctx.report.add(rules.BYTES_OF_COLOR, span, written=span.text, hint=hint)
