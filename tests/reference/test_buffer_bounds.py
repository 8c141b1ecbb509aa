"""The bounds of an element that is read from a buffer which a kernel has written."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from burnish.compiler.ir.leaves import Buffer
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    INT,
    VEC3,
    Array,
    RuntimeArray,
    Struct,
    Type,
    Vector,
)
from burnish.compiler.reference.bounds import Bounded, exact
from burnish.compiler.reference.storage_buffers import BufferReader, Contents

Rows = Sequence[Sequence[float]]


def reader(element: Type, value: Rows, off: Rows) -> BufferReader:
    """The reader of a buffer with these words, each with a bound ``off`` on both sides.

    The contents are the bytes of floats.
    """
    words, wide = np.array(value, float), np.array(off, float)
    ends = np.stack([words, words - wide, words + wide]).reshape(3, -1)
    leaf = Buffer("b", RuntimeArray(element), "draw")
    return BufferReader(Contents(words.astype("<f4").tobytes(), ends), leaf, leaf.type)


def ends_of(lane: Bounded) -> tuple[object, ...]:
    return tuple(np.asarray(end).tolist() for end in (lane.value, lane.low, lane.high))


def at(low: Sequence[int], value: Sequence[int], high: Sequence[int]) -> Bounded:
    lows, values, highs = (np.array(each, np.int64) for each in (low, value, high))
    return Bounded(values, lows, highs)


def test_an_element_has_the_bounds_with_which_it_was_written() -> None:
    read = reader(FLOAT, [[1], [2], [4]], [[0], [0.5], [0.25]])
    (lane,) = read.element(exact(np.array([2, 1, 0, 9])))
    assert ends_of(lane) == ([4, 2, 1, 4], [3.75, 1.5, 1, 3.75], [4.25, 2.5, 1, 4.25])


def test_without_bounds_it_is_what_it_means_and_not_rounded() -> None:
    read = reader(FLOAT, [[0.1], [2]], [[0.5], [0.5]])
    assert read.element(0) == (0.1,)
    assert read.element(np.array([1, 0]))[0].tolist() == [2, 0.1]


def test_where_all_devices_have_the_same_it_is_exact() -> None:
    (lane,) = reader(FLOAT, [[1], [2]], [[0], [0]]).element(exact(np.array([0, 1])))
    assert lane.is_exact


def test_an_open_index_may_be_any_of_a_run_of_elements() -> None:
    read = reader(FLOAT, [[5], [1], [9], [3]], [[0], [0.5], [0.25], [0]])
    (lane,) = read.element(at([0, 1, -7], [0, 3, 3], [1, 3, 99]))
    assert ends_of(lane) == ([5, 3, 3], [0.5, 0.5, 0.5], [5, 9.25, 9.25])


def test_a_run_does_not_make_other_reads_less_certain() -> None:
    read = reader(FLOAT, [[float(i)] for i in range(100)], [[0]] * 100)
    (lane,) = read.element(at([0, 40], [50, 40], [99, 40]))
    assert ends_of(lane) == ([50, 40], [0, 40], [99, 40])


def test_integers_and_conditions_may_be_open() -> None:
    (number,) = reader(INT, [[5], [7]], [[0], [2]]).element(exact(np.array([0, 1])))
    assert number.kind == "i" and ends_of(number) == ([5, 7], [5, 5], [5, 9])
    (on,) = reader(BOOL, [[1], [0.5], [0]], [[0], [0.5], [0]]).element(exact(np.arange(3)))
    assert on.kind == "b"
    assert (on.low.tolist(), on.high.tolist()) == ([True, False, False], [True, True, False])


def test_each_lane_and_member_has_its_own() -> None:
    element = Struct("S", (("place", VEC3), ("ways", Array(Vector("float", 2), 2))))
    value, off = [list(range(1, 9))], [[i / 8 for i in range(8)]]
    place, ways = reader(element, value, off).element(exact(np.array([0])))
    lanes = [*place, *ways[0], *ways[1]]
    assert [lane.value.item() for lane in lanes] == [1, 2, 3, 5, 6, 7, 8]
    assert [lane.high.item() - lane.value.item() for lane in lanes] == [
        i / 8 for i in (0, 1, 2, 4, 5, 6, 7)
    ]


def test_what_is_read_of_one_element_shares_its_error() -> None:
    (lane,) = reader(FLOAT, [[1], [2]], [[0.5], [0.5]]).element(exact(np.array([0, 1])))
    apart = (lane + 1.0) - lane
    assert np.asarray(apart.radius).max() == pytest.approx(0, abs=1e-5)


def test_what_was_written_of_nothing_known_is_nothing_known() -> None:
    ends = np.array([[1.0], [-np.inf], [np.nan]])
    leaf = Buffer("b", RuntimeArray(FLOAT), "draw")
    read = BufferReader(Contents(np.float32(1).tobytes(), ends), leaf, leaf.type)
    (lane,) = read.element(exact(np.array([0])))
    assert not np.isfinite(lane.low).any() and not np.isfinite(lane.high).any()
