"""Recognises elements of parameters' arrays at positions that a shader computes: ``lamps[i]``.

``hoist`` and ``draw_constants`` ask for them. The host does not know which element a shader will
read, but it knows all elements. So it can compute a value that depends on one element, and on
parameters only, for each of them.
"""

from __future__ import annotations

from ..ir.leaves import Parameter
from ..ir.node import Node
from ..ir.types import Array

MOST = 64
"""The number of elements up to which arrays are looked at.

Blocks hold 16 KiB on some devices, and a host computes the derived values for all elements whenever
one changes.
"""


def is_element(node: Node) -> bool:
    """True if a value is an element, at whatever position, of a parameter's array."""
    if node.op != "index":
        return False
    array, _ = node.operands
    return (
        isinstance(array.type, Array) and array.type.count <= MOST and array_name(array) is not None
    )


def array_name(array: Node) -> str | None:
    """The host's name of a parameter's array, or of a part that is one: ``lamps``.

    A part has a name such as ``p.weights``. ``None`` if the array is no such thing.
    """
    parts: list[str] = []
    while array.op in ("member", "index"):
        if array.op == "member":
            parts.append(f".{array.data}")
        elif array.operands[1].op == "constant":
            parts.append(f"[{array.operands[1].data}]")
        else:
            return None
        array = array.operands[0]
    if not isinstance(array.data, Parameter):
        return None
    return array.data.name + "".join(reversed(parts))
