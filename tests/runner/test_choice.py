"""The device of a machine that a name or a number chooses."""

from __future__ import annotations

import pytest

from burnish.targets.runner.drivers.choice import chosen
from burnish.targets.runner.drivers.device import DriverError

NAMES = ("llvmpipe", "NVIDIA RTX 4070", "Intel Arc by D3D12", "Intel Arc by Vulkan")
HARDWARE = (False, True, True, True)


@pytest.mark.parametrize(
    ("wanted", "number"), [("", 1), ("0", 0), ("3", 3), ("rtx", 1), ("arc", 2), ("Arc by vul", 3)]
)
def test_a_device_is_chosen(wanted: str, number: int) -> None:
    assert chosen(NAMES, HARDWARE, wanted) == number


def test_a_number_can_be_a_part_of_a_name() -> None:
    assert chosen(NAMES, HARDWARE, "4070") == 1


def test_without_hardware_the_first_device_is_taken() -> None:
    assert chosen(["llvmpipe", "SwiftShader"], [False, False], "") == 0


@pytest.mark.parametrize("wanted", ["radeon", "9", "-1"])
def test_an_unknown_device_is_an_error_that_lists_them(wanted: str) -> None:
    with pytest.raises(DriverError) as error:
        chosen(NAMES[:2], HARDWARE[:2], wanted)
    assert str(error.value) == (
        f"no device is called `{wanted}`; "
        "the devices are number 0, llvmpipe; number 1, NVIDIA RTX 4070"
    )


def test_a_machine_may_have_no_device() -> None:
    with pytest.raises(DriverError, match="there is no device to draw with"):
        chosen([], [], "")
