"""A simulated device that filters as NVIDIA's do: it is measured, stays in bounds, and its errors
are found."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, lru_cache
from typing import Any

import pytest

from burnish.api import entry_points as api
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.picture import Expected, RasterRules
from burnish.targets.conformance.bounds import precise, rules_of
from burnish.targets.conformance.compare import Comparison, Level, compare
from burnish.targets.conformance.drivers import DRIVERS, Hardware
from burnish.targets.conformance.measuring.derivation import Pictures
from burnish.targets.conformance.measuring.measure import measured_by
from burnish.targets.conformance.measuring.probes import FILE, PROBES
from burnish.targets.runner.drivers.device import Device
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.reference import expected
from burnish.targets.runner.routes import EVERY_ROUTE
from burnish.targets.runner.scene_state import SceneState
from burnish.targets.runner.subject import Subject

from .example_subjects import states, subjects
from .rounding_device import WRONG, Wrong, sampling

ROUTE = EVERY_ROUTE["vulkan:glsl"]
DRIVER = DRIVERS[ROUTE.driver]
DEVICE = Device("simulated", "1", subpixel_bits=8, subtexel_bits=8, mip_bits=8)
MATERIALS = (
    "plastic.burnish: Plastic × Studio",
    "volume.burnish: Carved",
    "irradiance.burnish: Plaster",
    "texture_array.burnish: Terrain",
    "splatting.burnish: Terrain",
)
"""Materials that read flat textures, a volume, a cube and an array, in levels by steps."""
CASES = ("stretched", "behind")


@cache
def measured() -> Hardware:
    """The precision that is measured of the simulated device."""

    def draw(material: Subject, given: Sequence[SceneState]) -> list[Pictures]:
        shader = Exact.of(material).emitted(ROUTE.profile)
        with sampling():
            return [
                expected(shader, state, RasterRules(state.width, state.height)).targets
                for state in given
            ]

    probes = [
        api.compile(FILE, (ROUTE.profile,), material=each.material, pass_=each.pass_).materials[0]
        for each in PROBES
    ]
    return measured_by(draw, probes, DRIVER.assumed, bottom_up=False)


def test_its_precision_is_found_with_a_margin() -> None:
    found = measured()
    assert (found.subtexel_bits, found.mip_bits) == (8, 8)
    assert found.footprint == "ellipse"
    assert found.lod_error is not None
    assert 22.5 / 256 < found.lod_error < 0.125
    assert found.product_bits == 8
    assert found.fixed_bits in (15, 16)
    assert found.float_bits in (16, 17)
    assert found.mixing_bits in (15, 16)
    assert found.derivatives == "own"
    # Nothing was measured of these.
    assert found.half_bits == DRIVER.assumed.half_bits
    assert found.varying_bits == DRIVER.assumed.varying_bits


def _rules(state: SceneState, level: Level) -> RasterRules:
    hardware = measured() if level == "measured" else DRIVER.assumed
    return rules_of(state, DEVICE, DRIVER, hardware, bottom_up=ROUTE.bottom_up)


def _case(material: str, case: str) -> tuple[Any, SceneState]:
    subject = subjects(material.partition(":")[0])[material]
    return Exact.of(subject).emitted(ROUTE.profile), states(subject)[case]


@lru_cache(maxsize=4)
def _bounds(material: str, case: str, level: Level) -> Expected:
    shader, state = _case(material, case)
    return expected(shader, state, _rules(state, level), Errors(ROUTE.platforms))


def _compared(material: str, case: str, level: Level, wrong: Wrong | None = None) -> Comparison:
    shader, state = _case(material, case)
    with sampling(wrong):
        drawn = expected(shader, state, precise(_rules(state, level))).targets
    bounds = _bounds(material, case, level)
    return compare(drawn, bounds, bounds.targets, [abs(t) + 1 for t in bounds.targets], level)


@pytest.mark.parametrize("level", ["measured", "guaranteed"])
@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("material", MATERIALS)
def test_it_stays_in_bounds(material: str, case: str, level: Level) -> None:
    found = _compared(material, case, level)
    assert found.wrong == 0, found.worst


@pytest.mark.parametrize("wrong", WRONG, ids=str)
@pytest.mark.parametrize("material", MATERIALS)
def test_its_errors_are_found(material: str, wrong: Wrong) -> None:
    assert any(_compared(material, case, "measured", wrong).wrong for case in CASES)
