"""The barriers of a plan, in front of steps that use textures and buffers in another way.

``plan.py`` tells ``Waits`` step by step what is used, and gets the barriers that stand before.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ...support.frozen import fresh, record
from ..documents.plan import (
    BarrierRow,
    BufferBarrierRow,
    BufferState,
    BufferUse,
    TextureState,
    TextureUse,
    WaitingRow,
)
from ..ir.frame import Elements

_WRITES = frozenset(("target", "depth", "image", "copied_to"))
"""Uses behind which even the same use has to wait."""


@record
class Waits:
    """The uses of all textures and buffers at some place of the plan."""

    is_rare: Callable[[int | Elements], bool]
    """True for a texture, or a buffer, that is used in the first frame only."""
    textures: dict[int, TextureState] = fresh(factory=dict)
    buffers: dict[Elements, BufferState] = fresh(factory=dict)
    uses: dict[int, dict[TextureUse, None]] = fresh(factory=dict)
    """All uses of each texture."""

    def add(self, texture: int, left: TextureUse | None = None) -> None:
        """Begin with a texture: one without contents, or one that the last frame has ``left``."""
        self.textures[texture] = left or "undefined"
        self.uses[texture] = {} if left is None else {left: None}

    def before(
        self, used: Iterable[tuple[int, TextureUse]], buffers: Iterable[tuple[Elements, BufferUse]]
    ) -> WaitingRow:
        """The barriers in front of a step that uses textures and buffers in these ways."""
        textures = [self._barrier(*each) for each in dict.fromkeys(used)]
        others = [self._buffer_barrier(*each) for each in dict.fromkeys(buffers)]
        return WaitingRow(
            barriers=tuple(each for each in textures if each is not None),
            buffer_barriers=tuple(each for each in others if each is not None),
        )

    def _barrier(self, texture: int, after: TextureUse) -> BarrierRow | None:
        before = self.textures[texture]
        self.textures[texture] = after
        self.uses[texture][after] = None
        if before == after and before not in _WRITES:
            return None
        return BarrierRow(
            texture=texture, before=before, after=after, only_first=self.is_rare(texture)
        )

    def _buffer_barrier(self, elements: Elements, after: BufferUse) -> BufferBarrierRow | None:
        before = self.buffers.get(elements, "undefined")
        self.buffers[elements] = after
        if before == after:
            return None
        return BufferBarrierRow(
            result=elements.name, before=before, after=after, only_first=self.is_rare(elements)
        )
