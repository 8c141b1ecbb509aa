"""Computes the captured values of a pass: all those of all vertices at once, with bounds.

It evaluates the same graphs by the same definitions as the pictures, at the mesh's vertices and, if
primitives are expanded, at the vertices that are emitted: these are listed as triangles, lines or
points, and each is told by the numbers of its group, of its strip and of its own in that.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..ir.capture import NUMBER_SIZE
from ..ir.expansion import EmittedStrips, Expansion
from ..ir.leaves import Attribute, Texture
from ..ir.node import Node, reachable
from ..ir.operations import CROSS, INPUT
from ..ir.shader import Shader
from ..ir.stages import (
    CAPTURE,
    CAPTURED,
    CAPTURED_EXPANDED,
    EMITTING,
    GROUP,
    PRIMITIVE_INDEX,
    STRIP,
    STRIP_VERTEX,
)
from ..ir.types import width
from .bounds import Bounded, Bounds, Errors, exact, hull
from .evaluate import Evaluator
from .held_values import HeldValues, as_rounded, rounded_constants
from .kernel import computed
from .namespace import Lanes
from .picture.sampler import TextureReader
from .picture.scene import Geometry, RasterRules, Texels
from .picture.stage_evaluation import attribute_lanes
from .picture.texels import Image

Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Listed:
    """All vertices that may be captured, in order."""

    values: tuple[tuple[Bounded, ...], ...]
    """The lanes of each member, each of shape (vertices,)."""
    certain: Bools
    """True for the vertices that every device captures."""
    possible: Bools
    """True for the vertices that some device may capture."""
    meant: Bools
    """True for the vertices that are captured if nothing is rounded."""


def captured(
    shader: Shader,
    values: Mapping[str, Any],
    textures: Mapping[str, Texels],
    geometry: Geometry,
    errors: Errors,
    rules: RasterRules,
) -> Listed:
    """The captured vertices of a mesh's primitives, whose corners are ``geometry.triangles``.

    ``values`` are those of parameters and buffers by name. Raises ``ValueError`` for a shader that
    captures nothing, and where a value is missing.
    """
    if shader.chain not in (CAPTURED, CAPTURED_EXPANDED):
        raise ValueError(f"{shader.name} captures nothing.")
    capturing = _Capturing(shader, values, textures, geometry, errors, rules)
    with np.errstate(all="ignore"):
        if shader.expansion is None:
            return capturing.of_vertices()
        return capturing.of_emitted(shader.expansion)


def captured_by_kernel(
    shader: Shader,
    values: Mapping[str, Any],
    textures: Mapping[str, Texels],
    count: int,
    errors: Errors,
    rules: RasterRules,
) -> Listed:
    """The vertices that a kernel in place of a stream output captures, of ``count``."""
    assert shader.capture is not None
    lengths = {info.leaf.name: count for info in shader.written}
    lanes = computed(shader, values, textures, count, lengths, errors, rules)
    by_place = {lane.store.offset: Bounded(lane.value, lane.low, lane.high) for lane in lanes}
    everywhere = np.ones(count, np.bool_)
    there = by_place.get(shader.capture.numbers)
    ends = (everywhere,) * 3 if there is None else (there.low, there.high, there.value)
    certain, possible, meant = (np.asarray(end) != 0 for end in ends)
    found = [
        tuple(by_place[member.offset // NUMBER_SIZE + lane] for lane in range(width(member.type)))
        for member in shader.capture.members
    ]
    return Listed(tuple(found), certain, possible, meant)


class _Capturing:
    def __init__(
        self,
        shader: Shader,
        values: Mapping[str, Any],
        textures: Mapping[str, Texels],
        geometry: Geometry,
        errors: Errors,
        rules: RasterRules,
    ) -> None:
        self._held = HeldValues(values, as_rounded)
        self._textures, self._rules = textures, rules
        self._geometry = geometry
        self._bounds = Bounds(errors)
        self._results = [result.value for result in shader.results_of(CAPTURE)]
        self._emitting = [result.value for result in shader.results_of(EMITTING)]
        self._readers: dict[Texture, TextureReader] = {}

    def of_vertices(self) -> Listed:
        """The vertices of the mesh's triangles, as they are."""
        corners = self._geometry.triangles.reshape(-1)
        at_vertices = self._evaluator(self._of_vertex)
        found = [_taken(at_vertices.value(value), corners) for value in self._results]
        everywhere = np.ones(len(corners), np.bool_)
        return Listed(tuple(found), everywhere, everywhere, everywhere)

    def of_emitted(self, expansion: Expansion) -> Listed:
        """The vertices that the primitives turn into."""
        corners = self._geometry.triangles
        numbers = _numbered(expansion, len(corners))
        primitives = numbers[PRIMITIVE_INDEX.name]
        copies = max(self._geometry.instance_count, 1)
        inputs = {
            **numbers,
            # The primitives of each instance of the mesh are counted anew.
            PRIMITIVE_INDEX.name: primitives % max(len(corners) // copies, 1),
        }
        crossed: dict[int, Lanes] = {}
        at_vertices = self._evaluator(self._of_vertex)

        def leaves(node: Node) -> Lanes | None:
            if node.op == "cross":
                return crossed[node.id]
            if node.op == "input":
                return (exact(inputs[INPUT.data(node).name]),)
            return self._leaf(node)

        for node in reachable((*self._results, *self._emitting)):
            if node.op == "cross":
                assert CROSS.data(node).mode == "corner", node
                value, number = node.operands
                (corner,) = self._evaluator(leaves).value(number)
                lanes = at_vertices.value(value)
                crossed[node.id] = _at_corner(lanes, corner, corners[primitives])
        emitted = self._evaluator(leaves)
        shape = (len(primitives),)
        found = tuple(_whole(emitted.value(value), shape) for value in self._results)
        groups = [_whole(emitted.value(value), shape)[0] for value in self._emitting]
        choices = range(len(groups))
        certain, possible, meant = (
            np.select(
                [numbers[GROUP.name] == number for number in choices],
                [np.asarray(getattr(group, end)) for group in groups],
                default=False,
            )
            for end in ("low", "high", "value")
        )
        return Listed(found, certain, possible, meant)

    def _evaluator(self, leaves: Any) -> Evaluator:
        return Evaluator(leaves, self._bounds, rounded_constants)

    def _of_vertex(self, node: Node) -> Lanes | None:
        """A leaf at all vertices of the mesh."""
        if isinstance(node.data, Attribute):
            lanes = attribute_lanes(self._geometry, node.data)
            return tuple(exact(np.asarray(lane)) for lane in lanes)
        if node.op == "input":
            return (exact(np.asarray(self._geometry.inputs()[INPUT.data(node).name])),)
        return self._leaf(node)

    def _leaf(self, node: Node) -> Lanes | None:
        if not isinstance(node.data, Texture):
            return self._held.value(node)
        if node.data not in self._readers:
            image = Image(self._textures[node.data.name], node.data, self._rules)
            self._readers[node.data] = TextureReader(image)
        return (self._readers[node.data],)


def _numbered(expansion: Expansion, primitives: int) -> dict[str, Ints]:
    """The primitive of each listed vertex, and the numbers that tell the vertex apart."""
    rows = [
        (number, strip, vertex)
        for number, group in enumerate(expansion.groups)
        for strip in range(group.strips)
        for vertex in _listed(group)
    ]
    each = np.array(rows, np.int64).reshape(-1, 3)
    groups, strips, vertices = np.tile(each, (primitives, 1)).T
    return {
        PRIMITIVE_INDEX.name: np.repeat(np.arange(primitives), len(each)),
        GROUP.name: groups,
        STRIP.name: strips,
        STRIP_VERTEX.name: vertices,
    }


def _listed(group: EmittedStrips) -> Sequence[int]:
    """The vertices of a strip as a list of triangles, in Vulkan's order; of lines; or of points."""
    if not group.kind.is_joined:
        return range(group.vertices)
    if group.kind.emits == "line":
        return [n for line in range(group.primitives) for n in (line, line + 1)]
    triangles = range(group.primitives)
    return [n for t in triangles for n in (t, t + 1 + t % 2, t + 2 - t % 2)]


def _whole(lanes: Lanes, shape: tuple[int, ...]) -> tuple[Bounded, ...]:
    return tuple(
        (lane if isinstance(lane, Bounded) else exact(np.asarray(lane))).spread(shape)
        for lane in lanes
    )


def _taken(lanes: Lanes, vertices: Ints) -> tuple[Bounded, ...]:
    """Values of the mesh's vertices at some of them."""
    whole = (lane if isinstance(lane, Bounded) else exact(np.asarray(lane)) for lane in lanes)
    return tuple(
        lane.mapped(lambda array: array[vertices] if array.ndim else array).spread(vertices.shape)
        for lane in whole
    )


def _at_corner(lanes: Lanes, corner: Any, corners: Ints) -> Lanes:
    """Values of the mesh's vertices at one corner of each primitive.

    Where rounding tips which corner it is, the bounds contain those at all possible ones.
    """
    last = corners.shape[1] - 1
    number = _whole((corner,), (len(corners),))[0]
    rows = np.arange(len(corners))
    low, high, meant = (
        np.clip(np.asarray(end), 0, last) for end in (number.low, number.high, number.value)
    )
    found = _taken(lanes, corners[rows, meant])
    for further in range(int((high - low).max(initial=0)) + 1):
        other = np.minimum(low + further, high)
        if (other != meant).any():
            there = _taken(lanes, corners[rows, other])
            found = tuple(hull(*pair) for pair in zip(found, there, strict=True))
    return found
