"""What MaterialX cannot say of a material, and where it is written."""

from __future__ import annotations

from collections.abc import Sequence

from ...compiler.diagnostics.source import Span


class UnsayableError(Exception):
    """An expression that no node means.

    ``advice`` says what can be done. Whoever knows the place of the expression fills in ``span``,
    and whoever knows the slot that needs it, its name.
    """

    def __init__(self, text: str, advice: str = "", span: Span | None = None) -> None:
        super().__init__(text)
        self.text, self.advice, self.span = text, advice, span
        self.slot = ""

    def __str__(self) -> str:
        place = f"{self.span}: " if self.span is not None else ""
        about = f"`{self.slot}`: " if self.slot else ""
        return f"{place}{about}{self.text}"


class ReadsMaterialError(Exception):
    """A function reads slots of the material, so it cannot be a definition of its own."""


class UnsaidError(Exception):
    """All that cannot be exported, slot by slot."""

    def __init__(self, told: Sequence[UnsayableError]) -> None:
        super().__init__("\n".join(map(str, told)))
        self.told = told
