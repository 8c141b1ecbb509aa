"""``burnish conform --measure``: finds and keeps how precisely the devices of routes filter."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

import click

from ..api import entry_points as api
from ..targets.conformance.drivers import DRIVERS, Hardware
from ..targets.conformance.measuring.derivation import MeasuringError
from ..targets.conformance.measuring.measure import measured
from ..targets.conformance.measuring.probes import FILE, Probe
from ..targets.conformance.profiles import keep
from ..targets.runner.codes import CodeError
from ..targets.runner.drivers.device import DriverError
from ..targets.runner.routes import DEVICE_DRIVERS, Route
from ..targets.runner.runner import Runner
from ..targets.toolchain import Toolchain
from .console import Styled, remark, say
from .terminal import FAILED

if TYPE_CHECKING:
    from ..api.entry_points import CompiledMaterial
    from ..targets.runner.drivers.device import Device

_INEXACT: tuple[tuple[str, str], ...] = (
    ("subtexel_bits", "weights of texels"),
    ("product_bits", "their products"),
    ("mip_bits", "levels that are named"),
    ("fixed_bits", "results of texels in fixed point"),
    ("float_bits", "blends of float texels"),
    ("mixing_bits", "blends of two levels of single texels"),
)
"""The rows of the table that count binary places."""


def measure(routes: Sequence[Route], device: str, *, named: bool) -> None:
    """Measure the device of each driver among some routes, print what was found, and keep it.

    ``named`` says that the routes were named on the command line. Ends the command with the exit
    code 1 if a device could not be measured, or none was.
    """
    found = failed = 0
    with (
        Runner(routes, device=device, parallel=1) as runner,
        Toolchain(states=runner.states, parallel=1) as toolchain,
    ):
        for choice in _by_driver(routes):
            route = next((one for one in choice if runner.problem(one) is None), None)
            if route is None:
                remark("warning", f"{choice[0].name}: not measured: {runner.problem(choice[0])}")
                failed += named
            elif _measure_one(route, runner, toolchain):
                found += 1
            else:
                failed += 1
    if failed or not found:
        click.get_current_context().exit(FAILED)


def _by_driver(routes: Iterable[Route]) -> Iterator[list[Route]]:
    """The routes to each driver."""
    groups: dict[str, list[Route]] = {}
    for route in routes:
        groups.setdefault(route.driver, []).append(route)
    yield from groups.values()


def _measure_one(route: Route, runner: Runner, toolchain: Toolchain) -> bool:
    """Measure a route's device; false, with a message, if that fails. Then nothing is kept."""
    try:
        device = runner.device(route)
        assumed = DRIVERS[route.driver].assumed
        hardware = measured(route, assumed, _compiled, runner, toolchain)
    except (CodeError, DriverError, MeasuringError) as error:
        remark("error", f"{route.name}: its device was not measured, and nothing is kept: {error}")
        return False
    _print_table(route, device, hardware)
    if route.driver not in DEVICE_DRIVERS:
        say("  not kept: `conform` knows this driver")
    elif keep(route.driver, device, hardware):
        say("  kept: later runs of `conform` hold pictures of this device against it first")
    else:
        remark("error", f"{route.name}: what was measured cannot be kept in Burnish's cache folder")
        return False
    return True


def _compiled(probe: Probe, profile: str) -> CompiledMaterial:
    """The material of a probe."""
    found = api.compile(FILE, (profile,), material=probe.material, pass_=probe.pass_)
    (material,) = found.materials
    return material


def _print_table(route: Route, device: Device, hardware: Hardware) -> None:
    """Print what was found, one property in each line."""
    rows = [(words, _places(getattr(hardware, name))) for name, words in _INEXACT]
    corner = hardware.corner_bits
    rows += [("beyond a cube's corner", f"the mean, {_places(corner)}" if corner else "any texel")]
    level = f"{hardware.footprint}, off by up to {hardware.lod_error:.3f}"
    rows += [("levels that follow from steps", level), ("derivatives", hardware.derivatives)]
    say(Styled(f"{route.name}: {device.title}", is_bold=True))
    width = max(len(words) for words, _ in rows)
    for words, value in rows:
        say(f"  {words:<{width}}  {value}")


def _places(bits: int | None) -> str:
    return "as precise as a float" if bits is None else f"{bits} binary places"
