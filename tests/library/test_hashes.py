"""Hashes, bit for bit against NumPy and published values."""

from __future__ import annotations

import numpy as np
import pytest

from .hashed import fractions, hashed, words
from .kit import Floats
from .sampled import sampled
from .truth import truth

CELLS = np.concatenate([
    np.array([[0, 0, 0, 0], [1, 0, 0, 0], [-1, 2, -3, 4], [2**31 - 1, -(2**31), 7, -1]]),
    np.random.default_rng(1).integers(-(2**31), 2**31, (60, 4)),
])  # fmt: skip


def bits(expression: str, count: int) -> Floats:
    """The lanes of a hash of the cells, as whole numbers."""
    lanes = [expression if count == 1 else f"{expression}.{lane}" for lane in "xyzw"[:count]]
    halves = [f"float({lane} >> 16), float({lane} & 0xFFFFu), 0, 0" for lane in lanes]
    found = [sampled("import std.hashes", half, k=CELLS) for half in halves]
    return np.stack([half[:, 0] * 65536 + half[:, 1] for half in found], axis=-1)


@truth("std.hashes.pcg")
@truth("std.hashes.pcg2d", "std.hashes.pcg3d", "std.hashes.pcg4d", "std.hashes.pcg_round")
@pytest.mark.parametrize(
    ("expression", "count"),
    [
        ("pcg(uint(k.x))", 1),
        ("pcg2d(uvec2(k.xy))", 2),
        ("pcg3d(uvec3(k.xyz))", 3),
        ("pcg4d(uvec4(k))", 4),
    ],
)
def test_hashes_have_the_bits_of_the_paper(expression: str, count: int) -> None:
    assert np.array_equal(bits(expression, count), hashed(CELLS[:, :count]))


@truth("std.hashes.pcg")
def test_pcg_has_published_values() -> None:
    """The values that implementations of RXS-M-XS 32 agree on."""
    assert bits("pcg(uint(k.x))", 1)[:2, 0].tolist() == [129708002, 2831084092]


@truth("std.hashes.xxhash32")
def test_xxhash_has_published_values() -> None:
    """XXH32 of four bytes, with the seed 0, written in Python's integers from the specification."""

    def xxh32(word: int) -> int:
        h = (374761393 + 4 + word * 3266489917) & 0xFFFFFFFF
        h = (((h << 17) | (h >> 15)) & 0xFFFFFFFF) * 668265263 & 0xFFFFFFFF
        h = (h ^ (h >> 15)) * 2246822519 & 0xFFFFFFFF
        h = (h ^ (h >> 13)) * 3266489917 & 0xFFFFFFFF
        return h ^ (h >> 16)

    assert xxh32(int.from_bytes(b"test", "little")) == 0x3E2023CF
    expected = [xxh32(int(word)) for word in words(CELLS[:, 0])]
    assert bits("xxhash32(uint(k.x))", 1)[:, 0].tolist() == expected


@truth("std.hashes.fraction_of")
@truth("std.hashes.random2", "std.hashes.random3", "std.hashes.random4")
@pytest.mark.parametrize(
    ("expression", "count"),
    [
        ("fraction_of(pcg(uint(k.x))), 0, 0, 0", 1),
        ("random2(k.xy), 0, 0", 2),
        ("random3(k.xyz), 0", 3),
        ("random4(k)", 4),
    ],
)
def test_fractions_are_the_high_bits(expression: str, count: int) -> None:
    found = sampled("import std.hashes", expression, k=CELLS)[:, :count]
    assert np.array_equal(found, fractions(CELLS[:, :count]))


@truth("std.hashes.fraction_of")
def test_fractions_go_from_zero_to_just_below_one() -> None:
    all_bits = words([-1, -1, 0, 255]).astype(np.int64)
    expression = "fraction_of(0xFFFFFFFFu), fraction_of(uvec2(0, 255u)), fraction_of(256u)"
    found = sampled("import std.hashes", expression, k=all_bits)
    assert found.tolist() == [1 - 2.0**-24, 0, 0, 2.0**-24]


@truth("std.hashes.random2", "std.hashes.random3", "std.hashes.random4")
@pytest.mark.parametrize("count", [2, 3, 4])
def test_fractions_of_neighbours_have_nothing_in_common(count: int) -> None:
    """All lanes of 4096 neighbours are spread evenly, and no two of them go together."""
    cells = np.pad(np.indices((64, 64)).reshape(2, -1).T, ((0, 0), (0, 2)))
    noise = f"random{count}({'k' if count == 4 else 'k.' + 'xyz'[:count]})"
    found = sampled("import std.hashes", ", ".join([noise, *["0"] * (4 - count)]), k=cells)
    lanes = found[:, :count]
    assert lanes.mean(axis=0) == pytest.approx(0.5, abs=0.02)
    assert lanes.var(axis=0) == pytest.approx(1 / 12, abs=0.004)
    together = np.corrcoef(lanes.T) - np.eye(count)
    assert np.abs(together).max() < 0.06
