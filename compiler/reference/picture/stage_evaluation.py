"""Evaluates the two stages of a shader: all vertices at once, then many quads at once.

``drawing.py`` makes a ``StageEvaluator`` for each picture.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count
from typing import Any

import numpy as np

from ....stdlib.builtins import BUILTINS, texture
from ...ir.leaves import Attribute, Parameter, Resource
from ...ir.node import Node, reachable
from ...ir.operations import BUILTIN_OPS, CALL, CROSS, INPUT, LOOPS, builtin_of
from ...ir.shader import Shader
from ...ir.stages import CLIP_POSITION, DISCARD, RASTERISED, TARGET
from ...ir.types import scalar_kind, width
from ..evaluate import Evaluator
from ..namespace import Lane, Lanes
from ..stored import stored
from ..vectors import inner
from .margins import EXACT, READS, Margins, margin
from .quads import Barycentric
from .sampler import QuadReader
from .scene import Bools, Floats, Geometry, RasterRules, Texels
from .texels import Image
from .variants import Variants, variants
from .vertex_reads import VertexReader

_COMPARES_NEIGHBOURS = frozenset(name for name, row in BUILTINS.items() if row.uniform_control_flow)
_GRADS = frozenset({"sample_grad"})
"""Builtins that use neighbours' values, too, if cubes are not projected."""
_PROMISES = frozenset(name for name, row in BUILTINS.items() if row.is_promise)
_FILTERED = frozenset(row.name for row in texture.ROWS if row.sampler is not None)
_NOT_ROUNDED = (
    EXACT
    | READS
    | _COMPARES_NEIGHBOURS
    | {"neg", "abs", "min", "max", "clamp", "saturate", "nonzero"}
)
"""Operations that return an operand or an exact float32, or that have a margin of their own."""
_CORRECTLY_ROUNDED = frozenset({"add", "sub", "mul"})
"""Operations whose result, where it is a float32, is exact on every device."""


@dataclass(frozen=True, slots=True)
class Vertices:
    """The results of the vertex stage for all vertices."""

    positions: Floats
    """(vertices, 4) in clip space."""
    crossings: Mapping[int, Lanes]
    """By the id of the ``cross`` node: lanes of length (vertices,), or single numbers."""
    off: Mapping[int, Lanes]
    """By how much rounding may change these; empty if operations are exact."""
    undecided: Bools
    """(vertices,)."""


@dataclass(frozen=True, slots=True)
class Shaded:
    """The results of the fragment stage for some quads; a leading axis is that of variants."""

    targets: tuple[Lanes, ...]
    """Lanes that broadcast to (variants, quads, side, side)."""
    discarded: Lane
    undecided: Bools
    """(quads, side, side)."""


