"""What became of an operation, and why: kept as found, and worked out in words by ``proofs.py``."""

from __future__ import annotations

from typing import Literal

from ...frozen import frozen
from ..diagnostics.source import Span
from ..ir.node import Node
from .paths import Told

Outcome = Literal["native", "dropped", "guarded"]
"""The hardware's own operation; nothing at all, as it changes nothing; a guard."""


@frozen
class Judgement:
    """One operation that somebody wrote."""

    builtin: str
    operands: tuple[Node, ...]
    span: Span | None
    outcome: Outcome
    told: tuple[Told, ...] = ()
    """What conditions around it tell, where ranges alone do not decide."""
