"""Writes arrays with a head of JSON as bytes, and reads them again.

``reference.py`` and ``conformance/frame_pictures.py`` keep pictures so. Unlike a pickle, this
format cannot contain code. NumPy's own format would do, but NumPy reads its heads with
``ast.literal_eval``. Until Python 3.11.8, two threads that are both in it disturb each other, which
happens if garbage is collected there: one of them ends with a ``SystemError``
(https://github.com/python/cpython/issues/106905). Pictures are read by many threads at once.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

AnyArray: TypeAlias = NDArray[Any]


def dumped_arrays(head: object, arrays: Iterable[AnyArray]) -> bytes:
    """A line of JSON, which has the head and the type and shape of each array, and their values,
    the last axis first.

    ``head`` consists of what JSON can say, and the arrays of numbers or booleans.
    """
    parts = list(arrays)
    kinds = [(part.dtype.str, part.shape) for part in parts]
    first = json.dumps([head, kinds]).encode()
    return b"".join([first, b"\n", *(part.tobytes() for part in parts)])


def loaded_arrays(data: bytes) -> tuple[Any, list[AnyArray]]:
    """The head and the arrays that were dumped; the arrays may be changed."""
    first, _, values = data.partition(b"\n")
    head, kinds = json.loads(first)
    arrays, start = [], 0
    for kind, shape in kinds:
        array = np.ndarray(shape, kind, values, start).copy()
        arrays.append(array)
        start += array.nbytes
    return head, arrays
