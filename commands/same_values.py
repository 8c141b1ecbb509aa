"""Reads the values and ranges that ``burnish same`` gets: texts, as numbers of formulas."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from ..api.sameness import Range, Value


def values_of(given: Sequence[tuple[str, str]]) -> dict[str, Value]:
    """Values by name. Ends the command for a text that is none."""
    found: dict[str, Value] = {}
    for name, text in given:
        lanes = _lanes(text)
        if lanes is None:
            raise click.UsageError(
                f"'{name}={text}' is no value, which would be like 0.5, 1,0,0, #b5651d or true"
            )
        found[name] = lanes
    return found


def ranges_of(given: Sequence[tuple[str, str]]) -> dict[str, Range]:
    """Ranges by name. Ends the command for a text that is none."""
    found = {}
    for name, text in given:
        ends = [_number(part.strip()) for part in text.split("..")]
        if len(ends) != 2 or ends[0] is None or ends[1] is None:
            raise click.UsageError(f"'{name}={text}' is no range, which would be like 0..1")
        found[name] = ends[0], ends[1]
    return found


def _lanes(text: str) -> tuple[float, ...] | None:
    from ..targets.runner.instances.literals import color_lanes

    if text.startswith("#"):
        return color_lanes(text)
    parts = [_number(part.strip()) for part in text.strip("()").split(",")]
    return None if None in parts else tuple(part for part in parts if part is not None)


def _number(text: str) -> float | None:
    from ..targets.runner.instances.literals import measured

    if text in ("true", "false"):
        return float(text == "true")
    try:
        found = float(text)
    except ValueError:
        angle = measured(text, "angle")
        return measured(text, None) if angle is None else angle
    return found if math.isfinite(found) else None
