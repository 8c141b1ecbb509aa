"""Checks the order of a frame job: a step uses only what is ready, and has waited for it.

Nothing else finds some of these mistakes. OpenGL waits by itself, so that a missing barrier shows
only with other drivers, and the first contents of a device's memory are often, but not always, what
one hopes for.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

from ....compiler.documents.plan import BufferState, ResolveRow, TextureState
from .device import DriverError
from .frame_job import OWN, Attachment, FrameJob, FrameStep

Part = tuple[int, int]
"""A layer and a level of a texture."""


def check_order(job: FrameJob) -> None:
    """Raise ``DriverError`` for the first step that uses something before it is ready."""
    textures = [_Texture(job, number) for number in range(len(job.textures))]
    buffers = [_Buffer(f"buffer {number}") for number in range(len(job.buffers))]
    memories: dict[int, list[_Texture]] = defaultdict(list)
    for texture in textures:
        if texture.memory is not None:
            memories[texture.memory].append(texture)
    for number, step in enumerate(job.steps):
        try:
            _check_step(textures, memories, step)
            _check_buffers(job, buffers, step)
        except DriverError as error:
            raise DriverError(f"{job.called(number)}: {error}") from None


def _check_step(
    textures: list[_Texture], memories: Mapping[int, list[_Texture]], step: FrameStep
) -> None:
    for barrier in step.barriers:
        waiting = textures[barrier.texture]
        if barrier.before == "undefined" and waiting.memory is not None:
            for texture in memories[waiting.memory]:
                texture.lose()
        waiting.wait(barrier.before, barrier.after)
    for number in (texture for draw in step.draws for texture in draw.textures):
        if number != OWN:
            textures[number].read("sampled")
    for number in step.images:
        textures[number].write("image")
    for target in step.targets:
        textures[target.texture].draw(target, "target")
        if target.resolve is not None:
            textures[target.resolve.texture].resolve(target.resolve)
    if step.depth is not None:
        textures[step.depth.texture].draw(step.depth, "depth")
    if step.copied:
        source, copy = step.copied
        textures[source].read("copied_from")
        textures[copy].write("copied_to")
    for number in step.read:
        textures[number].read("copied_from", levels=1)


def _check_buffers(job: FrameJob, buffers: list[_Buffer], step: FrameStep) -> None:
    for barrier in step.buffer_barriers:
        buffers[barrier.buffer].wait(barrier.before, barrier.after)
    for draw in step.draws:
        slots = job.pipelines[draw.pipeline].buffers
        for slot, number in zip(slots, draw.buffers, strict=True):
            if number != OWN:
                buffers[number].be_used("written" if slot.written else "read")
    for number in step.read_buffers:
        buffers[number].be_used("read")


class _Buffer:
    """The state of a storage buffer between two steps, as the checks follow it."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._use: BufferState = "undefined"
        self._is_changed = False
        """True if the buffer was written since the last barrier."""

    def wait(self, before: BufferState, after: BufferState) -> None:
        """Pass a barrier."""
        if before != self._use:
            raise DriverError(
                f"a barrier takes {self._name} from {before!r}, but its use is {self._use!r}"
            )
        self._use = after
        self._is_changed = False

    def be_used(self, use: BufferState) -> None:
        """Let a kernel write the buffer, or a shader read it."""
        if use != self._use:
            raise DriverError(f"{self._name} is used as {use!r}, but its use is {self._use!r}")
        if self._is_changed:
            raise DriverError(
                f"no barrier waits for what is written to {self._name}, and it is written again"
            )
        self._is_changed = use == "written"


class _Texture:
    """The state of a texture between two steps, as the checks follow it."""

    def __init__(self, job: FrameJob, number: int) -> None:
        made = job.textures[number]
        self._name = f"texture {number}"
        self._layers, self._levels = made.layers, made.levels
        self.memory = made.memory
        self._use: TextureState = "sampled" if made.is_black else "undefined"
        self._held = set(self._parts()) if made.is_black else set()
        """The parts that have contents."""
        self._changed: set[Part] = set()
        """The parts that were written since the last barrier."""

    def lose(self) -> None:
        """Lose the contents: another texture takes the memory, or this one begins anew."""
        self._use = "undefined"
        self._held.clear()

    def wait(self, before: TextureState, after: TextureState) -> None:
        """Pass a barrier."""
        if before != self._use:
            raise DriverError(
                f"a barrier takes {self._name} from {before!r}, but its use is {self._use!r}"
            )
        self._use = after
        self._changed.clear()

    def read(self, use: TextureState, levels: int | None = None) -> None:
        """Let a shader, a copy or the host read the first levels, or all of them."""
        self._check_use(use)
        self._check_contents(self._parts(levels))

    def write(self, use: TextureState) -> None:
        """Let a kernel or a copy write the whole texture."""
        self._check_use(use)
        self._change(self._parts())
        self._held.update(self._parts())

    def draw(self, attachment: Attachment, use: TextureState) -> None:
        """Let a step draw to a part of the texture."""
        self._check_use(use)
        first = attachment.layer
        parts = [(first + layer, attachment.level) for layer in range(attachment.layers)]
        if attachment.loads:
            self._check_contents(parts)
        self._change(parts)
        if attachment.stores:
            self._held.update(parts)
        else:
            self._held.difference_update(parts)

    def resolve(self, resolve: ResolveRow) -> None:
        """Let a step write the means of samples to a part of the texture."""
        self._check_use("target")
        parts = [(resolve.layer, resolve.level)]
        self._change(parts)
        self._held.update(parts)

    def _parts(self, levels: int | None = None) -> Iterator[Part]:
        """The parts of the texture: of the first ``levels``, or of all levels."""
        for level in range(self._levels if levels is None else levels):
            for layer in range(self._layers):
                yield layer, level

    def _check_use(self, use: TextureState) -> None:
        if use != self._use:
            raise DriverError(f"{self._name} is used as {use!r}, but its use is {self._use!r}")

    def _check_contents(self, parts: Iterable[Part]) -> None:
        for layer, level in parts:
            if (layer, level) not in self._held:
                raise DriverError(
                    f"{self._name} is read, but nothing has drawn its layer {layer}, level {level}"
                )

    def _change(self, parts: Iterable[Part]) -> None:
        for layer, level in parts:
            if (layer, level) in self._changed:
                raise DriverError(
                    f"no barrier waits for what is written to {self._name}, layer {layer}, level "
                    f"{level}, and it is written again"
                )
            self._changed.add((layer, level))
