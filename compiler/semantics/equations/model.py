"""The graph of a material's own equations: nodes with rows, and the nodes that rows read.

``building.py`` makes it of checked syntax. ``burnish graph`` draws it.
"""

from __future__ import annotations

from typing import Literal

from ....support.frozen import frozen
from ...diagnostics.source import Span

NodeKind = Literal[
    "parameter", "texture", "buffer", "attribute", "inherited", "input", "host", "lights",
    "equation", "operation", "function", "term", "statement", "pass",
]  # fmt: skip
"""The kinds of nodes.

``inherited`` is what a base or a mixin declares, folded into one node; an ``input`` is supplied by
the pipeline, and ``host`` stands for a member of a block of the host; a ``function`` or ``term``
is a call; a ``statement`` is a member such as ``expand``; and the ``pass`` reads what the material
delivers.
"""


@frozen
class Row:
    """A row of a node: something that it reads."""

    label: str
    """The name of an argument, or the sign of an operator; it may be empty."""
    words: str
    """The constant, or the name of the node that is read, with what is picked out of it."""
    source: str = ""
    """The key of the node that is read; empty for a constant."""


@frozen
class EquationNode:
    """A node: a declaration, an operation, or something folded."""

    key: str
    kind: NodeKind
    name: str
    """The declared name, or the name of the operation, with a number if there are several."""
    type: str = ""
    doc: str = ""
    text: str = ""
    """The default of a parameter, the constant of an equation, or the text of a loop."""
    note: str = ""
    """The operation of an equation, or the owner of something inherited."""
    lines: tuple[str, ...] = ()
    """The lights of a rig."""
    rows: tuple[Row, ...] = ()
    span: Span | None = None
    """The place where it is written; ``None`` for what is folded."""


@frozen
class Equations:
    """The graph of one material under a pass and a rig."""

    name: str
    doc: str
    pass_name: str
    rig_name: str
    nodes: tuple[EquationNode, ...]
    """The nodes, each behind those that it reads."""
