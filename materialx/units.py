"""Units of values: lengths, angles and times as the units that shaders compute in."""

from __future__ import annotations

from .model import Port
from .problems import UnsupportedError
from .values import numbers_of

_UNITS = {
    "distance": {
        "nanometer": 1e-9, "micron": 1e-6, "millimeter": 0.001, "centimeter": 0.01, "inch": 0.0254,
        "foot": 0.3048, "yard": 0.9144, "meter": 1.0, "kilometer": 1000.0, "mile": 1609.344,
    },
    "angle": {"degree": 1.0, "radian": 180 / 3.141592653589793},
    "time": {
        "second": 1.0, "millisecond": 0.001, "microsecond": 1e-6, "minute": 60.0, "hour": 3600.0,
        "day": 86400.0,
    },
}  # fmt: skip
"""How many of the unit that shaders get each unit is: metres, degrees and seconds."""


def converted(port: Port) -> str:
    """The text of a value, in the unit that shaders get."""
    assert port.value is not None
    if not port.unit:
        return port.value
    kinds = [port.unit_type] if port.unit_type else list(_UNITS)
    for kind in kinds:
        factor = _UNITS.get(kind, {}).get(port.unit)
        if factor is not None:
            if factor == 1.0:
                return port.value
            return ", ".join(repr(float(f"{number * factor:.7g}")) for number in _numbers(port))
    raise UnsupportedError(f"there is no unit '{port.unit}'")


def _numbers(port: Port) -> list[float]:
    assert port.value is not None
    try:
        return numbers_of(port.value)
    except ValueError:
        raise UnsupportedError(f"'{port.value}' is no value of the type {port.type}") from None
