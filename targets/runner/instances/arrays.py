"""Packs NumPy arrays into storage buffers, with the checks that lists of elements get."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from .contents import Contents, Layout, numbers_in
from .shapes import STORED, WHOLE, Numbers
from .values import UNIT_TOLERANCE, UNIT_TYPES, ParameterError, shown

_STEP = re.compile(r"\.(\w+)|\[(\d+)\]")


def packed_array(layout: Layout, given: Any) -> Contents | None:
    """The contents of an array; ``None`` if its shape has to be explained element by element."""
    array = np.asarray(given)
    if array.dtype.names is None and (array.dtype.kind not in "fiub" or array.ndim == 0):
        return None
    count = len(array)
    words = np.zeros((count, layout.stride // 4), np.uint32)
    for name, offset, shape in numbers_in(layout.element):
        lanes = _lanes(array, name, shape)
        if lanes is None:
            return None
        numbers = _checked(layout, name, shape, lanes)
        for column in range(max(shape.columns, 1)):
            first = (offset + column * shape.column_stride) // 4
            part = numbers[:, column * shape.lanes : (column + 1) * shape.lanes]
            words[:, first : first + shape.lanes] = np.ascontiguousarray(part).view(np.uint32)
    return Contents(layout, count, words.astype("<u4").tobytes())


def _lanes(array: Any, name: str, shape: Numbers) -> Any:
    """The named part of every element, as (elements, lanes); ``None`` if there is no such part."""
    part = array
    for member, position in _STEP.findall(name):
        if member:
            if part.dtype.names is None or member not in part.dtype.names:
                return None
            part = part[member]
        elif part.ndim < 2 or int(position) >= part.shape[1]:
            return None
        else:
            part = part[:, int(position)]
    count = shape.lanes * max(shape.columns, 1)
    if part.dtype.names is not None or part.dtype.kind not in "fiub":
        return None
    if part.size != len(array) * count or (part.ndim > 1 and shape.lanes == 1):
        return None
    return part.reshape(len(array), count)


def _checked(layout: Layout, name: str, shape: Numbers, lanes: Any) -> Any:
    """The numbers as they are stored. Raises ``ParameterError`` if a number cannot be stored."""
    if shape.kind in WHOLE:
        low, high = WHOLE[shape.kind]
        whole = np.floor(lanes) == lanes if lanes.dtype.kind == "f" else True
        _refuse(layout, name, shape, lanes, ~((lanes >= low) & (lanes <= high) & whole))
    elif shape.kind == "bool":
        _refuse(layout, name, shape, lanes, (lanes != 0) & (lanes != 1))
    with np.errstate(over="ignore"):
        numbers = lanes.astype(STORED[shape.kind])
    if shape.kind == "float":
        _refuse(layout, name, shape, lanes, ~np.isfinite(numbers))
        if shape.meaning in UNIT_TYPES and shape.lanes > 1:
            lengths = np.sqrt(np.square(lanes.astype(np.float64)).sum(axis=1, keepdims=True))
            _refuse(layout, name, shape, lanes, np.abs(lengths - 1.0) > UNIT_TOLERANCE)
            numbers = (lanes / lengths).astype(np.float32)
    return numbers


def _refuse(layout: Layout, name: str, shape: Numbers, lanes: Any, wrong: Any) -> None:
    """Report the first element that is wrong."""
    found = np.flatnonzero(np.broadcast_to(wrong, lanes.shape).any(axis=1))
    if len(found):
        where = f"{layout.name}[{found[0]}]{name}"
        value = lanes[found[0]].tolist()
        given = shown(value[0] if len(value) == 1 else tuple(value))
        raise ParameterError(where, f"`{where}` ({shape.type}) cannot hold {given}")
