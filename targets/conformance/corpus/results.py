"""The results of a case: the exact one, and for each promise which ones conform.

The exact result is the definition of the builtin, evaluated with fractions. Where a device may be
follows from the same definition, evaluated with the bounds that pictures are judged by.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Any, cast

import numpy as np

from ....compiler.reference import rationals
from ....compiler.reference.bounds import Bounds, as_bounded, exact, given
from ....compiler.reference.bounds.errors import Errors
from ....compiler.reference.functions import LaneKind, evaluate
from ....compiler.reference.rationals import Rational
from ....stdlib.builtins.accuracy import PLATFORMS, Platform
from ....stdlib.builtins.overloads import Overload, Shape
from ...runner.routes import EVERY_ROUTE
from .bits import bits_of, least_float32, most_float32, rounded
from .operands import CorpusCase
from .records import Ends, Kind, LaneRow

PROMISES: Mapping[str, tuple[Platform, ...]] = {
    **{platform: (platform,) for platform in PLATFORMS},
    **{"+".join(r.platforms): r.platforms for r in EVERY_ROUTE.values() if len(r.platforms) > 1},
}
"""The sets of specifications of which results have intervals.

There is one for each platform, and one for texts in another language that become SPIR-V: then both
may lose accuracy. Their names are those of the platforms.
"""

_BOUNDS = {name: Bounds(Errors(platforms)) for name, platforms in PROMISES.items()}
_RANGES: Mapping[str, tuple[int, int]] = {
    "int": (-(2**31), 2**31 - 1), "uint": (0, 2**32 - 1), "bool": (0, 1),
}  # fmt: skip


def title_of(promise: str) -> str:
    """The specifications of a promise, in words."""
    return " and ".join(PLATFORMS[platform] for platform in PROMISES[promise])


def result_of(overload: Overload, case: CorpusCase) -> tuple[LaneRow, ...]:
    """The lanes of the result of a case."""
    kind = _kind(overload)
    meaning = evaluate(overload.row.name, _operands(overload, case, _as_rational), rationals, kind)
    operands = _operands(overload, case, _as_bounded)
    with np.errstate(all="ignore"):
        found = {
            name: list(_flat(evaluate(overload.row.name, operands, bounds, kind)))
            for name, bounds in _BOUNDS.items()
        }
    of = cast(Kind, overload.result.kind)
    return tuple(
        LaneRow(
            exact=_in_words(lane, of),
            nearest=_nearest(lane, of),
            within={name: _ends(lanes[place], of) for name, lanes in found.items()},
        )
        for place, lane in enumerate(_flat(meaning))
    )


def _kind(overload: Overload) -> LaneKind:
    """The kind of lanes for which an operation is asked: that of its numbers."""
    kinds = [shape.kind for shape in overload.operands]
    return cast(LaneKind, next((kind for kind in kinds if kind != "bool"), "bool"))


def _operands(
    overload: Overload, case: CorpusCase, lane: Callable[[float, str], Any]
) -> list[tuple[Any, ...]]:
    """The operands of a case as an evaluation takes them."""
    return [
        _in_columns(shape, [lane(number, shape.kind) for number in lanes])
        for shape, lanes in zip(overload.operands, case.operands, strict=True)
    ]


def _in_columns(shape: Shape, lanes: Sequence[Any]) -> tuple[Any, ...]:
    if not shape.columns:
        return tuple(lanes)
    starts = range(0, shape.lanes, shape.width)
    return tuple(tuple(lanes[start : start + shape.width]) for start in starts)


def _flat(value: tuple[Any, ...]) -> Iterator[Any]:
    for item in value:
        yield from item if isinstance(item, tuple) else (item,)


def _as_rational(number: float, kind: str) -> Any:
    if kind == "float":
        return Rational(Fraction(number))
    return bool(number) if kind == "bool" else int(number)


def _as_bounded(number: float, kind: str) -> Any:
    if kind == "float":
        return given(np.float64(number))
    return exact(np.bool_(number) if kind == "bool" else np.int64(number))


# --- as texts -------------------------------------------------------------------------------------


def _in_words(lane: Any, kind: Kind) -> str:
    return float(lane).hex() if kind == "float" else str(int(lane))


def _nearest(lane: Any, kind: Kind) -> Ends:
    """The bits of the nearest float32, or of an integer or a condition."""
    if kind != "float":
        bits = bits_of(int(lane), kind)
        return bits, bits
    if isinstance(lane, float) and not math.isfinite(lane):
        return bits_of(lane, kind), bits_of(lane, kind)
    number = Rational.of(lane)
    low, high = number.value - number.error, number.value + number.error
    return bits_of(rounded(low), kind), bits_of(rounded(high), kind)


def _ends(lane: Any, kind: Kind) -> Ends | None:
    """The bits of the least and of the greatest result, if anything is promised."""
    bounded = as_bounded(lane)
    low, high = bounded.low.item(), bounded.high.item()
    if not (math.isfinite(low) and math.isfinite(high)):
        return None
    if kind == "float":
        return bits_of(least_float32(low), kind), bits_of(most_float32(high), kind)
    least, most = _RANGES[kind]
    return (bits_of(low, kind), bits_of(high, kind)) if least <= low and high <= most else None
