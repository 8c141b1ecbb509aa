"""Computes the level of detail of a texture read, for the sampler.

Source: Vulkan, "Scale Factor Operation, LOD Operation and Image Level(s) Selection". A device may
take differences between either two rows and columns of a quad, may take for the length of a step
anything from its largest lane to the square root of two times the sum of all lanes, and rounds the
level to a number of binary places. OpenGL (4.6, 8.14) also allows for the sum of what is the larger
one, of both steps, for each lane. Direct3D (11.3 functional specification, 7.18.11, after Heckbert,
*Fundamentals of Texture Mapping and Image Warping*, 1989) lets the level follow from the longer
axis of the ellipse that the two steps span, which is within that: it may be longer than either of
them, but not than the diagonal of both. NVIDIA's devices do so in Vulkan, too, and know the axis
only roughly.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ....stdlib.builtins.facts import ULP
from ..bounds import Bounded, between, exact
from .choices import Part, lane_at
from .intervals import difference, increasing, largest, product, quotient, widened
from .scene import Floats, RasterRules
from .texels import Image

_TINY = 2.0**-60
"""The least change from pixel to pixel: smaller ones do not change the level."""


@dataclass(frozen=True, slots=True)
class CoordinateSteps:
    """The changes of a coordinate from one pixel to the next."""

    across: Sequence[Bounded]
    down: Sequence[Bounded]
    bias: Bounded | None = None
    """The number that is added to the level which follows from the changes, if there is one."""

    @property
    def lanes(self) -> list[Bounded]:
        """All that the level depends on."""
        return [*self.across, *self.down, *([] if self.bias is None else [self.bias])]

    def at(self, part: Part) -> CoordinateSteps:
        """The steps of some pixels."""
        return self.mapped(lambda lane: lane_at(part, lane))

    def mapped(self, change: Callable[[Bounded], Bounded]) -> CoordinateSteps:
        """The steps with each lane changed."""
        return CoordinateSteps(
            [change(lane) for lane in self.across],
            [change(lane) for lane in self.down],
            None if self.bias is None else change(self.bias),
        )


def named(image: Image, level: Bounded) -> Bounded:
    """The level that a program names, rounded to one of the neighbouring levels that there are."""
    bits = image.rules.mip_bits
    if bits is None:
        return _limited(image, level)
    low, high = np.ldexp(level.low, bits), np.ldexp(level.high, bits)
    low, high = np.ldexp(np.floor(low), -bits), np.ldexp(np.ceil(high), -bits)
    return _limited(image, Bounded(level.value, low, high))


def differences(coordinate: Sequence[Bounded], image: Image) -> CoordinateSteps:
    """The steps between the pixels of quads, (quads, 1, 1); the exact ones are at the first pixel.

    Without quads (…, 2, 2) nothing changes.
    """
    across, down = ([_difference(lane, axis, image) for lane in coordinate] for axis in (-1, -2))
    return CoordinateSteps(across, down)


def _difference(lane: Bounded, axis: int, image: Image) -> Bounded:
    """The difference between the two columns (axis -1) or rows (axis -2) of a quad."""
    if lane.ndim != 3 or lane.shape[axis] != 2:
        return exact(np.float64(0))
    first, second = (lane.take([i], axis) for i in (0, 1))
    step = difference(second, first)
    if not image.is_exact:
        # Each operand is multiplied by the texture's size, and may be rounded to float32.
        step = widened(step, ULP * np.maximum(first.magnitude, second.magnitude))
    row = first_row(image.rules)
    first_step = step.mapped(lambda array: array[..., row, :1])
    if image.has_known_steps:
        return first_step
    low, high = step.low.min(axis=(-2, -1)), step.high.max(axis=(-2, -1))
    return Bounded(first_step.value, low[..., None, None], high[..., None, None])


def of_steps(image: Image, steps: CoordinateSteps) -> Bounded:
    """The level for these steps, in units of the texture or face."""
    across, down = (_in_texels(lanes, image) for lanes in (steps.across, steps.down))
    power = image.rules.level_power
    level = increasing(lambda x: _logarithm(x, power), _footprint(across, down, image))
    return _rounded(image, _biased(level, steps.bias))


def on_surface(image: Image, steps: CoordinateSteps) -> Bounded:
    """The level if a point on a cube's surface moves by this much, along three axes.

    Vulkan does not define this. SwiftShader adds the two axes with the largest changes, takes the
    logarithm from the bits of the square, and scales the gradients of a quad like those of its
    first pixel.
    """
    size = image.first_sizes[0]

    def length(*lanes: Floats) -> Floats:
        changes = np.stack(np.broadcast_arrays(*lanes))
        total: Floats = size * (changes.sum(axis=0) - changes.min(axis=0))
        return total

    footprint = largest([
        increasing(length, *map(abs, lanes)) for lanes in (steps.across, steps.down)
    ])  # fmt: skip
    level = increasing(lambda x: _logarithm(x, 2), footprint)
    return _rounded(image, _biased(level, steps.bias))


def on_cube(direction: Sequence[Bounded]) -> list[Bounded]:
    """The point on the surface of a cube of size 1 that a direction meets."""
    out = increasing(lambda x: 2 * _at_least_tiny(x), largest([abs(lane) for lane in direction]))
    return [quotient(lane, out) for lane in direction]


def first_row(rules: RasterRules) -> slice:
    """The row of a quad whose first pixel a device knows as the quad's first."""
    return slice(-1, None) if rules.bottom_up else slice(1)


