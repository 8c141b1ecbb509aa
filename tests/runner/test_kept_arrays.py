"""What is dumped is loaded again, with its types and shapes, by many threads at once."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator

import numpy as np
import pytest

from burnish.targets.runner.kept_arrays import dumped_arrays, loaded_arrays

from ..suite.processes import at_once

HEAD = {"names": ["größe", "a\nb"], "counted": [["owns_bottom", 3]]}
ARRAYS = [
    np.array([[1.5, np.nan, np.inf], [-0.0, 5e-324, -1e308]]),
    np.array([[True], [False]]),
    np.zeros((0, 4)),
    np.array(7, np.int64),
    np.asfortranarray(np.arange(12, dtype=np.int32).reshape(3, 4)),
    np.array([10, 0], ">u2"),
]


def test_what_is_dumped_is_loaded() -> None:
    head, arrays = loaded_arrays(dumped_arrays(HEAD, ARRAYS))
    assert head == HEAD
    for before, after in zip(ARRAYS, arrays, strict=True):
        assert (after.dtype, after.shape, after.tobytes()) == (
            before.dtype,
            before.shape,
            before.tobytes(),
        )
        after[...] = 0  # What is loaded may be changed.


def test_nothing_is_an_answer_too() -> None:
    assert loaded_arrays(dumped_arrays([], [])) == ([], [])


def work_of_a_collection(*_phase: object) -> None:
    """A callback in Python, in which the interpreter may go on with another thread."""
    sum(range(50))


@pytest.fixture
def busy_collections() -> Iterator[None]:
    """Garbage is collected at each allocation, and threads take turns as often as they can."""
    thresholds, interval = gc.get_threshold(), sys.getswitchinterval()
    gc.callbacks.append(work_of_a_collection)
    gc.set_threshold(1)
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(interval)
    gc.set_threshold(*thresholds)
    gc.callbacks.remove(work_of_a_collection)


@pytest.mark.usefixtures("busy_collections")
def test_many_threads_load_at_once() -> None:
    """NumPy's own format fails here in Python 3.11.7."""
    data = dumped_arrays(HEAD, ARRAYS)

    def load() -> int:
        return sum(len(loaded_arrays(data)[1]) for _ in range(50))

    assert at_once([load] * 8) == [50 * len(ARRAYS)] * 8
