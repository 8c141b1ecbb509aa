"""Captures without a stream output: a kernel writes the vertices, one by each invocation.

``lower_stages`` calls ``lower_capture`` before all passes, when expansions and tessellations have
been lowered. The attributes of the mesh are read from one storage buffer. Each of its elements is a
vertex that is drawn; or a primitive that is expanded or a patch that is divided, with the
attributes that are read at its corners. The numbers of a vertex are written as they lie in the
buffer of a stream output, each as the 32 bits that it has. A vertex that is not emitted is written,
too: one more number says of each vertex whether it is there, and a host leaves the others out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain

from ...support.frozen import changed
from ..diagnostics.source import Span
from ..ir import build
from ..ir.capture import NUMBER_SIZE
from ..ir.kernel import USUAL, WRITTEN_GROUP
from ..ir.leaves import MOST_ELEMENTS, Attribute, Buffer, Parameter
from ..ir.node import Graph, Node, reachable
from ..ir.rewrite import rewrite
from ..ir.shader import AttributeInfo, BufferInfo, MeshInput, ParameterInfo, Result, Shader, Store
from ..ir.stages import CAPTURE, COMPUTE, COMPUTED, EMITTING, EXTENT, STORE, VERTEX, SystemInput
from ..ir.types import INT, UINT, RuntimeArray, Type, Vector, width
from .corner_inputs import VERTEX_INDEX, as_attribute
from .mesh_buffers import buffer_info, free_name, member_name, mesh_buffer, names_taken

CAPTURED = "captured"
"""The buffer that is written."""
INDEX = changed(next(row for row in COMPUTE.inputs if row.type == INT), most=int(MOST_ELEMENTS) - 1)


def lower_capture(shader: Shader) -> Shader:
    """The shader with a kernel instead of the vertex stage; itself if it captures nothing.

    Expansions and tessellations have been lowered before.
    """
    if shader.capture is None:
        return shader
    before = len(shader.graph)
    reading = _Reading(shader)
    values = rewrite(
        shader.graph, shader.roots, reading.rule, shader.notes.follow, ("attribute", "input")
    )
    lowered = [changed(r, value=v) for r, v in zip(shader.results, values, strict=True)]
    written = _written(shader, reading.span)
    results = (
        Result(EXTENT, COMPUTE, reading.extent), *_stores(shader, written, lowered),
    )  # fmt: skip
    # The inputs and counts have no place of their own: they get that of the first captured value.
    for node in reachable([result.value for result in results]):
        if node.id >= before:
            shader.notes.spans.setdefault(node.id, reading.span)
    return changed(
        shader,
        results=results,
        parameters=(*shader.parameters, reading.mesh.count),
        attributes=(),
        buffers=(*shader.buffers, reading.mesh),
        written=(written,),
        chain=COMPUTED,
        work_group=USUAL[1],
    )


class _Reading:
    """Reads the attributes of the mesh's vertices from a buffer."""

    def __init__(self, shader: Shader) -> None:
        self._graph: Graph = shader.graph
        self._notes = shader.notes
        self._of_primitives = shader.expansion is not None or shader.tessellation is not None
        self._listed = listed_each(shader)
        """The number of vertices for each element of the buffer."""
        self.span = _first_span(shader)
        """The span of the first captured value."""
        infos = list(self._infos(shader)) or [self._counted(VERTEX_INDEX)]
        self._members = {info.leaf: member_name(info.leaf) for info in infos}
        self.mesh = mesh_buffer(shader, infos, is_primitive=self._of_primitives)
        """The buffer."""
        index = shader.graph.node("input", INT, (), INDEX)
        self._vertex = self._element = index
        if self._of_primitives:
            listed = build.constant(self._graph, INT, self._listed)
            self._element = self._call(INT, "div", index, listed)
            self._vertex = self._call(INT, "mod", index, listed)
            self._notes.names.setdefault(self._element.id, "primitive")
            self._notes.names.setdefault(self._vertex.id, "number")

    @property
    def extent(self) -> Node:
        """The number of vertices that are written."""
        count = self._graph.node("parameter", INT, (), self.mesh.leaf.count)
        if self._listed == 1:
            return count
        vertices = self._call(INT, "mul", count, build.constant(self._graph, INT, self._listed))
        self._notes.names.setdefault(vertices.id, "vertices")
        return vertices

    def rule(self, _graph: Graph, node: Node, _operands: tuple[Node, ...]) -> Node | None:
        """The replacement of a vertex input, or of a number that the pipeline supplies."""
        leaf = node.data
        if isinstance(leaf, SystemInput):
            if self._of_primitives:
                number = self._vertex if leaf.name == VERTEX_INDEX.name else self._element
                return self._call(UINT, "to_uint", number)
            leaf = as_attribute(leaf)
        assert isinstance(leaf, Attribute)
        buffer = self.mesh.leaf
        # There are as many invocations as the elements ask for, so none is beyond the last one.
        element = build.index(
            self._graph, self._graph.node("buffer", buffer.type, (), buffer), self._element
        )
        return build.member(self._graph, element, self._members[leaf])

    def _infos(self, shader: Shader) -> Iterator[AttributeInfo]:
        """The inputs that are read, in the order of their declaration."""
        read = {node.data for node in reachable(shader.roots) if node.op in ("attribute", "input")}
        yield from (info for info in shader.attributes if info.leaf in read)
        if not self._of_primitives:
            yield from (self._counted(row) for row in VERTEX.inputs if row in read)

    def _counted(self, row: SystemInput) -> AttributeInfo:
        """A number that the host counts."""
        mesh = MeshInput(row.name, 0 if self._of_primitives else None, is_number=True)
        return AttributeInfo(as_attribute(row), str(row.type), "", self.span, mesh=mesh)

    def _call(self, type_: Type, name: str, *operands: Node) -> Node:
        return self._graph.node("call", type_, operands, name)


