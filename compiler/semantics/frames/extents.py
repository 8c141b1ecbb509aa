"""The size of a kernel's images, in terms of the frame that runs it.

A kernel says so in terms of its own parameters and textures. Where the frame gives these, the size
is a number of the frame, which is known before anything is drawn.
"""

from __future__ import annotations

from collections.abc import Callable

from ...ir.leaves import Parameter, Texture
from ...ir.node import Node, reachable
from ...ir.operations import BINDING, builtin_of
from ...ir.types import INT
from ..state.tree import Tree

SIZE = "texture_size"


def in_frame(
    tree: Tree,
    extent: Node,
    number_of: Callable[[Parameter], Node | None],
    size_of: Callable[[Texture], Node | None],
) -> Node | None:
    """``extent`` as a tree of the frame; ``None`` where the frame does not give all of it.

    ``number_of`` tells what the frame gives a parameter, and ``size_of`` the size of a texture.
    """
    made: dict[int, Node] = {}
    for node in reachable([extent]):
        found: Node | None
        if isinstance(node.data, Parameter):
            found = number_of(node.data)
        elif isinstance(node.data, Texture):
            continue
        elif builtin_of(node) == SIZE:
            texture, level = node.operands[0], node.operands[-1]
            assert isinstance(texture.data, Texture)
            is_first = len(node.operands) == 1 or (level.op, level.data) == ("constant", 0)
            found = (
                size_of(texture.data) if is_first and level.type in (INT, texture.type) else None
            )
        elif node.op in BINDING or any(operand.id not in made for operand in node.operands):
            found = None
        else:
            operands = tuple(made[operand.id] for operand in node.operands)
            found = tree.node(node.op, node.type, operands, node.data)
        if found is not None:
            made[node.id] = found
    return made.get(extent.id)
