"""Numbers read back as what they were."""

from __future__ import annotations

import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from burnish.targets.description.spellings import Literals
from burnish.targets.emit.literals import decimal, literal


def single(value: float) -> float:
    return float(struct.unpack("<f", struct.pack("<f", value))[0])


@given(st.floats(width=32, allow_nan=False, allow_infinity=False, allow_subnormal=False))
def test_round_trip(value: float) -> None:
    text = decimal(value)
    assert single(float(text)) == value
    assert math.copysign(1.0, float(text)) == math.copysign(1.0, value)
    assert any(mark in text for mark in ".e")


@given(st.floats(min_value=-1e30, max_value=1e30))
def test_other_numbers_are_rounded(value: float) -> None:
    expected = single(value) if abs(single(value)) >= 2.0**-126 else 0
    assert single(float(decimal(value))) == expected


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.1, "0.1"), (1.0, "1.0"), (-0.0, "-0.0"), (1e-7, "1e-7"), (1 / 3, "0.33333334"),
        (16777216.0, "16777216.0"), (3.4028234663852886e38, "3.4028234e38"),
        (1e10, "10000000000.0"), (2.0**-126, "1.1754944e-38"),
        (1e-39, "0.0"), (-1e-39, "-0.0"), (2.0**-150, "0.0"),
    ],
)  # fmt: skip
def test_shortest(value: float, text: str) -> None:
    assert decimal(value) == text


def test_other_kinds() -> None:
    style = Literals()
    assert literal(7, "uint", style) == "7u"
    assert literal(-7, "int", style) == "-7"
    assert literal(-(2**31), "int", style) == "-2147483647 - 1"
    assert [literal(value, "bool", style) for value in (True, False)] == ["true", "false"]
