"""The captured vertices' side of the reflection: how they lie in the buffer, and how many come."""

from __future__ import annotations

from ..documents.drawing import CapturedRow, CaptureRow
from ..ir.primitives import DrawnPrimitive
from ..ir.shader import Shader


def capture_row(shader: Shader) -> CaptureRow:
    """The buffer into which a pass captures, for a host."""
    capture = shader.capture
    assert capture is not None
    written = next(iter(shader.written), None)
    is_told = written is not None and written.each > capture.numbers
    return CaptureRow(
        topology=_primitive(shader),
        vertices=_vertices_each(shader),
        stride=capture.stride,
        buffer=None if written is None else written.buffer.name,
        there=capture.stride if is_told else None,
        members=tuple(
            CapturedRow(
                name=member.name,
                type=member.declared_type,
                representation=str(member.type),
                offset=member.offset,
                doc=member.doc,
            )
            for member in capture.members
        ),
    )


def _primitive(shader: Shader) -> DrawnPrimitive:
    """The kind of primitives of the captured vertices."""
    if shader.expansion is not None:
        return shader.expansion.emits
    return "triangle" if shader.tessellation is None else shader.tessellation.kind.drawn


def _vertices_each(shader: Shader) -> int:
    """The largest number of vertices for each primitive or patch that is drawn."""
    if shader.listed:
        return shader.listed
    return 3 if shader.expansion is None else shader.expansion.listed
