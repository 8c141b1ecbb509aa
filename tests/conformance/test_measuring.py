"""The precision of a device that is measured: on drivers that are known, and what is kept of it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from burnish.api import entry_points as api
from burnish.targets.conformance import profiles
from burnish.targets.conformance.bounds import bounds_of
from burnish.targets.conformance.drivers import DRIVERS
from burnish.targets.conformance.measuring import cubes, derivation, footprints
from burnish.targets.conformance.measuring.derivation import MeasuringError
from burnish.targets.conformance.measuring.measure import measured, measured_by
from burnish.targets.conformance.measuring.probes import FILE, PROBES, THIRD, Probe
from burnish.targets.conformance.profiles import keep, profile_of
from burnish.targets.runner.drivers.device import Device
from burnish.targets.runner.routes import EVERY_ROUTE, ROUTES
from burnish.targets.runner.store import Store

from .kit import Studio

DEVICE = Device("Some GPU", "1.2.3", subpixel_bits=8, subtexel_bits=8, mip_bits=8)
ASSUMED = DRIVERS["vulkan"].assumed
FOUND = replace(
    ASSUMED, lod_error=0.11, footprint="ellipse", fixed_bits=15, float_bits=None, derivatives="own"
)


def compiled(probe: Probe, profile: str) -> Any:
    return api.compile(
        FILE, (profile,), material=probe.material, pass_=probe.pass_, keep_graphs=True
    ).materials[0]


@pytest.fixture(autouse=True)
def _own_cache(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))


@pytest.mark.parametrize(
    "name", ["lavapipe:glsl", "swiftshader:glsl", "llvmpipe:gl330", "llvmpipe:gl450"]
)
def test_software_is_found_to_be_what_is_known_of_it(studio: Studio, name: str) -> None:
    route = ROUTES[name]
    driver = DRIVERS[route.driver]
    assert driver.measured is not None
    found = measured(route, driver.assumed, compiled, studio.runner, studio.toolchain)
    assert found.footprint == driver.measured.footprint == "euclidean"
    assert found.derivatives == driver.measured.derivatives
    # Both read logarithms from the bits of floats (``level_power``).
    assert found.lod_error is not None
    assert found.lod_error < 2.0**-4
    assert found.subtexel_bits >= driver.measured.subtexel_bits
    assert found.mip_bits >= driver.measured.mip_bits
    assert (found.fixed_bits, found.float_bits) == (None, None)
    assert found.varying_bits == driver.assumed.varying_bits


def _drawn(value: float) -> Any:
    """A device that draws one number for everything."""

    def draw(material: Any, states: Sequence[object]) -> Any:
        count = len(material.reflection.targets)
        return [[np.full((128, 128, 4), value)] * count for _ in states]

    return draw


@pytest.mark.parametrize(
    ("value", "message"),
    [(np.nan, "what is not a number"), (0.0, "something else than the texels")],
)
def test_a_device_that_draws_nonsense_is_told(value: float, message: str) -> None:
    subjects = [compiled(probe, "glsl:vulkan") for probe in PROBES]
    with pytest.raises(MeasuringError, match=message):
        measured_by(_drawn(value), subjects, ASSUMED, bottom_up=False)


def test_a_device_that_reports_weights_of_0_bits_is_told() -> None:
    """It takes the nearest texel, although it is asked to filter."""
    where = np.zeros((128, 128, 4))
    where[..., 0] = np.linspace(0.25, 0.75, 128)
    where[..., 1] = where[..., 0].T
    nearest = np.rint(where * 2 - 0.5)
    nearest[..., 3] = THIRD
    drawn: dict[str, Any] = {
        "Weights": [(nearest, nearest, nearest, where)],
        "Levels": [(where, where, where, where)],
        "Slopes": [(where,)],
    }
    with pytest.raises(MeasuringError, match="it blends texels by weights of 0 bits"):
        derivation.derived(drawn, ASSUMED, bottom_up=False)


# --- what is kept ---------------------------------------------------------------------------------


def test_a_profile_is_kept_for_one_driver_one_device_and_one_version() -> None:
    assert profile_of("vulkan", DEVICE) is None
    assert keep("vulkan", DEVICE, FOUND)
    assert profile_of("vulkan", DEVICE) == FOUND
    assert profile_of("wgpu", DEVICE) is None
    assert profile_of("vulkan", replace(DEVICE, version="1.2.4")) is None
    assert profile_of("vulkan", replace(DEVICE, name="Another GPU")) is None


def test_a_profile_goes_with_what_is_assumed_beside_it(monkeypatch: pytest.MonkeyPatch) -> None:
    keep("vulkan", DEVICE, FOUND)
    driver = DRIVERS["vulkan"]
    assumed = replace(driver.assumed, varying_bits=driver.assumed.varying_bits - 1)
    monkeypatch.setitem(DRIVERS, "vulkan", replace(driver, assumed=assumed))
    assert profile_of("vulkan", DEVICE) is None


def test_bounds_are_those_that_were_measured_first() -> None:
    route, size = EVERY_ROUTE["vulkan:glsl"], SimpleNamespace(width=8, height=8)
    (alone,) = bounds_of(size, route, DEVICE)
    assert alone.level == "guaranteed"
    assert (alone.rules.footprint, alone.rules.fixed_bits) == ("any", 6)
    keep("vulkan", DEVICE, FOUND)
    first, last = bounds_of(size, route, DEVICE)
    assert (first.level, last) == ("measured", alone)
    assert (first.rules.footprint, first.rules.fixed_bits) == ("ellipse", 15)
    assert first.rules.derivatives == "own"
    # Functions and interpolation were not measured.
    assert first.errors == alone.errors
    assert first.rules.varying_bits == alone.rules.varying_bits


def _stored(content: object) -> None:
    Store(profiles.STORE).write(profiles._name("vulkan", DEVICE), json.dumps(content).encode())


def _content(**changes: object) -> dict[str, Any]:
    keep("vulkan", DEVICE, FOUND)
    data = Store(profiles.STORE).read(profiles._name("vulkan", DEVICE))
    assert data is not None
    return {**json.loads(data), **changes}


BAD_FIELDS: list[dict[str, object]] = [
    {"subtexel_bits": "8"}, {"subtexel_bits": -1}, {"subtexel_bits": 33}, {"subtexel_bits": True},
    {"footprint": "circle"}, {"lod_error": float("nan")}, {"lod_error": 1e9}, {"mip_bits": None},
    {"lines": None}, {"another": 1},
]  # fmt: skip


@pytest.mark.parametrize("bad", BAD_FIELDS, ids=str)
def test_a_profile_with_a_field_that_cannot_be_counts_as_none(bad: dict[str, object]) -> None:
    content = _content()
    _stored({**content, "hardware": {**content["hardware"], **bad}})
    assert profile_of("vulkan", DEVICE) is None


@pytest.mark.parametrize(
    "change", [{"format": 0}, {"device": "Another GPU"}, {"hardware": None}, {"hardware": {}}]
)
def test_a_profile_of_something_else_counts_as_none(change: dict[str, object]) -> None:
    _stored(_content(**change))
    assert profile_of("vulkan", DEVICE) is None


@pytest.mark.parametrize("content", [None, 7, [], "text", {}])
def test_what_is_no_profile_counts_as_none(content: object) -> None:
    _stored(content)
    assert profile_of("vulkan", DEVICE) is None


def test_a_damaged_file_counts_as_none() -> None:
    keep("vulkan", DEVICE, FOUND)
    (path,) = (each for each in Store(profiles.STORE).folder.rglob("*") if each.is_file())
    whole = path.read_bytes()
    for damaged in (whole[: len(whole) // 2], b"", whole[:-1] + bytes([whole[-1] ^ 1])):
        path.write_bytes(damaged)
        assert profile_of("vulkan", DEVICE) is None


def test_without_a_place_for_it_nothing_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BURNISH_CACHE", "/dev/null/nowhere")
    assert not keep("vulkan", DEVICE, FOUND)


# --- parts of the derivation ----------------------------------------------------------------------


@pytest.mark.parametrize(("error", "places"), [(0.5 / 256, 8), (0.5 / 240, 7), (0.25, 1), (0.6, 0)])
def test_a_rounding_error_of_half_a_step_is_that_of_its_bits(error: float, places: int) -> None:
    assert derivation.places(error, 16) == places
    assert derivation.places(0.0, 16) is None


@pytest.mark.parametrize("bottom_up", [False, True])
@pytest.mark.parametrize("kind", ["own", "first", "any"])
def test_the_pixels_that_lend_differences(kind: str, bottom_up: bool) -> None:
    random = np.random.default_rng(1)
    height = random.uniform(-1, 1, (8, 8))
    across = np.repeat(height[:, 1::2] - height[:, ::2], 2, axis=1)
    down = np.repeat(height[1::2] - height[::2], 2, axis=0)
    if kind == "first":
        row = 1 if bottom_up else 0
        across = np.repeat(across[row::2], 2, axis=0)
        down = np.repeat(down[:, ::2], 2, axis=1)
    if kind == "any":
        across = across[::-1]
    slopes = np.stack([height, across, down, 0 * height], axis=-1)
    assert footprints.derivatives(slopes, bottom_up=bottom_up) == kind


def test_a_texel_beyond_a_corner_that_is_one_of_three_is_no_mean() -> None:
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    texels = np.random.default_rng(3).integers(0, 256, (6, 4, 4, 4)) / 255
    three = [[cubes._texel(texels, face, at) for face in cubes._faces(at)] for at in corners]
    where = np.concatenate([corners, np.zeros((8, 1))], axis=1)[None]
    mean = np.mean(three, axis=1)[None]
    assert cubes.corner_bits((mean, where)) == cubes.MOST_BITS
    first = np.array([(2 * a + b + c) / 4 for a, b, c in three])[None]
    assert cubes.corner_bits((first, where)) is None
