"""Evaluates a shader for one pixel alone, in many slightly different ways at once.

``influences.py`` calls it. The lanes of a value have a leading axis of ways; the first way is
undisturbed. A callback sees every value and may change it in the other ways.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import count
from typing import Any

import numpy as np

from ...ir.leaves import Attribute, Parameter, Resource
from ...ir.node import Node, reachable
from ...ir.operations import CROSS, INPUT
from ...ir.shader import Shader
from ...ir.stages import CLIP_POSITION, DISCARD, TARGET
from ..evaluate import Evaluator
from ..namespace import Lane, Lanes
from ..picture.coverage import Fragments, fragments_of
from ..picture.faces import Faces, assemble
from ..picture.margins import Margins
from ..picture.quads import depth_of
from ..picture.sampler import QuadReader
from ..picture.scene import Floats, Geometry, Ints, RasterRules, Texels
from ..picture.texels import Image
from ..picture.variants import EXACT

SIDE = 2
"""A pixel is evaluated with its neighbours in the quad, because derivatives compare them."""


class UncoveredError(ValueError):
    """The pixel shows nothing of the mesh, so that no shader computes its value."""


@dataclass(frozen=True, slots=True)
class Occurrence:
    """One evaluation of one node: a node in a loop is evaluated several times."""

    stage: str
    node: int
    """The id of the node."""
    number: int
    """How many evaluations of the same node in the same stage came before."""


Change = Callable[[Occurrence, Node, list[Lanes], Lanes], Lanes]
"""Called for every value that is computed or interpolated, with the values of its operands (of an
interpolated value, those at the corners). Evaluation continues with the lanes that it returns."""


@dataclass(frozen=True, eq=False, slots=True)
class Outcome:
    """What a pixel becomes in each way."""

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
        x: int,
        y: int,
    ) -> None:
        """Raises ``UncoveredError`` if nothing is drawn at (x, y)."""
        self.shader = shader
        self.geometry = geometry
        self.images = {
            node.data: Image(textures[node.data.name], node.data, rules)
            for node in reachable(shader.roots)
            if isinstance(node.data, Resource)
        }
        self._values = values
        self._row, self._column = y % SIDE, x % SIDE
        self.targets = tuple(result.value for result in shader.results_of(TARGET))
        self._discard = next((result.value for result in shader.results_of(DISCARD)), None)
        faces = assemble(self._positions(), geometry.triangles, rules)
        for face in _faces_at(faces, rules, x, y):
            self._enter(faces, face, x, y)
            if not self.evaluated(1, _unchanged).discarded[0]:
                return
        raise UncoveredError

    def evaluated(self, ways: int, change: Change) -> Outcome:
        """Evaluate everything that the pixel needs."""
        numbers: Counter[tuple[str, int]] = Counter()

        def changed(stage: str, node: Node, operands: list[Lanes], value: Lanes) -> Lanes:
            number = numbers[stage, node.id]
            numbers[stage, node.id] += 1
            return change(Occurrence(stage, node.id, number), node, operands, value)

        vertex = self._vertex_stage(self._corners[None, :], changed)

        def leaves(node: Node) -> Lanes | None:
            if node.op == "cross":
                corners = vertex.value(node.operands[0])
                return changed("fragment", node, [corners], self._interpolated(node, corners))
            if isinstance(node.data, Resource):
                return (Reader(self.images[node.data], (SIDE, SIDE)),)
            if node.op != "input":
                return self._parameter(node)
            value = self._inputs[INPUT.data(node).name]
            return changed("fragment", node, [], value)

        evaluator = Evaluator(leaves, np, lambda *seen: changed("fragment", *seen))
        discarded: Lane = False if self._discard is None else evaluator.value(self._discard)[0]
        lanes = [lane for target in self.targets for lane in evaluator.value(target)]
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
        if where.stage == "vertex":
            return (3,), np.ones(3)
        row, column = np.indices((SIDE, SIDE))
        signs = np.where((row + column + self._row + self._column) % 2, -1.0, 1.0)
        return signs.shape, signs

    # --- the vertex stage -------------------------------------------------------------------------

    def _positions(self) -> Floats:
        """(vertices, 4): where all vertices are, in clip space."""
        every = np.arange(self.geometry.vertex_count)[None, :]
        evaluator = self._vertex_stage(every, lambda _stage, _node, _operands, value: value)
        ((position,),) = ((r.value for r in self.shader.results_of(CLIP_POSITION)),)
        lanes = evaluator.value(position)
        return np.stack([np.broadcast_to(lane, every.shape)[0] for lane in lanes], axis=-1)

    def _vertex_stage(
        self, vertices: Ints, changed: Callable[[str, Node, list[Lanes], Lanes], Lanes]
    ) -> Evaluator:
        """Evaluates values of vertices, whose indices are (1, vertices)."""
        inputs = self.geometry.inputs()

        def leaves(node: Node) -> Lanes | None:
            if isinstance(node.data, Attribute):
                return tuple(np.moveaxis(self.geometry.attributes[node.data.name][vertices], -1, 0))
            if isinstance(node.data, Resource):
                return (Reader(self.images[node.data], ()),)
            if node.op == "input":
                return (inputs[INPUT.data(node).name][vertices],)
            return self._parameter(node)

        return Evaluator(leaves, np, lambda *seen: changed("vertex", *seen))

    # --- between the stages -----------------------------------------------------------------------

    def _enter(self, faces: Faces, face: int, x: int, y: int) -> None:
        """Take the fragment of one face as the one that is evaluated."""
        centres = np.arange(SIDE) + 0.5
        across, down = np.meshgrid(x - self._column + centres, y - self._row + centres)
        ones = np.ones_like(across)
        corners = np.stack([faces.plane_x[face], faces.plane_y[face], np.ones(3)])
        places = np.stack([across, down, ones]).reshape(3, -1)
        linear = np.linalg.solve(corners, places).reshape(3, SIDE, SIDE)
        depth = np.clip(np.tensordot(faces.z[face], linear, 1), 0.0, 1.0)
        per_w = np.tensordot(faces.per_w[face], linear, 1)
        perspective = linear * faces.per_w[face][:, None, None] / per_w
        self._corners = faces.corners[face]
        self._weights = np.tensordot(faces.weights[face].T, perspective, 1)
        self._inputs: Mapping[str, Lanes] = {
            "frag_coord": tuple(lane[None] for lane in (across, down, depth, per_w)),
            "front_facing": (bool(faces.front[face]),),
        }

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

    def _parameter(self, node: Node) -> Lanes | None:
        return self._values[node.data.name] if isinstance(node.data, Parameter) else None


class Reader:
    """Reads an image with an axis of ways in the place of that of quads."""

    def __init__(self, image: Image, quad: tuple[int, ...]) -> None:
        """``quad`` is (side, side), or empty for vertices, which have no neighbours."""
        self.image = image
        self._quad = quad

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of the builtin ``name``; ``operands`` are those after the texture."""
        quad = self._quad or (1, 1)
        reader = QuadReader(self.image, EXACT, Margins((1, *quad)), count())
        shapes = [np.shape(lane) for lanes in operands for lane in lanes]
        shape = np.broadcast_shapes(*shapes) if self._quad else np.broadcast_shapes((1, 1), *shapes)

        def whole(lane: Lane) -> Lane:
            if self._quad or np.ndim(lane) == 0:
                return lane
            return np.broadcast_to(lane, shape).reshape(-1, 1, 1)

        lanes = reader.read(name, tuple(tuple(map(whole, lanes)) for lanes in operands))
        return tuple(self._without_quads(lane, shape) for lane in lanes)

    def _without_quads(self, lane: Any, shape: tuple[int, ...]) -> Lane:
        if np.ndim(lane) == 0:
            return lane
        found = lane[0] if np.ndim(lane) == 4 else lane
        if self._quad:
            return found
        return np.broadcast_to(found.reshape(-1), (shape[0] * shape[1],)).reshape(shape)


def _faces_at(faces: Faces, rules: RasterRules, x: int, y: int) -> list[int]:
    """The faces that cover a pixel, the nearest one first."""
    fragments, _ = fragments_of(faces, rules)
    here = fragments.pixel == y * rules.width + x
    members = Fragments(fragments.face[here], fragments.pixel[here])
    depth = depth_of(faces, members, rules.width)
    nearest: list[int] = members.face[np.argsort(depth, kind="stable")].tolist()
    return nearest


def _unchanged(_where: Occurrence, _node: Node, _operands: list[Lanes], value: Lanes) -> Lanes:
    return value
