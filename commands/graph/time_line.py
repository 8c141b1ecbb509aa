"""Finds the uses and results of each texture of a frame, step by step; ``frame.py`` calls it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from ...compiler.documents.plan import (
    AttachmentRow,
    CopyStep,
    FramePlan,
    FrameTextureRow,
    PlanStep,
)
from ...targets.runner.frames.checks.rows import read_before, read_now
from .kinds import Mark
from .model import Column, Life, Row, TimeLine


def time_line(
    plan: FramePlan, groups: Sequence[int], what: Callable[[FrameTextureRow], str]
) -> TimeLine:
    """The steps of a plan, and its textures and buffers.

    ``groups`` has the number of steps of each equation, and ``what`` describes a texture.
    """
    columns = [
        Column(number, "copy" if step.kind == "copy" else step.name, step.only_first)
        for number, step in enumerate(plan.steps)
    ]
    at = 0
    for group, size in enumerate(groups):
        for column in columns[at : at + size]:
            column.group = str(group) if size > 1 else ""
        at += size
    textures = [
        Row(f"#{number}", what(texture), number) for number, texture in enumerate(plan.textures)
    ]
    buffers: dict[str, Row] = {}
    outputs = {row.result for row in plan.outputs}
    kept = {row.result: row for row in plan.kept}
    for result in plan.results:
        name = result.name
        life = Life(name, result.first, result.last, after=name in outputs or name in kept)
        if result.texture is None:
            buffers[name] = Row(name, "buffer", None, [life])
        else:
            textures[result.texture].lives.append(life)
    _mark(plan, textures, buffers)
    for name, exchanged in kept.items():
        if exchanged.previous is not None:
            previous = textures[exchanged.previous]
            last = max(previous.marks, default=0)
            previous.lives.append(Life(name, 0, last, before=True))
    return TimeLine(columns, [*textures, *buffers.values()])


def _mark(plan: FramePlan, textures: Sequence[Row], buffers: Mapping[str, Row]) -> None:
    """Mark the steps' uses in the rows; the first of several uses counts."""
    for number, step in enumerate(plan.steps):
        for texture, result, mark in _touched(step):
            row = buffers.get(result) if texture is None else textures[texture]
            if row is not None:
                row.marks.setdefault(number, mark)


def _touched(step: PlanStep) -> Iterator[tuple[int | None, str, Mark]]:
    """The texture, the result, and the use of them."""
    if isinstance(step, CopyStep):
        yield step.into.texture, step.into.result, Mark.WRITTEN
        yield step.copied.texture, step.copied.result, Mark.READ
        return
    for image in step.images:
        yield image.texture, image.result, Mark.WRITTEN
    for buffer in step.buffers:
        yield None, buffer.result, Mark.WRITTEN
    for target in step.attachments:
        yield target.texture, target.result, mark_of(target)
    for result, texture in (*read_now(step, is_first=True), *read_before(step)):
        yield texture, result, Mark.READ


def mark_of(target: AttachmentRow) -> Mark:
    """The use of an attachment by a render pass; one of depths may have stencil values, too."""
    stencil = target.stencil
    if not (target.store or (stencil is not None and stencil.store)):
        return Mark.DROPPED
    is_loaded = "load" in (target.load, stencil and stencil.load)
    return Mark.DRAWN_OVER if is_loaded else Mark.CLEARED
