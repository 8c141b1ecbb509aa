"""The two stages of a shader, evaluated: all vertices at once, then many quads at once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....stdlib.builtins import texture
from ...ir.leaves import Attribute, Parameter, Resource
from ...ir.node import Node, reachable
from ...ir.types import scalar_kind, width
from ...semantics.shader import Shader
from ..namespace import Lane, Lanes
from .quads import Barycentric
from .rounding import COMPARES_NEIGHBOURS, Rounding, nominal
from .scene import Bools, Floats, Geometry, RasterRules, Texels
from .texels import Image
from .variants import Variants, variants

_GRADS = frozenset({"sample_grad"})
"""What looks at neighbours besides where cubes are not projected."""
_FILTERED = frozenset(row.name for row in texture.ROWS if row.sampler is not None)


@dataclass(frozen=True, slots=True)
class Vertices:
    """What the vertex stage makes of all vertices."""

    positions: Floats
    """(vertices, 4) in clip space."""
    crossings: Mapping[int, Lanes]
    """By the id of the ``interpolate`` node: lanes of (vertices, 1, 1), with a leading axis of
    variants where those move them; or single numbers."""
    undecided: Bools
    """(vertices,): where rounding may tip what crosses."""
    astray: Bools
    """(vertices,): where it may tip a position."""


@dataclass(frozen=True, slots=True)
class Shaded:
    """What the fragment stage makes of some quads; a leading axis is one of variants."""

    targets: tuple[Lanes, ...]
    """Lanes that broadcast to (variants, quads, side, side)."""
    discarded: Lane
    undecided: Bools
    """(quads, side, side)."""


class Stages:
    """A shader with the values of its parameters and its textures."""

    def __init__(
        self,
        shader: Shader,
        values: Mapping[str, Lanes],
        textures: Mapping[str, Texels],
        rules: RasterRules,
    ) -> None:
        self.values = values
        self._position = shader.clip_position
        self._targets = tuple(target.value for target in shader.targets)
        self._discard = shader.discard
        self._functions = dict(rules.functions)
        nodes = reachable((*self._targets, *([self._discard] if self._discard else [])))
        self._crossings = [node for node in nodes if node.op == "interpolate"]
        neighbours = COMPARES_NEIGHBOURS if rules.projects_cubes else COMPARES_NEIGHBOURS | _GRADS
        self.side = 2 if _called(nodes) & neighbours else 1
        everywhere = (*nodes, *reachable((self._position,)))
        read = dict.fromkeys(n.data for n in everywhere if isinstance(n.data, Resource))
        self._images = {r: Image(_texels(textures, r), r, rules) for r in read}
        self.ways = _ways(self._images.values(), rules, everywhere, self._crossings)

    def vertices(self, geometry: Geometry) -> Vertices:
        """The vertex stage, in which each vertex is a quad of one pixel."""
        number = geometry.vertex_count
        stage = self._stage((number, 1, 1))
        inputs = geometry.inputs()

        def leaves(node: Node) -> Lanes | None:
            if isinstance(node.data, Attribute):
                return _as_quads(_attribute(geometry, node.data))
            return (
                _as_quads((inputs[str(node.data)],))
                if node.op == "input"
                else self._parameter(node)
            )

        evaluator = stage.evaluator(leaves)
        lanes = evaluator.value(self._position)
        astray = stage.margins.undecided.copy()
        crossings = {node.id: evaluator.value(node.operands[0]) for node in self._crossings}
        places = [np.broadcast_to(nominal(lane).reshape(-1), (number,)) for lane in lanes]
        positions = np.stack(places, axis=-1).astype(np.float64)
        undecided = stage.margins.undecided
        return Vertices(positions, crossings, undecided[:, 0, 0], astray[:, 0, 0])

    def fragments(self, place: Barycentric, front: Bools, vertices: Vertices) -> Shaded:
        """The fragment stage in quads; ``front`` says which of them face the eye."""
        stage = self._stage((len(front), self.side, self.side))
        margins = stage.margins
        inputs = {
            "frag_coord": (place.x, place.y, place.depth, place.per_w),
            "front_facing": (front[:, None, None],),
        }

        def leaves(node: Node) -> Lanes | None:
            if node.op == "interpolate":
                values = vertices.crossings[node.id]
                if node.data == "flat":
                    return place.flat(values)
                return place.perspective(values, self.ways, self._crossings.index(node))
            return inputs[str(node.data)] if node.op == "input" else self._parameter(node)

        evaluator = stage.evaluator(leaves)
        discarded: Any = evaluator.value(self._discard)[0] if self._discard else False
        doubtful = margins.undecided.copy()
        targets = tuple(evaluator.value(target) for target in self._targets)
        # What is surely discarded has no colour that could be in doubt.
        surely = np.asarray(nominal(discarded), dtype=np.bool_) & ~doubtful
        undecided = margins.undecided & ~surely
        return Shaded(targets, discarded, undecided)

    def _stage(self, shape: tuple[int, int, int]) -> Rounding:
        return Rounding(shape, self.ways, self._functions, self._images)

    def _parameter(self, node: Node) -> Lanes | None:
        if not isinstance(node.data, Parameter):
            return None
        name = node.data.name
        if name not in self.values:
            raise ValueError(f"The parameter `{name}` has no value.")
        return self.values[name]


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


def _as_quads(value: Lanes) -> Lanes:
    """Of all vertices, each as a quad of one pixel."""
    return tuple(lane[:, None, None] for lane in value)


def _ways(
    images: Iterable[Image], rules: RasterRules, nodes: Sequence[Node], crossings: list[Node]
) -> Variants:
    """The variants of reading and interpolating that make a difference to a shader."""
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
        rules.varying_bits if any(node.data != "flat" for node in crossings) else None,
        rules.rounding_bits,
        any(name in called for name, _ in rules.functions),
        mixing_bits=rules.mixing_bits if steps else None,
        volumes="3d" in read,
        cubes="cube" in read,
        reads=_reads(nodes),
    )


def _called(nodes: Iterable[Node]) -> set[str]:
    """The builtins among these nodes."""
    return {str(node.data) for node in nodes if node.op in ("call", "native")}


def _reads(nodes: Sequence[Node]) -> int:
    """How many times a fragment reads through samplers; a loop does so several times."""
    again = any(node.op in ("fold", "iterate") for node in nodes)
    count = sum(node.op in ("call", "native") and node.data in _FILTERED for node in nodes)
    return 3 * count if again else count
