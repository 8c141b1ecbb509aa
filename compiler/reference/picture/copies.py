"""Finds faces at exactly the same place on every device: copies, and faces drawn twice.

If the places of vertices do not depend on the instance, all instances lie in each other. A shader
computes the same from the same operands, so the depths of a face and of its copy in another
instance are equal, bit by bit, and the one that is drawn first hides the others. Two shaders do so
only if their positions are invariant (``placing.py``). ``drawing.py`` asks for this, because equal
depths of two other faces are undecided.
"""

from __future__ import annotations

import numpy as np

from ...ir.domains import Domains
from ...ir.node import reachable
from ...ir.operations import CROSS, INPUT
from ...ir.shader import Shader
from ...ir.stages import CLIP_POSITION, INSTANCES
from .edges import EdgeFaces
from .faces import Faces
from .scene import Geometry, Ints


class Places:
    """Gives numbers to the places of faces, in all draws whose depths may meet."""

    def __init__(self) -> None:
        self._count = 0
        self._first: dict[bytes, int] = {}
        """The first number of each draw, by the digest of the placing of its faces."""

    def numbers(
        self, shader: Shader, geometry: Geometry, faces: Faces, placing: bytes | None
    ) -> Ints:
        """Numbers for the faces of a draw: those of another one that has the same ``placing``."""
        own = _place_numbers(shader, geometry, faces)
        shared = None if isinstance(faces, EdgeFaces) else placing
        first = self._count if shared is None else self._first.setdefault(shared, self._count)
        self._count = max(self._count, first + int(own.max(initial=-1)) + 1)
        return own + first


def _place_numbers(shader: Shader, geometry: Geometry, faces: Faces) -> Ints:
    """A number for each face of a draw, which it shares with its copies."""
    if isinstance(faces, EdgeFaces) and not _shows_triangles(shader):
        # Two triangles have an edge in common, which shows the same for both.
        _, shared = np.unique(faces.between, axis=0, return_inverse=True)
        return np.asarray(shared.ravel())
    if geometry.instance_count == 1 or _moves_instances(shader):
        return faces.primitive
    copies: Ints = faces.primitive % (len(geometry.triangles) // geometry.instance_count)
    return copies


def _moves_instances(shader: Shader) -> bool:
    domains = Domains()
    places = [result.value for result in shader.results_of(CLIP_POSITION)]
    return any(not n.operands and domains.of(n) == INSTANCES for n in reachable(places))


def _shows_triangles(shader: Shader) -> bool:
    """True if depths or values may change from one triangle to the next where both meet."""
    if shader.render_state.depth.is_biased:
        return True
    nodes = reachable(shader.roots)
    if any(n.op == "cross" and CROSS.data(n).mode != "perspective" for n in nodes):
        return True
    return any(n.op == "input" and INPUT.data(n).name == "front_facing" for n in nodes)
