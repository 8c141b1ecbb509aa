"""The captured vertices' side of the reflection: how they lie in the buffer, and how many come."""

from __future__ import annotations

from typing import Any

from ..ir.shader import Shader


def capture_row(shader: Shader) -> dict[str, Any]:
    """What a host has to know of the buffer into which a pass captures."""
    capture, expansion = shader.capture, shader.expansion
    assert capture is not None
    written = next(iter(shader.written), None)
    is_told = written is not None and written.each > capture.numbers
    return {
        "primitive": "triangle" if expansion is None else expansion.emits,
        "vertices": 3 if expansion is None else expansion.listed,
        "stride": capture.stride,
        "buffer": None if written is None else written.buffer.name,
        "there": capture.stride if is_told else None,
        "members": [
            {
                "name": member.name,
                "type": member.declared_type,
                "representation": str(member.type),
                "offset": member.offset,
                "doc": member.doc,
            }
            for member in capture.members
        ],
    }
