"""Sums up what an experiment has found, for people and for the page of the documentation."""

from __future__ import annotations

import json
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from ..bench.table import Row, Section
from .experiment import BOUNDS, NAMES, Correct, Outcome, Planted
from .rules import MEASURES
from .verdicts import Measured

KEPT = Path(__file__).parent / "found.json"
"""The numbers of which ``docs/tolerances.md`` is made."""


@dataclass(slots=True)
class Numbers:
    """All outcomes together."""

    correct: list[Correct] = field(default_factory=list)
    planted: list[Planted] = field(default_factory=list)
    refused: int = 0
    unseen: int = 0
    larger: list[Measured] = field(default_factory=list)
    failed: list[str] = field(default_factory=list)

    def add(self, outcome: Outcome) -> None:
        """Count one more subject."""
        self.correct += outcome.correct
        self.planted += outcome.planted
        self.refused += outcome.refused
        self.unseen += outcome.unseen
        self.larger += outcome.larger
        self.failed += outcome.failed

    @staticmethod
    def told(outcome: Outcome) -> str:
        """A line about one subject."""
        return (
            f"{len(outcome.correct)} correct, {len(outcome.planted)} with errors, {outcome.unseen} "
            f"errors change nothing, {outcome.refused} are refused by tools"
        )


@dataclass(frozen=True, slots=True)
class Sum:
    """What a rule has said, in all."""

    rule: str
    found: int
    """The number of planted errors that it finds."""
    worst_missed: float
    """The largest change of a code by an error that it misses."""
    alarms: int
    """The number of tests without an error that it refuses, compared with the reference."""
    alarms_beside_kept: int | None
    """Likewise, compared with the pictures of one driver; ``None`` of bounds."""
    alarms_larger: int | None = None
    """Likewise, of the tests with larger pictures."""


@dataclass(frozen=True, slots=True)
class Best:
    """The best threshold of a measure: the least that refuses no correct picture."""

    measure: str
    least: float
    found: int
    """The number of planted errors that are beyond it."""


def sums(numbers: Numbers) -> Iterator[Sum]:
    """A sum for each rule, those of bounds first."""
    for name in NAMES:
        missed = [each.apart for each in numbers.planted if name not in each.found]
        found, worst = len(numbers.planted) - len(missed), max(missed, default=0.0)
        if name in BOUNDS:
            yield Sum(name, found, worst, sum(bool(c.beyond[name]) for c in numbers.correct), None)
            continue
        beside = _alarms(_beside_kept(numbers), name)
        alarms = sum(bool(each.beside_reference.refused[name]) for each in numbers.correct)
        yield Sum(name, found, worst, alarms, beside, _alarms(numbers.larger, name))


def _alarms(tests: Sequence[Measured], rule: str) -> int | None:
    """The number of correct tests that a rule refuses; ``None`` if there are no tests."""
    return sum(bool(each.refused[rule]) for each in tests) if tests else None


def best(numbers: Numbers) -> Iterator[Best]:
    """For each measure the threshold with which no picture of another driver is refused."""
    beside = _beside_kept(numbers)
    for name in MEASURES if beside else ():
        least = max(each.worst[name] for each in beside)
        yield Best(name, least, sum(each.worst[name] > least for each in numbers.planted))


def _beside_kept(numbers: Numbers) -> list[Measured]:
    return [each.beside_kept for each in numbers.correct if each.beside_kept is not None]


def by_kind(planted: Sequence[Planted]) -> Mapping[str, Mapping[str, int]]:
    """For each kind of error the number of errors, and how many each rule finds."""
    found: dict[str, Counter[str]] = defaultdict(Counter)
    for each in planted:
        found[each.kind].update(["planted", *each.found])
    return found


def document(numbers: Numbers, routes: int) -> dict[str, Any]:
    """Everything that the page says, and each error that bounds miss."""
    missed = [each for each in numbers.planted if BOUNDS[0] not in each.found]
    return {
        "routes": routes,
        "subjects": len({each.subject for each in numbers.correct}),
        "tests": len(numbers.correct),
        "pictures": sum(each.pictures for each in numbers.correct),
        "tests_beside_kept": len(_beside_kept(numbers)),
        "tests_larger": len(numbers.larger),
        "planted": len(numbers.planted),
        "refused_by_tools": numbers.refused,
        "unseen": numbers.unseen,
        "not_drawn": numbers.failed,
        "prove_little": sorted({c.subject for c in numbers.correct if c.status != "agrees"}),
        "rules": [asdict(each) for each in sums(numbers)],
        "best": [asdict(each) for each in best(numbers)],
        "kinds": {kind: dict(counts) for kind, counts in sorted(by_kind(numbers.planted).items())},
        "alarms_of_bounds": [
            f"{each.subject}, {each.route}" for each in numbers.correct if any(each.beyond.values())
        ],
        "missed_by_bounds": [
            {"subject": each.subject, "route": each.route, "kind": each.kind, "what": each.what,
             "apart": each.apart}
            for each in sorted(missed, key=lambda each: -each.apart)
        ],
    }  # fmt: skip


def kept() -> dict[str, Any]:
    """The document that was kept last."""
    found: dict[str, Any] = json.loads(KEPT.read_text(encoding="utf-8"))
    return found


def printed(numbers: Numbers) -> str:
    """The table for people."""
    title = (
        f"{len(numbers.planted)} errors that change a picture, in {len(numbers.correct)} tests "
        f"({numbers.unseen} changed none, tools refused {numbers.refused})"
    )
    rows: list[Row] = [
        {
            "rule": each.rule, "found": each.found, "largest missed, of 255": each.worst_missed,
            "false alarms": each.alarms, "beside one driver": each.alarms_beside_kept,
            "in larger pictures": each.alarms_larger,
        }
        for each in sums(numbers)
    ]  # fmt: skip
    thresholds: list[Row] = [
        {"measure": each.measure, "no false alarm from": each.least, "found": each.found}
        for each in best(numbers)
    ]
    tables = Section("tolerances", title, rows), Section("best", "Best thresholds", thresholds)
    return "\n".join(table.text() for table in tables)
