"""The equations of materials as the records of a JSON document; ``burnish export`` writes it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ...compiler.diagnostics.source import Span
from ...compiler.documents.equation_graph import (
    EquationGraphs,
    GraphNode,
    MaterialGraph,
    NodeInput,
    SourcePlace,
)
from ...compiler.semantics.equations.model import EquationNode, Equations


def equations_document(found: Iterable[Equations]) -> EquationGraphs:
    """The document of some materials."""
    return EquationGraphs(graph=1, materials=tuple(map(_graph, found)))


def _graph(found: Equations) -> MaterialGraph:
    numbers = {node.key: number for number, node in enumerate(found.nodes)}
    return MaterialGraph(
        material=found.name, doc=found.doc, pass_=found.pass_name, rig=found.rig_name,
        nodes=tuple(_node(node, numbers) for node in found.nodes),
    )  # fmt: skip


def _node(node: EquationNode, numbers: Mapping[str, int]) -> GraphNode:
    is_equation = node.kind == "equation"
    return GraphNode(
        kind=node.kind,
        name=node.name,
        type=node.type,
        doc=node.doc,
        operation=node.note if is_equation else "",
        owner="" if is_equation else node.note.removeprefix("of "),
        text=node.text,
        lights=node.lines,
        inputs=tuple(
            NodeInput(label=row.label, text=row.words, node=numbers.get(row.source))
            for row in node.rows
        ),
        place=None if node.span is None else _place(node.span),
    )


def _place(span: Span) -> SourcePlace:
    line, column = span.source.position(span.start)
    return SourcePlace(file=span.source.name_in_outputs, line=line, column=column)
