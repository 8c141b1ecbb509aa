"""The parts in which an element is written to a storage buffer, as memory has them.

``kernels/kernel.py`` asks whether elements of a type can be written, and makes a result of each
part.
"""

from __future__ import annotations

from collections.abc import Iterator

from ....ir import build
from ....ir.node import Graph, Node
from ....ir.shader import BufferInfo, Result, Store
from ....ir.stages import COMPUTE, STORE
from ....ir.storage import elements_in_row
from ....ir.types import UINT, Array, Matrix, Scalar, Struct, Type, Vector, with_width
from ...state.context import Context


def is_writable(type_: Type, *, inside: bool = False) -> bool:
    """True if the texts can write values of a type part by part.

    A matrix is written as the columns that it is stored in, which only a buffer of matrices has as
    elements.
    """
    match type_:
        case Matrix():
            return not inside
        case Array(element=element):
            return isinstance(element, Scalar | Vector)
        case Struct(members=members):
            return all(is_writable(inner, inside=True) for _, inner in members)
        case _:
            return True


def stores(ctx: Context, info: BufferInfo, value: Node) -> Iterator[Result]:
    """A result for each part of an element, as it is stored."""
    graph, buffer = ctx.tree, info.leaf
    if isinstance(value.type, Matrix):
        columns = value.type.columns
        for column in range(columns):
            part = _padded(graph, build.part(graph, value, column), 4)
            yield Result(STORE, COMPUTE, part, store=Store(buffer, (), columns, column))
        return
    for path, part in _parts(graph, value):
        whole = not path and isinstance(part.type, Vector) and part.type.size == 3
        node = _padded(graph, _as_stored(graph, part), 4) if whole else _as_stored(graph, part)
        ctx.notes.names.setdefault(node.id, "_".join([buffer.name, *map(str, path)]))
        yield Result(STORE, COMPUTE, node, store=Store(buffer, path))


def _parts(
    graph: Graph, value: Node, path: tuple[str | int, ...] = ()
) -> Iterator[tuple[tuple[str | int, ...], Node]]:
    """The numbers and vectors that a value consists of; of an array, the rows that store it."""
    match value.type:
        case Struct(members=members):
            for name, _ in members:
                yield from _parts(graph, build.member(graph, value, name), (*path, name))
        case Array(Scalar() | Vector() as element, count):
            in_row = elements_in_row(element)
            parts = [_as_stored(graph, build.part(graph, value, i)) for i in range(count)]
            for row, first in enumerate(range(0, count, in_row)):
                joined = build.vector(graph, tuple(parts[first : first + in_row]))
                yield (*path, row), _padded(graph, joined, 4)
        case _:
            yield path, value


def _as_stored(graph: Graph, part: Node) -> Node:
    """A part as memory has it: bools are uints."""
    type_ = part.type
    if not isinstance(type_, Scalar | Vector) or type_.kind != "bool":
        return part
    one, zero = (build.constant(graph, UINT, number) for number in (1, 0))
    if isinstance(type_, Scalar):
        return graph.node("select", UINT, (part, one, zero))
    lanes = (build.swizzle(graph, part, (lane,)) for lane in range(type_.size))
    return build.vector(graph, tuple(graph.node("select", UINT, (x, one, zero)) for x in lanes))


def _padded(graph: Graph, part: Node, lanes: int) -> Node:
    """A vector with zeros in its last lanes."""
    assert isinstance(part.type, Scalar | Vector)
    own = part.type.size if isinstance(part.type, Vector) else 1
    if own == lanes:
        return part
    zero = 0.0 if part.type.kind == "float" else 0
    missing = build.splat(
        graph, build.constant(graph, with_width(part.type.kind, 1), zero), lanes - own
    )
    return build.vector(graph, (part, missing))
