"""Packs the values of a text's uniforms as one block, by which drivers set them one by one.

Values that a host sets have names that MaterialX gives them; all others stand in the document.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ...targets.runner.drivers.slots import BlockSlot, Place, UniformSlot
from ...targets.runner.lamps import Lamp
from .records import MOST_LIGHTS, Generated, Stream, Uniform
from .settings import ALPHA_THRESHOLD, Floats, Setting, columns

_WHOLE = frozenset(("integer", "boolean", "string"))
"""The types whose uniforms hold whole numbers."""
_LANES = {
    "float": 1, "vector2": 2, "vector3": 3, "vector4": 4, "color3": 3, "color4": 4,
    "matrix33": 9, "matrix44": 16, "integer": 1, "boolean": 1, "string": 1,
}  # fmt: skip

INTENSITY = math.pi
"""The intensity of MaterialX's lights for those of Burnish, under which a white matt surface is
white: of MaterialX's light, such a surface reflects 1/π."""


@dataclass(slots=True)
class _Block:
    """A block that grows."""

    slots: list[UniformSlot] = field(default_factory=list)
    data: bytearray = field(default_factory=bytearray)

    def add(self, name: str, values: Sequence[float] | Floats, *, whole: bool = False) -> None:
        """Add the value of a uniform."""
        packed = np.asarray(values).astype("<i4" if whole else "<f4").tobytes()
        self.slots.append(UniformSlot(name, len(self.data), len(packed)))
        self.data += packed


def uniform_block(generated: Generated, setting: Setting) -> tuple[BlockSlot, bytes]:
    """The block of all uniforms of a text, with the values of a setting."""
    block, given = _Block(), _given(setting)
    for uniform in generated.uniforms:
        whole = uniform.type in _WHOLE
        block.add(uniform.name, _value(uniform, given), whole=whole)
    for member in generated.light_members:
        for number in range(MOST_LIGHTS):
            lamp = setting.lamps[number] if number < len(setting.lamps) else None
            value = (0.0,) * _LANES[member.type] if lamp is None else _of(lamp, member, setting)
            name = f"u_lightData[{number}].{member.name}"
            block.add(name, value, whole=member.type in _WHOLE)
    place = Place("", None, None)
    return BlockSlot(place, len(block.data), tuple(block.slots)), bytes(block.data)


def _value(uniform: Uniform, given: Mapping[str, Sequence[float] | Floats]) -> Floats:
    value = given.get(uniform.name, uniform.value)
    lanes = _LANES[uniform.type]
    found = np.zeros(lanes)
    found[: len(value)] = value
    return found


def _of(lamp: Lamp, member: Stream, setting: Setting) -> Sequence[float]:
    """The value of a member for a light."""
    match member.name:
        case "type":
            return (float(1 + setting.light_kinds.index(lamp.kind)),)
        case "color":
            return lamp.color
        case "intensity":
            return (INTENSITY,)
        case "direction":
            return lamp.direction
        case "position":
            return lamp.place
        case "decay_rate":
            return (setting.decay,)
    raise AssertionError(member.name)  # no light of ``LIGHT_KINDS`` has others


def _given(setting: Setting) -> dict[str, Sequence[float] | Floats]:
    """The values that a host sets, by the names of uniforms."""
    camera = setting.scene.camera
    given: dict[str, Sequence[float] | Floats] = {
        "u_viewPosition": camera.eye,
        "u_viewDirection": -camera.world_to_camera[2, :3],
        "u_numActiveLightSources": (float(len(setting.lamps)),),
        "u_alphaThreshold": (ALPHA_THRESHOLD,),
        "u_frame": (setting.frame,),
        "u_time": (setting.time,),
    }
    given.update(_matrices(setting))
    return given


def _matrices(setting: Setting) -> Iterator[tuple[str, Floats]]:
    """The matrices of all spaces: each as it is, transposed, inverse, and both."""
    camera = setting.scene.camera
    world = np.array(setting.scene.object_to_world)
    view = np.asarray(camera.world_to_camera)
    clip = camera.world_to_clip(setting.aspect)
    projection = clip @ np.linalg.inv(view)
    named = {"world": world, "view": view, "projection": projection}
    for name, matrix in named.items():
        inverse = np.linalg.inv(matrix)
        yield f"u_{name}Matrix", columns(matrix)
        yield f"u_{name}TransposeMatrix", columns(matrix.T)
        yield f"u_{name}InverseMatrix", columns(inverse)
        yield f"u_{name}InverseTransposeMatrix", columns(inverse.T)
    yield "u_worldViewMatrix", columns(view @ world)
    yield "u_viewProjectionMatrix", columns(clip)
    yield "u_worldViewProjectionMatrix", columns(clip @ world)
