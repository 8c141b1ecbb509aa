"""Evaluates the two stages of a shader: all vertices at once, then many quads at once.

``drawing.py`` makes a ``StageEvaluator`` for each picture. With ``errors`` all lanes are
``Bounded`` and say where a device's values may lie; without, they are plain arrays of float64.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ....stdlib.builtins import BUILTINS
from ...ir.leaves import Attribute, Texture
from ...ir.node import Node, reachable
from ...ir.operations import BUILTIN_OPS, CALL, CROSS, INPUT, builtin_of
from ...ir.shader import Shader
from ...ir.stages import CLIP_POSITION, DISCARD, FRAGMENT_DEPTH, TARGET
from ...ir.types import scalar_kind, width
from ..bounds import Bounded, Bounds, Errors, all_remembered, exact, given, hull, joined
from ..bounds.deciding import Case, Deciding
from ..evaluate import Evaluator, LeafValues
from ..held_values import HeldValues, as_rounded
from ..kept_numbers import KeptNumbers
from ..live import at_once
from ..namespace import Lane, Lanes, Namespace
from ..texture_reads import Reader
from .quads import Barycentric
from .sampler import PlainReader, TextureReader
from .scene import Bools, Floats, Geometry, Ints, RasterRules, Texels
from .texels import Image
from .watch import Found, Watch

_COMPARES_NEIGHBOURS = frozenset(name for name, row in BUILTINS.items() if row.uniform_control_flow)
_GRADS = frozenset({"sample_grad"})
"""Builtins that use neighbours' values, too, if cubes are not projected."""
_ANGLES = frozenset(("sin", "cos", "asin", "acos", "atan", "atan2"))
"""Builtins that platforms may promise roughly: the error of each value is then remembered."""
_ROWS, _COLUMNS = -2, -1
"""The axes of a quad."""
DERIVATIVE_AXES = {"ddx": _ROWS, "ddy": _COLUMNS}
"""The axis of a quad along which a device may choose between two differences."""

VERTICES_AT_ONCE, PIXELS_AT_ONCE = 1 << 14, 1 << 13
"""The numbers of vertices and of pixels that are evaluated at once.

They are limited so that a large mesh or picture needs no more memory than others.
"""


@dataclass(frozen=True, slots=True)
class Vertices:
    """The results of the vertex stage for all vertices."""

    positions: Floats
    """(vertices, 4) in clip space."""
    off: Floats
    """(vertices, 4): by how much a device's positions may differ."""
    crossings: Mapping[int, Lanes]
    """The crossing values, by the id of the ``cross`` node.

    Lanes have the length (vertices,), or are single numbers.
    """
    undecided: Bools
    """(vertices,): where a promise is broken."""


@dataclass(frozen=True, slots=True)
class Shaded:
    """The results of the fragment stage for some quads; lanes broadcast to (quads, side, side)."""

    targets: tuple[Lanes, ...]
    depth: Lane | None
    """The depth of each fragment, if it has one of its own."""
    discarded: Lane
    undecided: Bools
    """True where a promise is broken."""


