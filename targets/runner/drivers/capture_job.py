"""Jobs that capture vertices instead of drawing, and what a driver answers."""

from __future__ import annotations

from dataclasses import dataclass

from .draw_job import Draw
from .pipeline import Pipeline


@dataclass(frozen=True, slots=True)
class CaptureJob:
    """A pipeline with a stream output, and what to capture with it."""

    pipeline: Pipeline
    draws: tuple[Draw, ...]
    """The sizes of their pictures do not matter."""
    most: tuple[int, ...]
    """Of each draw, how many vertices it captures at most."""


@dataclass(frozen=True, slots=True)
class Captured:
    """The vertices that one draw has captured."""

    count: int
    """The number of vertices."""
    data: bytes
    """All of them, without gaps."""
