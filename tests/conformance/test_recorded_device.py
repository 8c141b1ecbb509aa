"""Pixels that a real GPU has drawn are within the bounds of its routes.

``recorded/h200.json`` has 148 pixels of the examples: of each row that was out of bounds when these
were taken from software that rasterises, the one that was farthest out. 17 more of them were
drawn with spots whose inner cone was the wider one, which mean something else since; and 12 with
materials that counted light in units of their own. Examples that have become other programs since
are kept beside the record as they were.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from burnish.support.frozen import changed
from burnish.targets.conformance import sample
from burnish.targets.conformance.bounds import Bounds, bounds_of, promised
from burnish.targets.conformance.drivers import DRIVERS
from burnish.targets.conformance.profiles import keep
from burnish.targets.runner.drivers.device import Device
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.reference import expected
from burnish.targets.runner.routes import EVERY_ROUTE, Route
from burnish.targets.runner.scene_state import SceneState

from .example_subjects import states, subjects

FOLDER = Path(__file__).parent / "recorded"
RECORD = json.loads((FOLDER / "h200.json").read_text(encoding="utf-8"))
DIGITS = 2e-7
"""The relative error of the recorded numbers, which have seven digits."""
REPORTED: Mapping[str, Any] = {
    "vulkan": Device(RECORD["device"], RECORD["version"], 8, subtexel_bits=8, mip_bits=8),
    "wgpu": Device(RECORD["device"], RECORD["version"], 8, subtexel_bits=0, mip_bits=0),
}
"""What each API reported of the device."""

PROFILE = replace(
    DRIVERS["vulkan"].assumed, subtexel_bits=8, mip_bits=8, lod_error=0.11, footprint="ellipse",
    product_bits=8, fixed_bits=15, float_bits=15, mixing_bits=15, derivatives="own",
)  # fmt: skip
"""What measuring finds of a device that filters as this one does (``test_simulated_device.py``)."""


@dataclass(frozen=True)
class Pixel:
    """A pixel that was drawn."""

    subject: str
    route: str
    case: str
    at: tuple[int, int]
    drawn: tuple[float, ...]


@pytest.fixture(autouse=True)
def data_in_textures(monkeypatch: pytest.MonkeyPatch) -> None:
    """No texture was encoded as sRGB when these were drawn, as those of colours are now."""
    sampled = sample._sampled_texture
    monkeypatch.setattr(
        sample, "_sampled_texture", lambda row, *rest: sampled(changed(row, intent="data"), *rest)
    )


PIXELS = [Pixel(**row) for row in RECORD["pixels"]]
FILES = sorted({pixel.subject.partition(":")[0] for pixel in PIXELS})


def _ends(
    subject: Any, route: Route, state: SceneState, pixel: Pixel, bounds: Bounds
) -> tuple[Any, Any]:
    """The bounds of a pixel; only its quad is drawn."""
    x, y = (place // 2 * 2 for place in pixel.at)
    rules = replace(bounds.rules, scissor=(x, y, 2, 2))
    shader = Exact.of(subject).emitted(route.profile)
    found = expected(shader, state, rules, bounds.errors)
    column, row = pixel.at
    return found.low[0][row, column], found.high[0][row, column]


def _drawn(file: str) -> dict[str, Any]:
    """The materials of an example as it was when it was drawn, by the label in the table."""
    return subjects(file, FOLDER) if (FOLDER / file).exists() else subjects(file)


def _outside(file: str, level: str) -> Iterator[str]:
    """The lanes of recorded pixels that are out of the hull of some bounds."""
    found = _drawn(file)
    for pixel in (each for each in PIXELS if each.subject.startswith(f"{file}:")):
        subject, route = found[pixel.subject], EVERY_ROUTE[pixel.route]
        state = states(subject)[pixel.case]
        lows, highs = zip(
            *(
                _ends(subject, route, state, pixel, bounds)
                for bounds in _wanted(state, route, level)
            ),
            strict=True,
        )
        low, high = np.min(lows, axis=0), np.max(highs, axis=0)
        drawn = np.array(pixel.drawn)
        slack = DIGITS * np.abs(drawn)
        lanes = slice(len(drawn))
        if ((drawn < low[lanes] - slack) | (drawn > high[lanes] + slack)).any():
            yield f"{pixel}: {low} … {high}"


def _wanted(state: SceneState, route: Route, level: str) -> list[Bounds]:
    """The bounds of a level for the device; those that are promised know nothing of it."""
    if level == "promised":
        return list(promised(state, route))
    return [one for one in bounds_of(state, route, REPORTED[route.driver]) if one.level == level]


@pytest.mark.parametrize("file", FILES)
def test_what_a_gpu_drew_is_within_what_is_guaranteed(file: str) -> None:
    assert list(_outside(file, "guaranteed")) == []


@pytest.mark.parametrize("file", FILES)
def test_what_a_gpu_drew_is_within_what_golden_folders_have(file: str) -> None:
    assert list(_outside(file, "promised")) == []


@pytest.mark.parametrize("file", FILES)
def test_what_a_gpu_drew_is_within_what_would_be_measured(
    file: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path))
    for driver, device in REPORTED.items():
        keep(driver, device, PROFILE)
    assert list(_outside(file, "measured")) == []
