"""Uploads the data that the draws of a frame job carry: meshes, blocks, textures and buffers.

Draws often share these, so equal bytes are uploaded once.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import Any

import vulkan as vk

from ..frame_job import OWN, FrameDraw
from ..pipeline import Pipeline
from ..texels import Image
from .descriptor_sets import DescriptorSets, make_descriptor_sets
from .device import Gpu
from .frame_textures import MadeTexture
from .memory import Buffer, filled_buffer
from .texture_images import make_texture

STORAGE = vk.VK_BUFFER_USAGE_STORAGE_BUFFER_BIT
MESH = vk.VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | vk.VK_BUFFER_USAGE_INDEX_BUFFER_BIT


@dataclass(slots=True)
class Uploads:
    """The uploads of one job."""

    owned: ExitStack
    gpu: Gpu
    _images: dict[Image, Any] = field(default_factory=dict)
    _buffers: dict[tuple[int, bytes], Buffer] = field(default_factory=dict)

    def bound(
        self,
        once: ExitStack,
        pipeline: Pipeline,
        drawn: FrameDraw,
        textures: Sequence[MadeTexture],
        buffers: Sequence[Buffer],
        images: Sequence[int],
    ) -> DescriptorSets:
        """The descriptor sets of a draw or dispatch, over the frame's textures and buffers, and
        the images that a kernel writes. ``once`` owns them."""
        given = drawn.values
        own_textures, own_buffers = iter(given.textures), iter(given.buffers)
        sets = make_descriptor_sets(once, self.gpu, pipeline)
        sets.bind_blocks(given.blocks)
        sets.bind_textures(
            self.gpu,
            [
                self._image(next(own_textures)) if number == OWN else textures[number].view
                for number in drawn.textures
            ],
        )
        sets.bind_buffers(
            self.gpu,
            [
                self.buffer(STORAGE, next(own_buffers)) if number == OWN else buffers[number]
                for number in drawn.buffers
            ],
        )
        if images:
            sets.bind_images(self.gpu, [textures[number].view for number in images])
        return sets

    def buffer(self, usage: int, data: bytes) -> Buffer:
        """A buffer with these bytes, which nobody writes."""
        key = usage, data
        if key not in self._buffers:
            self._buffers[key] = filled_buffer(self.owned, self.gpu, usage, data)
        return self._buffers[key]

    def _image(self, image: Image) -> Any:
        if image not in self._images:
            self._images[image] = make_texture(self.owned, self.gpu, image)
        return self._images[image]
