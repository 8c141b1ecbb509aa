"""Draws and dispatches: all the bytes that one call of a pipeline takes, as plain data for every
API.

``frame_job.py`` puts them into steps. Names have already been resolved to bindings, and values to
bytes.
"""

from __future__ import annotations

from dataclasses import dataclass

from .texels import Image

Sides = tuple[int, int, int]
"""Lengths along x, y and z."""


@dataclass(frozen=True, slots=True)
class Draw:
    """One draw: the bytes for every slot of the pipeline, in the pipeline's order."""

    width: int
    height: int
    vertex_count: int
    vertices: tuple[bytes, ...]
    """For each of ``Pipeline.inputs``, the values of all vertices or of all instances."""
    indices: bytes
    """A uint32 for each corner of each primitive; the vertex of the first corner is the provoking
    one. Empty if there is nothing to draw, such as patches of level 0: the targets are only
    cleared."""
    blocks: tuple[bytes, ...]
    textures: tuple[Image, ...]
    instance_count: int = 1
    buffers: tuple[bytes, ...] = ()
    """The contents of all storage buffers, in the pipeline's order."""


@dataclass(frozen=True, slots=True)
class Dispatch:
    """One run of a kernel: the bytes for every slot, and the number of elements."""

    extent: Sides
    """The elements along x, y and z. Those of buffers lie along x; images have width, height and
    1."""
    blocks: tuple[bytes, ...]
    textures: tuple[Image, ...]
    buffers: tuple[bytes, ...]
    """The contents of all storage buffers before the dispatch, in the pipeline's order. Those that
    the kernel writes are among them."""

    def groups(self, work_group: Sides) -> Sides:
        """The numbers of work groups along x, y and z; ``work_group`` are the invocations in one,
        as the text declares them."""
        x, y, z = (-(-length // side) for length, side in zip(self.extent, work_group, strict=True))
        return x, y, z
