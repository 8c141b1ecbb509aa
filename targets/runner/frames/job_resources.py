"""The textures and buffers of a frame job, and the uses that barriers bring them into.

``by_route.py`` asks for them while it makes the steps of the job.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from ....compiler.budget import Tally, check
from ....compiler.documents.plan import KeptRow, PlanStep, TextureState, WaitingRow
from ....compiler.ir.formats import DEPTH_WORDS
from ..binding import FORMATS
from ..drivers.frame_job import (
    Barrier,
    BufferBarrier,
    FrameBuffer,
    FrameJob,
    FrameStep,
    FrameTexture,
)
from ..drivers.pipeline import Pipeline
from .host import FrameHost
from .memory import bytes_of, taking_turns

WORD = 4
"""The bytes of a word."""


@dataclass(frozen=True, slots=True)
class JobParts:
    """The parts of a job that is being made.

    Several hosts may add to it, if their plans have the same shaders, in whose order the pipelines
    are, and no textures that share memory.
    """

    pipelines: tuple[Pipeline, ...]
    textures: list[FrameTexture] = field(default_factory=list)
    buffers: list[FrameBuffer] = field(default_factory=list)
    steps: list[FrameStep] = field(default_factory=list)

    def whole(self) -> FrameJob:
        """The job. Of equal pipelines only the first one is drawn with, so that one is made."""
        first = [self.pipelines.index(each) for each in self.pipelines]
        steps = (
            replace(
                step,
                draws=tuple(replace(each, pipeline=first[each.pipeline]) for each in step.draws),
            )
            for step in self.steps
        )
        return FrameJob(tuple(self.textures), tuple(self.buffers), self.pipelines, tuple(steps))


class JobResources:
    """The resources of one host: made where a step needs them first, and kept for later frames."""

    def __init__(
        self,
        host: FrameHost,
        parts: JobParts,
        written_as: TextureState,
        *,
        writes_to_black: bool = False,
    ) -> None:
        """``written_as`` is the use of the images that kernels write, which some routes draw. With
        ``writes_to_black``, those that a kernel writes itself start transparent black."""
        self._parts = parts
        self._host = host
        self._plan = host.plan
        self._written_as = written_as
        self._writes_to_black = writes_to_black
        self._uses: dict[int, TextureState] = {}
        """The present use of each texture of the job."""
        self._at: dict[int, int] = {}
        """The present texture of the job for each of the plan."""
        self._buffer_of: dict[str, int] = {}
        """The present buffer of the job for each result of the plan."""
        self._bytes = Tally("memory", f"the buffers and textures of {host.plan.frame} take")
        """Bytes of the buffers and textures that kernels write: their sizes are known when the
        kernels are run. ``_shared_memory`` counts all other textures."""
        self._memory: dict[int, int] = {}
        """For textures of the plan that share memory in turn, the number of that memory."""

    def begin(self, *, is_first: bool) -> None:
        """Make the textures that a frame reads of the last one, before its first step."""
        if is_first:
            self._memory = _shared_memory(self._host)
        for row in self._plan.kept:
            for texture in (row.texture, row.previous):
                if texture is not None and texture not in self._at:
                    self._make(texture, is_black=texture == row.previous)

    def end(self) -> None:
        """Let the next frame read what this one has left."""
        for row in self._plan.kept:
            self._exchange(row)

    def _exchange(self, row: KeptRow) -> None:
        one, other = row.texture, row.previous
        if one is None or other is None:
            name = row.result
            self._buffer_of[f"previous({name})"] = self._buffer_of.pop(name)
            return
        at = self._at
        at[one], at[other] = at[other], at[one]

    def texture(self, number: int) -> int:
        """The number in the job of a texture of the plan."""
        found = self._at.get(number)
        return self._make(number) if found is None else found

    def _make(self, number: int, *, is_black: bool = False) -> int:
        row = self._plan.textures[number]
        width, height = self._host.size_of(number)
        if row.size.value is None:
            self._bytes.add(bytes_of(row, (width, height)))
        name: Any = DEPTH_WORDS.get(row.format) or FORMATS[row.format]
        is_black = is_black or (self._writes_to_black and "image" in row.uses)
        found = len(self._parts.textures)
        self._parts.textures.append(
            FrameTexture(
                name,
                width,
                height,
                row.layers,
                row.levels,
                row.dimension,
                is_black,
                row.samples,
                self._memory.get(number),
            )
        )
        self._uses[found] = "sampled" if is_black else "undefined"
        self._at[number] = found
        return found

    def buffer(self, result: str) -> int:
        """The number in the job of the buffer that a kernel has written."""
        return self._buffer_of[result]

    def buffer_size(self, result: str) -> int:
        """The size of such a buffer, in bytes."""
        return self._parts.buffers[self.buffer(result)].size

    def left_buffer(self, result: str) -> int:
        """The number in the job of a buffer behind the end of a frame: the next one may call it
        what the last one has left."""
        kept = self._buffer_of.get(f"previous({result})")
        return self.buffer(result) if kept is None else kept

    def written(self, step: PlanStep, contents: Sequence[bytes]) -> list[int]:
        """The numbers of the buffers for a kernel's results; each run has new ones.

        ``contents`` are those before it runs.
        """
        found = []
        for row, data in zip(step.buffers, contents, strict=True):
            self._bytes.add(len(data))
            initial = int.from_bytes(data[:WORD], "little")
            found.append(len(self._parts.buffers))
            self._parts.buffers.append(FrameBuffer(len(data) // WORD, initial))
            self._buffer_of[row.result] = found[-1]
        return found

    def barriers(self, place: PlanStep | WaitingRow, *, is_first: bool) -> tuple[Barrier, ...]:
        """The barriers of textures before a step, or behind the last one."""
        found = []
        for row in place.barriers:
            if row.only_first and not is_first:
                continue
            number = self.texture(row.texture)
            before, after = self._use(row.before), self._use(row.after)
            if before == "undefined" and self._parts.textures[number].memory is None:
                # The last frame may still read the contents that it left there.
                before = self._uses[number]
            found.append(Barrier(number, before, after))
            self._uses[number] = after
        return tuple(found)

    def buffer_barriers(
        self, place: PlanStep | WaitingRow, *, is_first: bool
    ) -> tuple[BufferBarrier, ...]:
        """The barriers of the job's own buffers; a kernel's buffers have been made."""
        return tuple(
            BufferBarrier(self.buffer(row.result), row.before, row.after)
            for row in place.buffer_barriers
            if is_first or not row.only_first
        )

    def _use(self, planned: TextureState) -> TextureState:
        return self._written_as if planned == "image" else planned


def _shared_memory(host: FrameHost) -> dict[int, int]:
    """A number of memory for each texture that shares it with others in turn.

    Sizes that a kernel determines are known too late.
    """
    rows = host.plan.textures
    known = [number for number, row in enumerate(rows) if row.size.value is not None]
    needed = {number: bytes_of(rows[number], host.size_of(number)) for number in known}
    groups = taking_turns(host.plan, needed)
    said = f"the textures of {host.plan.frame} take"
    check("memory", sum(max(needed.get(each, 0) for each in group) for group in groups), said)
    groups = [group for group in groups if len(group) > 1]
    return {texture: number for number, group in enumerate(groups) for texture in group}
