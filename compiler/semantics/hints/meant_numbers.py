"""Warns of numbers that have the types that are wanted, and do not say what is meant.

A colour is written as its bytes, ``0xff8000`` or ``rgb(255, 128, 0)``, which mean amounts of light,
of which a screen shows the largest as white. ``clamp(0, 1, x)`` is written for ``clamp(x, 0, 1)``,
and ``sin(90)`` for ``sin(90deg)``. The type rules cannot object to any of it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from math import tau
from types import MappingProxyType

from ...diagnostics import rules
from ...diagnostics.fixes import fix_it, write
from ...diagnostics.source import Span
from ...ir.meaning import COLORS
from ...ir.node import Node
from ...syntax import ast
from ...syntax.quoting import shortened
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


# --- arguments ---------------------------------------------------------------------------------

Written = Sequence[ast.Expression]
_STEP, _LEAST, _MOST = 5, 10, 720
"""Whole multiples of 5 from 10 to 720 are taken for degrees."""


def warn_of_order(
    ctx: Context, name: str, operands: Sequence[Node], span: Span, e: Written
) -> None:
    """Warn of a call with the written arguments ``e``, if ``name`` is a row of ``CHECKED``."""
    if len(e) == len(operands):
        CHECKED[name](ctx, name, operands, span, e)


def _in_order(ctx: Context, name: str, span: Span, e: Written, order: Sequence[int]) -> None:
    """Warn, and offer the arguments in another order."""
    listed = ", ".join(e[index].span.text for index in order)
    hint = fix_it(
        f"did you mean `{name}({shortened(listed)})`?",
        *((e[place].span, e[index].span.text) for place, index in enumerate(order)),
    )
    ctx.report.add(rules.ORDER_OF_ARGUMENTS, span, function=name, hint=hint)


def _clamp(ctx: Context, name: str, _: Sequence[Node], span: Span, e: Written) -> None:
    if _is_number(e[0]) and _is_number(e[1]) and not _is_number(e[2]):
        _in_order(ctx, name, span, e, (2, 0, 1))


def _smoothstep(ctx: Context, name: str, _: Sequence[Node], span: Span, e: Written) -> None:
    if _is_number(e[1]) and _is_number(e[2]) and not _is_number(e[0]):
        _in_order(ctx, name, span, e, (1, 2, 0))


def _mix(ctx: Context, name: str, operands: Sequence[Node], span: Span, e: Written) -> None:
    """A share in front of two colours."""
    colors = [ctx.meanings.of(each) for each in operands[1:]]
    if not all(each is not None and each.kind in COLORS for each in colors):
        return
    if isinstance(e[0], ast.Number) and e[0].kind == "float" and 0 < float(e[0].text) < 1:
        _in_order(ctx, name, span, e, (1, 2, 0))


def _angle(ctx: Context, name: str, _: Sequence[Node], span: Span, e: Written) -> None:
    number = e[0]
    if not isinstance(number, ast.Number) or number.kind != "int" or not number.text.isdecimal():
        return
    degrees = int(number.text)
    if _LEAST <= degrees <= _MOST and degrees % _STEP == 0:
        meant = f"{degrees}deg"
        hint = fix_it(f"did you mean `{name}({meant})`?", (number.span, meant))
        turns = f"{degrees / tau:.3g}"
        ctx.report.add(
            rules.WHOLE_RADIANS, span, function=name, number=degrees, turns=turns, hint=hint
        )


def _is_number(e: ast.Expression) -> bool:
    """True for a number as it is written, with a sign or without."""
    return isinstance(e.operand if isinstance(e, ast.Unary) else e, ast.Number)


CHECKED: Mapping[str, Callable[[Context, str, Sequence[Node], Span, Written], None]] = (
    MappingProxyType(
        {
            "clamp": _clamp, "smoothstep": _smoothstep, "mix": _mix,
            "sin": _angle, "cos": _angle, "tan": _angle,
        }
    )
)  # fmt: skip
"""The builtins whose calls are looked at, and what looks at them."""
