"""Binds what the text of a draw or of a kernel reads and writes."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

import moderngl

from ..draw import Dispatch, Draw, Pipeline, Place
from .context import Functions
from .texture_units import bound_texture


@contextmanager
def bound(
    context: moderngl.Context, functions: Functions, pipeline: Pipeline, values: Draw | Dispatch
) -> Iterator[list[moderngl.Buffer]]:
    """Bind blocks, storage buffers and textures for a while; yields the storage buffers."""
    blocks = [context.buffer(data) for data in values.blocks]
    for number, (block, buffer) in enumerate(zip(pipeline.blocks, blocks, strict=True)):
        buffer.bind_to_uniform_block(bound_at(block.place, number))
    storage = [context.buffer(data) for data in values.buffers]
    for number, (slot, buffer) in enumerate(zip(pipeline.buffers, storage, strict=True)):
        buffer.bind_to_storage_buffer(bound_at(slot.place, number))
    with ExitStack() as textures:
        for number, (texture, image) in enumerate(
            zip(pipeline.textures, values.textures, strict=True)
        ):
            unit = bound_at(texture.texture, number)
            textures.enter_context(bound_texture(functions, texture, image, unit))
        yield storage


def bound_at(place: Place, number: int) -> int:
    """Where a block, buffer or texture is bound: at the text's binding, else at its number in the
    pipeline, which ``program.py`` gives it."""
    return number if place.binding is None else place.binding
