"""The corpus on real devices: no result of any case is outside of what its route promises."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import pytest

from burnish.targets.conformance.corpus.records import LaneRow
from burnish.targets.conformance.corpus.results import result_of
from burnish.targets.runner.routes import ROUTES

from ..corpus.kit import SEED, number
from .corpus_programs import Called, Floats, all_called, batches, returned, textures
from .kit import Studio

DEFECTS: Mapping[str, set[str]] = {"lavapipe:glsl": set(), "swiftshader:glsl": {"degrees"}}
"""The operations with results outside, by route; docs/drivers.md lists these bugs."""


@cache
def everything() -> list[Called]:
    """All overloads with their cases; drawing these takes a second, which only tests here need."""
    return all_called(SEED)


@cache
def results(place: int) -> list[tuple[LaneRow, ...]]:
    """The results of all cases of the overload at this place, which every route has to have."""
    called = everything()[place]
    return [result_of(called.overload, case) for case in called.cases]


@pytest.mark.parametrize("name", DEFECTS)
def test_results_are_within_their_intervals(studio: Studio, name: str) -> None:
    route = ROUTES[name]
    promise = "+".join(route.platforms)
    operands = textures(everything())
    wrong: list[str] = []
    seen = set()
    compared = 0
    for batch in batches(everything()):
        for called, lanes in returned(batch, operands, route, studio):
            found, count = _outside(called, lanes, promise)
            compared += count
            if found:
                seen.add(called.overload.row.name)
                wrong += found
    assert seen == DEFECTS[name], "\n".join([f"{len(wrong)} of {compared}", *wrong[:40]])
    assert compared > 25_000


def _outside(called: Called, lanes: list[Floats], promise: str) -> tuple[list[str], int]:
    """The lanes that are outside of their intervals, in words; and how many were compared."""
    kind = called.overload.result.kind
    wrong = []
    compared = 0
    for column, case in enumerate(called.cases):
        for lane, row in enumerate(results(called.row)[column]):
            ends = row.within[promise]
            if ends is None:
                continue
            compared += 1
            got = float(lanes[lane][column])
            if kind == "int" and got >= 2**31:
                got -= 2**32
            low, high = (number(end, kind) for end in ends)
            if not low <= got <= high:
                wrong.append(
                    f"{called.overload} of {case.operands}, lane {lane}: {got!r}, not in "
                    f"{low!r} .. {high!r}; exactly {row.exact}"
                )
    return wrong, compared