class StageEvaluator:
    """A shader with the values of its parameters and its textures."""

    def __init__(
        self,
        shader: Shader,
        values: Mapping[str, Lanes],
        textures: Mapping[str, Texels],
        rules: RasterRules,
        errors: Errors | None = None,
        kept: KeptNumbers | None = None,
    ) -> None:
        """``kept`` has numbers of other draws with the same errors."""
        if not shader.is_lowered:
            raise ValueError(f"{shader.name} has other stages than the reference can draw.")
        self.has_bounds = errors is not None
        """True if lanes are ``Bounded``."""
        self._held = HeldValues(values, as_rounded if self.has_bounds else None, kept)
        self._kept = kept
        self.rules = rules
        self._errors = errors or _no_error
        self.bounds = Bounds(self._errors)
        self._xp: Namespace = self.bounds if self.has_bounds else np
        ((self._position,), self._targets, discards, depths) = (
            tuple(result.value for result in shader.results_of(kind))
            for kind in (CLIP_POSITION, TARGET, DISCARD, FRAGMENT_DEPTH)
        )
        self.discards = bool(discards)
        """True if fragments may be discarded."""
        self.has_own_depths = bool(depths)
        """True if fragments have depths of their own."""
        self._at_pixels = (*discards, *depths, *self._targets)
        nodes = reachable(self._at_pixels)
        self._crossings = [node for node in nodes if node.op == "cross"]
        compared = _compared(nodes, rules)
        self.side = 2 if compared else 1
        self._compared = frozenset(node.id for node in reachable(compared))
        """The ids of nodes that pixels of a quad compare, whose decisions cases leave open."""
        self._at_vertices = (*(node.operands[0] for node in self._crossings), self._position)
        self._vertices_at_once = at_once(self._at_vertices, VERTICES_AT_ONCE)
        self.pixels_at_once = at_once(self._at_pixels, PIXELS_AT_ONCE)
        """The number of pixels for which ``fragments`` may be called at once."""
        everywhere = (*nodes, *reachable((self._position,)))
        read = dict.fromkeys(n.data for n in everywhere if isinstance(n.data, Texture))
        texels = {texture: _texels(textures, texture) for texture in read}
        self._images = {r: Image(each, r, rules) for r, each in texels.items()}
        self.found = Found.of((*self._targets, self._position), texels.values(), rules)
        """The places where nothing is defined, as far as it is known."""

    def vertices(self, geometry: Geometry) -> Vertices:
        """Evaluate the vertex stage."""
        inputs = geometry.inputs()
        parts = []
        for begin in range(0, max(geometry.vertex_count, 1), self._vertices_at_once):
            some = slice(begin, begin + self._vertices_at_once)
            attributes = {name: rows[some] for name, rows in geometry.attributes.items()}
            numbers = {name: numbers[some] for name, numbers in inputs.items()}
            parts.append(self._some_vertices(replace(geometry, attributes=attributes), numbers))
        return parts[0] if len(parts) == 1 else _joined(parts)

    def _some_vertices(self, geometry: Geometry, inputs: Mapping[str, Ints]) -> Vertices:
        """Evaluate it for vertices with these attributes and inputs of the pipeline."""
        count = len(inputs["vertex_index"])
        readers = {r: self._reader(TextureReader(image)) for r, image in self._images.items()}

        def leaves(node: Node) -> Lanes | None:
            if isinstance(node.data, Attribute):
                return self._given(attribute_lanes(geometry, node.data))
            if isinstance(node.data, Texture):
                return (readers[node.data],)
            return (
                (inputs[INPUT.data(node).name],) if node.op == "input" else self._held.value(node)
            )

        watch = _Watch(self, self.found, (count,))
        evaluator = Evaluator(leaves, self._xp, watch, kept=self._kept)
        *crossed, position = evaluator.values(self._at_vertices)
        crossings = {
            node.id: tuple(_at_each(lane, count) for lane in lanes)
            for node, lanes in zip(self._crossings, crossed, strict=True)
        }
        lanes = [_whole(lane, (count,)) for lane in position]
        watch.end(tuple(lane.value for lane in lanes))
        positions = np.stack([lane.value for lane in lanes], axis=-1)
        off = np.stack([_radius(lane) for lane in lanes], axis=-1)
        return Vertices(positions.astype(np.float64), off, crossings, watch.undecided)

    def fragments(self, place: Barycentric, front: Bools, vertices: Vertices) -> Shaded:
        """Evaluate the fragment stage in quads; ``front`` says which of them face the eye."""
        watch = _Watch(self, self.found, (len(front), self.side, self.side))
        leaves = self._pixel_leaves(place, front, vertices)
        evaluator = Evaluator(leaves, self._xp, watch, stored=all_remembered, kept=self._kept)
        found = evaluator.values(self._at_pixels)
        discarded: Any = found.pop(0)[0] if self.discards else False
        depth: Any = found.pop(0)[0] if self.has_own_depths else None
        tests = (discarded,) if depth is None else (discarded, depth)
        watch.end((*(lane for target in found for lane in target), *tests))
        targets = tuple(map(watch.as_defined, found))
        return Shaded(targets, depth, discarded, watch.undecided)

    def cases(
        self, numbers: Ints, place: Barycentric, front: Bools, vertices: Vertices
    ) -> tuple[list[Lanes], Ints]:
        """The targets of quads, each in one case of the fragment stage's decisions, and how many of
        these each pixel has."""
        shape = len(front), self.side, self.side
        watch = _Watch(self, Found(frozenset()), shape)
        case = Case(numbers[:, None, None])
        xp = Deciding(self._errors, lambda node: node.id in self._compared)
        leaves = self._pixel_leaves(place, front, vertices)
        evaluator = Evaluator(leaves, xp, watch, stored=all_remembered)
        xp.begin(evaluator.outermost, case)
        found = evaluator.values(self._targets)
        return found, np.broadcast_to(case.counts, shape)

    def _pixel_leaves(self, place: Barycentric, front: Bools, vertices: Vertices) -> LeafValues:
        readers = {r: self._reader(TextureReader(image)) for r, image in self._images.items()}
        inputs = {
            "frag_coord": self._given((place.x, place.y, place.depth_read, place.per_w)),
            "front_facing": (front[:, None, None],),
        }

        def leaves(node: Node) -> Lanes | None:
            if node.op == "cross":
                values = vertices.crossings[node.id]
                if CROSS.data(node).mode == "flat":
                    return place.flat(values)
                return all_remembered(self._given(place.perspective(values)))
            if isinstance(node.data, Texture):
                return (readers[node.data],)
            return inputs[INPUT.data(node).name] if node.op == "input" else self._held.value(node)

        return leaves

    # --- leaves -----------------------------------------------------------------------------------

    def _reader(self, reader: Reader) -> Reader:
        return reader if self.has_bounds else PlainReader(reader)

    def _given(self, lanes: Lanes) -> Lanes:
        """Floats from outside, which are exact unless they have bounds already."""
        if not self.has_bounds:
            return tuple(lane.value if isinstance(lane, Bounded) else lane for lane in lanes)
        return tuple(lane if isinstance(lane, Bounded) else given(lane) for lane in lanes)


