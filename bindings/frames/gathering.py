"""Makes the frame of a binding of its plan: resources, steps and blocks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ...compiler.documents.plan import FramePlan, OutputRow
from ..helpers import Helpers
from ..materials import Material
from ..structures import Structures
from .model import Frame, FrameBuffer, FrameTexture, Kept, Output
from .steps import Steps
from .values import FrameNumbers

Buffers = Mapping[tuple[str, bool], FrameBuffer]
"""The buffers of results; with true, those of the last frame."""


def frame_of(
    name: str,
    plan: FramePlan,
    shaders: Sequence[Material],
    structures: Structures,
    helpers: Helpers,
) -> Frame:
    """The frame that is called so in the binding; ``shaders`` are those of the plan."""
    values = FrameNumbers(plan, shaders, structures, helpers)
    textures = tuple(_textures(values))
    buffers = dict(_buffers(values))
    steps = tuple(Steps(values, textures, buffers).all())
    parameters, numbers = values.blocks(name)
    return Frame(
        name=name, plan=plan, parameters=parameters, numbers=numbers, textures=textures,
        buffers=tuple(buffers.values()), kept=tuple(_kept(plan, buffers)), steps=steps,
        outputs=tuple(_output(plan, row, buffers) for row in plan.outputs),
    )  # fmt: skip


def _textures(values: FrameNumbers) -> Iterator[FrameTexture]:
    for number, row in enumerate(values.plan.textures):
        name = row.results[0]
        size = values.size(number, f"{name}.size")
        yield FrameTexture(number=number, name=name, row=row, size=size)


def _buffers(values: FrameNumbers) -> Iterator[tuple[tuple[str, bool], FrameBuffer]]:
    """The buffers that kernels write, each with that of the last frame if it is kept."""
    kept = {row.result for row in values.plan.kept if row.texture is None}
    number = 0
    for step in values.steps.values():
        rows = {row.name: row for row in values.shaders[step.use.shader].reflection.results}
        for written in step.buffers:
            row, result = rows[written.name], written.result
            count = values.count(result, f"{result}.count")
            for is_previous in (False, True) if result in kept else (False,):
                yield (result, is_previous), FrameBuffer(
                    number=number, name=result, count=count, stride=row.stride,
                    initial=row.initial,
                )  # fmt: skip
                number += 1


def _kept(plan: FramePlan, buffers: Buffers) -> Iterator[Kept]:
    for row in plan.kept:
        if row.texture is not None and row.previous is not None:
            yield Kept(kind="texture", number=row.texture, previous=row.previous)
        else:
            now, before = (buffers[row.result, is_previous].number for is_previous in (False, True))
            yield Kept(kind="buffer", number=now, previous=before)


def _output(plan: FramePlan, row: OutputRow, buffers: Buffers) -> Output:
    texture = plan.output_texture(row.name)
    if texture is not None:
        return Output(name=row.name, doc=row.doc, kind="texture", number=texture)
    is_kept = (row.result, True) in buffers
    number = buffers[row.result, is_kept].number
    return Output(name=row.name, doc=row.doc, kind="buffer", number=number)
