"""Over random operands: finite in, finite out; and what a row claims of its results holds."""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from burnish.compiler.reference.functions import LaneKind, evaluate
from burnish.compiler.reference.namespace import Lanes
from burnish.stdlib.builtins import BUILTINS, Builtin
from burnish.stdlib.builtins.facts import SMALLEST_NORMAL, UNIT, Fact
from burnish.stdlib.builtins.row import nowhere
from burnish.support.frozen import changed

LARGEST = 3.4028234663852886e38
OVERFLOWING = {"exp", "exp2", "pow", "lit", "sinh", "cosh", "ldexp"}
EDGES = [0.0, -0.0, 1e-45, -1e-40, SMALLEST_NORMAL, 0.5, 1.0, -1.0, 2.0, 88.0, -128.0, LARGEST]
INT_EDGES = [0, 1, -1, 2, 7, 2**31 - 1, -(2**31)]
UINT_EDGES = [0, 1, 2, 7, 2**31, 2**32 - 1]
EXAMPLES = 15
"""The number of examples for each row; the suite has to stay quick."""

OF_NUMBERS = [row for row in BUILTINS.values() if row.method is None]
"""All but reads of textures, which have tests of their own (``tests/reference/test_kinds.py``)."""

rows = pytest.mark.parametrize(
    "row",
    [row for row in OF_NUMBERS if not row.uniform_control_flow],
    ids=lambda row: row.name,
)


def to_float32(value: float) -> float:
    """The nearest float32."""
    rounded: float = struct.unpack("f", struct.pack("f", value))[0]
    return rounded


@dataclass(frozen=True)
class Shape:
    """One operand's type: lanes of a kind, in columns where it is a matrix."""

    kind: LaneKind
    width: int
    columns: int = 0

    @property
    def lanes(self) -> int:
        """All lanes there are."""
        return self.width * max(self.columns, 1)


@st.composite
def shapes(draw: st.DrawFn, row: Builtin) -> list[Shape]:
    """Operand types that fit one of the row's signatures."""
    signature = draw(st.sampled_from(row.signatures))
    width = draw(st.integers(2 if "V" in signature or "M" in signature else 1, 4))
    columns, further = draw(st.integers(2, 4)), draw(st.integers(2, 4))
    numbers: LaneKind = draw(st.sampled_from(["float", "int", "uint"]))
    integers: LaneKind = draw(st.sampled_from(["int", "uint"]))
    plain: LaneKind = draw(st.sampled_from(["float", "int", "uint", "bool"]))
    words = {
        "T": Shape("float", width),
        "V": Shape("float", width),
        "O": Shape("float", columns),
        "S": Shape("float", 1),
        "M": Shape("float", width, columns),
        "Z": Shape("float", columns, further),
        "N": Shape(numbers, width),
        "L": Shape(numbers, 1),
        "I": Shape(integers, width),
        "B": Shape("bool", width),
        "P": Shape(plain, width),
        "Q": Shape("bool", width),
        "U": Shape("uint", width),
        "J": Shape("int", width),
    }
    kinds: tuple[tuple[str, str, LaneKind], ...] = (
        ("float", "vec", "float"),
        ("int", "ivec", "int"),
        ("uint", "uvec", "uint"),
        ("bool", "bvec", "bool"),
    )
    for scalar, vector, kind in kinds:
        words |= {scalar: Shape(kind, 1)} | {f"{vector}{n}": Shape(kind, n) for n in (2, 3, 4)}
    words |= {f"mat{n}": Shape("float", n, n) for n in (2, 3, 4)}
    return [words[word] for word in signature.split(" -> ", maxsplit=1)[0].split(", ")]


def shaped(lanes: list[Any], shape: Shape) -> Lanes:
    """A value of a type from its lanes."""
    width = shape.width
    if not shape.columns:
        return tuple(lanes)
    return tuple(tuple(lanes[start : start + width]) for start in range(0, len(lanes), width))


LANES: dict[LaneKind, st.SearchStrategy[Any]] = {
    "float": st.one_of(
        st.sampled_from([to_float32(edge) for edge in EDGES]),
        st.floats(-4.0, 4.0, width=32),
        st.floats(allow_nan=False, allow_infinity=False, width=32),
    ),
    "int": st.sampled_from(INT_EDGES) | st.integers(-(2**31), 2**31 - 1),
    "uint": st.sampled_from(UINT_EDGES) | st.integers(0, 2**32 - 1),
    "bool": st.booleans(),
}


