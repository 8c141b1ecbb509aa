"""Runs kernels over buffers by the reference: what they write, as the bytes that a GPU would have.

``feeding.py`` calls it. ``compiler/reference/kernel.py`` computes the values.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ...compiler.ir.shader import Shader
from ...compiler.ir.storage import LANE, byte_size, place_in, stored_element
from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.kernel import Lane, computed
from ...compiler.reference.picture import RasterRules, Texels
from .instances.instance import Instance
from .instances.shapes import STORED
from .reference import texels_of, values_for

ANY = Errors(("vulkan",))
"""Bounds come with the values, and are not asked for."""


def elements_by_reference(
    shader: Shader, instance: Instance, textures: Mapping[str, Texels] | None = None
) -> dict[str, bytes]:
    """The bytes of the elements of each result of a kernel, by name.

    ``textures`` are what it reads, if not those of the instance. Raises ``MissingValuesError``.
    """
    counts = instance.result_counts()
    lanes = computed(
        shader, values_for(shader, instance),
        texels_of(instance) if textures is None else textures,
        instance.extent(), counts, ANY, RasterRules(1, 1),
    )  # fmt: skip
    return {name: _bytes(count, _of(name, lanes)) for name, count in counts.items()}


def _of(name: str, lanes: Sequence[Lane]) -> list[Lane]:
    return [lane for lane in lanes if lane.store.buffer.name == name]


def _bytes(count: int, lanes: Sequence[Lane]) -> bytes:
    """The elements of one result, which consist of these lanes and of padding."""
    store = lanes[0].store
    stride = byte_size(stored_element(store.buffer.type.element)) * store.stride
    elements: NDArray[np.uint8] = np.zeros((count, stride), np.uint8)
    for lane in lanes:
        start, kind = place_of(lane)
        elements[:, start : start + LANE] = _words(lane.value, kind)[:count]
    return elements.tobytes()


def place_of(lane: Lane) -> tuple[int, str]:
    """Where a lane lies in the elements of its result, in bytes, and how it is stored."""
    element = lane.store.buffer.type.element
    type_, offset = place_in(element, lane.store.path)
    start = lane.store.offset * byte_size(stored_element(element)) + offset
    return start + LANE * lane.lane, STORED[type_]


def _words(values: NDArray[np.generic], kind: str) -> NDArray[np.uint8]:
    """A lane of all elements, of shape (elements, 4): numbers too large are infinite, and integers
    wrap."""
    if kind == STORED["float"]:
        with np.errstate(over="ignore"):
            stored = values.astype(kind)
    else:
        stored = values.astype(np.int64).astype(kind)
    return stored.view(np.uint8).reshape(-1, LANE)
