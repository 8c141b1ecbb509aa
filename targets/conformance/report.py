"""A conformance run as a table for terminals, as JSON, and as a page with pictures."""

from __future__ import annotations

import base64
import io
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from jinja2 import Environment, FileSystemLoader, StrictUndefined

from ..runner.pictures import to_image
from .compare import Comparison
from .rows import STATUSES, Result, Row

TEMPLATE = "report.html.j2"
AMPLIFIED = 1000.0
"""So many times brighter than it is, a difference is shown."""


def table(rows: Sequence[Row]) -> Iterator[tuple[str, ...]]:
    """Cells for a terminal: a heading, then a line for each row."""
    yield "material", "route", "max |difference|", "undecided", "result"
    for row in rows:
        measured = row.status in ("agrees", "differs")
        difference = f"{row.max_difference:.1e}" if measured else "–"
        undecided = f"{row.undecided} of {row.covered}" if measured else "–"
        yield row.material, row.route.name, difference, undecided, row.status


def counted(rows: Iterable[Row]) -> str:
    """``12 agree, 1 differs``: how many rows there are of each status."""
    counts = Counter(row.status for row in rows)
    words = {"agrees": "agree", "differs": "differ"}
    shown = (
        f"{counts[status]} {words.get(status, status) if counts[status] != 1 else status}"
        for status in STATUSES
        if counts[status]
    )
    return ", ".join(shown)


def drawn_by(rows: Iterable[Row]) -> Iterator[str]:
    """A line for each route: what drew, and by which tools; or why nothing did."""
    for row in {row.route.name: row for row in rows}.values():
        if row.status == "not run":
            yield f"{row.route.name}: not run: {row.problem}"
        elif row.device is not None:
            tools = ", ".join(f"{name} {version}" for name, version in row.versions.items())
            yield f"{row.route.name}: {row.device.name} {row.device.version}; {tools}"


def details(row: Row) -> Iterator[str]:
    """Lines that say what is wrong with a row; none if it agrees."""
    if row.problem:
        yield row.problem
    for result in row.results:
        comparison = result.comparison
        if comparison.wrong and comparison.worst:
            worst = comparison.worst
            yield (
                f"{result.case}: {comparison.wrong} of {comparison.covered} pixels; the worst, at "
                f"({worst.x}, {worst.y}), is {_lanes(worst.got)} and should be "
                f"{_lanes(worst.expected)}"
            )
        elif comparison.too_undecided:
            yield (
                f"{result.case}: {comparison.undecided} of {comparison.pixels} pixels hang on "
                "rounding, which is too many to prove anything"
            )


def as_json(rows: Sequence[Row]) -> dict[str, Any]:
    """The whole run; what is not finite is ``null``."""
    return {"format": 1, "rows": [_row_json(row) for row in rows]}


def page(rows: Sequence[Row]) -> str:
    """One HTML file with everything in it."""
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    materials = list(dict.fromkeys(row.material for row in rows))
    groups = [
        {
            "name": name,
            "references": _references([row for row in rows if row.material == name]),
            "rows": [_row_page(row) for row in rows if row.material == name],
        }
        for name in materials
    ]
    template = environment.get_template(TEMPLATE)
    return template.render(groups=groups, summary=counted(rows), amplified=f"{AMPLIFIED:g}")


def _row_json(row: Row) -> dict[str, Any]:
    device = row.device
    return {
        "material": row.material,
        "route": row.route.name,
        "status": row.status,
        "problem": row.problem or None,
        "device": None if device is None else f"{device.name} {device.version}",
        "versions": dict(row.versions),
        "cases": {r.case: _comparison_json(r.comparison) for r in row.results},
    }


def _comparison_json(comparison: Comparison) -> dict[str, Any]:
    worst = comparison.worst
    return {
        "covered": comparison.covered,
        "undecided": comparison.undecided,
        "wrong": comparison.wrong,
        "max_difference": _finite(comparison.max_difference),
        "max_difference_in_tolerances": _finite(comparison.excess),
        "worst": worst
        and {
            "x": worst.x,
            "y": worst.y,
            "target": worst.target,
            "got": [_finite(lane) for lane in worst.got],
            "expected": [_finite(lane) for lane in worst.expected],
        },
    }


def _row_page(row: Row) -> dict[str, Any]:
    device = row.device
    return {
        "route": row.route.name,
        "title": row.route.title,
        "status": row.status,
        "difference": f"{row.max_difference:.2e}" if row.results else "",
        "undecided": row.undecided if row.results else "",
        "device": f"{device.name} {device.version}" if device else "",
        "versions": ", ".join(f"{name} {v}" for name, v in row.versions.items()),
        "details": list(details(row)),
        "pictures": [_pictures(r) for r in row.results if not r.comparison.agrees],
    }


def _references(rows: Sequence[Row]) -> list[dict[str, str]]:
    """The reference's picture of each case, from the first row that has any."""
    results = next((row.results for row in rows if row.results), ())
    return [
        {"case": result.case, "picture": _embedded(result.expected.targets[0])}
        for result in results
    ]


def _pictures(result: Result) -> dict[str, str]:
    got, expected = result.got[0], result.expected.targets[0]
    with np.errstate(invalid="ignore"):
        difference = np.abs(got - expected) * AMPLIFIED
    difference[result.expected.undecided] = [0.0, 0.0, 1.0, 1.0]
    return {
        "case": result.case,
        "got": _embedded(got),
        "expected": _embedded(expected),
        "difference": _embedded(difference, linear=False),
    }


def _embedded(pixels: Any, *, linear: bool = True) -> str:
    """A picture as a ``data:`` address."""
    file = io.BytesIO()
    to_image(pixels, linear=linear).save(file, "PNG")
    return f"data:image/png;base64,{base64.b64encode(file.getvalue()).decode('ascii')}"


def _finite(number: float) -> float | None:
    return number if math.isfinite(number) else None


def _lanes(values: Sequence[float]) -> str:
    return f"({', '.join(f'{value:.6g}' for value in values)})"