@cache
def values(shape: Shape) -> st.SearchStrategy[Lanes]:
    """Any value of a type."""
    lanes = st.lists(LANES[shape.kind], min_size=shape.lanes, max_size=shape.lanes)
    return lanes.map(lambda drawn: shaped(drawn, shape))


@cache
def parts(count: int) -> st.SearchStrategy[list[int]]:
    """Places in an interval, in hundredths of its width; its ends are likelier than the rest."""
    place = st.sampled_from([0, 100]) | st.integers(0, 100)
    return st.lists(place, min_size=count, max_size=count)


def flat(value: Any) -> list[Any]:
    """All lanes of a value."""
    return [lane for item in value for lane in flat(item)] if isinstance(value, tuple) else [value]


def mapped(value: Any, function: Callable[[Any], Any]) -> Any:
    """The value with a function applied to every lane."""
    if isinstance(value, tuple):
        return tuple(mapped(item, function) for item in value)
    return function(value)


def on_arrays(
    row: Builtin, operands: Sequence[Lanes], kind: LaneKind, dtype: type | None = None
) -> list[float]:
    """The row's value by NumPy, as Python numbers."""
    arrays = [mapped(operand, lambda lane: np.array([lane], dtype)) for operand in operands]
    with np.errstate(all="ignore"):
        result = evaluate(row.name, arrays, np, kind)
    return [np.broadcast_to(lane, (1,))[0].item() for lane in flat(result)]


@rows
@settings(max_examples=EXAMPLES)
@given(data=st.data())
def test_finite_operands_have_a_finite_result(row: Builtin, data: st.DataObject) -> None:
    types = data.draw(shapes(row))
    operands = [data.draw(values(shape)) for shape in types]
    result = flat(evaluate(row.name, operands, kind=types[0].kind))
    assert not any(map(math.isnan, result))
    assert row.name in OVERFLOWING or all(map(math.isfinite, result))
    assert on_arrays(row, operands, types[0].kind) == pytest.approx(result, rel=1e-9)


@st.composite
def known(draw: st.DrawFn, shape: Shape) -> tuple[Fact, Lanes]:
    """A fact and a value of which it holds."""
    if shape.kind == "float" and shape.width > 1 and not shape.columns and draw(st.booleans()):
        return UNIT, draw(directions(shape.width))
    fact, lanes = draw(known_lanes(shape.kind, shape.lanes))
    if shape.columns:
        return fact.as_kind("matrix"), shaped(lanes, shape)
    if shape.kind == "float" and shape.width > 1 and draw(st.booleans()):
        fact = changed(fact, length=math.hypot(*lanes) * draw(st.sampled_from([0.5, 1.0])))
    return fact, shaped(lanes, shape)


@st.composite
def directions(draw: st.DrawFn, width: int) -> Lanes:
    """A vector of length one, rounded to float32."""
    lanes = draw(st.tuples(*[st.floats(-1.0, 1.0)] * width))
    size = math.hypot(*lanes)
    assume(size > 1e-3)
    return tuple(to_float32(lane / size) for lane in lanes)


@st.composite
def known_lanes(draw: st.DrawFn, kind: LaneKind, count: int) -> tuple[Fact, list[Any]]:
    """An interval and lanes within it."""
    lo, hi = sorted((draw(LANES[kind]), draw(LANES[kind])))
    lanes = [between(lo, hi, part, kind) for part in draw(parts(count))]
    fact = Fact(lo, hi).as_kind(kind)
    if kind == "float":
        open_ended = [fact, changed(fact, lo=-math.inf), changed(fact, hi=math.inf)]
        fact = draw(st.sampled_from(open_ended))
    nonzero = all(abs(lane) >= SMALLEST_NORMAL for lane in lanes) and draw(st.booleans())
    return changed(fact, nonzero=nonzero), lanes


def between(lo: Any, hi: Any, part: int, kind: LaneKind) -> Any:
    """A lane some hundredths of the way from one to another."""
    if kind == "bool":
        return hi if part >= 50 else lo
    if kind != "float":
        return lo + (hi - lo) * part // 100
    return min(max(to_float32(lo + (hi - lo) * (part / 100)), lo), hi)


