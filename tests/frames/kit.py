"""The examples of frames, compiled."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import burnish
from burnish.api.entry_points import CompiledFrame
from burnish.compiler.documents.plan import InputRow, PlanStep
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.memory import bytes_of, taking_turns, total
from burnish.targets.runner.frames.scenery import in_a_row

from ..targets.standings import profiles

FOLDER = Path(__file__).parents[2] / "examples" / "frames"
EXAMPLES = tuple(sorted(FOLDER.glob("*.burnish")))

LACKING = {"transparency": profiles("absent", "equations by target")}
"""The profiles that lack the capability of an example, by example."""


@cache
def compiled(path: Path) -> CompiledFrame:
    """The only frame of a file, in one language."""
    (frame,) = burnish.compile(path, ("wgsl",)).frames
    return frame


def of_text(text: str) -> CompiledFrame:
    """The only frame of a text."""
    (frame,) = burnish.compile(text, ("wgsl",)).frames
    return frame


def inputs_of(step: PlanStep) -> list[InputRow]:
    """The inputs that the frame sets in a step of a plan."""
    return [row for use in step.uses for row in use.inputs]


def memory_share(frame: CompiledFrame, size: tuple[int, int] = (512, 512)) -> float:
    """The memory of a frame's textures if they take turns, as a share of the memory that they would
    need if each result had a texture of its own."""
    plan = frame.plan
    tags = {row.name: row.materials for row in plan.models}
    materials = list(dict.fromkeys(each for listed in tags.values() for each in listed))
    host = FrameHost(frame, in_a_row(materials, tags, "torus"), size)
    needed = {
        number: bytes_of(row, host.size_of(number)) for number, row in enumerate(plan.textures)
    }
    each = sum(needed[row.texture] for row in plan.results if row.texture is not None)
    each += sum(needed[row.previous] for row in plan.kept if row.previous is not None)
    return total(taking_turns(plan, needed), needed) / each
