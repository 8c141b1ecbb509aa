"""Narrows parameters of a shader: to one value, or to a part of their ranges.

``api/specialising.py`` calls ``narrow`` for what ``compile --set`` says, before all passes. These
then leave out of the shader all that the narrower ranges prove to be dead. Blocks keep their
layouts, so that a host sets the same blocks for every version of a shader.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...support.frozen import changed
from ..ir.leaves import Parameter
from ..ir.node import Graph, Node
from ..ir.rewrite import rewrite
from ..ir.shader import ExternInfo, ParameterInfo, PatchPattern, Shader


def narrow(shader: Shader, narrowed: Mapping[Parameter, ParameterInfo]) -> Shader:
    """The shader with some of its parameters declared otherwise: they have the same names."""

    def rule(graph: Graph, node: Node, _operands: tuple[Node, ...]) -> Node | None:
        info = narrowed.get(node.data) if isinstance(node.data, Parameter) else None
        return None if info is None else graph.node(node.op, node.type, (), info.leaf)

    def of(info: ParameterInfo) -> ParameterInfo:
        return narrowed.get(info.leaf, info)

    pattern = shader.pattern
    told = () if pattern is None else (pattern.place, pattern.is_there)
    roots = (*shader.roots, *told)
    values = rewrite(shader.graph, roots, rule, shader.notes.follow, ("parameter",))
    results = zip(shader.results, values, strict=False)
    return changed(
        shader,
        parameters=tuple(map(of, shader.parameters)),
        externs=tuple(_extern(block, narrowed) for block in shader.externs),
        results=tuple(changed(result, value=value) for result, value in results),
        pattern=PatchPattern(*values[len(shader.results) :]) if told else None,
    )


def _extern(block: ExternInfo, narrowed: Mapping[Parameter, ParameterInfo]) -> ExternInfo:
    """A block that the host owns, with the members that are declared otherwise."""
    members = (
        changed(member, info=narrowed.get(member.info.leaf, member.info))
        for member in block.members
    )
    return changed(block, members=tuple(members))
