"""Golden folders as others might write them, for tests of what judges pictures."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

WIDTH, HEIGHT = 3, 2
CASE = "Plain/defaults"


def bounds(low: float = 0.25, high: float = 0.5, lanes: int = 4) -> tuple[Array, Array]:
    """The same bounds for all numbers of a small picture."""
    shape = HEIGHT, WIDTH, lanes
    return np.full(shape, low, np.float64), np.full(shape, high, np.float64)


def write_case(
    root: Path,
    low: Array,
    high: Array,
    undecided: Array | None = None,
    name: str = "color",
    folder: str = CASE,
) -> dict[str, Any]:
    """Write the files of a case with one output, and return its row."""
    place = root / folder
    place.mkdir(parents=True, exist_ok=True)
    height, width, lanes = low.shape
    if undecided is None:
        undecided = np.zeros((height, width), "u1")
    np.save(place / "undecided.npy", undecided)
    middle = np.clip(low, -1e9, 1e9) / 2 + np.clip(high, -1e9, 1e9) / 2
    for end, array in (("lower", low), ("upper", high), ("reference", middle)):
        np.save(place / f"{name}.{end}.npy", array)
    subject, _, case = folder.partition("/")
    return {
        "subject": subject, "case": case, "folder": folder, "width": width, "height": height,
        "outputs": [{"name": name, "lanes": lanes}], "inputs": {},
    }  # fmt: skip


def write_golden(root: Path, *cases: Mapping[str, Any], **changes: object) -> Path:
    """Write the document of a golden folder, and return the folder."""
    document = {
        "format": "burnish-golden", "version": 1, "burnish": "0.1.0", "seed": 0, "routes": [],
        "cases": list(cases), **changes,
    }  # fmt: skip
    root.mkdir(parents=True, exist_ok=True)
    (root / "golden.json").write_text(json.dumps(document), "utf-8")
    return root


def small_golden(root: Path, **changes: object) -> Path:
    """A golden folder with one small picture."""
    return write_golden(root, write_case(root, *bounds()), **changes)


def flat(value: float, lanes: int = 4) -> Array:
    """A picture of one number."""
    return np.full((HEIGHT, WIDTH, lanes), value)
