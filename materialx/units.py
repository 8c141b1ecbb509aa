"""Units of values: lengths, angles and times as the units that shaders compute in."""

from __future__ import annotations

from .expressions import Call, Expression, Name, Number, Unary, number_text
from .model import Port
from .problems import UnsupportedError
from .values import LANES, literal, numbers_of

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


_WRITTEN = {
    "nanometer": "nm", "micron": "um", "millimeter": "mm", "centimeter": "cm", "inch": "in",
    "foot": "ft", "yard": "yd", "meter": "m", "kilometer": "km", "mile": "mi",
}  # fmt: skip
"""The units of lengths as they stand behind numbers in Burnish."""


def written_unit(port: Port) -> str:
    """The unit that is written behind the numbers of an input; empty if they are converted."""
    if port.unit_type not in ("", "distance") or port.type not in LANES:
        return ""
    return _WRITTEN.get(port.unit, "")


def measured(port: Port, kind: str) -> Expression:
    """The value of an input, with the unit that the document has if there is such a one."""
    assert port.value is not None
    unit = written_unit(port)
    return _with_unit(literal(port.value, kind), unit) if unit else literal(converted(port), kind)


def _with_unit(value: Expression, unit: str) -> Expression:
    match value:
        case Number(0.0):
            return value
        case Number(number):
            return Name(f"{number_text(number)}{unit}")
        case Unary(operator, operand):
            return Unary(operator, _with_unit(operand, unit))
        case Call(name, arguments, labels):
            return Call(name, tuple(_with_unit(each, unit) for each in arguments), labels)
    return value


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
