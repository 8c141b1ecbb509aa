"""The documents of the corpus: whole, readable by their schemas, the same again, and of use."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest
from jsonschema import Draft202012Validator

from burnish.compiler.documents.reading import ShapeError, read
from burnish.compiler.documents.schema import json_schema
from burnish.compiler.reference import functions
from burnish.stdlib.builtins import BUILTINS, Builtin
from burnish.stdlib.builtins.accuracy import PLATFORMS, Exact, Rounded
from burnish.targets.conformance.corpus.bits import least_float32, most_float32
from burnish.targets.conformance.corpus.making import INDEX, corpus_of, make
from burnish.targets.conformance.corpus.operands import OPERATIONS
from burnish.targets.conformance.corpus.records import Corpus, CorpusIndex
from burnish.targets.conformance.corpus.results import PROMISES
from burnish.targets.runner.routes import EVERY_ROUTE

from .kit import NAMES, SEED, Json, cases, corpus, each_name, number, shown


def texts(*names: str, seed: int = SEED) -> dict[str, str]:
    return make(names, seed, "test", lambda _share: None)


def test_every_builtin_of_operands_alone_is_in_it() -> None:
    needs_more = {
        name
        for name, row in BUILTINS.items()
        if row.method is not None or row.uniform_control_flow or row.is_promise
    }
    assert set(NAMES) == BUILTINS.keys() - needs_more
    assert {"add", "not", "pow", "inverse", "to_int", "pack_half2x16", "shift_left"} <= set(NAMES)


def test_every_platform_and_every_route_has_its_promise() -> None:
    assert PLATFORMS.keys() <= PROMISES.keys()
    assert {route.platforms for route in EVERY_ROUTE.values()} <= set(PROMISES.values())


@each_name
def test_the_nearest_result_keeps_every_promise(name: str) -> None:
    wrong = []
    for overload, case in cases(name):
        kind = overload["result"]["kind"]
        for lane in case["result"]:
            assert lane["within"].keys() == PROMISES.keys()
            nearest = [number(bits, kind) for bits in lane["nearest"]]
            for promise, ends in lane["within"].items():
                low, high = [number(bits, kind) for bits in ends] if ends else (-math.inf, math.inf)
                if not all(low <= each <= high for each in nearest):
                    wrong.append(f"{shown(overload, case)}: {nearest}, {promise}: {low} .. {high}")
    assert not wrong, "\n".join(wrong[:20])


@each_name
def test_intervals_say_something(name: str) -> None:
    """Where operations are exact or correctly rounded, they say all that there is to say."""
    found = [(*each, _are_normal(*each)) for each in cases(name)]
    for promise, platforms in PROMISES.items():
        bounds = {type(BUILTINS[name].accuracy.on(platform).bound) for platform in platforms}
        is_one_step = bounds <= {Exact, Rounded}
        widths = []
        for overload, case, are_normal in found:
            result = overload["result"]
            for lane in case["result"]:
                width, step = _width(lane, promise, result["kind"])
                widths.append(width)
                if is_one_step and are_normal and result["width"] == 1:
                    # Two steps where float64 has rounded a sum to a number that float32 has.
                    assert width <= 2 * step or width == math.inf, (shown(overload, case), lane)
        known = [width for width in widths if width < math.inf]
        assert len(known) > 0.7 * len(widths), promise
        assert np.median(known) < 2**-8, promise


def _width(lane: Json, promise: str, kind: str) -> tuple[float, float]:
    """The width of an interval, and the step of float32 there.

    Both are relative to the result, or to 1 if that is less.
    """
    if (ends := lane["within"][promise]) is None:
        return math.inf, 0.0
    low, high = (number(bits, kind) for bits in ends)
    size = max(abs(low), abs(high))
    whole = max(size, 1.0)
    step = math.ulp(size) * 2.0**29 if kind == "float" else 0.0
    return (high - low) / whole, max(step, 2.0**-149) / whole


def _are_normal(overload: Json, case: Json) -> bool:
    """True if no operand or result is a float that a device may flush to zero."""
    lanes = [
        number(bits, type_["kind"])
        for type_, operand in zip(overload["operands"], case["operands"], strict=True)
        for bits in operand
    ]
    lanes += [float.fromhex(lane["exact"]) for lane in case["result"]]
    return all(lane == 0 or abs(lane) > 2.0**-126 for lane in lanes)


def test_files_follow_their_schemas() -> None:
    kinds = {INDEX: CorpusIndex, "div.json": Corpus, "inverse.json": Corpus, "exp.json": Corpus}
    found = texts("div", "inverse", "exp")
    assert found.keys() == kinds.keys()
    for name, text in found.items():
        document = json.loads(text)
        schema = json.loads(json.dumps(json_schema(kinds[name])))
        assert [e.message for e in Draft202012Validator(schema).iter_errors(document)] == []
        assert read(kinds[name], document)


def test_a_lane_that_is_no_bits_is_refused() -> None:
    document: Any = json.loads(texts("sqrt")["sqrt.json"])
    document["overloads"][0]["cases"][0]["operands"][0][0] = "0x3f800000"
    with pytest.raises(ShapeError):
        read(Corpus, document)
    assert list(Draft202012Validator(json_schema(Corpus)).iter_errors(document))


def test_a_seed_makes_the_same_files_and_another_seed_others() -> None:
    assert texts("pow") == texts("pow")
    first, other = (json.loads(texts("pow", seed=n)["pow.json"]) for n in (1, 2))
    both = [
        {str(case["operands"]) for case in document["overloads"][0]["cases"]}
        for document in (first, other)
    ]
    assert both[0] != both[1]
    assert len(both[0] & both[1]) >= len(BUILTINS["pow"].samples), "the samples stay"


def test_an_operation_is_the_same_beside_others() -> None:
    assert texts("sin")["sin.json"] == texts("sin", "cos")["sin.json"]


@each_name
def test_cases_are_many_different_and_mostly_in_the_domain(name: str) -> None:
    for overload in corpus(name)["overloads"]:
        operands = [json.dumps(case["operands"]) for case in overload["cases"]]
        assert len(set(operands)) == len(operands)
        kinds = {type_["kind"] for type_ in overload["operands"]}
        assert len(operands) >= (2 if kinds == {"bool"} else 16), overload["operands"]
        guarded = sum(case["guarded"] for case in overload["cases"])
        is_always = guarded == len(operands)
        samples = 2 * len(BUILTINS[name].samples)
        assert is_always or guarded <= len(operands) / 4 + samples * len(overload["operands"]) + 1
        if is_always:
            assert BUILTINS[name].expansion or name in ("shift_left", "shift_right", "mod")


def test_operands_stumble() -> None:
    """Where something changes there are operands on both sides."""
    operands = {bits for _, case in cases("round") for lanes in case["operands"] for bits in lanes}
    assert {"3f000000", "3f000001", "3effffff", "40200000", "80000000", "00000001"} <= operands
    angles = {bits for _, case in cases("sin") for lanes in case["operands"] for bits in lanes}
    assert {"40490fdb", "40490fdc", "c0490fdb"} <= angles, "pi, up to which accuracy is promised"


def test_what_is_guarded() -> None:
    found = {case["operands"][0][0]: case["guarded"] for _, case in cases("sqrt")
             if len(case["operands"][0]) == 1}  # fmt: skip
    assert found["bf800000"] and not found["40000000"] and not found["80000000"]
    assert all(case["guarded"] for _, case in cases("pack_unorm4x8"))
    assert not any(case["guarded"] for _, case in cases("sin"))


def test_numbers_too_large_have_no_interval() -> None:
    overflowing = [
        lane
        for _, case in cases("exp")
        for lane in case["result"]
        if lane["nearest"] == ["7f800000"] * 2
    ]
    assert overflowing
    assert all(set(lane["within"].values()) == {None} for lane in overflowing)


def test_ends_are_rounded_inwards() -> None:
    third = 1.0 / 3.0
    assert most_float32(third) < third < least_float32(third)
    assert least_float32(-third) == -most_float32(third)
    assert least_float32(0.5) == most_float32(0.5) == 0.5
    assert most_float32(2.0**-150) == 0.0


def test_a_file_says_what_the_row_says() -> None:
    found = corpus_of(OPERATIONS["smoothstep"], SEED)
    row = BUILTINS["smoothstep"]
    assert (found.name, found.doc, found.domain, found.outside) == (
        row.name, row.doc, row.needs, row.outside,
    )  # fmt: skip
    assert [s.accuracy for s in found.specifications] == [
        str(row.accuracy.on(platform).bound) for platform in PLATFORMS
    ]


def test_a_new_builtin_needs_no_change_here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its row and its meaning are all that the corpus asks for, also of the domain."""
    monkeypatch.setitem(functions._FLOATS, "fourth_root", lambda xp, x: xp.power(abs(x), 1.0 / 4.0))
    row = Builtin(
        name="fourth_root",
        signatures=("T -> T",),
        doc="A root.",
        domain=lambda facts: facts[0].within(3.0, 5.0),
        needs="the operand lies within 3..5",
        samples=((4.0,),),
    )
    found = corpus_of(row, SEED)
    (scalars, vectors) = found.overloads
    assert (scalars.result.name, vectors.result.name) == ("float", "vec3")
    assert scalars.cases[0].operands == (("40800000",),)
    assert len(scalars.cases) > 48
    assert sum(not case.guarded for case in scalars.cases) > 20
    for case in scalars.cases:
        x = abs(number(case.operands[0][0], "float"))
        assert float.fromhex(case.result[0].exact) == pytest.approx(math.sqrt(math.sqrt(x)))
