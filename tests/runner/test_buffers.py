"""Storage buffers of an instance: from lists and arrays to bytes, and back."""

from __future__ import annotations

import struct
from typing import Any

import numpy as np
import pytest

import burnish
from burnish import Instance, ParameterError
from burnish.targets.runner.instances.instance import Instance as Runtime

TEXT = """
struct Lamp {
    place : vec3  power : float  aim : direction<world>  on : bool  turn : mat2  w : float[2]
}
material M {
    buffer lamps   : Lamp[]
    buffer numbers : float[]
    buffer heights : vec3[]
    buffer codes   : uint[]
    color = lamps[1].place * numbers[0] + heights[0] + vec3(float(codes[0]))
}
"""
REFLECTION = burnish.compile(TEXT, ("wgsl",))["M"].reflection

LAMP: dict[str, Any] = {
    "place": (1, 2, 3), "power": 4, "aim": (0, 1, 0), "on": True,
    "turn": ((5, 6), (7, 8)), "w": (9, 10),
}  # fmt: skip
VALUES = (1, 2, 3, 4, 0, 1, 0, 1, 5, 6, 0, 0, 7, 8, 0, 0, 9, 10, 0, 0)
BYTES = struct.pack("<3ff3fI2f2f2f2f2f2f", *VALUES)


@pytest.fixture
def instance() -> Runtime:
    return Instance(REFLECTION)


def test_until_it_is_set_a_buffer_is_empty(instance: Runtime) -> None:
    contents = instance.buffers()["heights"]
    assert (contents.count, contents.data, contents.bound) == (0, b"", bytes(16))
    assert instance.get("heights") == ()
    assert instance.get("heights.count") == 0


def test_a_list_sets_elements_and_their_count(instance: Runtime) -> None:
    instance.set("lamps", [LAMP, LAMP | {"power": 0.5}])
    contents = instance.buffers()["lamps"]
    assert contents.count == instance.get("lamps.count") == 2
    assert contents.data[: len(BYTES)] == BYTES
    assert len(contents.data) == 2 * len(BYTES)
    assert instance.get("lamps")[1] == {
        "place": (1, 2, 3), "power": 0.5, "aim": (0, 1, 0), "on": True,
        "turn": ((5, 6), (7, 8)), "w": (9, 10),
    }  # fmt: skip


def test_an_attribute_sets_and_reads_one(instance: Runtime) -> None:
    instance.numbers = [1, 2.5]
    assert instance.get("numbers") == (1, 2.5)
    assert instance.numbers == instance.get("numbers")


def test_an_array_with_fields_gives_the_same_bytes(instance: Runtime) -> None:
    kind = [
        ("place", "f8", 3), ("power", "f4"), ("aim", "f4", 3), ("on", "?"),
        ("turn", "f4", (2, 2)), ("w", "f4", 2), ("more", "i4"),
    ]  # fmt: skip
    array = np.zeros(2, dtype=kind)
    for name, value in LAMP.items():
        array[name] = value
    instance.set("lamps", array)
    assert instance.buffers()["lamps"].data == 2 * BYTES


@pytest.mark.parametrize(
    ("name", "array"),
    [
        ("numbers", np.arange(5)),
        ("heights", np.arange(12.0).reshape(4, 3)),
        ("codes", np.array([0, 2**32 - 1], np.uint32)),
        ("numbers", np.zeros(0)),
    ],
)
def test_arrays_and_lists_of_numbers_are_alike(instance: Runtime, name: str, array: Any) -> None:
    instance.set(name, array)
    packed = instance.buffers()[name]
    instance.set(name, array.tolist())
    assert instance.buffers()[name] == packed
    assert packed.count == len(array)


WRONG: list[tuple[str, Any, str]] = [
    ("numbers", 3, "`numbers` takes a list of elements (float[]), and was given 3"),
    ("numbers", "abc", "`numbers` takes a list of elements (float[]), and was given 'abc'"),
    ("numbers", [1, "x"], "`numbers[1]` (float) cannot hold 'x'"),
    ("numbers", np.array([1, np.inf]), "`numbers[1]` (float) cannot hold inf"),
    ("codes", [-1], "`codes[0]` is a 32-bit uint, 0 to 4294967295: -1 is not"),
    ("codes", np.array([3, -1]), "`codes[1]` (uint) cannot hold -1"),
    ("codes", np.array([0.5]), "`codes[0]` (uint) cannot hold 0.5"),
    ("heights", [(1, 2)], "`heights[0]` takes 3 numbers (vec3), and was given a list of 2"),
    ("heights", np.zeros((2, 2)), "`heights[0]` takes 3 numbers (vec3), and was given a list of 2"),
    ("lamps", [{"power": 1}], "`lamps[0].place` has no value (vec3)"),
    ("lamps", [LAMP | {"aim": (0, 2, 0)}],
     "`lamps[0].aim` is a direction and has to be of length 1, not 2: that would be (0, 1, 0)"),
    ("lamps.count", 3, "`lamps.count` is set with `lamps`, whose elements it counts"),
    ("lamps[0].power", 3, "`lamps` is a storage buffer, which is set and read as a whole"),
    ("nmbers", [1], "there is no parameter `nmbers`: did you mean `numbers`?"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "value", "message"), WRONG, ids=[row[2] for row in WRONG])
def test_what_does_not_fit_is_refused_and_changes_nothing(
    instance: Runtime, name: str, value: Any, message: str
) -> None:
    instance.set("numbers", [7])
    with pytest.raises(ParameterError) as error:
        instance.set(name, value)
    assert str(error.value) == message
    assert instance.get("numbers") == (7,)
    assert instance.get("lamps") == ()


def test_directions_of_an_array_have_length_one(instance: Runtime) -> None:
    kind = [("place", "f4", 3), ("power", "f4"), ("aim", "f4", 3), ("on", "?"),
            ("turn", "f4", (2, 2)), ("w", "f4", 2)]  # fmt: skip
    array = np.zeros(1, dtype=kind)
    array["aim"] = (0, 1.0005, 0)
    instance.set("lamps", array)
    assert instance.get("lamps")[0]["aim"] == (0, 1, 0)
    array["aim"] = (0, 3, 0)
    with pytest.raises(ParameterError, match=r"`lamps\[0\].aim` \(direction<world>\) cannot hold"):
        instance.set("lamps", array)
