"""Evaluates a shader for one pixel alone, in many slightly different ways at once.

``influences.py`` calls it. The lanes of a value have a leading axis of ways; the first way is
undisturbed. A callback sees every value and may change it in the other ways.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ...ir.leaves import Attribute, Texture
from ...ir.node import Node, reachable
from ...ir.operations import CROSS, INPUT, builtin_of
from ...ir.shader import Shader
from ...ir.stages import DISCARD, FRAGMENTS, TARGET, VERTICES, Domain
from ..bounds import Bounded, Errors, exact
from ..evaluate import Evaluator
from ..held_values import HeldValues
from ..namespace import Lane, Lanes
from ..picture.assembly import faces_of
from ..picture.coverage import coverage_of
from ..picture.faces import Faces
from ..picture.quads import Barycentric, Quads, depths_of, rows_above
from ..picture.sampler import TextureReader
from ..picture.samples import pixels_of
from ..picture.scene import Floats, Geometry, RasterRules, Texels
from ..picture.stage_evaluation import DERIVATIVE_AXES, StageEvaluator, difference_taken
from ..picture.texels import Image

SIDE = 2
"""A pixel is evaluated with its neighbours in the quad, because derivatives compare them."""


class UncoveredError(ValueError):
    """The pixel shows nothing of the mesh, so that no shader computes its value."""


@dataclass(frozen=True, slots=True)
class Occurrence:
    """One evaluation of one node: a node in a loop is evaluated several times."""

    domain: Domain
    """The domain over which it varies: vertices or fragments."""
    node: int
    """The id of the node."""
    number: int
    """The number of evaluations of the same node in this domain that came before."""


Change = Callable[[Occurrence, Node, list[Lanes], Lanes], Lanes]
"""A function that is called for every value that is computed or interpolated.

