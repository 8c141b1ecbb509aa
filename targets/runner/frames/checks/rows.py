"""What all checks of plans share: their error, and how they walk over the rows of a plan.

A plan has every name and every number several times over, and the checks compare these. So a plan
in which one place is wrong contradicts itself.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NoReturn

from .....compiler.diagnostics.display import harmless

Row = Mapping[str, Any]

Reading = tuple[str, int | None]
"""A result that a step reads, and the number of its texture; ``None`` of a buffer."""

WRITES = frozenset(("target", "depth", "image", "copied_to"))
"""Uses of a texture behind which even the same use has to wait."""


MOST_TOLD = 300
"""How many letters a line of an error has: what a plan calls things may be as long as it likes."""


class PlanError(ValueError):
    """A plan cannot be executed; the text tells people why, in one line or several."""

    def __init__(self, *lines: str) -> None:
        super().__init__("\n".join(map(_line, lines)))


def _line(text: str) -> str:
    """A line of an error, without what would make two of it, or a very long one."""
    shown = harmless(text if len(text) <= MOST_TOLD else text[: MOST_TOLD // 2])
    return shown if len(text) <= MOST_TOLD else f"{shown} … {harmless(text[-MOST_TOLD // 2 :])}"


def fail(plan: Row, where: str, text: str) -> NoReturn:
    """Raise ``PlanError``; ``where`` names the row that is wrong."""
    raise PlanError(f"{plan['frame']}, {where}: {text}")


END = "the end"
"""What messages call the place behind the last step."""


def places_of_waiting(plan: Row) -> Iterator[tuple[str, Row]]:
    """Each place of a plan that has barriers, with what messages call it."""
    for step in plan["steps"]:
        yield step_name(step), step
    yield END, plan["end"]


def step_name(step: Row) -> str:
    """What messages call a step."""
    return str(step.get("name", "a copy"))


def is_rare(step: Row) -> bool:
    """Whether a step is done in the first frame only."""
    return bool(step.get("only_first", False))


def attachments(step: Row) -> Iterator[Row]:
    """What a step draws to, its depths last."""
    yield from step.get("targets", ())
    if step.get("depth") is not None:
        yield step["depth"]


def drawn_to(step: Row) -> Iterator[int]:
    """The textures that a step draws to, and those to which it resolves samples then."""
    for row in attachments(step):
        yield row["texture"]
        if row["resolve"] is not None:
            yield row["resolve"]["texture"]


def has_samples(plan: Row, attachment: Row) -> bool:
    """Whether a step draws with several samples there."""
    return bool(plan["textures"][attachment["texture"]]["samples"] > 1)


def uses(step: Row) -> Iterator[Row]:
    """The shaders of a step, with what the frame sets of them."""
    if step["kind"] == "run":
        yield step
    for drawn in step.get("draws", ()):
        yield from drawn["uses"]


def inputs(step: Row) -> Iterator[Row]:
    """What the frame sets in a step."""
    for use in uses(step):
        yield from use["inputs"]


def read_now(step: Row, *, is_first: bool) -> Iterator[Reading]:
    """The results of this frame that a step reads: a first frame has no last one."""
    for row in inputs(step):
        source = row
        if "previous" in row:
            if not is_first or row["initially"] is None:
                continue
            source = row["initially"]
        if "result" in source:
            yield source["result"], source["texture"]


def read_before(step: Row) -> Iterator[Reading]:
    """The results of the last frame that a step reads."""
    for row in inputs(step):
        if "previous" in row:
            yield row["previous"], row["texture"]


def written(step: Row) -> Iterator[Reading]:
    """The results that a step leaves, each with the texture that it lies in then. A copy leaves
    nothing of its own: the next step draws over it."""
    for row in attachments(step):
        yield row["result"], row["texture"]
        if row["resolve"] is not None:
            yield row["result"], row["resolve"]["texture"]
    for row in step.get("images", ()):
        yield row["result"], row["texture"]
    for row in step.get("buffers", ()):
        yield row["result"], None


def drawn_over(step: Row) -> Iterator[str]:
    """The results that are there before, where a step draws."""
    for row in attachments(step):
        if row["over"] is not None:
            yield row["over"]


def places(texture: Row) -> Iterator[tuple[int, int]]:
    """Every layer and level of a texture."""
    for layer in range(texture["layers"]):
        for level in range(texture["levels"]):
            yield layer, level
