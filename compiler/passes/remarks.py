"""Remarks: the record of what passes decided about the builtins that a user wrote.

``simplify`` and ``guard`` leave a remark for each decision. ``proofs.py`` explains it in words when
somebody asks (``burnish graph --why``).
"""

from __future__ import annotations

from typing import Literal

from ...support.frozen import frozen
from ..diagnostics.source import Span
from ..ir.node import Node
from .path_conditions import PathRefinement

Outcome = Literal["native", "dropped", "guarded"]
"""Replaced by the hardware's own operation; removed, as it changes nothing; kept with a guard."""


@frozen
class Remark:
    """A decision about one operation of the user's text."""

    builtin: str
    operands: tuple[Node, ...]
    span: Span | None
    outcome: Outcome
    conditions: tuple[PathRefinement, ...] = ()
    """The conditions around it that the decision rests on, where ranges alone do not decide."""
    rule: str = ""
    """The name of the simplification rule that has removed it."""
