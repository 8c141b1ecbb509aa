"""Creates the bind groups of a draw or of a dispatch, and the resources that these carry."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import wgpu

from ..slots import BlockSlot, BufferSlot, ImageSlot
from ..texels import Image
from ..webgpu import Bound
from .device import Gpu
from .pipeline import MadePipeline
from .textures import make_sampler, make_view


@dataclass(slots=True)
class DrawnData:
    """Buffers and textures with the data that draws carry; equal bytes are uploaded once."""

    gpu: Gpu
    _buffers: dict[tuple[int, bytes], Any] = field(default_factory=dict)
    _views: dict[Image, Any] = field(default_factory=dict)

    def buffer(self, data: bytes, usage: int) -> Any:
        """A buffer that contains exactly these bytes, which nobody writes."""
        key = usage, data
        if key not in self._buffers:
            self._buffers[key] = self.gpu.device.create_buffer_with_data(data=data, usage=usage)
        return self._buffers[key]

    def view(self, image: Image) -> Any:
        """A texture with all levels of an image, as a shader reads it."""
        if image not in self._views:
            self._views[image] = make_view(self.gpu, image)
        return self._views[image]


def bind_groups(
    uploads: DrawnData,
    made: MadePipeline,
    blocks: Sequence[bytes],
    views: Sequence[Any],
    storage: Sequence[Any],
    images: Sequence[Any],
) -> list[Any]:
    """The bind groups with everything that a pipeline reads and writes: the contents of its blocks,
    its textures, storage buffers and images."""

    def resource(what: Bound) -> Any:
        if isinstance(what.slot, BlockSlot):
            return {"buffer": uploads.buffer(blocks[what.number], wgpu.BufferUsage.UNIFORM)}
        if isinstance(what.slot, BufferSlot):
            return {"buffer": storage[what.number]}
        if isinstance(what.slot, ImageSlot):
            return images[what.number]
        if what.is_sampler:
            return make_sampler(uploads.gpu, what.slot)
        return views[what.number]

    return [
        uploads.gpu.device.create_bind_group(
            layout=layout,
            entries=[{"binding": at, "resource": resource(what)} for at, what in group.items()],
        )
        for layout, group in zip(made.layouts, made.groups, strict=True)
    ]
