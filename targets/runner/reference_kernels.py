"""Runs kernels over buffers by the reference: the results, and the bounds of a device's results.

``kernel_results.py`` gives the bytes to drivers, and ``frames/by_reference.py`` the whole contents
to other steps. ``compiler/reference/kernel.py`` computes the values.
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
from ...compiler.reference.storage_buffers import Contents
from .instances.instance import Instance
from .instances.shapes import STORED, WHOLE
from .reference import texels_of, values_for

Floats = NDArray[np.float64]

_INTEGERS = {STORED[kind]: ends for kind, ends in WHOLE.items()}
"""The smallest and the largest integer of each stored type."""


def elements_by_reference(
    shader: Shader,
    instance: Instance,
    textures: Mapping[str, Texels] | None = None,
    buffers: Mapping[str, Contents] | None = None,
    rules: RasterRules | None = None,
    errors: Errors | None = None,
) -> dict[str, Contents]:
    """The elements of each result of a kernel, by name.

    ``textures`` are the textures that it reads, if not those of the instance, and ``buffers`` the
    buffers that other kernels have written. With ``errors`` the elements have bounds. Raises
    ``MissingValuesError``.
    """
    counts = instance.result_counts()
    lanes = computed(
        shader, values_for(shader, instance, buffers),
        texels_of(instance) if textures is None else textures,
        instance.extent(), counts, errors, rules or RasterRules(1, 1),
    )  # fmt: skip
    return {name: _contents(count, _of(name, lanes)) for name, count in counts.items()}


def _of(name: str, lanes: Sequence[Lane]) -> list[Lane]:
    return [lane for lane in lanes if lane.store.buffer.name == name]


def _contents(count: int, lanes: Sequence[Lane]) -> Contents:
    """The elements of one result, which consist of these lanes and of padding."""
    store = lanes[0].store
    stride = byte_size(stored_element(store.buffer.type.element)) * store.stride
    elements = np.zeros((count, stride), np.uint8)
    words = np.zeros((3, count, stride // LANE))
    for lane in lanes:
        start, kind = place_of(lane)
        elements[:, start : start + LANE] = _bytes(lane.value, kind)[:count]
        words[:, :, start // LANE] = _numbers(lane, kind)[:, :count]
    return Contents(elements.tobytes(), words.reshape(3, -1))


def place_of(lane: Lane) -> tuple[int, str]:
    """The offset of a lane in the elements of its result, in bytes, and its stored type."""
    element = lane.store.buffer.type.element
    type_, offset = place_in(element, lane.store.path)
    start = lane.store.offset * byte_size(stored_element(element)) + offset
    return start + LANE * lane.lane, STORED[type_]


def _bytes(values: NDArray[np.generic], kind: str) -> NDArray[np.uint8]:
    """A lane of all elements, of shape (elements, 4): numbers too large are infinite, and integers
    wrap."""
    if kind == STORED["float"]:
        with np.errstate(over="ignore"):
            stored = values.astype(kind)
    else:
        stored = values.astype(np.int64).astype(kind)
    return stored.view(np.uint8).reshape(-1, LANE)


def _numbers(lane: Lane, kind: str) -> Floats:
    """A lane of all elements: its values, and the bounds of a device's values."""
    found = np.stack([lane.value, lane.low, lane.high]).astype(np.float64)
    if kind in _INTEGERS:
        found = np.clip(found, *_INTEGERS[kind])
    return np.where(lane.undecided, np.nan, found)
