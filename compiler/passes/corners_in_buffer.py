"""Corners of primitives that need more vertex inputs than there are: a storage buffer has them.

The pipeline calls ``corners_in_buffer`` behind all passes but the last one, if the vertex stage of
a draw of instances reads more than the inputs that every profile has. An element of the buffer is a
primitive, or a patch, with all that vertices read of its corners, and the vertex stage reads the
element of its instance. Profiles whose vertex stage reads no storage buffers say so.
"""

from __future__ import annotations

from ...support.frozen import changed
from ..diagnostics.source import Span
from ..ir import build
from ..ir.leaves import Attribute
from ..ir.node import Graph, Node, reachable
from ..ir.rewrite import rewrite
from ..ir.shader import AttributeInfo, Shader
from ..ir.stages import INSTANCES
from ..ir.types import INT, UINT
from .corner_inputs import INSTANCE_INDEX
from .lower_reads import lower_reads
from .mesh_buffers import member_name, mesh_buffer


def corners_in_buffer(shader: Shader) -> Shader:
    """Replaces inputs per instance at corners by reads of a buffer; changes no other shader.

    The graph is in the form in which memory has the read values, and stays so.
    """
    graph, notes, roots = shader.graph, shader.notes, shader.roots
    read = {node.data for node in roots.nodes if node.op == "attribute"}
    corners = [info for info in shader.attributes if _is_of_corner(info)]
    wanted = [info for info in corners if info.leaf in read]
    if not wanted:
        return shader
    before = len(graph)
    mesh = mesh_buffer(shader, wanted, is_primitive=True)
    # A host draws one instance for each element, so none is beyond the last one.
    index = graph.node("input", UINT, (), INSTANCE_INDEX)
    number = graph.node("native", INT, (index,), "to_int")
    notes.names.setdefault(number.id, "primitive")
    whole = graph.node("buffer", mesh.leaf.type, (), mesh.leaf)
    element = build.index(graph, whole, number)
    members = {info.leaf: member_name(info.leaf) for info in wanted}

    def rule(graph: Graph, node: Node, _operands: tuple[Node, ...]) -> Node | None:
        assert isinstance(node.data, Attribute)
        name = members.get(node.data)
        return None if name is None else build.member(graph, element, name)

    values = rewrite(graph, roots, rule, notes.follow, ("attribute",))
    values = lower_reads(graph, values, notes.follow)
    for node in reachable(values):
        if node.id >= before:
            notes.spans.setdefault(node.id, _span(shader))
    results = zip(shader.results, values, strict=True)
    return changed(
        shader,
        results=tuple(changed(result, value=value) for result, value in results),
        attributes=tuple(info for info in shader.attributes if info not in corners),
        parameters=(*shader.parameters, mesh.count),
        buffers=(*shader.buffers, mesh),
    )


def _is_of_corner(info: AttributeInfo) -> bool:
    """True if an input has a value for each primitive that is drawn as an instance."""
    return info.mesh is not None and info.leaf.step == INSTANCES


def _span(shader: Shader) -> Span:
    """The span that names the primitives, or the patches."""
    made = shader.tessellation or shader.expansion
    assert made is not None
    return made.span
