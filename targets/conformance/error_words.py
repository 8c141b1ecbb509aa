"""Says in words where a pixel loses precision, for the terminal, the report and verdicts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

from ...compiler.diagnostics.source import Span
from ...compiler.reference.attribution.explanation import (
    Explanation,
    Expression,
    Kind,
    Loss,
    Tipping,
)
from ...stdlib.builtins.facts import ULP

MOST = 8
"""The number of expressions that are listed under each heading."""
MOST_WITHOUT_EFFECT = 2
"""The number of jumps without an effect of their own that are listed, if there is no better
cause."""
_LANES = "rgba"
_INACCURATE = 1024.0
"""An operation whose own error is this many roundings of its value is called inaccurate."""
_HALF_ULP = 0.5 * ULP
_WHOLE_STEP = 0.5
"""An operand that is off by more than this may be on either side of a jump at whole numbers."""
_OWN: Mapping[Kind, str] = {
    "operation": "may itself be off by",
    "read": "is filtered, and may be off by",
    "interpolation": "is interpolated, and may be off by",
    "constant": "is rounded by",
    "input": "may be off by",
}
"""The words for an expression's own error, by its kind."""
_NEARLY_ALL = 0.8
"""The part of the error above which one operation is to blame."""


def lanes_text(values: Iterable[float]) -> str:
    """The lanes of a pixel."""
    return f"({', '.join(f'{value:.7g}' for value in values)})"


def causes(explanation: Explanation) -> Iterator[str]:
    """The causes of a pixel's error, each with its place, the worst one first.

    There are none if the error is the sum of many small ones.
    """
    found = [*_causes_of_errors(explanation)]
    yield from found or (
        _with_place(_tipping(tipping), tipping.expression.span)
        for tipping in explanation.tippings[:MOST_WITHOUT_EFFECT]
    )


def _causes_of_errors(explanation: Explanation) -> Iterator[str]:
    """The causes that change the pixel by themselves."""
    for large in explanation.overflows[:1]:
        yield _with_place(_overflow(large), large.span)
    for loss in explanation.losses[:1]:
        yield _with_place(_lossy(loss), loss.expression.span)
    for tipping in [one for one in _other_tippings(explanation) if one.effect > 0][:1]:
        yield _with_place(_tipping(tipping), tipping.expression.span)
    for worst in explanation.contributions[:1]:
        size = max((abs(lane) for lane in worst.value), default=0.0)
        if worst.own > _INACCURATE * _HALF_ULP * max(size, 1.0):
            text = f"`{worst.text}` {_OWN[worst.kind]} {short(worst.own)}"
            yield _with_place(text, worst.span)


def small(explanation: Explanation, width: float) -> str:
    """The sentence about a pixel whose bounds are wide although nothing in it loses precision."""
    return (
        f"no expression magnifies rounding much: at ({explanation.x}, {explanation.y}) it amounts "
        f"to {short(explanation.error)}, to first order, but the bounds are {short(width)} wide, "
        "as they do not see how errors cancel out"
    )


def blamed(explanation: Explanation) -> Iterator[str]:
    """The operation that explains nearly all of a pixel's error, if there is one."""
    for worst in explanation.contributions[:1]:
        part = worst.contribution / explanation.error
        if part >= _NEARLY_ALL:
            text = f"{part:.0%} of what it may be off is due to `{worst.text}`"
            yield _with_place(text, worst.span)


