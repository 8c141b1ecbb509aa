"""Reads textures in the vertex stage, at each vertex alone, because it has no neighbours."""

from __future__ import annotations

from itertools import count
from typing import Any

import numpy as np

from ..namespace import Lane, Lanes
from .margins import Margins
from .sampler import QuadReader
from .scene import Bools
from .texels import Image
from .variants import EXACT


class VertexReader:
    """Reads an image at all vertices at once: lanes are (vertices,), or single numbers."""

    def __init__(self, image: Image, vertices: int) -> None:
        self._margins = Margins((vertices, 1, 1))
        self._reader = QuadReader(image, EXACT, self._margins, count())
        self._count = vertices

    @property
    def undecided(self) -> Bools:
        """(vertices,): where rounding may change what has been read so far."""
        return self._margins.undecided[:, 0, 0]

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of the builtin ``name``; ``operands`` are those after the texture."""
        quads = tuple(tuple(_with_quads(lane) for lane in lanes) for lanes in operands)
        return tuple(self._of_vertices(lane) for lane in self._reader.read(name, quads))

    def _of_vertices(self, lane: Lane) -> Lane:
        if not np.ndim(lane):
            return lane
        array: Any = np.asarray(lane)
        return np.broadcast_to(array.reshape(-1), (self._count,))


def _with_quads(lane: Any) -> Any:
    """A vertex as a quad of one pixel."""
    return lane[:, np.newaxis, np.newaxis] if np.ndim(lane) else lane
