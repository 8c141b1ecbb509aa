"""Builds the ``Picture`` of a material's own equations; ``command.py`` calls it."""

from __future__ import annotations

from ...compiler.semantics.equations.model import EquationNode, Equations, NodeKind
from .kinds import ArrowKind, Kind
from .model import Arrow, Box, Cluster, Input, Picture

_KINDS: dict[NodeKind, Kind] = {
    "parameter": Kind.MATERIAL_PARAMETER, "texture": Kind.TEXTURE, "buffer": Kind.BUFFER,
    "attribute": Kind.ATTRIBUTE, "inherited": Kind.INHERITED,
    "input": Kind.INPUT, "host": Kind.OTHER_PARAMETER, "lights": Kind.LIGHTS,
    "equation": Kind.EQUATION, "operation": Kind.OPERATION, "function": Kind.FUNCTION,
    "term": Kind.TERM, "statement": Kind.STATEMENT, "pass": Kind.DRAWN_BY,
}  # fmt: skip
_INPUTS = (
    "parameter", "texture", "buffer", "attribute", "inherited", "input", "host", "lights",
)  # fmt: skip
_TITLES = ("inputs", "equations", "drawn by")


def equations_picture(found: Equations) -> Picture:
    """A picture with a box for each node, in which data flow from left to right."""
    clusters = {title: Cluster(title, has_border=False) for title in _TITLES}
    arrows: dict[Arrow, None] = {}
    for node in found.nodes:
        clusters[_title(node)].boxes.append(_box(node))
        for number, row in enumerate(node.rows):
            if row.source:
                arrows[Arrow(row.source, node.key, ArrowKind.WIRE, row=number)] = None
    title = f"{found.name}, pass {found.pass_name}, rig {found.rig_name}"
    filled = [cluster for cluster in clusters.values() if cluster.boxes]
    return Picture(title, filled, list(arrows), found.doc)


def _title(node: EquationNode) -> str:
    """The cluster of a node; something inherited is an input as long as it reads nothing."""
    if node.kind == "pass":
        return _TITLES[2]
    return _TITLES[0] if node.kind in _INPUTS and not node.rows else _TITLES[1]


def _box(node: EquationNode) -> Box:
    lines = [node.note, *node.lines, *node.doc.splitlines()[:1]]
    return Box(
        node.key, _KINDS[node.kind], node.name, node.type, node.text,
        lines=[line for line in lines if line], place=str(node.span) if node.span else "",
        inputs=[Input(row.label, row.words, bool(row.source)) for row in node.rows],
    )  # fmt: skip
