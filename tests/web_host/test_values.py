"""The host's values and blocks against the bytes of Python's runtime, and what it refuses."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import burnish
from burnish import Instance
from burnish.compiler.documents.reflection import Reflection
from burnish.targets.runner.scene import Scene

from .kit import in_node

EXAMPLES = Path(__file__).parents[2] / "examples"
NAMES = (
    "area_lights", "fog", "instances", "own_light", "plastic", "shadow_map", "skinned",
    "texture_shift", "water",
)  # fmt: skip
"""Together they have matrices, arrays of lights, tables, structures, and values derived by folds
and functions."""

_BLOCKS = """({reflection, values}) => {
  const made = new call(reflection.material, reflection);
  for (const [name, value] of Object.entries(values)) made.set(name, value);
  return Object.fromEntries([...made.copied().blocks()].map(([name, bytes]) => [name, [...bytes]]));
}"""
_SET = """([reflection, name, value]) => {
  try {
    new call(reflection.material, reflection).set(name, value);
    return null;
  } catch (error) {
    return error.message;
  }
}"""


@cache
def reflections(name: str) -> list[Reflection]:
    return [each.reflection for each in burnish.compile(EXAMPLES / f"{name}.burnish", "wgsl")]


def set_up(reflection: Reflection) -> Instance:
    instance = Instance(reflection)
    Scene().apply(instance, 1.5)
    return instance


def test_blocks_have_the_same_bytes() -> None:
    """Only the last bit may differ, where functions of another library have computed a value."""
    instances = [set_up(each) for name in NAMES for each in reflections(name)]
    given = []
    for instance in instances:
        names = [row.name for row in instance.reflection.parameters]
        values = {name: instance.get(name) for name in names}
        given.append({"reflection": instance.reflection, "values": values})
    found = in_node("values.js", "Values", _BLOCKS, given)
    compared = 0
    for instance, blocks in zip(instances, found, strict=True):
        wanted = instance.blocks()
        assert blocks.keys() == wanted.keys()
        for name, data in wanted.items():
            one = np.array(blocks[name], np.uint8).view("<i4").astype(np.int64)
            other = np.frombuffer(data, "<i4").astype(np.int64)
            label = instance.reflection.material, name
            assert one.shape == other.shape, label
            assert np.abs(one - other).max() <= 1, label
            compared += len(other)
    assert compared > 1000


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("power", 32, None),
        ("power", 600, "`power` is declared in 1..512: 600 is not"),
        ("power", [1, 2], "`power` (float) takes one number"),
        ("base", [0.5, 0.5], "`base` (rgb) takes 3 numbers"),
        ("torch.axis", [0, -2, 0], "`torch.axis` has to be of length 1, not 2"),
        ("torch", {"axis": [0, -1, 0], "outer": 0.5}, None),
        ("lamps", [{"place": [0, 1, 0]}], None),
        ("lamps", [{}] * 9, "`lamps` takes 8 elements"),
        ("lamps.count", 1.5, "`lamps.count` takes whole numbers"),
        ("lamps[2].place", [0, 1, 0], None),
        ("lamps[8].place", [0, 1, 0], "`lamps` has no part `8`"),
        ("shin", 1, "Plastic has no parameter `shin`"),
    ],
)
def test_what_is_set(name: str, value: Any, message: str | None) -> None:
    (reflection,) = reflections("plastic")
    assert in_node("values.js", "Values", _SET, [[reflection, name, value]]) == [message]
