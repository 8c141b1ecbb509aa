"""Parts of all checks of plans: their error, and functions that walk over the rows of a plan.

A plan has every name and every number several times over, and the checks compare these. So a plan
in which one place is wrong contradicts itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NoReturn, Protocol

from .....compiler.diagnostics.display import harmless
from .....compiler.documents.plan import (
    AttachmentRow,
    FramePlan,
    FrameTextureRow,
    InputRow,
    PlanStep,
    PreviousSource,
    ResultSource,
    Source,
    WaitingRow,
)

Reading = tuple[str, int | None]
"""A result that a step reads, and the number of its texture; ``None`` for a buffer."""

WRITES = frozenset(("target", "depth", "image", "copied_to"))
"""Uses of a texture after which even the same use has to wait."""


class Named(Protocol):
    """A row with a name."""

    @property
    def name(self) -> str:
        """The name of the row."""


MOST_TOLD = 300
"""The most letters of a line of an error: names in a plan may be as long as they like."""


class PlanError(ValueError):
    """A plan cannot be executed; the text tells people why, in one line or several."""

    def __init__(self, *lines: str) -> None:
        super().__init__("\n".join(map(_line, lines)))


def _line(text: str) -> str:
    """A line of an error, without characters that would break it, and not too long."""
    shown = harmless(text if len(text) <= MOST_TOLD else text[: MOST_TOLD // 2])
    return shown if len(text) <= MOST_TOLD else f"{shown} … {harmless(text[-MOST_TOLD // 2 :])}"


def fail(plan: FramePlan, where: str, text: str) -> NoReturn:
    """Raise ``PlanError``; ``where`` names the row that is wrong."""
    raise PlanError(f"{plan.frame}, {where}: {text}")


END = "the end"
"""The name, in messages, of the place behind the last step."""


def places_of_waiting(plan: FramePlan) -> Iterator[tuple[str, PlanStep | WaitingRow]]:
    """Each place of a plan that has barriers, with its name in messages."""
    for step in plan.steps:
        yield step.name, step
    yield END, plan.end


def drawn_to(step: PlanStep) -> Iterator[int]:
    """The textures that a step draws to, and those to which it resolves samples."""
    for row in step.attachments:
        yield row.texture
        if row.resolve is not None:
            yield row.resolve.texture


def has_samples(plan: FramePlan, attachment: AttachmentRow) -> bool:
    """True if a step draws to an attachment with several samples."""
    return plan.textures[attachment.texture].samples > 1


def inputs(step: PlanStep) -> Iterator[InputRow]:
    """The inputs that the frame sets in a step."""
    for use in step.uses:
        yield from use.inputs


def read_now(step: PlanStep, *, is_first: bool) -> Iterator[Reading]:
    """The results of this frame that a step reads: a first frame has no last one."""
    for row in inputs(step):
        source: Source | None = row.source
        if isinstance(source, PreviousSource):
            source = source.initially if is_first else None
        if isinstance(source, ResultSource):
            yield source.result, source.texture


def read_before(step: PlanStep) -> Iterator[Reading]:
    """The results of the last frame that a step reads."""
    for row in inputs(step):
        if isinstance(row.source, PreviousSource):
            yield row.source.previous, row.source.texture


def written(step: PlanStep) -> Iterator[Reading]:
    """The results that a step leaves, each with the texture that holds it then.

    A copy leaves nothing of its own: the next step draws over it.
    """
    for row in step.attachments:
        yield row.result, row.texture
        if row.resolve is not None:
            yield row.result, row.resolve.texture
    for image in step.images:
        yield image.result, image.texture
    for buffer in step.buffers:
        yield buffer.result, None


def drawn_over(step: PlanStep) -> Iterator[str]:
    """The results over which a step draws."""
    for row in step.attachments:
        if row.over is not None:
            yield row.over


def places(texture: FrameTextureRow) -> Iterator[tuple[int, int]]:
    """Every layer and level of a texture."""
    for layer in range(texture.layers):
        for level in range(texture.levels):
            yield layer, level
