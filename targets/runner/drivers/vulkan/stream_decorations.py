"""Writes into a SPIR-V module which of its outputs are captured, and where to.

A text in GLSL states that itself. A text in HLSL does not, since Direct3D gets it beside the text.
So ``capture.py`` adds to the module of such a text what a module from GLSL has.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from itertools import chain

from ....toolchain.spirv import HEADER_WORDS, Op, instructions
from ..device import DriverError
from ..pipeline import StreamOutput

TRANSFORM_FEEDBACK = 53
"""SPIR-V's capability of transform feedback."""
XFB = 11
"""The execution mode of an entry point whose outputs are captured."""
LOCATION, OFFSET, XFB_BUFFER, XFB_STRIDE = 30, 35, 36, 37
"""SPIR-V's decorations."""
OUTPUT = 3
"""The storage class of outputs."""

Words = tuple[int, ...]


def decorated(spirv: bytes, stream: StreamOutput) -> bytes:
    """The module with its outputs decorated. Raises ``DriverError`` if it lacks one of them."""
    found = [*instructions(spirv)]
    outputs = {
        one.operands[1] for one in found if one.opcode == Op.VARIABLE and one.operands[2] == OUTPUT
    }
    located = {
        one.operands[2]: one.operands[0]
        for one in found
        if one.opcode == Op.DECORATE and one.operands[1] == LOCATION and one.operands[0] in outputs
    }
    decorations = list(_decorations(located, stream))
    head = struct.unpack_from(f"<{HEADER_WORDS}I", spirv)
    words = [*head, *_instruction(Op.CAPABILITY, TRANSFORM_FEEDBACK)]
    for one in found:
        if one.opcode == Op.DECORATE and decorations:
            words += chain.from_iterable(decorations)
            decorations = []
        words += _instruction(one.opcode, *one.operands)
        if one.opcode == Op.ENTRY_POINT:
            words += _instruction(Op.EXECUTION_MODE, one.operands[1], XFB)
    return struct.pack(f"<{len(words)}I", *words)


def _decorations(located: dict[int, int], stream: StreamOutput) -> Iterator[Words]:
    for output in stream.outputs:
        if output.location not in located:
            raise DriverError(f"the module has no output {output.identifier!r}")
        variable = located[output.location]
        yield _instruction(Op.DECORATE, variable, XFB_BUFFER, 0)
        yield _instruction(Op.DECORATE, variable, XFB_STRIDE, stream.stride)
        yield _instruction(Op.DECORATE, variable, OFFSET, output.offset)


def _instruction(op: int, *operands: int) -> Words:
    return (len(operands) + 1) << 16 | op, *operands