It gets the values of the operands (of an interpolated value, those at the corners). Evaluation
continues with the lanes that it returns.
"""


@dataclass(frozen=True, eq=False, slots=True)
class Outcome:
    """The result of a pixel in each way."""

    lanes: Floats
    """(ways, lanes): the lanes of all render targets, one target after the other."""
    discarded: Any
    """(ways,): whether the fragment is discarded."""


class PixelShader:
    """A shader with everything that it reads, for one pixel of a picture."""

    def __init__(
        self,
        shader: Shader,
        values: Mapping[str, Lanes],
        textures: Mapping[str, Texels],
        geometry: Geometry,
        rules: RasterRules,
        errors: Errors,
        x: int,
        y: int,
    ) -> None:
        """Raises ``UncoveredError`` if nothing is drawn at (x, y)."""
        rules = replace(rules, samples=shader.render_state.samples)
        self._held = HeldValues(values)
        self._geometry = geometry
        self._rules = rules
        self._row, self._column = (y + rows_above(rules, SIDE)) % SIDE, x % SIDE
        self._targets = tuple(result.value for result in shader.results_of(TARGET))
        self._discard = next((result.value for result in shader.results_of(DISCARD)), None)
        read = (node.data for node in reachable(shader.roots) if isinstance(node.data, Texture))
        self._readers = {r: AttributionReader(textures[r.name], r, rules) for r in read}
        vertices = StageEvaluator(shader, values, textures, rules, errors).vertices(geometry)
        faces = faces_of(
            vertices.positions, geometry.triangles, rules, vertices.off, shader.render_state
        )
        for face in _faces_at(faces, rules, x, y):
            self._enter(faces, face, rules, x, y)
            if not self.evaluated(1, _unchanged).discarded[0]:
                return
        raise UncoveredError

    def evaluated(self, ways: int, change: Change) -> Outcome:
        """Evaluate everything that the pixel needs."""
        numbers: Counter[tuple[Domain, int]] = Counter()

        def changed(domain: Domain, node: Node, operands: list[Lanes], value: Lanes) -> Lanes:
            number = numbers[domain, node.id]
            numbers[domain, node.id] += 1
            return change(Occurrence(domain, node.id, number), node, operands, value)

        vertex = self._vertex_stage(changed)

        def leaves(node: Node) -> Lanes | None:
            if node.op == "cross":
                corners = vertex.value(node.operands[0])
                return changed(FRAGMENTS, node, [corners], self._interpolated(node, corners))
            if isinstance(node.data, Texture):
                return (self._readers[node.data],)
            if node.op != "input":
                return self._held.value(node)
            value = self._inputs[INPUT.data(node).name]
            return changed(FRAGMENTS, node, [], value)

        def seen_by_device(node: Node, operands: list[Lanes], value: Lanes) -> Lanes:
            if (builtin := builtin_of(node)) in DERIVATIVE_AXES:
                value = tuple(difference_taken(lane, builtin, self._rules) for lane in value)
            return changed(FRAGMENTS, node, operands, value)

        evaluator = Evaluator(leaves, np, seen_by_device)
        discarded: Lane = False if self._discard is None else evaluator.value(self._discard)[0]
        lanes = [lane for target in self._targets for lane in evaluator.value(target)]
        whole = [np.broadcast_to(self.seen(lane), (ways,)) for lane in lanes]
        return Outcome(
            np.stack(whole, axis=-1).astype(np.float64),
            np.broadcast_to(self.seen(discarded), (ways,)),
        )

    def seen(self, lane: Lane) -> Any:
        """(ways,): a lane in the pixel itself; of vertices, at the corner where it is largest."""
        if np.ndim(lane) == 0:
            return np.asarray(lane)[None]
        if lane.ndim == 2:
            return lane[:, np.abs(lane[0]).argmax()]
        row, column = (min(i, n - 1) for i, n in zip(
            (self._row, self._column), lane.shape[1:], strict=True))  # fmt: skip
        return lane[:, row, column]

    def quad(self, where: Occurrence) -> tuple[tuple[int, ...], Floats]:
        """The axes of a lane of a stage behind that of ways; and the signs of an error in it.

        Devices round every pixel of a quad separately. The signs differ between neighbours, so that
        derivatives see the errors of two pixels.
        """
        if where.domain == VERTICES:
            return (3,), np.ones(3)
        row, column = np.indices((SIDE, SIDE))
        signs = np.where((row + column + self._row + self._column) % 2, -1.0, 1.0)
        return signs.shape, signs

    # --- inside -----------------------------------------------------------------------------------

    def _enter(self, faces: Faces, face: int, rules: RasterRules, x: int, y: int) -> None:
        """Take the fragment of one face as the one that is evaluated."""
        self._corners = faces.corners[face][None, :]
        alone = faces.only(np.arange(len(faces.corners)) == face)
        alone = replace(alone, corners=np.arange(3)[None, :])
        left, top = x - self._column, y - self._row
        quad = Quads(np.array([0]), np.array([left]), np.array([top]), SIDE)
        self.place = Barycentric(alone, quad, rules)
        """The place of the quad in the face, whose corners are the vertices 0 to 2."""
        ends = self.place.perspective(tuple(np.eye(3)))
        self._weights = np.stack([end.value[0] for end in ends])
        self._inputs: Mapping[str, Lanes] = {
            "frag_coord": (
                *(np.broadcast_to(lane, (1, SIDE, SIDE)) for lane in (self.place.x, self.place.y)),
                self.place.depth_read.value, self.place.per_w.value,
            ),
            "front_facing": (bool(faces.front[face]),),
        }  # fmt: skip

    def _vertex_stage(
        self, changed: Callable[[Domain, Node, list[Lanes], Lanes], Lanes]
    ) -> Evaluator:
        """Evaluates values of the three vertices: lanes are (ways, 3)."""
        inputs = self._geometry.inputs()

        def leaves(node: Node) -> Lanes | None:
            if isinstance(node.data, Attribute):
                lanes = self._geometry.attributes[node.data.name][self._corners]
                return tuple(np.moveaxis(lanes, -1, 0))
            if isinstance(node.data, Texture):
                return (self._readers[node.data],)
            if node.op == "input":
                return (inputs[INPUT.data(node).name][self._corners],)
            return self._held.value(node)

        return Evaluator(leaves, np, lambda *seen: changed(VERTICES, *seen))

    def _interpolated(self, cross: Node, corners: Lanes) -> Lanes:
        """The values of a quad, from those at the three corners, (ways, 3)."""
        flat = CROSS.data(cross).mode == "flat"
        return tuple(
            lane
            if np.ndim(lane) == 0
            else np.ascontiguousarray(lane[:, :1, None])
            if flat
            else np.tensordot(lane.astype(np.float64), self._weights, 1)
            for lane in corners
        )


class AttributionReader:
    """Reads a texture without rounding; or, at coordinates with bounds, as a device may."""

    def __init__(self, texels: Texels, texture: Texture, rules: RasterRules) -> None:
        self._exact = TextureReader(Image(texels, texture, rules.reading_exactly))
        self._rounding = TextureReader(Image(texels, texture, rules))

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of the builtin ``name``; ``operands`` are those after the texture."""
        if any(isinstance(lane, Bounded) for lanes in operands for lane in lanes):
            return self._rounding.read(name, operands)
        lanes = self._exact.read(name, tuple(tuple(map(exact, lanes)) for lanes in operands))
        return tuple(lane.value if isinstance(lane, Bounded) else lane for lane in lanes)


def _faces_at(faces: Faces, rules: RasterRules, x: int, y: int) -> list[int]:
    """The faces that cover a pixel or a part of it, the nearest one first."""
    fragments = coverage_of(faces, rules).fragments
    members = fragments.only(pixels_of(fragments.sample, rules) == y * rules.width + x)
    depth, _ = depths_of(faces, members, rules)
    nearest: list[int] = members.face[np.argsort(depth, kind="stable")].tolist()
    return list(dict.fromkeys(nearest))


def _unchanged(_where: Occurrence, _node: Node, _operands: list[Lanes], value: Lanes) -> Lanes:
    return value
