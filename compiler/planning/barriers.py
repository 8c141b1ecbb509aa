"""What a plan waits for: textures and buffers that are used in another way from some step on.

``plan.py`` tells ``Waits`` step by step what is used, and gets the barriers that stand before.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Literal

from ...frozen import fresh, frozen, record
from ..ir.frame import Elements

State = Literal["undefined", "target", "depth", "image", "sampled", "copied_from", "copied_to"]
"""What a texture is used as: drawn to, written by a kernel, read, copied. At first it has no
contents: ``undefined``."""

BufferState = Literal["undefined", "written", "read"]
"""What a buffer is used as: written by a kernel, or read by one or by a pass."""

_WRITES = frozenset(("target", "depth", "image", "copied_to"))
"""Uses behind which even the same use has to wait."""


@frozen(eq=False)
class Barrier:
    """A texture that is used in another way from here on."""

    texture: int
    before: State
    after: State
    only_first: bool
    """Whether the texture is used in the first frame only."""


@frozen(eq=False)
class BufferBarrier:
    """A buffer that is used in another way from here on. Each result has its own, which one kernel
    writes before others read it."""

    elements: Elements
    before: BufferState
    after: BufferState
    only_first: bool
    """Whether the kernel that writes it runs in the first frame only."""


@frozen(eq=False)
class Waiting:
    """What is waited for in one place."""

    textures: tuple[Barrier, ...]
    buffers: tuple[BufferBarrier, ...]


@record
class Waits:
    """How everything is used at some place of the plan."""

    is_rare: Callable[[int | Elements], bool]
    """Whether a texture, or a buffer, is used in the first frame only."""
    textures: dict[int, State] = fresh(factory=dict)
    buffers: dict[Elements, BufferState] = fresh(factory=dict)
    uses: dict[int, dict[State, None]] = fresh(factory=dict)
    """All that a texture is used as."""

    def add(self, texture: int, state: State = "undefined") -> None:
        """Begin with a texture: one without contents, or one that the last frame has left."""
        self.textures[texture] = state
        self.uses[texture] = {} if state == "undefined" else {state: None}

    def before(
        self, used: Iterable[tuple[int, State]], buffers: Iterable[tuple[Elements, BufferState]]
    ) -> Waiting:
        """What stands before something that uses textures and buffers in these ways."""
        textures = [self._barrier(*each) for each in dict.fromkeys(used)]
        others = [self._buffer_barrier(*each) for each in dict.fromkeys(buffers)]
        return Waiting(
            tuple(each for each in textures if each is not None),
            tuple(each for each in others if each is not None),
        )

    def _barrier(self, texture: int, after: State) -> Barrier | None:
        before = self.textures[texture]
        self.textures[texture] = after
        self.uses[texture][after] = None
        if before == after and before not in _WRITES:
            return None
        return Barrier(texture, before, after, self.is_rare(texture))

    def _buffer_barrier(self, elements: Elements, after: BufferState) -> BufferBarrier | None:
        before = self.buffers.get(elements, "undefined")
        self.buffers[elements] = after
        if before == after:
            return None
        return BufferBarrier(elements, before, after, self.is_rare(elements))
