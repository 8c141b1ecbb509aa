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
from ...ir.shader import Shader
from ...ir.stages import CLIP_POSITION, INSTANCES
from .faces import Faces
from .scene import Geometry, Ints


def place_numbers(shader: Shader, geometry: Geometry, faces: Faces) -> Ints:
    """A number for each face, which it shares with its copies."""
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
