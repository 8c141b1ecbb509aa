"""A run that is interrupted, as by Ctrl-C, does not go on with the rows that are under way."""

from __future__ import annotations

from collections.abc import Iterator
from time import sleep
from typing import Any

import pytest

import burnish
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.gathering import Gathering
from burnish.targets.conformance.rows import CaseResult
from burnish.targets.conformance.trials import Trial
from burnish.targets.runner.routes import ROUTES, Route
from burnish.targets.runner.subject import Subject

from .kit import Studio

QUICK, SLOW = ROUTES["lavapipe:glsl"], ROUTES["lavapipe:hlsl-dxc"]
PROFILES = sorted({QUICK.profile, SLOW.profile})
CASES = 3000

COLOURED = "material M { color = vec3(uv, 0) }"
SUBJECTS = {
    "material": COLOURED,
    "captures": COLOURED + "pass P { capture place : vec2 = uv }",
    "kernel": "kernel K { result two : float[4] = 2 }",
}


@pytest.mark.parametrize("name", SUBJECTS)
def test_rows_under_way_end_early(
    name: str, studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    compared: list[CaseResult] = []
    judge = Trial.results

    def results(self: Any, route: Route, *rest: Any) -> Iterator[CaseResult]:
        """The results of one route; those of the other come slowly, and are many."""
        first, *others = judge(self, route, *rest)
        yield first
        if route is QUICK:
            yield from others
            return
        for _ in range(CASES):
            sleep(0.01)
            compared.append(first)
            yield first

    monkeypatch.setattr(Trial, "results", results)
    with pytest.raises(KeyboardInterrupt):
        conform(
            [(name, _subject(SUBJECTS[name]))], [QUICK, SLOW], studio.runner, studio.toolchain,
            gathering=Gathering(_interrupt),
        )  # fmt: skip
    assert len(compared) < CASES


def _subject(text: str) -> Subject:
    result = burnish.compile(text, PROFILES, pass_="P" if "pass" in text else None)
    (subject,) = result.materials
    return subject


def _interrupt(_done: int, _total: int) -> None:
    raise KeyboardInterrupt
