"""The storage buffers' side of the reflection: the host's bindings, and the layout of elements."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, TypedDict

from ..documents.steps import StepRow
from ..documents.values import BufferRow, LayoutRow, MemberRow, ResultRow, StructRow
from ..ir.kernel import neutral
from ..ir.program import Program
from ..ir.shader import BufferInfo, Shader
from ..ir.stages import EXTENT, LENGTH
from ..ir.storage import stored_type, structs_in
from ..ir.types import INT
from ..packing import element_packing
from .bytes import layout_row, struct_row
from .parameters import member_rows
from .values import steps


def buffer_rows(infos: Sequence[BufferInfo], program: Program) -> Iterator[BufferRow]:
    """A row for each declared buffer."""
    read = {stage.name: frozenset(stage.buffers) for stage in program.stages}
    for info in infos:
        stages = tuple([name for name, buffers in read.items() if info.leaf in buffers])
        yield buffer_row(info, stages)


def buffer_row(info: BufferInfo, stages: tuple[str, ...] = ()) -> BufferRow:
    """A buffer that some stages read."""
    stride = element_packing(info.leaf.type.element).stride
    return BufferRow(**_elements(info), stride=stride, count=info.leaf.count.name, stages=stages)


def result_rows(shader: Shader) -> Iterator[ResultRow]:
    """A row for each buffer that a kernel writes."""
    extents = shader.results_of(EXTENT)
    scattered = {r.store: r.value for r in shader.results_of(LENGTH) if r.store is not None}
    lengths = {store.buffer: (store.operator, length) for store, length in scattered.items()}
    for info in shader.written:
        operator, count = lengths.get(info.leaf, (None, extents[0].value))
        element = info.leaf.type.element
        yield ResultRow(
            **_elements(info),
            stride=element_packing(element).stride * info.each,
            count=steps(count),
            scattered=operator,
            initial=None if operator is None else neutral(operator, signed=element == INT),
        )


def extent_steps(shader: Shader) -> tuple[StepRow, ...] | None:
    """The steps that compute how many elements a kernel's results have; ``None`` for others."""
    extents = shader.results_of(EXTENT)
    return steps(extents[0].value) if extents else None


if TYPE_CHECKING:  # Python would compile the annotations while it loads this module.

    class _Elements(TypedDict):
        """The fields that both kinds of buffers have."""

        name: str
        type: str
        representation: str
        group: str
        layout: LayoutRow
        members: tuple[MemberRow, ...]
        structs: tuple[StructRow, ...]
        doc: str


def _elements(info: BufferInfo) -> _Elements:
    buffer, packed = info.leaf, element_packing(info.leaf.type.element)
    return {
        "name": buffer.name,
        "type": f"{info.element.declared_type}[]",
        "representation": str(buffer.type),
        "group": buffer.group,
        "layout": layout_row(packed),
        "members": member_rows(packed, info.element.members),
        "structs": tuple(map(struct_row, structs_in([stored_type(buffer.type)]))),
        "doc": info.doc,
    }
