"""Jobs that capture vertices instead of drawing, and the answers of drivers."""

from __future__ import annotations

from dataclasses import dataclass

from .draw_job import Draw
from .pipeline import Pipeline


@dataclass(frozen=True, slots=True)
class CaptureJob:
    """A pipeline with a stream output, and the draws whose vertices it captures."""

    pipeline: Pipeline
    draws: tuple[Draw, ...]
    """The sizes of their pictures do not matter."""
    most: tuple[int, ...]
    """The largest number of vertices that each draw captures."""


@dataclass(frozen=True, slots=True)
class Captured:
    """The vertices that one draw has captured."""

    count: int
    """The number of vertices."""
    data: bytes
    """The bytes of all vertices, without gaps."""
