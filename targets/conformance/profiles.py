"""The profiles of devices that were measured on this machine, and the store that keeps them.

``burnish conform --measure`` keeps one for each driver and device, and ``bounds.py`` asks for it. A
file that is damaged, of another format, or about another device counts as none.
"""

from __future__ import annotations

import json
import math
import types
from dataclasses import fields
from typing import Any, Literal, get_args, get_origin, get_type_hints

from ..runner.drivers.device import Device
from ..runner.drivers.wire import to_json
from ..runner.store import Store, digest
from .drivers import DRIVERS, Hardware

STORE = "devices"
"""The name of the store that keeps profiles."""
FORMAT = 1
"""The version of what is kept: one more whenever probes or ``Hardware`` change."""
_MOST_BITS = 32
_MOST_LEVELS = 16.0


def keep(driver: str, device: Device, hardware: Hardware) -> bool:
    """Keep the precision that was measured of a device; false if the store cannot be written."""
    kept = {**_heading(driver, device), "hardware": to_json(hardware)}
    Store(STORE).write(_name(driver, device), json.dumps(kept).encode())
    return profile_of(driver, device) == hardware


def profile_of(driver: str, device: Device) -> Hardware | None:
    """The precision of a device, if it was measured with this driver in this version."""
    data = Store(STORE).read(_name(driver, device))
    try:
        kept = json.loads(data or b"null")
    except ValueError:
        return None
    if not isinstance(kept, dict):
        return None
    found = kept.pop("hardware", None)
    if kept != _heading(driver, device) or not _is_sound(found):
        return None
    return Hardware(**found)


def _is_sound(found: object) -> bool:
    """True if a value has all fields of a ``Hardware``, each in its range."""
    hints = get_type_hints(Hardware)
    if not isinstance(found, dict) or found.keys() != {row.name for row in fields(Hardware)}:
        return False
    return all(_fits(hints[name], value) for name, value in found.items())


def _fits(hint: Any, value: object) -> bool:
    if isinstance(hint, types.UnionType):
        return any(_fits(part, value) for part in get_args(hint))
    if get_origin(hint) is Literal:
        return value in get_args(hint)
    if hint is int:
        return type(value) is int and 0 <= value <= _MOST_BITS
    if hint is float:
        return type(value) is float and math.isfinite(value) and 0.0 <= value <= _MOST_LEVELS
    return hint is type(None) and value is None


def _heading(driver: str, device: Device) -> dict[str, Any]:
    """What a profile is of; what is not measured is assumed, and may be assumed otherwise later."""
    return {
        "format": FORMAT, "driver": driver, "device": device.name, "version": device.version,
        "assumed": to_json(DRIVERS[driver].assumed),
    }  # fmt: skip


def _name(driver: str, device: Device) -> str:
    return digest(*map(str, _heading(driver, device).values()))