class StageEvaluator:
    """A shader with the values of its parameters and its textures."""

    def __init__(
        self,
        shader: Shader,
        values: Mapping[str, Lanes],
        textures: Mapping[str, Texels],
        rules: RasterRules,
    ) -> None:
        if shader.chain != RASTERISED:
            raise ValueError(f"{shader.name} has other stages than the reference can draw.")
        self.values = values
        ((self._position,), self._targets, discards) = (
            tuple(result.value for result in shader.results_of(kind))
            for kind in (CLIP_POSITION, TARGET, DISCARD)
        )
        self._discard = next(iter(discards), None)
        self._functions = dict(rules.functions)
        self._relative = 0.0 if rules.rounding_bits is None else 2.0**-rules.rounding_bits
        nodes = reachable((*self._targets, *([self._discard] if self._discard else [])))
        self._crossings = [node for node in nodes if node.op == "cross"]
        neighbours = _COMPARES_NEIGHBOURS if rules.projects_cubes else _COMPARES_NEIGHBOURS | _GRADS
        self.side = 2 if _called(nodes) & neighbours else 1
        everywhere = (*nodes, *reachable((self._position,)))
        read = dict.fromkeys(n.data for n in everywhere if isinstance(n.data, Resource))
        self._images = {r: Image(_texels(textures, r), r, rules) for r in read}
        self.ways = _ways(self._images.values(), rules, nodes, self._crossings)
        self._promised = _promised((*self._targets, self._position))
        self.broken: set[int] = set()
        """The ids of promises that were broken at some vertex or pixel so far."""

    def vertices(self, geometry: Geometry) -> Vertices:
        """Evaluate the vertex stage."""
        count = geometry.vertex_count
        margins = Margins((count,))
        readers = {resource: VertexReader(image, count) for resource, image in self._images.items()}

        inputs = geometry.inputs()

        def leaves(node: Node) -> Lanes | None:
            if isinstance(node.data, Attribute):
                return _attribute(geometry, node.data)
            if isinstance(node.data, Resource):
                return (readers[node.data],)
            return (inputs[INPUT.data(node).name],) if node.op == "input" else self._parameter(node)

        def observer(node: Node, operands: list[Lanes], value: Lanes) -> Lanes:
            margins.watch(node, operands, value)
            self._check(node, value, margins)
            return value

        evaluator = Evaluator(leaves, np, observer)
        crossings = {node.id: evaluator.value(node.operands[0]) for node in self._crossings}
        lanes = Evaluator(leaves, np).value(self._position)
        positions = np.stack([np.broadcast_to(lane, (count,)) for lane in lanes], axis=-1)
        off: dict[int, Lanes] = {}
        if self._relative:
            rounded = Evaluator(leaves, np, self._round_alike)
            for node in self._crossings:
                pairs = zip(rounded.value(node.operands[0]), crossings[node.id], strict=True)
                off[node.id] = tuple(moved - exact for moved, exact in pairs)
        undecided = margins.undecided
        for reader in readers.values():
            undecided = undecided | reader.undecided
        return Vertices(positions.astype(np.float64), crossings, off, undecided)

    def _round_alike(self, node: Node, _operands: list[Lanes], value: Lanes) -> Lanes:
        """The result of an operation of the vertex stage, with an error in one or the other
        direction."""
        if not _rounds(node, value):
            return value
        relative = (-1.0) ** node.id * self._relative
        absolute = self._functions.get(builtin_of(node) or "", 0.0)
        return tuple(
            lane + (np.abs(lane) * relative + absolute) if np.ndim(lane) else lane for lane in value
        )

    def fragments(self, place: Barycentric, front: Bools, vertices: Vertices) -> Shaded:
        """Evaluate the fragment stage in quads; ``front`` says which of them face the eye."""
        margins = Margins((len(front), self.side, self.side))
        turns, reads = count(), count()
        readers = {
            resource: QuadReader(image, self.ways, margins, reads)
            for resource, image in self._images.items()
        }
        inputs = {
            "frag_coord": (place.x, place.y, place.depth, place.per_w),
            "front_facing": (front[:, None, None],),
        }

        def leaves(node: Node) -> Lanes | None:
            if node.op == "cross":
                values = vertices.crossings[node.id]
                if CROSS.data(node).mode == "flat":
                    return place.flat(values)
                number = self._crossings.index(node)
                return place.perspective(values, vertices.off.get(node.id), self.ways, number)
            if isinstance(node.data, Resource):
                return (readers[node.data],)
            return inputs[INPUT.data(node).name] if node.op == "input" else self._parameter(node)

        def observer(node: Node, operands: list[Lanes], value: Lanes) -> Lanes:
            margins.watch(node, operands, value)
            self._check(node, value, margins)
            if node.data in ("ddx", "ddy"):
                margins.spread()
                return _differences(value, self.ways, CALL.data(node))
            return self._rounded(node, value, margins, turns)

        evaluator = Evaluator(leaves, np, observer)
        discarded: Any = evaluator.value(self._discard)[0] if self._discard else False
        doubtful = margins.undecided.copy()
        targets = tuple(evaluator.value(target) for target in self._targets)
        # A fragment that is certainly discarded has no colour that could be undecided.
        nominal = discarded[0] if np.ndim(discarded) > margins.undecided.ndim else discarded
        undecided = margins.undecided & ~(np.asarray(nominal, dtype=np.bool_) & ~doubtful)
        return Shaded(targets, discarded, undecided)

    def _rounded(self, node: Node, value: Lanes, margins: Margins, turns: Iterator[int]) -> Lanes:
        """The result of an operation under every variant, with an error in one or the other
        direction."""
        if len(self.ways) == 1 or not _rounds(node, value):
            return value
        relative = (-1.0) ** node.id * self.ways.rounding
        absolute = np.zeros(len(self.ways))
        if node.data in self._functions:
            side = (-1.0) ** (next(turns) // np.maximum(self.ways.period, 1))
            absolute = np.where(self.ways.period > 0, side * self._functions[node.data], 0.0)
        off = [self._off(lane, relative, absolute) for lane in value]
        if node.data in _CORRECTLY_ROUNDED:
            off = [_unless_exact(lane, moved) for lane, moved in zip(value, off, strict=True)]
        for lane, moved in zip(value, off, strict=True):
            margins.hand_on(lane, moved)
        return tuple(off)

    @staticmethod
    def _off(lane: Lane, relative: Floats, absolute: Floats) -> Lane:
        if not np.ndim(lane):
            return lane
        return lane + (np.abs(lane) * relative[:, None, None, None] + absolute[:, None, None, None])

    def _check(self, node: Node, value: Lanes, margins: Margins) -> None:
        """Record where a promise is broken, or may be by rounding: nothing is defined there."""
        if node.id in self._promised:
            length = np.sqrt(inner(value, value))
            if np.any(length <= margin()):
                self.broken.add(node.id)
            margins.at_zero(length, margin())

    def _parameter(self, node: Node) -> Lanes | None:
        if not isinstance(node.data, Parameter):
            return None
        name = node.data.name
        if name not in self.values:
            raise ValueError(f"The parameter `{name}` has no value.")
        value = self.values[name]
        return value if node.type == node.data.type else stored(node.data.type, value)


def _promised(roots: Sequence[Node]) -> frozenset[int]:
    """The ids of the promises whose values are used in any case.

    Both sides of a choice are evaluated for all pixels here, and one may be there because a promise
    of the other does not hold.
    """
    seen = set(roots)
    pending = list(seen)
    while pending:
        node = pending.pop()
        used = node.operands[:1] if node.op == "select" else node.operands
        pending += (new := [operand for operand in used if operand not in seen])
        seen.update(new)
    return frozenset(node.id for node in seen if builtin_of(node) in _PROMISES)


def _rounds(node: Node, value: Lanes) -> bool:
    """Whether a value is the rounded result of an operation, and not exact."""
    builtin = builtin_of(node)
    if builtin is None or builtin in _NOT_ROUNDED:
        return False
    return scalar_kind(node.type) == "float" and not isinstance(value[0], tuple)


def _unless_exact(lane: Lane, moved: Lane) -> Lane:
    """``moved`` where the result of a correctly rounded operation is no float32, and so rounded."""
    with np.errstate(over="ignore"):
        return np.where(np.float32(lane) == lane, lane, moved)


def _texels(textures: Mapping[str, Texels], resource: Resource) -> Texels:
    if resource.name not in textures:
        raise ValueError(f"The texture `{resource.name}` has no picture.")
    return textures[resource.name]


def _attribute(geometry: Geometry, attribute: Attribute) -> Lanes:
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


def _ways(
    images: Iterable[Image], rules: RasterRules, nodes: Sequence[Node], crossings: list[Node]
) -> Variants:
    """The variants of reading and interpolating that can change a shader's results."""
    called = _called(nodes)
    varied = [image for image in images if image.only is None]
    read = {image.type.dimension for image in varied}
    smooth = any(image.state.get("filter") == "linear" for image in varied)
    mipped = any(image.state.get("mip", "none") != "none" for image in varied)
    steps = any(
        (image.state.get("filter"), image.state.get("mip")) == ("nearest", "linear")
        for image in varied
    )
    return variants(
        rules.subtexel_bits if smooth else None,
        rules.mip_bits if mipped or called & {"ddx", "ddy"} else None,
        rules.varying_bits if any(CROSS.data(node).mode != "flat" for node in crossings) else None,
        rules.rounding_bits,
        any(name in called for name, _ in rules.functions),
        mixing_bits=rules.mixing_bits if steps else None,
        volumes="3d" in read,
        cubes="cube" in read,
        reads=_reads(nodes),
    )


def _called(nodes: Iterable[Node]) -> set[str]:
    """The builtins among these nodes."""
    return {CALL.data(node) for node in nodes if node.op in BUILTIN_OPS}


def _reads(nodes: Sequence[Node]) -> int:
    """How many reads through samplers a fragment does; a loop may do several."""
    again = any(node.op in LOOPS for node in nodes)
    count = sum(builtin_of(node) in _FILTERED for node in nodes)
    return 3 * count if again else count


def _differences(value: Lanes, ways: Variants, name: str) -> Lanes:
    """A derivative under every variant: the pixel's own row or column, or the same one for the
    quad."""
    axis, choice = (-2, ways.row) if name == "ddx" else (-1, ways.column)
    return tuple(
        _in_common(lane, choice, axis) if np.ndim(lane) and lane.shape[axis] == 2 else lane
        for lane in value
    )


def _in_common(lane: Any, choice: Any, axis: int) -> Any:
    choice = choice[:, None, None, None]
    first, second = lane.take([0], axis), lane.take([1], axis)
    return np.where(choice < 0, lane, np.where(choice == 0, first, second))
