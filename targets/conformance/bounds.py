"""The bounds of a device's values: its rasterisation rules, and the errors of its functions.

``trials.py`` and ``frames.py`` ask for them, for each route and the device with which it draws.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import product
from typing import Protocol

from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.picture import RasterRules
from ...stdlib.builtins.accuracy import Platform
from ..runner.drivers.device import Device
from ..runner.routes import Route
from .compare import Level
from .drivers import DRIVERS, Driver, Hardware
from .measured import ENVELOPES
from .profiles import profile_of

_ANY: tuple[Platform, ...] = ("vulkan",)
"""The platform for errors of functions. Errors that were not measured follow from those that were,
on any platform. So all routes to a driver share one picture."""


@dataclass(frozen=True, slots=True)
class Bounds:
    """The tolerance for a device: its rasterisation rules, and the errors of its functions."""

    level: Level
    rules: RasterRules
    errors: Errors


class Sized2d(Protocol):
    """Anything with a width and a height in pixels."""

    @property
    def width(self) -> int:
        """Pixels in a row."""

    @property
    def height(self) -> int:
        """Rows."""


def bounds_of(state: Sized2d, route: Route, device: Device) -> tuple[Bounds, ...]:
    """The bounds of a picture: those that were measured, then the guaranteed ones.

    Of software, its driver was measured; of other devices, this user may have measured theirs.
    """
    driver = DRIVERS[route.driver]
    ruled = partial(rules_of, state, device, driver, bottom_up=route.bottom_up)
    guaranteed = Bounds(
        "guaranteed",
        ruled(_guaranteed(driver.assumed, device)),
        Errors(route.platforms),
    )
    if driver.measured is not None:
        functions = ENVELOPES[route.driver].allowed()
        errors = Errors(_ANY, tuple(sorted(functions.items())))
        return Bounds("measured", ruled(driver.measured), errors), guaranteed
    profile = profile_of(route.driver, device)
    if profile is None:
        return (guaranteed,)
    # Nothing was measured of the device's functions.
    return Bounds("measured", ruled(profile), guaranteed.errors), guaranteed


def promised(state: Sized2d, route: Route) -> Iterator[Bounds]:
    """The bounds of a picture by all devices that keep the promises of a route's API.

    No device has to be at hand: what devices report is assumed. A device has one of the usual
    grids, and may interpolate between the corners of a triangle before or after they are snapped.
    Golden folders have the hull of what these bounds allow.
    """
    driver = DRIVERS[route.driver]
    errors = Errors(route.platforms)
    is_software = driver.measured is not None
    ways = (driver.interpolates_snapped,) if is_software else (True, False)
    for grid, snapped in product(driver.grids, ways):
        device = Device("", "", subpixel_bits=grid, subtexel_bits=0, mip_bits=0)
        own = replace(driver, interpolates_snapped=snapped)
        hardware = _guaranteed(driver.assumed, device)
        rules = rules_of(state, device, own, hardware, bottom_up=route.bottom_up)
        yield Bounds("guaranteed", rules, errors)


def _guaranteed(assumed: Hardware, device: Device) -> Hardware:
    """The properties that a device reports, and the assumed ones for the rest."""
    return replace(
        assumed,
        subtexel_bits=device.subtexel_bits or assumed.subtexel_bits,
        mip_bits=device.mip_bits or assumed.mip_bits,
    )


def rules_of(
    state: Sized2d, device: Device, driver: Driver, hardware: Hardware, *, bottom_up: bool
) -> RasterRules:
    """The rules by which a device rasterises a state; ``bottom_up``: if a quad's first pixel is the
    lower left one, which matters for levels and derivatives."""
    return RasterRules(
        state.width,
        state.height,
        device.subpixel_bits,
        interpolates_snapped=driver.interpolates_snapped,
        clips_sides=driver.clips_sides,
        owns_bottom=driver.owns_bottom,
        edge_slack=driver.edge_slack,
        subtexel_bits=hardware.subtexel_bits,
        varying_bits=hardware.varying_bits,
        frag_coord_bits=hardware.frag_coord_bits,
        mip_bits=hardware.mip_bits,
        lod_error=hardware.lod_error,
        product_bits=hardware.product_bits,
        fixed_bits=hardware.fixed_bits,
        half_bits=hardware.half_bits,
        float_bits=hardware.float_bits,
        mixing_bits=hardware.mixing_bits,
        derivatives=hardware.derivatives,
        footprint=hardware.footprint,
        corner_bits=hardware.corner_bits,
        lines=(device.lines or "any") if hardware.lines == "any" else hardware.lines,
        snaps_line_ends=driver.snaps_line_ends,
        level_power=driver.level_power,
        bottom_up=bottom_up,
        projects_cubes=driver.projects_cubes,
        mirrors_sample_depths=driver.mirrors_sample_depths,
    )


def precise(rules: RasterRules) -> RasterRules:
    """The rules of a device that covers the same pixels, but rounds nothing.

    Of this device, nothing is known about an operation without a guard that leaves its domain.
    """
    return replace(
        rules.reading_exactly,
        varying_bits=None,
        frag_coord_bits=None,
        unguarded_is_nan=True,
    )
