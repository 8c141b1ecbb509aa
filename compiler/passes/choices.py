"""Tells which operations choose, and so may leave an operand out.

``schedule`` asks for it: what comes of a choice printed in place, and which of them to make a
branch.
"""

from __future__ import annotations

from ...stdlib.builtins import BUILTINS
from ..ir.node import Node
from ..ir.types import BOOL

_SHORT_CIRCUITING = frozenset(name for name, row in BUILTINS.items() if row.short_circuits)


def chooses(node: Node) -> bool:
    """Whether a node is a ``?:``, ``&&`` or ``||`` where it is printed in place."""
    return node.op == "select" or (
        node.op == "native" and node.data in _SHORT_CIRCUITING and node.type == BOOL
    )


def may_skip(user: Node, position: int) -> bool:
    """Whether an operand that is printed in place is computed for some pixels only.

    A ``?:`` evaluates one of its sides, ``&&`` and ``||`` the right one where the left does not
    decide.
    """
    return position > 0 and chooses(user)
