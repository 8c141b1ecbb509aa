"""Makes random values for parameters, textures and vertex inputs, within their declarations.

``cases.py`` uses it. The value for a name depends only on the seed and on the name, so that a new
parameter does not change the values of the others.
"""

from __future__ import annotations

import math
import random
from collections.abc import Collection, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...compiler.documents.representations import kind_of
from ..runner.instances.contents import layout_of
from ..runner.instances.declared import TextureDeclaration
from ..runner.instances.host_values import HostValues
from ..runner.instances.shapes import WHOLE, Elements, Members, Numbers, Shape, shape_of
from ..runner.scene import set_by_scene
from ..runner.textures.texture import Texture

SPREAD = 4.0
"""A number with a default is chosen from a quarter to four times the default."""

WIDEST = 1024.0
"""The whole of a declared range up to this width is used if there is no default."""

BUFFER_SIZES = (0, 1, 3, 8, 13)
"""The numbers of elements that storage buffers get."""

_LARGEST = float(np.finfo(np.float32).max)
"""The largest number that a parameter can hold."""

_USUAL = {"rgb": (0.0, 1.0), "point": (-2.0, 2.0)}
"""The range of numbers with some meanings, whatever their default."""


def sample_values(
    instance: HostValues, seed: int, *, missing: bool = False, kept: Collection[str] = ()
) -> None:
    """Set every parameter that a scene does not set to an allowed value, and use all lights.

    With ``missing``, set only those that have no value. Those that are ``kept`` stay as they are. A
    parameter that the program does not read needs none; but the material may read it, and parts
    that were removed from the program relied on its range.
    """
    lights = instance.declared.lights
    counts = {light.count for light in lights if light.count}
    counts |= {buffer.count for buffer in instance.declared.buffers}
    placed = set_by_scene(instance.declared) | counts
    for light in lights:
        if light.count:
            instance.set(light.count, light.capacity)
    without = [name.replace("[", ".") for name in instance.missing]
    for row in instance.declared.parameters:
        name = row.name
        unset = any(f"{each}.".startswith(f"{name}.") for each in without)
        unset |= row.block is None and row.default is None
        if name not in placed and name not in kept and (unset or not missing):
            instance.set(name, _value(shape_of(row), random.Random(f"{seed} {name}")))


def sample_buffers(instance: HostValues, seed: int, sizes: Sequence[int] = BUFFER_SIZES) -> None:
    """Fill every storage buffer with some elements, or now and then with none."""
    for row in instance.declared.buffers:
        chance = random.Random(f"{seed} {row.name}")
        element = layout_of(row).element
        count = chance.choice(sizes)
        instance.set(row.name, [_value(element, chance) for _ in range(count)])


def sample_textures(
    instance: HostValues, seed: int, like: Sequence[TextureDeclaration] = ()
) -> None:
    """Give every texture a picture of its own: smooth, and different in all lanes and directions.

    Textures get what those of the same names get among others, which they are ``like``.

    Integer textures get arbitrary numbers; those with 8 bits get few different ones, as palettes
    have. Colours are encoded as sRGB, as those of pictures are, but not what stands for normals.
    """
    numbers = {row.name: number for number, row in enumerate(like or instance.declared.textures)}
    for row in instance.declared.textures:
        number = numbers[row.name]
        chance = random.Random(f"{seed} {row.name}")
        instance.set(row.name, _sampled_texture(row, chance, number + seed))


def _sampled_texture(row: TextureDeclaration, chance: random.Random, turn: int) -> Texture:
    dimension, sample = row.dimension, row.sample
    is_cube = dimension in ("cube", "cube_array")
    size = (16, 16) if is_cube else ((32, 32), (24, 20), (17, 31))[turn % 3]
    count = {"2d": 1, "cube": 6, "2d_array": 3, "3d": 12, "cube_array": 18}[dimension]
    if sample in ("int", "uint"):
        numbers = _numbers_of(chance, (count, size[1], size[0], 4), sample)
        flat = numbers[0] if dimension == "2d" else numbers
        return Texture.of_array(flat, dimension=dimension, sample=sample)
    if dimension == "3d":
        array = _volume(chance, (count, size[1], size[0]))
    else:
        array = np.stack([_waves(chance, size) for _ in range(count)])
    if row.default == "flat_normal":
        array = np.array([0.5, 0.5, 0.9, 0.5]) + (array - 0.5) * [0.5, 0.5, 0.2, 1.0]
    texels = array[0] if dimension == "2d" else array
    if sample == "depth":
        return Texture.of_array(texels[..., :1].clip(0, 1), dimension=dimension, sample="depth")
    encoded = row.intent == "color" and row.default != "flat_normal"
    return Texture.of_array(
        np.rint(texels * 255).astype(np.uint8), srgb=encoded, dimension=dimension
    )


