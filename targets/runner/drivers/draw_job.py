"""Jobs and pictures: the work for a driver, and its answer, as plain data for every API.

A job is one pipeline and several draws with it, because making a pipeline takes a driver much
longer than drawing. ``runner.py`` sends jobs; names have already been resolved to bindings, and
values to bytes.

The first row of a picture is the top one, whatever the API's framebuffer does. Each draw starts
with a cleared picture and cleared depths.
"""

from __future__ import annotations

from dataclasses import dataclass

from .pipeline import Pipeline
from .texels import Image


@dataclass(frozen=True, slots=True)
class Draw:
    """One picture: the bytes for every slot of the pipeline, in the pipeline's order."""

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
    clear: tuple[tuple[float, float, float, float], ...]
    """The clear colours, one for each target."""
    instance_count: int = 1
    buffers: tuple[bytes, ...] = ()
    """The contents of all storage buffers, in the pipeline's order."""
    clear_depth: float = 1.0
    blend_constant: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    """The colour of the blend factor ``constant``, for all targets."""
    layers: tuple[tuple[bytes, ...], ...] = ()
    """For each layer of the picture, the contents that replace ``blocks``, if every layer is a draw
    of its own. Drivers get these draws one by one."""


@dataclass(frozen=True, slots=True)
class Job:
    """A pipeline, and the draws with it."""

    pipeline: Pipeline
    draws: tuple[Draw, ...]


@dataclass(frozen=True, slots=True)
class Picture:
    """The contents of the targets after one draw."""

    width: int
    height: int
    """The number of all rows: those of the first layer come first."""
    targets: tuple[bytes, ...]
    """For each target float32 RGBA, row by row from the top; lanes that the format lacks are 0, 0,
    1."""