def assert_holds(fact: Fact, lanes: list[float]) -> None:
    """All that a fact says is true of the lanes."""
    assert fact.lo <= fact.hi
    for lane in lanes:
        assert fact.lo <= lane <= fact.hi
        assert not fact.nonzero or abs(lane) >= SMALLEST_NORMAL
    assert not fact.unit or math.hypot(*lanes) <= UNIT.hi
    assert not fact.length or math.hypot(*lanes) >= fact.length * (1 - 1e-6)


def test_bits_that_are_shifted_out_bound_nothing() -> None:
    """Two to the power of 31, shifted by one, is 0."""
    facts = Fact(1.0, 2.0**31, kind="uint"), Fact(0.0, 1.0, kind="int")
    assert BUILTINS["shift_left"].range(facts, False).lo == 0


@rows
@settings(max_examples=EXAMPLES)
@given(data=st.data())
def test_results_are_within_the_range(row: Builtin, data: st.DataObject) -> None:
    types = data.draw(shapes(row))
    pairs = [data.draw(known(shape)) for shape in types]
    same = len(pairs) > 1 and len(set(types)) == 1 and data.draw(st.booleans())
    if same:
        pairs = [pairs[0]] * len(pairs)
    facts, operands = tuple(fact for fact, _ in pairs), [value for _, value in pairs]
    fact = row.range(facts, same)
    result = flat(evaluate(row.name, operands, kind=types[0].kind))
    assume(not row.is_promise or math.hypot(*result) >= fact.length)
    assert_holds(fact, result)
    if all(shape.kind == "float" for shape in types):
        rounded = on_arrays(row, operands, "float", np.float32)
        if all(math.isfinite(lane) for lane in rounded):
            assert_holds(fact, rounded)


WITHOUT_A_NAIVE_ONE = {
    "normalize",
    "dot",
    "shift_left",
    "shift_right",
    "bits_of",
    "float_of_bits",
    "first_leading_bit",
}
"""Builtins of whole vectors, or of integers and bits, which are tried by value."""

NAIVE: dict[str, Callable[..., float]] = {
    "div": lambda x, y: x / y,
    "mod": lambda x, y: x % y,
    "clamp": lambda x, low, high: sorted((low, x, high))[1],
    "smoothstep": lambda low, high, x: naive_smoothstep(min(max((x - low) / (high - low), 0), 1)),
    "sqrt": math.sqrt,
    "inversesqrt": lambda x: 1 / math.sqrt(x),
    "pow": math.pow,
    "log": math.log,
    "log2": math.log2,
    "asin": math.asin,
    "tanh": math.tanh,
    "acos": math.acos,
    "atan2": math.atan2,
    "to_int": int,
    "to_uint": int,
}


def naive_smoothstep(t: float) -> float:
    """The textbook's polynomial."""
    return t * t * (3 - 2 * t)


def test_every_limited_domain_is_checked_against_the_naive_function() -> None:
    limited = {row.name for row in OF_NUMBERS if row.expansion and row.domain is not nowhere}
    assert limited - WITHOUT_A_NAIVE_ONE == NAIVE.keys()


def test_edges_that_count_as_farther_apart_need_their_guard() -> None:
    """A random try has found that such edges were taken as they are."""
    edges = (Fact(0.0, 0.0), Fact(2.0**-65, 2.0**-65), Fact(0.0, 1.0))
    assert not BUILTINS["smoothstep"].domain(edges)


@pytest.mark.parametrize("name", NAIVE)
@settings(max_examples=4 * EXAMPLES)
@given(data=st.data())
def test_within_its_domain_the_naive_function_is_the_meaning(
    name: str, data: st.DataObject
) -> None:
    row = BUILTINS[name]
    count = row.signatures[0].count(",") + 1
    pairs = [data.draw(known(Shape("float", 1))) for _ in range(count)]
    if row.domain(tuple(fact for fact, _ in pairs)):
        lanes = [lane for _, (lane,) in pairs]
        (meaning,) = evaluate(name, [(lane,) for lane in lanes])
        results = [naive(name, lanes), naive(name, [flushed(lane) for lane in lanes])]
        assert any(meaning == pytest.approx(result, rel=1e-12) for result in results)


def naive(name: str, lanes: list[float]) -> float:
    """The textbook's result; infinite where it overflows."""
    try:
        return NAIVE[name](*lanes)
    except OverflowError:
        return math.inf


def flushed(lane: float) -> float:
    """The value of a lane on a device without subnormals."""
    return lane if abs(lane) >= SMALLEST_NORMAL else 0.0