def listed_each(shader: Shader) -> int:
    """The largest number of vertices for each element of the buffer."""
    if shader.listed:
        return shader.listed
    return 1 if shader.expansion is None else shader.expansion.listed


def _first_span(shader: Shader) -> Span:
    """The span of the first captured value that is written somewhere.

    Values that the pipeline supplies are written nowhere: if nothing else is captured, the span is
    that of anything in the material.
    """
    spans = shader.notes.spans
    captured = (spans.get(result.value.id) for result in shader.results_of(CAPTURE))
    of_inputs = (info.span for info in shader.attributes)
    of_parameters = (info.span for info in shader.parameters)
    places = chain(captured, spans.values(), of_inputs, of_parameters)
    return next(span for span in places if span is not None)


def _written(shader: Shader, span: Span) -> BufferInfo:
    """The buffer of which each invocation writes the numbers of a vertex."""
    assert shader.capture is not None
    buffer = Buffer(free_name(CAPTURED, names_taken(shader)), RuntimeArray(UINT), WRITTEN_GROUP)
    element = ParameterInfo(Parameter("", UINT, ""), str(UINT), "", span)
    conditions = shader.results_of(EMITTING)
    return changed(
        buffer_info(buffer, element, span), each=shader.capture.numbers + len(conditions)
    )


def _stores(shader: Shader, written: BufferInfo, results: Iterable[Result]) -> Iterator[Result]:
    """A result for each number of a vertex; the last one says whether it is there."""
    graph, notes, capture = shader.graph, shader.notes, shader.capture
    assert capture is not None
    for result in results:
        if result.kind == EMITTING:
            one, zero = (build.constant(graph, UINT, number) for number in (1, 0))
            lanes, first = [graph.node("select", UINT, (result.value, one, zero))], capture.numbers
        else:
            assert result.kind == CAPTURE, result
            first = capture.member(result.name).offset // NUMBER_SIZE
            lanes = [result.value]
            if isinstance(result.value.type, Vector):
                count = width(result.value.type)
                lanes = [build.swizzle(graph, result.value, (lane,)) for lane in range(count)]
        for number, lane in enumerate(lanes, first):
            notes.spans.setdefault(lane.id, notes.spans.get(result.value.id, written.span))
            store = Store(written.leaf, (), written.each, number, as_bits=True)
            yield Result(STORE, COMPUTE, lane, store=store)
