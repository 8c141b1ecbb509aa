"""Binds the blocks, buffers, images and textures of a draw or of a kernel."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import Protocol

import moderngl

from ..pipeline import Pipeline
from ..slots import BlockSlot, Place, TextureSlot
from ..texels import Image
from .context import Functions
from .texture_units import bound_texture

Linked = moderngl.Program | moderngl.ComputeShader
LANE_BYTES = 4


class Bindable(Protocol):
    """A texture that is on the device already."""

    def bind(self, slot: TextureSlot, unit: int) -> None:
        """Bind the texture to a unit, with the state of a slot's sampler."""


@contextmanager
def bound(
    context: moderngl.Context,
    functions: Functions,
    program: Linked,
    pipeline: Pipeline,
    contents: Sequence[bytes],
    textures: Sequence[Image | Bindable],
    storage: Sequence[moderngl.Buffer],
) -> Iterator[None]:
    """Bind blocks, storage buffers and textures inside the ``with`` block.

    Some of the textures and buffers are on the device already.
    """
    # OpenGL keeps a bound buffer only as long as somebody refers to it.
    blocks = [context.buffer(data) for data in contents]
    for number, (block, buffer) in enumerate(zip(pipeline.blocks, blocks, strict=True)):
        if block.uniforms:
            _set(program, block, contents[number])
        else:
            buffer.bind_to_uniform_block(bound_at(block.place, number))
    for number, (slot, buffer) in enumerate(zip(pipeline.buffers, storage, strict=True)):
        buffer.bind_to_storage_buffer(bound_at(slot.place, number))
    with ExitStack() as owned:
        for number, (texture, given) in enumerate(zip(pipeline.textures, textures, strict=True)):
            unit = bound_at(texture.texture, number)
            if isinstance(given, Image):
                owned.enter_context(bound_texture(functions, texture, given, unit))
            else:
                given.bind(texture, unit)
        yield


def _set(program: Linked, block: BlockSlot, data: bytes) -> None:
    """Set the uniforms of a block, except those that the compiler has left out.

    A uniform that is longer in the text than in the block, such as a matrix with further columns,
    ends in zeros.
    """
    for slot in block.uniforms:
        uniform = program.get(slot.identifier, None)
        if isinstance(uniform, moderngl.Uniform):
            size = uniform.dimension * uniform.array_length * LANE_BYTES
            value = data[slot.offset : slot.offset + min(size, slot.size)]
            uniform.write(value.ljust(size, b"\0"))


def bound_at(place: Place, number: int) -> int:
    """The binding of a block, buffer or texture: the text's, else its number in the pipeline.

    ``program.py`` gives it this number.
    """
    return number if place.binding is None else place.binding
