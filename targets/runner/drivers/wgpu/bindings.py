"""Creates the bind groups of a draw or of a dispatch, and what is bound through them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import wgpu

from ..draw_job import Draw
from ..kernel_job import Dispatch
from ..slots import BlockSlot, BufferSlot, ImageSlot
from ..webgpu import Bound, Groups
from .device import Gpu
from .textures import make_sampler, make_view


def make_storage(gpu: Gpu, slots: Sequence[BufferSlot], contents: Sequence[bytes]) -> Sequence[Any]:
    """The storage buffers, filled; those that a kernel writes can be read back."""
    usage = wgpu.BufferUsage
    return [
        make_buffer(gpu, data, usage.STORAGE | (usage.COPY_SRC if slot.written else 0))
        for slot, data in zip(slots, contents, strict=True)
    ]


def make_buffer(gpu: Gpu, data: bytes, usage: int) -> Any:
    """A buffer that contains exactly these bytes."""
    return gpu.device.create_buffer_with_data(data=data, usage=usage)


def bind_groups(
    gpu: Gpu,
    layouts: Sequence[Any],
    groups: Groups,
    values: Draw | Dispatch,
    storage: Sequence[Any],
    images: Sequence[Any] = (),
) -> list[Any]:
    """The bind groups with everything that a pipeline reads and writes."""
    return [
        gpu.device.create_bind_group(
            layout=layout,
            entries=[
                {"binding": at, "resource": _resource(gpu, what, values, storage, images)}
                for at, what in group.items()
            ],
        )
        for layout, group in zip(layouts, groups, strict=True)
    ]


def _resource(
    gpu: Gpu,
    what: Bound,
    values: Draw | Dispatch,
    storage: Sequence[Any],
    images: Sequence[Any],
) -> Any:
    if isinstance(what.slot, BlockSlot):
        return {"buffer": make_buffer(gpu, values.blocks[what.number], wgpu.BufferUsage.UNIFORM)}
    if isinstance(what.slot, BufferSlot):
        return {"buffer": storage[what.number]}
    if isinstance(what.slot, ImageSlot):
        return images[what.number].create_view()
    if what.is_sampler:
        return make_sampler(gpu, what.slot)
    return make_view(gpu, values.textures[what.number])