def _value(shape: Shape, chance: random.Random) -> Any:
    match shape:
        case Elements():
            return [_value(shape.element, chance) for _ in range(shape.count)]
        case Members():
            return {member.name: _value(member.shape, chance) for member in shape.members}
        case Numbers():
            return _lanes(shape, chance)


def _lanes(shape: Numbers, chance: random.Random) -> Any:
    """A value of a number, a vector or a matrix."""
    if shape.columns:
        return _matrix(shape, chance)
    count = shape.lanes
    if shape.type.startswith("direction") and count > 1:
        return _unit(chance, count)
    drawn = _numbers(shape, chance)
    return drawn[0] if count == 1 else drawn


def _numbers(shape: Numbers, chance: random.Random) -> list[Any]:
    count, default = shape.lanes, shape.default
    if shape.kind == "bool":
        return [chance.random() < 0.5 for _ in range(count)]
    defaults = [None] * count if default is None else [default] if count == 1 else list(default)
    bounds = [_bounds(shape, each) for each in defaults]
    if limits := WHOLE.get(shape.kind):
        return [_whole(lo, hi, limits, chance) for lo, hi in bounds]
    return [chance.uniform(lo, hi) for lo, hi in bounds]


def _whole(lo: float, hi: float, limits: tuple[int, int], chance: random.Random) -> int:
    least, most = max(math.ceil(lo), limits[0]), min(math.floor(hi), limits[1])
    return chance.randint(least, max(least, most))


def _bounds(shape: Numbers, default: float | None) -> tuple[float, float]:
    """The range of a number: near its default, and within its declared range."""
    declared = shape.range
    if shape.choices and declared is not None:
        return declared
    near = _USUAL.get(shape.meaning)
    if near is None:
        near = _near(declared, default)
    if declared is None:
        return near
    lo, hi = max(near[0], declared[0]), min(near[1], declared[1])
    return (lo, hi) if lo <= hi else (declared[0], declared[1])


def _near(declared: tuple[float, float] | None, default: float | None) -> tuple[float, float]:
    if default:
        ends = (default / SPREAD, default * SPREAD)
        return max(min(ends), -_LARGEST), min(max(ends), _LARGEST)
    if default is None and declared is not None and declared[1] - declared[0] <= WIDEST:
        return declared[0], declared[1]
    return -1.0, 1.0


def _matrix(shape: Numbers, chance: random.Random) -> list[list[float]]:
    """A matrix near its default, or near the identity."""
    start = shape.default or np.eye(shape.columns, shape.lanes).tolist()
    return [[lane + chance.uniform(-0.1, 0.1) for lane in column] for column in start]


def _unit(chance: random.Random, count: int) -> list[float]:
    drawn = [chance.gauss(0, 1) for _ in range(count)]
    length = math.hypot(*drawn)
    return [lane / length for lane in drawn]


def _waves(chance: random.Random, size: tuple[int, int]) -> NDArray[np.float64]:
    """A picture of shape (height, width, 4) made of whole waves, so that it can be repeated, in
    0..1."""
    width, height = size
    y, x = np.meshgrid(np.arange(height) / height, np.arange(width) / width, indexing="ij")
    lanes = []
    for _ in range(4):
        across, down = chance.choice([1, 2, 3]), chance.choice([-2, -1, 1, 2])
        phase = chance.uniform(0, 2 * math.pi)
        slope = 0.15 * (x * chance.uniform(-1, 1) + y * chance.uniform(-1, 1))
        lanes.append(0.5 + 0.3 * np.sin(2 * np.pi * (across * x + down * y) + phase) + slope)
    return np.stack(lanes, 2)


def _volume(chance: random.Random, size: tuple[int, int, int]) -> NDArray[np.float64]:
    """Four lanes of whole waves through (depth, height, width), in 0..1."""
    axes = [(np.arange(count) + 0.5) / count for count in size]
    z, y, x = np.meshgrid(*axes, indexing="ij")
    lanes = []
    for _ in range(4):
        steps = [chance.choice([-2, -1, 1, 2]) for _ in range(3)]
        phase = chance.uniform(0, 2 * math.pi)
        whole = steps[0] * x + steps[1] * y + steps[2] * z
        lanes.append(0.5 + 0.45 * np.sin(2 * np.pi * whole + phase))
    return np.stack(lanes, -1)


def _numbers_of(
    chance: random.Random, shape: tuple[int, ...], sample: str
) -> NDArray[np.int64 | np.uint8]:
    """Small numbers, and now and then a large one that floats cannot represent exactly."""
    drawn = np.random.default_rng(chance.getrandbits(32))
    if sample == "uint" and chance.random() < 0.5:
        return drawn.integers(0, 16, shape).astype(np.uint8)
    limits = WHOLE[kind_of(sample)]
    large = drawn.integers(limits[0], limits[1], shape, endpoint=True)
    small = drawn.integers(max(limits[0], -16), 16, shape)
    return np.where(drawn.random(shape) < 0.1, large, small)
