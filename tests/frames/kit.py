"""The examples of frames, compiled."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import burnish
from burnish.api import CompiledFrame

FOLDER = Path(__file__).parents[2] / "examples" / "frames"
EXAMPLES = tuple(sorted(FOLDER.glob("*.burnish")))


@cache
def compiled(path: Path) -> CompiledFrame:
    """The only frame of a file, in one language."""
    (frame,) = burnish.compile(path, ("wgsl",)).frames
    return frame


def of_text(text: str) -> CompiledFrame:
    """The only frame of a text."""
    (frame,) = burnish.compile(text, ("wgsl",)).frames
    return frame


def inputs_of(step: dict[str, Any]) -> list[dict[str, Any]]:
    """What the frame sets in a step of a plan."""
    own: list[dict[str, Any]] = step.get("inputs", [])
    uses = [use for drawn in step.get("draws", []) for use in drawn["uses"]]
    return [*own, *(row for use in uses for row in use["inputs"])]
