"""Finds the values that are the same all over a draw and need no shader to compute them.

Three passes ask this: ``move_to_vertices``, whose proof needs constant factors; ``inline``, which
writes a body out if constant arguments leave little of it; and ``expand_builtins``, which keeps
apart what may be hoisted later. ``hoist`` decides whether such a value really leaves the shader, as
that depends on the parameters' groups.
"""

from __future__ import annotations

from ..ir.node import Node
from ..ir.operations import BINDING, joins_group
from .elements import is_element

_CONSTANT = frozenset({"constant", "parameter"})
_VARYING = BINDING | {"cross"}


class DrawConstants:
    """Made of constants and parameters only, without loops and functions, which stay in the shader.

    Each node is looked at once, when a value that needs it is first asked about.
    """

    def __init__(self, *, elements: bool = False) -> None:
        """``elements`` says that elements of parameters' arrays count too, at whatever position.

        A host can compute the values that depend on one for each of them.
        """
        self._elements = elements
        self._known: dict[int, bool] = {}

    def __contains__(self, root: Node) -> bool:
        """True if a value is the same all over the draw."""
        known = self._known
        pending = [root]
        while pending:
            node = pending[-1]
            if node.id in known:
                pending.pop()
                continue
            own = self._by_itself(node)
            if own is None:
                # One operand that varies decides: those behind it are not looked at.
                for operand in node.operands:
                    theirs = known.get(operand.id)
                    if theirs is None:
                        pending.append(operand)
                        break
                    if not theirs:
                        own = False
                        break
                else:
                    own = True
            if own is not None:
                known[node.id] = own
        return known[root.id]

    def _by_itself(self, node: Node) -> bool | None:
        """The answer for a node that needs no look at its operands; ``None`` if they decide."""
        if node.op in _CONSTANT or (self._elements and is_element(node)):
            return True
        varies = node.op in _VARYING or not node.operands or joins_group(node)
        return False if varies else None
