"""Tells which faces are at exactly the same place on every device: copies in several instances.

If the places of vertices do not depend on the instance, all instances lie in each other. A shader
computes the same from the same operands, so the depths of a face and of its copy in another
instance are equal, bit by bit, and the one that is drawn first hides the others. ``drawing.py``
asks for this, because equal depths of two other faces are undecided.
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


def place_numbers(shader: Shader, geometry: Geometry, faces: Faces) -> Ints:
    """A number for each face, which it shares with its copies."""
    if isinstance(faces, EdgeFaces) and not _shows_triangles(shader):
        # Two triangles have an edge in common, which shows the same for both.
        _, shared = np.unique(faces.between, axis=0, return_inverse=True)
        return np.asarray(shared.ravel())
    if geometry.instance_count == 1 or _moves_instances(shader):
        return np.arange(len(faces.corners))
    each = geometry.vertex_count // geometry.instance_count
    _, numbers = np.unique(faces.corners % each, axis=0, return_inverse=True)
    found: Ints = numbers.ravel()
    return found


def _moves_instances(shader: Shader) -> bool:
    domains = Domains()
    places = [result.value for result in shader.results_of(CLIP_POSITION)]
    return any(not n.operands and domains.of(n) == INSTANCES for n in reachable(places))


def _shows_triangles(shader: Shader) -> bool:
    """Whether depths or values may change from one triangle to the next where both meet."""
    if shader.render_state.depth.is_biased:
        return True
    nodes = reachable(shader.roots)
    if any(n.op == "cross" and CROSS.data(n).mode != "perspective" for n in nodes):
        return True
    return any(n.op == "input" and INPUT.data(n).name == "front_facing" for n in nodes)
