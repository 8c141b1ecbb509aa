"""Jobs that run kernels, and the answers of drivers."""

from __future__ import annotations

from dataclasses import dataclass

from .pipeline import Pipeline
from .texels import Image

Sides = tuple[int, int, int]
"""Lengths along x, y and z."""


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


@dataclass(frozen=True, slots=True)
class KernelJob:
    """A pipeline with a kernel as its only stage, and its dispatches."""

    pipeline: Pipeline
    work_group: Sides
    """The invocations in a work group, as the text declares them."""
    dispatches: tuple[Dispatch, ...]

    def groups(self, dispatch: Dispatch) -> Sides:
        """The numbers of work groups of a dispatch along x, y and z."""
        x, y, z = (
            -(-length // side)
            for length, side in zip(dispatch.extent, self.work_group, strict=True)
        )
        return x, y, z


@dataclass(frozen=True, slots=True)
class Written:
    """The output of a dispatch: all bytes of each buffer that the pipeline writes, in order."""

    buffers: tuple[bytes, ...]
    images: tuple[bytes, ...] = ()
    """The texels of each image, as ``Picture`` has them."""
