"""Reads textures as Vulkan's chapter on image operations specifies it, with bounds.

The evaluator gets a ``TextureReader`` as the value of a texture. A read's value is the exact one,
at the exact coordinate and level. Its interval contains what a conforming device may return: for
every coordinate and level within their own intervals, rounded to the device's number of bits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from ....stdlib.builtins.texture import MOST_BIAS
from ..bounds import Bounded, as_bounded, exact, remembered
from ..namespace import Lane, Lanes
from ..texture_reads import Reader
from . import levels
from .choices import Choice, Part, hull_of_choices, sure, with_hull
from .cube import FACES, may_be_nowhere, met
from .filtering import Filter, Place
from .intervals import finite, increasing
from .levels import CoordinateSteps
from .scene import Floats, Ints
from .texels import Image


class TextureReader:
    """Reads an image in one of the stages; it is a texture's lane for the evaluator.

    Operands broadcast together, and the result has their shape. Of lanes (quads, 2, 2), ``sample``
    takes the differences within quads; for any others, it reads level 0.
    """

    def __init__(self, image: Image) -> None:
        self._image = image

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of the builtin ``name``; ``operands`` are those after the texture."""
        read: Callable[..., Lanes] = getattr(self, f"_{name}")
        return read(*operands)

    # --- the builtins -----------------------------------------------------------------------------

    def _sample(self, *where: Lanes) -> Lanes:
        return self._colours(where, self._steps(where[0]))

    def _sample_bias(self, *operands: Lanes) -> Lanes:
        *where, (bias,) = operands
        added = increasing(lambda x: np.clip(x, -MOST_BIAS, MOST_BIAS), finite(bias))
        return self._colours(where, replace(self._steps(where[0]), bias=added))

    def _sample_level(self, *operands: Lanes) -> Lanes:
        *where, (level,) = operands
        return self._colours(where, levels.named(self._image, finite(level)))

    def _sample_grad(self, *operands: Lanes) -> Lanes:
        *where, across, down = operands
        steps = CoordinateSteps([finite(lane) for lane in across], [finite(lane) for lane in down])
        if self._moves_on_surface:
            coordinate = [finite(lane) for lane in where[0]]
            steps = levels.scaled(coordinate, steps, self._image.rules)
        return self._colours(where, steps)

    def _gather(self, *operands: Lanes) -> Lanes:
        *where, (lane,) = operands
        number = int(as_bounded(lane).value)
        if self._image.only is not None:
            return (self._image.only[number],) * 4
        return self._read(Filter(self._image, "gather", slice(number, number + 1)), where)

    def _compare(self, *operands: Lanes) -> Lanes:
        *where, (reference,) = operands
        kind = self._image.state["filter"]
        return self._read(Filter(self._image, kind), where, None, _in_range(reference))

    def _gather_compare(self, *operands: Lanes) -> Lanes:
        *where, (reference,) = operands
        return self._read(Filter(self._image, "gather"), where, None, _in_range(reference))

    def _load(self, *operands: Lanes) -> Lanes:
        image = self._image
        place, *rest = operands
        layer = rest[0][0] if image.type.layered else 0
        given = [as_bounded(lane) for lane in (*place, layer, rest[-1][0])]
        shape = np.broadcast_shapes(*(lane.shape for lane in given))
        counts = [*map(int, image.first_sizes), image.layers, image.levels]
        # Beyond an edge there is one texel, so one number there stands for all.
        choices = [
            Choice.of(_flat(lane, shape)).limited(-1, count)
            for lane, count in zip(given, counts, strict=True)
        ]

        def compute(_part: Part, numbers: list[Ints]) -> Bounded:
            *indices, layers, level = numbers
            return image.load(indices, layers, level)

        def anything(pixels: Ints) -> tuple[Floats, Floats]:
            return image.hull(pixels, every_level=True)

        found = hull_of_choices(choices, compute, anything)
        lanes = _lanes(found, shape)
        return tuple(map(_plain, lanes)) if found.kind == "i" else lanes

    def _texture_size(self, level: Lanes) -> Lanes:
        number = increasing(lambda x: np.clip(x, 0, self._image.levels - 1), as_bounded(level[0]))
        value, low, high = map(self._image.sizes, (number.value, number.high, number.low))
        if number.is_exact:
            return tuple(size if np.ndim(size) else int(size) for size in value)
        return tuple(Bounded(*sizes) for sizes in zip(value, low, high, strict=True))

    def _texture_layers(self) -> Lanes:
        return (self._image.layers,)

    def _texture_levels(self) -> Lanes:
        return (self._image.levels,)

    # --- places and levels ------------------------------------------------------------------------

    @property
    def _moves_on_surface(self) -> bool:
        """True if the level follows from the movement on a cube's surface, and not in its face."""
        return self._image.type.is_cube and not self._image.rules.projects_cubes

    def _steps(self, place: Lanes) -> CoordinateSteps:
        """The changes of a coordinate between the pixels of quads."""
        coordinate = [finite(lane) for lane in place]
        if self._moves_on_surface:
            coordinate = levels.on_cube(coordinate)
        return levels.differences(coordinate, self._image)

    def _colours(self, where: Sequence[Lanes], level: Bounded | CoordinateSteps) -> Lanes:
        """The filtered colours at a coordinate in a level, or in the one that steps lead to."""
        image = self._image
        filter_ = Filter(image, image.state["filter"])
        if image.only is not None:
            return tuple(remembered(filter_.of_equal(texel)) for texel in image.only)
        if image.has_one_level:
            return self._read(filter_, where)
        if isinstance(level, CoordinateSteps) and self._moves_on_surface:
            level = levels.on_surface(image, level)
        elif isinstance(level, CoordinateSteps) and not image.type.is_cube:
            level = levels.of_steps(image, level)
        return self._read(filter_, where, level)

    def _read(
        self,
        filter_: Filter,
        where: Sequence[Lanes],
        level: Bounded | CoordinateSteps | None = None,
        reference: Bounded | None = None,
    ) -> Lanes:
        """A read at a coordinate and, for an array, a layer; the first level if none is given."""
        axes = [finite(lane) for lane in where[0]]
        layer = as_bounded(where[1][0] if self._image.type.layered else 0)
        steps = level.lanes if isinstance(level, CoordinateSteps) else []
        others = [lane for lane in (level, reference) if isinstance(lane, Bounded)]
        shape = np.broadcast_shapes(*(lane.shape for lane in (*axes, layer, *steps, *others)))

        def flat(lane: Bounded) -> Bounded:
            return _flat(lane, shape)

        number = sure(layer.value) if layer.is_exact and not layer.ndim else Choice.of(flat(layer))
        place = Place(
            [flat(lane) for lane in axes],
            number.mapped(self._image.layer),
            flat(level) if isinstance(level, Bounded) else None,
            None if reference is None else flat(reference),
        )
        if not self._image.type.is_cube:
            return _lanes(filter_.of(place), shape)
        flat_steps = level.mapped(flat) if isinstance(level, CoordinateSteps) else None
        (_, nominal), *further = self._in_faces(place, flat_steps)
        found = filter_.of(nominal)
        for pixels, in_face in further:
            found = with_hull(found, pixels, filter_.of(in_face))
        lost = self._without_place(place, shape)
        if len(lost):
            found = with_hull(found, lost, filter_.of_any(place.at(lost)))
        return _lanes(found, shape)

    def _without_place(self, place: Place, shape: tuple[int, ...]) -> Ints:
        """The pixels that may read a cube in the direction zero, or whose neighbours do so.

        The differences between the places of a quad are not defined then, either.
        """
        if self._image.is_exact:
            return np.zeros(0, dtype=np.int64)
        lost = may_be_nowhere(place.axes)
        if len(shape) == 3:
            quads = lost.reshape(shape).any(axis=(1, 2), keepdims=True)
            lost = np.broadcast_to(quads, shape).ravel()
        return np.flatnonzero(lost)

    def _in_faces(
        self, place: Place, steps: CoordinateSteps | None
    ) -> Iterator[tuple[Part, Place]]:
        """The places in a cube's faces where directions may meet it, for the pixels that may.

        The first are those where the exact directions meet it, for all pixels. ``steps`` are those
        of the direction, if the level follows from them.
        """
        image = self._image
        for part, where in met(place.axes, image.is_exact):
            here = place.at(part)
            level = here.level
            if steps is not None:
                changes = steps.at(part)
                across, down = where.change(changes.across), where.change(changes.down)
                level = levels.of_steps(image, CoordinateSteps(across, down, changes.bias))
            axes = [where.across, where.down]
            yield part, Place(axes, _with_face(here.layer, where.face), level, here.reference)


