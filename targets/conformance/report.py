"""Writes a conformance run as JSON, and as a page with pictures."""

from __future__ import annotations

import base64
import io
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from jinja2 import Environment, FileSystemLoader, StrictUndefined
from numpy.typing import NDArray

from ..runner.pictures import to_image
from .compare import Comparison
from .rows import CaseResult, Row
from .summary import by_material, counted, details, devices, lacking, share, tools

TEMPLATE = "report.html.j2"


def as_json(rows: Sequence[Row]) -> dict[str, Any]:
    """The whole run; numbers that are not finite become ``null``."""
    return {"format": 1, "rows": [_row_json(row) for row in rows]}


def page(rows: Sequence[Row]) -> str:
    """The whole run as one HTML file, pictures included."""
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    routes = {row.route.name: row.route for row in rows}
    materials = [
        {"name": name, "references": list(_references(own)), "rows": list(map(_row_page, own))}
        for name, own in by_material(rows).items()
    ]
    return environment.get_template(TEMPLATE).render(
        summary=counted(rows),
        routes=[{"name": name.split(":"), "title": r.title} for name, r in routes.items()],
        materials=materials,
        devices=devices(rows),
        tools=tools(rows),
        lacking=lacking(rows),
    )


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
        "pixels": comparison.pixels,
        "covered": comparison.covered,
        "undecided": comparison.undecided,
        "overflowing": comparison.overflowing,
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
    return {
        "route": row.route.name,
        "status": row.status,
        "share": share(row) if row.results else "",
        "difference": f"{row.max_difference:.2e}" if row.results else "",
        "undecided": f"{row.undecided} of {row.covered}" if row.results else "",
        "details": list(details(row)) if row.status != "not run" else [],
        "pictures": [_pictures(r) for r in row.results if not r.comparison.agrees],
    }


def _references(rows: Sequence[Row]) -> Iterator[dict[str, str]]:
    """The reference's picture of each case and target, from the first row that has results."""
    for result in next((row.results for row in rows if row.results), ()):
        targets = result.expected.targets
        for number, target in enumerate(targets):
            name = f"{result.case}, target {number}" if len(targets) > 1 else result.case
            yield {"name": name, "picture": _embedded(target)}


def _pictures(result: CaseResult) -> dict[str, str]:
    """The pictures that show a disagreement, of the target with the worst pixel."""
    worst = result.comparison.worst
    number = worst.target if worst else 0
    got, expected = result.got[number], result.expected.targets[number]
    difference, times = _difference(got, expected, result.expected.undecided)
    return {
        "case": f"{result.case}, target {number}" if len(result.got) > 1 else result.case,
        "got": _embedded(got),
        "expected": _embedded(expected),
        "difference": _embedded(difference),
        "times": f"{times:.0e}",
    }


def _difference(
    got: NDArray[np.float64], expected: NDArray[np.float64], undecided: NDArray[np.bool_]
) -> tuple[NDArray[np.float64], float]:
    """The largest difference of any lane in grey, and the power of ten by which it is
    brightened."""
    with np.errstate(invalid="ignore"):
        distance = np.abs(got - expected).max(axis=2)
    distance = np.where(np.isfinite(distance), distance, np.inf)
    measured = distance[np.isfinite(distance) & ~undecided]
    largest = measured.max(initial=0.0)
    times = 10.0 ** math.floor(-math.log10(largest)) if largest > 0 else 1.0
    shown = np.repeat(np.minimum(distance * times, 1.0)[:, :, None], 4, axis=2)
    shown[undecided] = [0.0, 0.2, 0.6, 1.0]
    return shown, times


def _embedded(pixels: NDArray[np.float64]) -> str:
    """A picture as a ``data:`` URL."""
    file = io.BytesIO()
    to_image(pixels).save(file, "PNG")
    return f"data:image/png;base64,{base64.b64encode(file.getvalue()).decode('ascii')}"


def _finite(number: float) -> float | None:
    return number if math.isfinite(number) else None
