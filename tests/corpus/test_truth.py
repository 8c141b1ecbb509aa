"""The exact results of the corpus, against the same operations written a second time."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from . import truth
from .kit import NAMES, Json, cases, each_name, number, shown

CLOSE = Fraction(1, 2**49)
"""The largest error of an exact result relative to it, beside that of a float64."""
FLOAT32_END = Fraction(2**129 - 2**104, 2)
"""The middle between the largest float32 and the one that would follow it."""


@each_name
def test_exact_results_are_true(name: str) -> None:
    wrong = []
    for overload, case in cases(name):
        kind = overload["result"]["kind"]
        for lane, true in zip(case["result"], _true(name, overload, case), strict=True):
            if not (_is_close(lane["exact"], true, kind) and _is_nearest(lane, true, kind)):
                wrong.append(f"{shown(overload, case)}: {lane['exact']}, {lane['nearest']}")
    assert not wrong, "\n".join(wrong[:20])


def test_every_operation_has_a_second_definition() -> None:
    known = truth.LANEWISE.keys() | truth.WHOLE.keys() | truth.MATRICES.keys()
    assert known == set(NAMES)


def _true(name: str, overload: Json, case: Json) -> list[truth.Lane]:
    """The lanes of the true result."""
    types = overload["operands"]
    operands = [
        [_lane(bits, type_["kind"]) for bits in lanes]
        for type_, lanes in zip(types, case["operands"], strict=True)
    ]
    if any(type_["columns"] for type_ in [*types, overload["result"]]):
        columns = [_columns(t, lanes) for t, lanes in zip(types, operands, strict=True)]
        return [lane for column in truth.MATRICES[name](*columns) for lane in column]
    if name in truth.WHOLE:
        return truth.WHOLE[name](*operands)
    function = truth.LANEWISE[name]
    if name == "extract_bits" and types[0]["kind"] == "int":
        function = truth.extract_signed
    width = overload["result"]["width"]
    spread = [lanes if len(lanes) == width else lanes * width for lanes in operands]
    return [function(*lanes) for lanes in zip(*spread, strict=True)]


def _lane(bits: str, kind: str) -> truth.Lane:
    found = number(bits, kind)
    return Fraction(found) if kind == "float" else int(found)


def _columns(type_: Json, lanes: list[truth.Lane]) -> list[list[truth.Lane]]:
    width = type_["width"]
    return [lanes[start : start + width] for start in range(0, len(lanes), width)]


def _is_close(text: str, true: truth.Lane, kind: str) -> bool:
    if kind != "float":
        return (int(text) - int(true)) % 2**32 == 0
    found = float.fromhex(text)
    if math.isinf(found):
        return bool(true == found or abs(true) > 2**1023)
    if math.isinf(true):
        return False
    return bool(abs(Fraction(found) - true) <= abs(true) * CLOSE + Fraction(1, 2**1074))


def _is_nearest(lane: Json, true: truth.Lane, kind: str) -> bool:
    """True if the nearest float32 is no farther away than those beside it."""
    low, high = lane["nearest"]
    if kind != "float":
        return bool(low == high == f"{int(true) & 0xFFFFFFFF:08x}")
    return any(_is_nearest_float(number(bits, kind), true) for bits in (low, high))


def _is_nearest_float(found: float, true: truth.Lane) -> bool:
    if math.isinf(found):
        return bool((true > 0) == (found > 0) and abs(true) >= FLOAT32_END)
    with np.errstate(over="ignore"):
        ends = (-np.inf, np.inf)
        beside = [float(np.nextafter(np.float32(found), np.float32(end))) for end in ends]
    away = abs(Fraction(found) - true)
    return all(
        abs(true) <= FLOAT32_END if math.isinf(other) else away <= abs(Fraction(other) - true)
        for other in beside
    )