def _with_face(layer: Choice, face: Ints) -> Choice:
    """The numbers of faces in an array of cubes, whose faces are counted on from cube to cube."""
    return layer.mapped(lambda number: number * FACES + face)


def _in_range(reference: Lane) -> Bounded:
    """A reference within the range of depths."""
    return increasing(lambda x: np.clip(x, 0.0, 1.0), finite(reference))


def _flat(lane: Bounded, shape: tuple[int, ...]) -> Bounded:
    """The lane in this shape as an array (pixels,)."""
    return lane.spread(shape).mapped(np.ravel)


def _lanes(found: Bounded, shape: tuple[int, ...]) -> Lanes:
    """The lanes of a read (lanes, pixels) in the shape of its operands.

    Values that are computed from the read share its errors.
    """
    return tuple(
        remembered(Bounded(*ends)) if not found.is_exact else exact(ends[0])
        for ends in zip(*(
            np.reshape(end, (len(end), *shape)) for end in (found.value, found.low, found.high)
        ), strict=True)
    )  # fmt: skip


def _plain(lane: Bounded) -> Lane:
    """An integer as it is where it is certain."""
    if not lane.is_exact:
        return lane
    return lane.value if np.ndim(lane.value) else int(lane.value)


class PlainReader:
    """A reader of a texture for an evaluation without bounds."""

    def __init__(self, reader: Reader) -> None:
        self._reader = reader

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        lanes = self._reader.read(name, tuple(tuple(map(exact, lanes)) for lanes in operands))
        return tuple(lane.value if isinstance(lane, Bounded) else lane for lane in lanes)
