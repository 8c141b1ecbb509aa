"""Chooses one of a machine's devices, for the drivers that can draw with any."""

from __future__ import annotations

from collections.abc import Sequence

from .device import DriverError


def chosen(names: Sequence[str], hardware: Sequence[bool], wanted: str) -> int:
    """The number of the device that ``wanted`` means.

    That is a number itself, or a part of a name, in capitals or not. If it is empty, the first
    device that is hardware is meant, or else the first one. Raises ``DriverError``, which lists
    the devices.
    """
    if not names:
        raise DriverError("there is no device to draw with")
    if not wanted:
        return next((number for number, real in enumerate(hardware) if real), 0)
    fitting = [at for at, name in enumerate(names) if wanted.casefold() in name.casefold()]
    if wanted.isdigit() and int(wanted) < len(names):
        fitting = [int(wanted)]
    if fitting:
        return fitting[0]
    listed = "; ".join(f"number {number}, {name}" for number, name in enumerate(names))
    raise DriverError(f"no device is called `{wanted}`; the devices are {listed}")
