"""Writes a conformance run as JSON, and as a page with pictures."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from .compare import Comparison, Sample
from .html_pages import Embedded, environment
from .pixel_maps import EDGES, bound_map, decision_map, difference_map, histogram, picture
from .rows import STATUSES, CaseResult, Row
from .summary import (
    Unfinished,
    bite,
    by_material,
    devices,
    is_failure,
    lacking,
    messages,
    outcome,
    share,
    tools,
    unproven,
)

FOLDER = Path(__file__).parent
TEMPLATE, STYLE = "report.html.j2", "report.css"
_BINS = ("0", *(f"≤ {edge:g}" for edge in EDGES[1:]), "> 1")
"""The labels below the bars of a histogram."""


def as_json(
    rows: Sequence[Row], unfinished: Unfinished | None = None, *, strict: bool = False
) -> dict[str, Any]:
    """The whole run, or what is known of it; numbers that are not finite become ``null``."""
    statuses = {status: sum(row.status == status for row in rows) for status in STATUSES}
    return {
        "format": 2,
        **({"unfinished": asdict(unfinished)} if unfinished else {}),
        "statuses": statuses,
        "failures": sum(is_failure(row, strict=strict) for row in rows),
        "rows": [_row_json(row) for row in rows],
    }


def page(rows: Sequence[Row], unfinished: Unfinished | None = None) -> str:
    """The whole run, or what is known of it, as one HTML file, pictures included."""
    routes = {row.route.name: row.route for row in rows}
    return (
        environment(FOLDER)
        .get_template(TEMPLATE)
        .render(
            embedded=Embedded(FOLDER / STYLE),
            summary=outcome(rows, unfinished),
            routes=[{"name": name.split(":"), "title": r.title} for name, r in routes.items()],
            materials=[_material(name, own) for name, own in by_material(rows).items()],
            devices=devices(rows),
            tools=tools(rows),
            lacking=lacking(rows),
            bins=_BINS,
        )
    )


# --- JSON -----------------------------------------------------------------------------------------


def _row_json(row: Row) -> dict[str, Any]:
    device = row.device
    return {
        "material": row.material,
        "route": row.route.name,
        "status": row.status,
        "problem": row.problem or None,
        "reasons": list(row.reasons),
        "bound_in_steps": _finite(row.bite),
        "device": None if device is None else f"{device.name} {device.version}",
        "versions": dict(row.versions),
        "cases": {r.case: _comparison_json(r.comparison) for r in row.results},
    }


def _comparison_json(comparison: Comparison) -> dict[str, Any]:
    return {
        "level": comparison.level,
        "pixels": comparison.pixels,
        "covered": comparison.covered,
        "proven": comparison.proven,
        "undecided": comparison.undecided,
        "wide": comparison.wide,
        "overflowing": comparison.overflowing,
        "wrong": comparison.wrong,
        "changed_by_the_compiler": comparison.changed,
        "max_difference": _finite(comparison.max_difference),
        "max_difference_in_bounds": _finite(comparison.excess),
        "bound_in_steps": _finite(comparison.bite),
        "worst": _sample_json(comparison.worst),
        "changed": _sample_json(comparison.change),
        "beyond_what_was_measured": _sample_json(comparison.beyond),
    }


def _sample_json(sample: Sample | None) -> dict[str, Any] | None:
    if sample is None:
        return None
    lanes = {name: getattr(sample, name) for name in ("got", "expected", "low", "high")}
    return {
        "x": sample.x,
        "y": sample.y,
        "target": sample.target,
        **{name: [_finite(lane) for lane in values] for name, values in lanes.items()},
    }


def _finite(number: float) -> float | None:
    return number if math.isfinite(number) else None


# --- the page -------------------------------------------------------------------------------------


def _material(name: str, rows: Sequence[Row]) -> dict[str, Any]:
    shown = _shown(rows)
    return {
        "name": name,
        "rows": [_row_page(row) for row in rows],
        "messages": [
            {"routes": [row.route.name for row in said], "status": said[0].status, "lines": lines}
            for said, lines in messages(rows)
        ],
        "agrees": all(row.status in ("agrees", "not run") for row in rows),
        "shown": shown.route.name if shown else "",
        "cases": list(_cases(name, shown)) if shown else [],
    }


def _shown(rows: Sequence[Row]) -> Row | None:
    """The row whose pictures are shown: the one that needs most of its bounds."""
    drawn = [row for row in rows if row.results]
    return max(drawn, key=lambda row: max(r.comparison.excess for r in row.results), default=None)


def _cases(material: str, row: Row) -> Iterator[dict[str, Any]]:
    """The pictures of each case and target."""
    for result in row.results:
        for target in range(len(result.got)):
            name = f"{result.case}, target {target}" if len(result.got) > 1 else result.case
            yield {"name": name, "figures": list(_figures(material, name, result, target))}


def _figures(material: str, name: str, result: CaseResult, target: int) -> Iterator[dict[str, str]]:
    difference, times = difference_map(result, target)
    rows = (
        ("reference", "as it has to be", result.expected.targets[target]),
        ("drawn", "as this route has drawn it", result.got[target]),
        (f"difference × {times:.0e}", "blue: undecided", difference),
        ("bound", "black is 1e-8, white 1 or more", bound_map(result, target)),
        ("decided", "orange: the bound says nothing; blue: undecided; red: out of bounds",
         decision_map(result)),
    )  # fmt: skip
    for title, words, pixels in rows:
        yield {
            "title": title, "words": words, "picture": picture(pixels),
            "alternative": f"{material}, {name}: {title}, {words}",
        }  # fmt: skip


def _row_page(row: Row) -> dict[str, Any]:
    counts = histogram(row.results) if row.results else []
    return {
        "route": row.route.name,
        "status": row.status,
        "share": share(row) if row.results else "",
        "bite": bite(row) if row.results else "",
        "difference": f"{row.max_difference:.2e}" if row.results else "",
        "unproven": unproven(row) if row.results else "",
        "histogram": counts,
        "heights": [_height(count, counts) for count in counts],
    }


def _height(count: int, counts: Sequence[int]) -> float:
    """The height of a bar, on a logarithmic scale, so that a single lane is seen."""
    return round(math.log1p(count) / math.log1p(max(*counts, 1)), 3)
