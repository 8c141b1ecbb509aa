"""The devices that choose at random: what they make of the values that a graph gets."""

from __future__ import annotations

import numpy as np

from burnish.compiler.reference.bounds.errors import Errors

from .device import HABITS, Device
from .random_graphs import SPECIAL

ERROR = 2.0**-18
VALUES = np.array([*SPECIAL, 0.1, -7.3, 1e5]).astype(np.float32).astype(np.float64)


def _given(device: Device, place: str) -> np.ndarray:
    found: np.ndarray = device.given(VALUES, ERROR, place).value
    return found


def test_what_is_given_is_a_float32_within_its_error() -> None:
    for seed in range(100):
        found = _given(Device(Errors(("wgsl",)), HABITS[0], seed), "p0")
        assert (found == found.astype(np.float32)).all()
        assert (np.abs(found - VALUES) <= ERROR * np.abs(VALUES)).all()


def test_what_is_given_depends_on_the_place_and_on_nothing_before() -> None:
    device = Device(Errors(("wgsl",)), HABITS[4], 1)
    first = _given(device, "p0")
    assert (_given(device, "p1") != first).any()
    device.sin(VALUES)
    assert (_given(device, "p0") == first).all()
