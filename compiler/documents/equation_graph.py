"""The graphs of materials' own equations as a document: ``burnish export --format json`` writes it.

It says what ``burnish graph`` draws. ``compiler/semantics/equations`` makes the graphs, and
``commands/graph/document.py`` turns them into these records.
"""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from ...support.frozen import frozen
from ..constraints import Count, Range

Place = Annotated[int, Range(least=1)]


@frozen(kw_only=True)
class SourcePlace:
    """Where a node is written."""

    file: str
    """The file, as it was named; those of the library begin with ``std/``."""
    line: Place
    """The line, from 1."""
    column: Place
    """The column of its first character, from 1."""


@frozen(kw_only=True)
class NodeInput:
    """Something that a node reads: another node, or a constant."""

    label: str
    """The name of an argument, or the sign of an operator; it may be empty."""
    text: str
    """The constant; or the name of the node that is read, with what is picked out of it, as in
    ``read albedo.rgb``."""
    node: Count | None
    """The number of the node that is read, counted from 0; null for a constant."""


@frozen(kw_only=True)
class GraphNode:
    """A declaration of the material, an operation in an equation, or something that is folded."""

    kind: Literal[
        "parameter", "texture", "buffer", "attribute", "inherited", "input", "host", "lights",
        "equation", "operation", "function", "term", "statement", "pass",
    ]  # fmt: skip
    """The kind of the node.

    ``inherited`` is what a base or a mixin declares, folded into one node. An ``input`` is supplied
    by the pipeline, and a ``host`` is a member of a block of the host. An ``equation`` is that of a
    slot, together with its outermost operation. A ``function`` or ``term`` is a call. A
    ``statement`` is a member without a name, such as ``expand``. The ``lights`` are the rig, and
    the ``pass`` reads what the material delivers.
    """
    name: str
    """The declared name, or that of the operation, with a number if there are several of one."""
    type: str
    """The type, such as ``rgb`` or ``direction<world>``; empty where a node has none."""
    doc: str
    """Doc comment; empty where there is none."""
    operation: str
    """The outermost operation of an equation; empty for other nodes and plain values."""
    owner: str
    """The base or mixin that declares an inherited node; empty for other nodes."""
    text: str
    """The default of a parameter, the constant of an equation, or a loop as it is written."""
    lights: tuple[str, ...]
    """The lights of a rig, each with its type."""
    inputs: tuple[NodeInput, ...]
    """What it reads, in the order of the text."""
    place: SourcePlace | None
    """Where it is written; null for what is folded."""


@frozen(kw_only=True)
class MaterialGraph:
    """The graph of one material under one pass and one rig."""

    material: str
    """The material."""
    doc: str
    """The material's doc comment; empty where there is none."""
    pass_: str
    """The pass."""
    rig: str
    """The rig."""
    nodes: tuple[GraphNode, ...]
    """The nodes, each behind those that it reads."""


@frozen(kw_only=True)
class EquationGraphs:
    """The graphs of the own equations of a file's materials."""

    VERSION: ClassVar = "graph"

    graph: Literal[1]
    """Version of this document's format."""
    materials: tuple[MaterialGraph, ...]
    """The materials, in the order of the file."""
