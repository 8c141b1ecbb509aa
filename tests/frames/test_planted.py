"""Errors that are planted in plans: what contradicts the plan or its reflections is refused.

What a plan *means* it alone cannot tell: another number for another input is another frame, which
only the source contradicts. ``MEANING`` lists these places; ``tests/conformance/test_frames.py``
shows that pictures tell them apart.
"""

from __future__ import annotations

import os
import random
import re
from pathlib import Path
from typing import Any

import pytest

from burnish.api.entry_points import CompiledFrame
from burnish.compiler.documents.plan import FramePlan
from burnish.compiler.documents.reading import ShapeError, read
from burnish.compiler.documents.writing import to_json
from burnish.targets.runner.frames.checking import PlanError, check_plan

from .changes import changes
from .kit import EXAMPLES, compiled

MEANING = re.compile(
    "|".join((
        # What the host sets, and what is computed of it.
        r"(parameters|lights|host_textures|host_buffers|values|models)\b",
        # How large a texture is, and into how many levels nobody draws.
        r"textures\.\d+\.(size|levels|layers)\b",
        # What is drawn how often, and what a shader is given of things that are alike.
        r"steps\.\d+\.draws: ",
        r"steps\.\d+\.(draws\.\d+\.uses\.\d+|use)\.inputs: without",
        r"steps\.\d+\.draws\.\d+\.(models|vertices|light)\b",
        # Into which part is drawn, and over what.
        r"steps\.\d+\.(viewport|scissor|blend_constant)\b",
        r"steps\.\d+\.(targets\.\d+|depth)\.clear: ",
        r".*inputs\.\d+\.(name|source\.(value|host|result|previous|initially.*)): ",
        # What only has to be the same word as the host's.
        r"steps\.\d+\.(name|pass): ", r"outputs\b",
        # The same, in another order.
        r".*(barriers|inputs|uses|results|kept): row \d+ before",
    ))
)  # fmt: skip
"""Changes that make another plan, or the same one."""

SEED = 13
SAMPLE = 100
"""The number of changes of each example that are tried; ``BURNISH_PLANTED=all`` tries all."""


def is_refused(frame: CompiledFrame, wrong: dict[str, Any]) -> bool:
    """True if a host refuses the plan before anything is drawn."""
    files = {row.reflection: made.reflection for row, made in
             zip(frame.plan.shaders, frame.shaders, strict=True)}  # fmt: skip
    try:
        plan = read(FramePlan, wrong)
        if any(row.reflection not in files for row in plan.shaders):
            return True
        check_plan(plan, [files[row.reflection] for row in plan.shaders])
    except (ShapeError, PlanError):
        return True
    return False


SWAPPED = re.compile(r"steps: row (\d+) before the one before it")


def is_independent(plan: FramePlan, change: str) -> bool:
    """True if a change swaps two steps that draw to two layers or levels of the same texture.

    Their order does not matter.
    """
    match = SWAPPED.match(change)
    if match is None:
        return False
    number = int(match[1])
    one, other = plan.steps[number - 1 : number + 1]
    if not one.kind == other.kind == "draw" or one.barriers != other.barriers:
        return False
    return all(
        a.result == b.result and (a.layer, a.level) != (b.layer, b.level)
        for a, b in zip(one.attachments, other.attachments, strict=True)
    )


BECOMES_ARRAY = re.compile(r"textures\.(\d+)\.dimension: '2d' becomes '2d-array'")


def is_array_of_one(plan: FramePlan, change: str) -> bool:
    """True if a change makes an array of one layer of a texture that only the host reads.

    So is the result of a step that is repeated once, as ``each i in 0..1`` does.
    """
    match = BECOMES_ARRAY.match(change)
    if match is None:
        return False
    texture = plan.textures[int(match[1])]
    return set(texture.results) <= {output.result for output in plan.outputs}


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_changed_plans_are_refused(path: Path) -> None:
    frame = compiled(path)
    plan = to_json(frame.plan)
    found = [
        change
        for change in changes(plan)
        if not MEANING.match(change.name)
        and not is_independent(frame.plan, change.name)
        and not is_array_of_one(frame.plan, change.name)
    ]
    if os.environ.get("BURNISH_PLANTED") != "all":
        found = random.Random(SEED).sample(found, SAMPLE)
    missed = [change.name for change in found if not is_refused(frame, change.made(plan))]
    assert not missed
