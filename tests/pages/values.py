"""Values as marks write them: ``7``, ``true``, ``1.4142…``, ``(0, 1)``, ``((1, 0), (0, 1))``.

``claims.py`` compares them with those of the reference evaluator. A matrix is a tuple of its
columns, and an array one of its elements.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from burnish.compiler.reference.namespace import Lanes

_LANE = re.compile(r"true|false|[-+]?[\d.]+(?:…|e[-+]?\d+)?")
_CLOSE = 1e-12
"""How far a float may be from a number that is written in full: float64 rounds each step.

It is relative to the number, or absolute if this is less than 1.
"""

_Value = float | int | bool | tuple["_Value", ...]


def is_value(claimed: str, value: Lanes) -> bool:
    """True if ``value`` is what a mark claims.

    A number that ends in ``…`` is cut off there: the value begins with its digits.
    """
    if written(value, "#") != re.sub(r"\s", "", _LANE.sub("#", claimed)).replace(",", ", "):
        return False
    pairs = zip(_LANE.findall(claimed), _lanes(value), strict=True)
    return all(_is_lane(text, lane) for text, lane in pairs)


def written(value: _Value | Lanes, lane: str = "") -> str:
    """A value as a mark would write it in full, or with the text ``lane`` for each number."""
    if isinstance(value, tuple) and len(value) == 1:
        return written(value[0], lane)
    if isinstance(value, tuple):
        return f"({', '.join(written(part, lane) for part in value)})"
    return lane or (str(value).lower() if isinstance(value, bool) else f"{value:.15g}")


def _lanes(value: _Value | Lanes) -> Iterator[float | int | bool]:
    if isinstance(value, tuple):
        for part in value:
            yield from _lanes(part)
    else:
        yield value


def _is_lane(text: str, lane: float | int | bool) -> bool:
    """True if one lane is the number or the ``bool`` that a mark writes."""
    if text in ("true", "false"):
        return lane is (text == "true")
    if isinstance(lane, bool):
        return False
    digits = text.removesuffix("…")
    number = float(digits)
    if digits == text:
        return math.isclose(lane, number, rel_tol=_CLOSE, abs_tol=_CLOSE)
    step = 10.0 ** -len(digits.partition(".")[2])
    has_its_sign = math.copysign(1, lane) == math.copysign(1, number)
    return has_its_sign and abs(number) <= abs(lane) < abs(number) + step