class _Watch(Watch):
    """Observes derivatives, too, and other operations that compare neighbours."""

    def __init__(self, stages: StageEvaluator, found: Found, shape: tuple[int, ...]) -> None:
        super().__init__(found, shape, stages.rules, rounds=stages.has_bounds)
        self._bounds = stages.bounds

    def __call__(self, node: Node, operands: list[Lanes], value: Lanes) -> Lanes:
        value = super().__call__(node, operands, value)
        builtin = builtin_of(node)
        if builtin in _COMPARES_NEIGHBOURS and self.undecided.any():
            self.undecided |= self.undecided.any(axis=(-2, -1), keepdims=True)
        if self._rounds and builtin in _ANGLES and not (node.free or node.variables):
            # In loops, sums of such values would have more errors in each turn.
            return all_remembered(value) if self._bounds.is_rough(builtin) else value
        if builtin in DERIVATIVE_AXES:
            return tuple(difference_taken(lane, builtin, self._rules) for lane in value)
        return value


def _no_error(_name: str, _operand: Any, _result: Any) -> float:
    return 0.0


def difference_taken(lane: Lane, builtin: str, rules: RasterRules) -> Lane:
    """A derivative as a device takes it: ``lane`` has that of each pixel's own row or column."""
    axis = DERIVATIVE_AXES[builtin]
    if not np.ndim(lane) or lane.shape[axis] != 2:
        return lane
    if rules.derivatives == "first":
        first = int(rules.bottom_up and axis == _ROWS)
        return lane.take([first, first], axis)
    if rules.derivatives == "any" and isinstance(lane, Bounded):
        return hull(lane, lane.take([1, 0], axis))
    return lane


def _joined(parts: Sequence[Vertices]) -> Vertices:
    """Several parts of the vertices as one."""
    crossings = {
        id_: tuple(
            joined(lanes) if isinstance(lanes[0], Bounded) else np.concatenate(lanes)
            for lanes in zip(*(part.crossings[id_] for part in parts), strict=True)
        )
        for id_ in parts[0].crossings
    }
    return Vertices(
        np.concatenate([part.positions for part in parts]),
        np.concatenate([part.off for part in parts]),
        crossings,
        np.concatenate([part.undecided for part in parts]),
    )


def _whole(lane: Any, shape: tuple[int, ...]) -> Bounded:
    return (lane if isinstance(lane, Bounded) else exact(lane)).spread(shape)


def _at_each(lane: Any, count: int) -> Any:
    """A lane at each vertex, whether it was known to be the same at all of them or not."""
    if isinstance(lane, Bounded):
        return lane.spread((count,))
    return np.broadcast_to(lane, (count,))


def _radius(lane: Bounded) -> Floats:
    """The possible distance of a device's value from the exact one."""
    off = np.maximum(lane.high - lane.value, lane.value - lane.low)
    return np.nan_to_num(np.asarray(off, np.float64), nan=np.inf, posinf=np.inf)


def _texels(textures: Mapping[str, Texels], texture: Texture) -> Texels:
    if texture.name not in textures:
        raise ValueError(f"The texture `{texture.name}` has no picture.")
    return textures[texture.name]


def attribute_lanes(geometry: Geometry, attribute: Attribute) -> Lanes:
    """The values of a vertex input at all vertices."""
    lanes = width(attribute.type)
    array: Any = geometry.attributes.get(attribute.name)
    if array is None or array.ndim != 2 or array.shape[1] != lanes:
        what = "is missing" if array is None else f"has the shape {array.shape}"
        raise ValueError(
            f"The vertex attribute `{attribute.name}` {what}; it needs (vertices, {lanes})."
        )
    kind = np.float64 if scalar_kind(attribute.type) == "float" else np.int64
    if kind is np.int64 and array.dtype.kind == "f":
        raise ValueError(f"The vertex attribute `{attribute.name}` takes whole numbers.")
    return tuple(np.ascontiguousarray(array.T, dtype=kind))


def _compared(nodes: Iterable[Node], rules: RasterRules) -> list[Node]:
    """The operations that make pixels depend on others of their quad."""
    neighbours = _COMPARES_NEIGHBOURS if rules.projects_cubes else _COMPARES_NEIGHBOURS | _GRADS
    return [node for node in nodes if node.op in BUILTIN_OPS and CALL.data(node) in neighbours]
