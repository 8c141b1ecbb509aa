"""The textures of a frame: made, viewed, cleared, copied and read back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import wgpu

from .....compiler.ir.types import DIMENSION_WORDS
from ..device import DriverError
from ..frame_job import FrameTexels, FrameTexture
from ..readback import TEXEL_LANES, depths_to_float, to_float
from .device import Gpu

DEPTH_BYTES = 4


@dataclass(frozen=True, slots=True)
class MadeTexture:
    """A texture on the device."""

    gpu: Gpu
    description: FrameTexture
    texture: Any

    def size(self, level: int) -> tuple[int, int]:
        """The width and the height of a level."""
        made = self.description
        return max(made.width >> level, 1), max(made.height >> level, 1)

    def view(self, *, is_read: bool = False) -> Any:
        """The view of the whole texture, which a kernel writes or a shader reads.

        Of depths with stencil values, a shader reads the depths.
        """
        depths_only = is_read and self.description.has_stencil
        return self.texture.create_view(
            dimension=DIMENSION_WORDS[self.description.dimension],
            aspect="depth-only" if depths_only else "all",
        )

    def part(self, layer: int, level: int) -> Any:
        """A layer of a level, to which steps draw."""
        return self.texture.create_view(
            dimension="2d", base_mip_level=level, mip_level_count=1,
            base_array_layer=layer, array_layer_count=1,
        )  # fmt: skip

    def clear(self) -> None:
        """Clear depths to the far plane, if they are read before a step draws to them.

        WebGPU itself makes everything black at first.
        """
        if not (self.description.is_black and self.description.is_depth):
            return
        encoder = self.gpu.device.create_command_encoder()
        for level in range(self.description.levels):
            for layer in range(self.description.layers):
                attachment = {
                    "view": self.part(layer, level),
                    "depth_clear_value": 1.0, "depth_load_op": "clear", "depth_store_op": "store",
                }  # fmt: skip
                if self.description.has_stencil:
                    attachment |= {
                        "stencil_clear_value": 0,
                        "stencil_load_op": "clear", "stencil_store_op": "store",
                    }  # fmt: skip
                drawing = encoder.begin_render_pass(
                    color_attachments=[], depth_stencil_attachment=attachment
                )
                drawing.end()
        self.gpu.device.queue.submit([encoder.finish()])

    def copy_to(self, encoder: Any, other: MadeTexture) -> None:
        """Record a copy of the whole texture."""
        for level in range(self.description.levels):
            encoder.copy_texture_to_texture(
                {"texture": self.texture, "mip_level": level},
                {"texture": other.texture, "mip_level": level},
                (*self.size(level), self.description.layers),
            )

    def read(self) -> FrameTexels:
        """The texels of the first level."""
        made = self.description
        match made.format:
            case "depth32float" | "depth32float-stencil8":
                texels = depths_to_float(self._copied(DEPTH_BYTES, "depth-only"))
            case colours:
                lanes, kind = TEXEL_LANES[colours]
                data = self._copied(lanes * kind.itemsize, "all")
                texels = to_float(data, colours, made.width, made.height * made.layers)
        return FrameTexels(made.width, made.height, made.layers, texels)

    def _copied(self, texel: int, aspect: str) -> bytes:
        made = self.description
        data = self.gpu.device.queue.read_texture(
            {"texture": self.texture, "aspect": aspect},
            {"bytes_per_row": made.width * texel, "rows_per_image": made.height},
            (made.width, made.height, made.layers),
        )
        return bytes(data)


def make_frame_texture(gpu: Gpu, wanted: FrameTexture, *, written: bool) -> MadeTexture:
    """A texture of a frame, which a kernel may have ``written``. Raises ``DriverError``."""
    if wanted.has_stencil and wanted.format not in gpu.features:
        raise DriverError(f"{gpu.description.name} has no {wanted.format}")
    usages = wgpu.TextureUsage
    usage = usages.RENDER_ATTACHMENT | (usages.STORAGE_BINDING if written else 0)
    if wanted.samples == 1:
        usage |= usages.TEXTURE_BINDING | usages.COPY_SRC | usages.COPY_DST
    texture = gpu.device.create_texture(
        format=wanted.format,
        size=(wanted.width, wanted.height, wanted.layers),
        mip_level_count=wanted.levels,
        sample_count=wanted.samples,
        usage=usage,
    )
    return MadeTexture(gpu, wanted, texture)
