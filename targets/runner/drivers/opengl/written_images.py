"""Creates the images that a kernel writes, and reads them back."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import moderngl

from ..kernel_job import Sides
from ..readback import TEXEL_LANES, to_float
from ..slots import ImageSlot
from .bindings import bound_at


@contextmanager
def written_images(
    context: moderngl.Context, slots: Sequence[ImageSlot], size: Sides
) -> Iterator[list[moderngl.Texture]]:
    """Bind images of one size, to which a kernel writes, for a while."""
    width, height, _ = size
    images = []
    try:
        for number, slot in enumerate(slots):
            lanes, kind = TEXEL_LANES[slot.format]
            # Its word for bytes that stand for 0 to 1 is ``f1``.
            word = f"f{kind.itemsize}"
            black = bytes(width * height * lanes * kind.itemsize)
            images.append(context.texture((width, height), lanes, black, dtype=word, alignment=1))
            images[-1].bind_to_image(bound_at(slot.place, number), read=False, write=True)
        yield images
    finally:
        for image in images:
            image.release()


def texels(slot: ImageSlot, image: moderngl.Texture) -> bytes:
    """The texels of an image, row by row from the top."""
    return to_float(image.read(alignment=1), slot.format, image.width, image.height, "top")
