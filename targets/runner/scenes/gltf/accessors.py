"""Decodes accessors: the arrays of numbers of which meshes, skins and morph targets consist.

Each range is checked against the existing bytes, and each array is counted, before it is made: a
small file can name the same bytes again and again, or zeros without any bytes.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .....compiler.budget import Tally
from ..records import SceneError
from .folder import Folder
from .schema import Accessor, File, Sparse

_LEAST = 1000
"""The least numbers that an accessor is counted as: reading a short one takes as long."""
_LOOKED_UP = 30
"""The numbers that a named accessor is counted as, whether or not it is read."""
_BYTES_OF_NUMBER = 2 * 8
"""The memory of a number while it is decoded, beside its own size: as a double, and as a result."""

_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_SHAPES = {
    "SCALAR": (1, 1), "VEC2": (1, 2), "VEC3": (1, 3), "VEC4": (1, 4), "MAT2": (2, 2),
    "MAT3": (3, 3), "MAT4": (4, 4),
}  # fmt: skip
"""The columns and rows of an element."""

Array = NDArray[Any]


class Accessors:
    """The arrays of one file."""

    def __init__(
        self, file: File, folder: Folder, binary: memoryview | None, path: Path, memory: Tally
    ) -> None:
        """``memory`` counts everything that is read of the file ``path``."""
        self._file = file
        self._folder = folder
        self._binary = binary
        self._memory = memory
        self._numbers = Tally("numbers", f"reading {path} takes")
        self._buffers: dict[int, memoryview] = {}

    def floats(self, index: int, type_: str, what: str) -> NDArray[np.float64]:
        """An accessor as floats, (count, lanes), or (count, column, row) for matrices; integers are
        scaled if it says so. Raises ``SceneError`` if it has another type, or is wrong."""
        accessor, found = self._array(index, type_, what)
        if accessor.normalized and found.dtype.kind in "iu":
            scaled = found / np.iinfo(found.dtype).max
            return np.maximum(scaled, -1.0)
        with np.errstate(invalid="ignore"):  # Some NaN signal here; all are refused below.
            floats = found.astype(np.float64)
        if not np.isfinite(floats).all():
            raise SceneError(f"{what}: accessor {index} has numbers that are not finite")
        return floats

    def integers(self, index: int, type_: str, what: str) -> NDArray[np.int64]:
        """An accessor as whole numbers, (count, lanes). Raises ``SceneError``."""
        _accessor, found = self._array(index, type_, what)
        if found.dtype.kind != "u":
            raise SceneError(f"{what}: accessor {index} has to be of integers without signs")
        return found.astype(np.int64)

    def type_of(self, index: int, what: str) -> str:
        """The type of an accessor, such as ``VEC3``. Raises ``SceneError``."""
        return self._found(index, what).type

    def count_of(self, index: int, what: str) -> int:
        """The number of elements of an accessor. Raises ``SceneError``."""
        return self._found(index, what).count

    def tell_looked_up(self, count: int) -> None:
        """Count accessors that a primitive names, which takes time even if none is read. Raises
        ``BudgetError``."""
        self._numbers.add(count * _LOOKED_UP)

    def bytes_of_view(self, index: int, what: str) -> bytes:
        """The bytes of a buffer view, such as a picture's file. Raises ``SceneError``."""
        data, _stride = self._view(index, what)
        self._memory.add(0, passing=len(data))
        return bytes(data)

    def _found(self, index: int, what: str) -> Accessor:
        if index >= len(self._file.accessors):
            raise SceneError(f"{what}: there is no accessor {index}")
        return self._file.accessors[index]

    def _array(self, index: int, type_: str, what: str) -> tuple[Accessor, Array]:
        accessor = self._found(index, what)
        if accessor.type != type_:
            raise SceneError(f"{what}: accessor {index} is {accessor.type}, and not {type_}")
        return accessor, self._decode(accessor, f"accessor {index}")

    def _decode(self, accessor: Accessor, what: str) -> Array:
        kind, shape = np.dtype(_TYPES[accessor.component_type]), _SHAPES[accessor.type]
        numbers = accessor.count * shape[0] * shape[1]
        self._numbers.add(max(numbers, _LEAST))
        self._memory.add(0, passing=numbers * (kind.itemsize + _BYTES_OF_NUMBER))
        if accessor.buffer_view is None:
            found = np.zeros((accessor.count, *shape), kind)
        else:
            view, offset = accessor.buffer_view, accessor.byte_offset
            found = self._elements(view, offset, accessor.count, kind, shape, what)
        if accessor.sparse is not None:
            found = self._replaced(found, accessor.sparse, shape, what)
        return found[:, 0] if shape[0] == 1 else found

    def _elements(
        self,
        view: int,
        offset: int,
        count: int,
        kind: np.dtype[Any],
        shape: tuple[int, int],
        what: str,
    ) -> Array:
        """``count`` elements of a buffer view, each of shape (columns, rows)."""
        data, stride = self._view(view, what)
        columns, rows = shape
        # Each column of a matrix begins at a multiple of four bytes.
        column = rows * kind.itemsize if columns == 1 else -(-rows * kind.itemsize // 4) * 4
        step = stride or columns * column
        if step < columns * column:
            raise SceneError(f"{what}: its elements are longer than the {step} bytes between them")
        if offset + (count - 1) * step + columns * column > len(data):
            raise SceneError(f"{what}: it does not lie within buffer view {view}")
        strides = (step, column, kind.itemsize)
        return np.ndarray((count, columns, rows), kind, data, offset, strides).copy()

    def _replaced(self, found: Array, sparse: Sparse, shape: tuple[int, int], what: str) -> Array:
        """The array with the elements that a sparse accessor replaces."""
        if sparse.count > len(found):
            raise SceneError(f"{what}: it replaces {sparse.count} of {len(found)} elements")
        indices, values = sparse.indices, sparse.values
        kind = np.dtype(_TYPES[indices.component_type])
        places = self._elements(
            indices.buffer_view, indices.byte_offset, sparse.count, kind, (1, 1), what
        ).ravel().astype(np.int64)  # fmt: skip
        if (np.diff(places) <= 0).any() or places[-1] >= len(found):
            raise SceneError(
                f"{what}: the indices of what it replaces do not rise within its count"
            )
        found[places] = self._elements(
            values.buffer_view, values.byte_offset, sparse.count, found.dtype, shape, what
        )
        return found

    def _view(self, index: int, what: str) -> tuple[memoryview, int | None]:
        """The bytes of a buffer view, and the distance of its elements, if it has one."""
        if index >= len(self._file.buffer_views):
            raise SceneError(f"{what}: there is no buffer view {index}")
        view = self._file.buffer_views[index]
        data = self._buffer(view.buffer, f"buffer view {index}")
        end = view.byte_offset + view.byte_length
        if end > len(data):
            raise SceneError(f"buffer view {index}: it does not lie within buffer {view.buffer}")
        return data[view.byte_offset : end], view.byte_stride

    def _buffer(self, index: int, what: str) -> memoryview:
        if index >= len(self._file.buffers):
            raise SceneError(f"{what}: there is no buffer {index}")
        if index not in self._buffers:
            self._buffers[index] = self._read(index)
        return self._buffers[index]

    def _read(self, index: int) -> memoryview:
        buffer = self._file.buffers[index]
        what = f"buffer {index}"
        if buffer.uri is not None:
            data = memoryview(self._folder.read(buffer.uri, what))
        elif index == 0 and self._binary is not None:
            data = self._binary
        else:
            raise SceneError(f"{what}: it has neither a URI nor the binary part of a .glb")
        if len(data) < buffer.byte_length:
            raise SceneError(f"{what}: it has {len(data)} of {buffer.byte_length} bytes")
        return data[: buffer.byte_length]
