"""Kernels as drivers and the reference take them: the values of an instance as a dispatch.

``frames/by_route.py`` makes steps of them; ``compiler/reference/kernel.py`` computes the same by
the reference. A kernel over images may also be drawn, as the scene that ``full_screen_state``
makes.
"""

from __future__ import annotations

import struct
from typing import Literal

import numpy as np

from ...compiler.budget import check
from ...compiler.documents.reflection import Reflection
from ...compiler.documents.values import ResultRow
from ...compiler.ir.full_screen import CORNERS, full_screen, writes_images
from ...compiler.ir.shader import Shader
from ...support.frozen import changed
from .drivers.draws import Dispatch, Draw
from .instances.instance import Instance
from .scene_state import CLEAR, Color, SceneState

_WORD = struct.Struct("<I")

DEPTHS = ("depth", "r32f")
"""The name of the depths of a pass without targets, and the format that holds them."""


class EmptyImageError(ValueError):
    """The images of a kernel have no texels."""

    def __init__(self, kernel: str, width: int, height: int) -> None:
        super().__init__(f"the images of {kernel} have {width} x {height} texels: set what tells "
                         "their size")  # fmt: skip


class UndrawableError(ValueError):
    """The reference cannot draw a stage of the material, or cannot capture its vertices.

    An example are stages that make lines of patches.
    """

    def __init__(self, material: str, does: Literal["draw", "capture"] = "draw") -> None:
        super().__init__(
            f"{material} has other stages than the reference {does}s: only routes {does} it"
        )


def has_images(reflection: Reflection) -> bool:
    """True for a compiled kernel over images."""
    return reflection.extent is not None and bool(reflection.targets)


def is_over_buffers(reflection: Reflection) -> bool:
    """True for a compiled kernel over buffers, which has no picture of its own."""
    return bool(reflection.results) and reflection.capture is None


def is_drawn(reflection: Reflection) -> bool:
    """True if pictures are drawn. Kernels over buffers, and captures, write elements instead."""
    return reflection.capture is None and not is_over_buffers(reflection)


def pictures_of(reflection: Reflection) -> tuple[tuple[str, str], ...]:
    """The name and the format of each picture that a single shader leaves.

    They are its targets, or the images of a kernel. A pass without targets leaves its depths.
    """
    if reflection.targets or not is_drawn(reflection):
        return tuple((row.name, row.format) for row in reflection.targets)
    return (DEPTHS,)


def dispatch_of(instance: Instance) -> Dispatch:
    """The bytes that a driver computes with, in the order of the reflection. Raises
    ``BudgetError`` for too many that a kernel would write."""
    reflection = instance.reflection
    blocks, textures, buffers = instance.blocks(), instance.textures(), instance.buffers()
    count = instance.extent()
    read = [buffers[row.name].bound for row in reflection.buffers if row.stages]
    counts = instance.result_counts()
    size = sum(max(counts[row.name], 1) * row.stride for row in reflection.results)
    check("memory", size, f"the results of {reflection.material} take")
    written = [_before(row, counts[row.name]) for row in reflection.results]
    return Dispatch(
        extent=(count, 1, 1),
        blocks=tuple(blocks[row.name] for row in reflection.blocks),
        textures=tuple(textures[row.name].image() for row in reflection.textures if row.stages),
        buffers=(*read, *written),
    )


def image_dispatch(draw: Draw) -> Dispatch:
    """The run of a kernel over images that makes the same picture as a draw of them."""
    return Dispatch((draw.width, draw.height, 1), draw.blocks, draw.textures, draw.buffers)


def _before(row: ResultRow, count: int) -> bytes:
    """The contents of a buffer before a kernel writes it. No API binds an empty buffer."""
    size = max(count, 1) * row.stride
    if row.initial is None:
        return bytes(size)
    return _WORD.pack(int(row.initial) & 0xFFFFFFFF) * int(size // 4)


def full_screen_state(instance: Instance, clear: Color = CLEAR) -> SceneState:
    """The draw that makes the images of a kernel: one triangle over the whole picture.

    Raises ``MissingValuesError``, and ``EmptyImageError``.
    """
    reflection, (width, height) = instance.reflection, instance.image_size()
    if not width * height:
        raise EmptyImageError(reflection.material, width, height)
    corners = np.arange(CORNERS)[None]
    cleared = (clear,) * len(reflection.targets)
    return SceneState(width, height, {}, corners, instance, cleared)


def elements_state(instance: Instance) -> SceneState:
    """The run of a kernel over buffers, as a state: the elements of its longest result are pixels
    of a single row. Raises ``MissingValuesError``."""
    width = max(1, *instance.result_counts().values())
    return SceneState(width, 1, {}, np.arange(CORNERS)[None], instance, ())


def drawable(shader: Shader) -> Shader:
    """The shader as the reference draws it: a kernel over images as a full-screen pass.

    Raises ``UndrawableError``.
    """
    if not writes_images(shader):
        if not shader.is_lowered:
            raise UndrawableError(shader.name)
        return shader
    # A copy, as nodes are added, and others may walk over the given graph.
    return full_screen(changed(shader, graph=shader.graph.copy(), notes=shader.notes.copy()))
