"""What all rules say of the pictures of a test, beside those that are kept as right."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from burnish.targets.conformance.cases import UNCOVERED

from .rules import MEASURES, RULES, Shown

CLEAR = UNCOVERED[0]
"""The number in all lanes where nothing is drawn."""
KEPT_ROUTE = "lavapipe:glsl"
"""The route whose pictures stand for those that a test suite has kept from one machine."""

Pictures = Mapping[str, Sequence[Shown]]
"""The targets of each case."""


@dataclass(frozen=True, slots=True)
class Measured:
    """What all measures say of the pictures of a test, beside those that are kept as right."""

    refused: Mapping[str, int]
    """The number of pictures that each rule refuses."""
    worst: Mapping[str, float]
    """The largest value of each of ``MEASURES``."""


def measured(drawn: Pictures, kept: Pictures) -> Measured:
    """What rules and measures say; a measure that several rules share is taken once."""
    pairs = [pair for case, shown in drawn.items() for pair in zip(shown, kept[case], strict=True)]
    wanted = {*MEASURES.values(), *(rule.measure for rule in RULES)}
    values = {measure: [measure(*pair) for pair in pairs] for measure in wanted}
    return Measured(
        {rule.name: sum(not value <= rule.most for value in values[rule.measure])
         for rule in RULES},
        {name: max(values[measure]) for name, measure in MEASURES.items()},
    )  # fmt: skip