def lines(explanation: Explanation) -> Iterator[str]:
    """The whole explanation as lines of text."""
    lane = _LANES[explanation.lane]
    value = explanation.value[explanation.lane]
    yield f"rounding may change {lane} = {value:.7g} by {short(explanation.error)}, to first order"
    if explanation.overflows:
        yield from ("", "what overflows:")
        for large in explanation.overflows:
            yield f"  {_with_place(_overflow(large), large.span)}"
    if explanation.losses:
        yield from ("", "where precision is lost:")
        for loss in explanation.losses[:MOST]:
            yield f"  {_with_place(_lossy(loss), loss.expression.span)}"
    if tippings := _other_tippings(explanation):
        yield from ("", "what may tip:")
        for tipping in tippings[:MOST]:
            yield f"  {_with_place(_tipping(tipping), tipping.expression.span)}"
    if explanation.contributions:
        yield from ("", "what contributes:")
        yield from _contributions(explanation)
    if explanation.way:
        yield from ("", "the way of the largest contribution:")
        yield from _way(explanation.way)


def _other_tippings(explanation: Explanation) -> list[Tipping]:
    """Jumps of expressions that do not lose precision anyway, so that more than a jump is lost."""
    lossy = {(loss.expression.text, str(loss.expression.span)) for loss in explanation.losses}
    return [
        tipping
        for tipping in explanation.tippings
        if (tipping.expression.text, str(tipping.expression.span)) not in lossy
    ]


def _contributions(explanation: Explanation) -> Iterator[str]:
    rows = [("part", "own error", "magnified", "expression")]
    for one in explanation.contributions[:MOST]:
        part = one.contribution / explanation.error
        rows.append((
            f"{part:.0%}" if part >= 0.005 else "<1%", short(one.own), _times(one.magnification),
            _with_place(f"`{one.text}`", one.span),
        ))  # fmt: skip
    yield from table(rows)
    rest = explanation.contributions[MOST:]
    if rest:
        part = sum(one.contribution for one in rest) / explanation.error
        yield f"  and {len(rest)} more, with {part:.0%} together"


def _way(way: tuple[Expression, ...]) -> Iterator[str]:
    """The expressions as a tree, each with its value and its error."""
    rows = [("", "value", "error")]
    for depth, one in enumerate(way):
        lane = max(one.value, key=abs, default=0.0)
        branch = f"{'  ' * (depth - 1)}└ " if depth else ""
        rows.append((
            _with_place(f"{branch}`{one.text}`", one.span), f"{lane:.6g}", short(one.error)
        ))  # fmt: skip
    yield from table(rows)


def table(rows: Sequence[tuple[str, ...]]) -> Iterator[str]:
    """Rows as lines, column below column."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = (text.ljust(width) for text, width in zip(row, widths, strict=True))
        yield f"  {'  '.join(cells)}".rstrip()


def _overflow(large: Expression) -> str:
    return f"`{large.text}` is too large for float32: anything may follow"


def _lossy(loss: Loss) -> str:
    return f"`{loss.expression.text}` magnifies rounding {_times(loss.times)}"


def _tipping(tipping: Tipping) -> str:
    if tipping.error >= _WHOLE_STEP and tipping.repeats:
        off = short(tipping.error)
        return (
            f"the operand of `{tipping.expression.text}` may be off by {off}: anything may follow"
        )
    text = f"`{tipping.expression.text}` is {short(tipping.distance)} from {tipping.words}"
    text += f", and may be off by {short(tipping.error)}: "
    if math.isinf(tipping.effect):
        return text + "the pixel would be discarded"
    if tipping.effect == 0:
        return text + "the bounds are those of both sides, though this alone changes nothing"
    return text + f"the pixel would change by {short(tipping.effect)}"


def _times(factor: float) -> str:
    if factor < 1000:
        return f"{factor:.3g} times"
    leading, exponent = f"{factor:.0e}".split("e+")
    power = f"10^{int(exponent)} times"
    return power if leading == "1" else f"{leading}·{power}"


def short(number: float) -> str:
    """A number in few digits, for its size."""
    return f"{number:.1e}" if number and abs(number) < 1e-3 else f"{number:.3g}"


def _with_place(text: str, span: Span | None) -> str:
    if span is None:
        return text
    line, _ = span.source.position(span.start)
    return f"{text} ({span.source.name}:{line})"
