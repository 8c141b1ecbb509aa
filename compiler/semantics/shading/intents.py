"""Finds out which textures hold colours: those whose texels become colours in a shader.

``elaborate.py`` and ``kernels/kernel.py`` ask when they make a shader, while values still have
meanings. By this a host binds pictures of colours in a format that decodes sRGB, and no others.
"""

from __future__ import annotations

from collections.abc import Iterable

from ....stdlib.builtins import BUILTINS
from ....support.frozen import changed
from ...ir.build import in_body
from ...ir.leaves import Texture
from ...ir.meaning import COLORS, Meaning
from ...ir.node import Node, reachable
from ...ir.operations import CALL, SWIZZLE
from ...ir.shader import TextureInfo
from ...ir.types import Array, TextureType, Vector
from ..types.meanings import Meanings

_BY_LANE = frozenset({"sum", "difference", "product", "quotient", "remainder", "lanes", "limits"})
"""Rules of meanings for builtins that make colours of all their operands, lane by lane."""
_MADE_OF = {
    "as": slice(1), "called": slice(1), "cross": slice(1), "index": slice(1), "apply": slice(1),
    "vector": slice(None), "array": slice(None), "select": slice(1, 3), "fold": slice(1, 3),
}  # fmt: skip
"""For operations that hand colours on, the operands that may be the colours."""


def with_intents(
    textures: tuple[TextureInfo, ...], meanings: Meanings, roots: Iterable[Node]
) -> tuple[TextureInfo, ...]:
    """The textures of a shader, each with its intent.

    That is ``color`` for those whose texels become colours, unless a declaration says otherwise.
    ``roots`` are the values that the shader writes, as checked trees.
    """
    if not any(_may_hold_colors(info) for info in textures):
        return textures
    found = _read_for(meanings, roots)
    return tuple(
        changed(info, intent="color") if _may_hold_colors(info) and info.leaf in found else info
        for info in textures
    )


def _may_hold_colors(info: TextureInfo) -> bool:
    type_ = info.leaf.type
    return info.intent is None and isinstance(type_, TextureType) and type_.sample == "float"


def _read_for(meanings: Meanings, roots: Iterable[Node]) -> frozenset[Texture]:
    """The textures whose texels become colours, in the values that these roots need."""
    pending = [node for node in reachable(roots) if _is_color(meanings.of(node))]
    seen = set(pending)
    found = set()
    while pending:
        node = pending.pop()
        if (texture := _whole_texels_of(node)) is not None:
            found.add(texture)
        for operand in _made_of(node):
            if operand not in seen and _may_be_color(operand, meanings.of(operand)):
                seen.add(operand)
                pending.append(operand)
    return frozenset(found)


def _is_color(meaning: Meaning | None) -> bool:
    return meaning is not None and meaning.kind in COLORS


def _may_be_color(node: Node, meaning: Meaning | None) -> bool:
    """True for three or four numbers, or arrays of these, that are not known as something else."""
    type_ = node.type.element if isinstance(node.type, Array) else node.type
    is_vector = isinstance(type_, Vector) and type_.size >= 3
    return is_vector and (meaning is None or _is_color(meaning))


def _whole_texels_of(node: Node) -> Texture | None:
    """The texture that a node reads texels of, with all of their lanes."""
    if node.op != "call":
        return None
    row = BUILTINS[CALL.data(node)]
    texture = node.operands[0].data
    is_read = row.method is not None and not row.constants
    return texture if is_read and isinstance(texture, Texture) else None


def _made_of(node: Node) -> tuple[Node, ...]:
    """The operands that are colours if the node is one."""
    if node.op == "member":
        inside = in_body(node)
        return () if inside is None else (inside,)
    if node.op == "swizzle":
        return node.operands if {0, 1, 2} <= set(SWIZZLE.data(node)) else ()
    if node.op == "call":
        rule = BUILTINS[CALL.data(node)].meaning
        return node.operands if rule in _BY_LANE else node.operands[:2] if rule == "blend" else ()
    return node.operands[_MADE_OF.get(node.op, slice(0))]