def scaled(
    direction: Sequence[Bounded], steps: CoordinateSteps, rules: RasterRules
) -> CoordinateSteps:
    """The steps of a direction, as a quad's first pixel scales them onto a cube's surface."""
    out = increasing(lambda x: 2 * _at_least_tiny(x), largest([abs(lane) for lane in direction]))
    if out.ndim == 3:
        row = first_row(rules)
        out = out.mapped(lambda array: array[..., row, :1])
    return steps.mapped(lambda lane: quotient(lane, out))


def _in_texels(lanes: Sequence[Bounded], image: Image) -> list[Bounded]:
    """A step in texels of the first level."""
    return [
        increasing(lambda x, size=size: x * size, lane)
        for lane, size in zip(lanes, image.first_sizes, strict=True)
    ]


def _footprint(across: Sequence[Bounded], down: Sequence[Bounded], image: Image) -> Bounded:
    """The length that decides the level, for the steps to the right and downwards in texels."""
    steps = [[abs(lane) for lane in step] for step in (across, down)]
    lengths = [increasing(_euclidean, *lanes) for lanes in steps]
    longer = largest(lengths)
    if image.has_known_steps:
        return longer
    if image.rules.footprint == "ellipse":
        return between(longer.value, longer.low, _longer_axis(lengths, across, down))
    low = np.max(np.broadcast_arrays(*(lane.low for step in steps for lane in step)), axis=0)
    high = np.maximum(*(sum(lane.high for lane in step) for step in steps))
    # A cube's level on a device that is known otherwise follows from one of the steps.
    if image.rules.footprint == "any":
        of_lanes = sum(np.maximum(x.high, y.high) for x, y in zip(*steps, strict=True))
        high = np.maximum(np.sqrt(2.0) * high, of_lanes)
    return between(longer.value, low, high)


def _euclidean(*lanes: Floats) -> Floats:
    """The length of a step with these lanes."""
    length: Floats = np.sqrt(sum(lane * lane for lane in lanes))
    return length


def _longer_axis(
    lengths: Sequence[Bounded], across: Sequence[Bounded], down: Sequence[Bounded]
) -> Floats:
    """The upper bound of the longer half axis of the ellipse that two steps span.

    Its square is the larger eigenvalue of the products of the steps with each other and with
    themselves, which grows with each of these products.
    """
    first, second = (length.high * length.high for length in lengths)
    pairs = [product(x, y) for x, y in zip(across, down, strict=True)]
    low, high = sum(pair.low for pair in pairs), sum(pair.high for pair in pairs)
    mixed = np.maximum(np.abs(low), np.abs(high))
    axis: Floats = np.sqrt((first + second + np.hypot(first - second, 2 * mixed)) / 2)
    return axis


def _logarithm(footprint: Floats, power: int | None) -> Floats:
    """The logarithm, or with a power the one from this power's bits.

    That is too small by up to 0.086 divided by the power: a float's exponent is the integer part of
    its logarithm, and its mantissa is roughly the rest.
    """
    if power is None:
        exact_one: Floats = np.log2(_at_least_tiny(footprint))
        return exact_one
    mantissa, exponent = np.frexp(_at_least_tiny(footprint) ** power)
    rough: Floats = (exponent + 2 * mantissa - 2) / power
    return rough


def _at_least_tiny(number: Floats) -> Floats:
    """The number, but not zero, so that one can divide by it or take its logarithm."""
    return np.maximum(number, _TINY)


def _biased(level: Bounded, bias: Bounded | None) -> Bounded:
    return level if bias is None else increasing(np.add, level, bias)


def _rounded(image: Image, level: Bounded) -> Bounded:
    """A level that follows from steps, as precisely as a device computes it."""
    bits, error = image.rules.mip_bits, image.rules.lod_error
    if bits is None:
        return _limited(image, level)
    return _limited(image, widened(level, 2.0**-bits if error is None else error))


def _limited(image: Image, level: Bounded) -> Bounded:
    return increasing(lambda x: np.clip(x, 0, image.levels - 1), level)
