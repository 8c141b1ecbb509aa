"""What the steps of a frame leave, while they are put together, and the numbers they are given."""

from __future__ import annotations

from collections.abc import Mapping

from ....frozen import fresh, frozen, record
from ...ir.frame import Elements, FromHost, Image, Previous
from ...ir.node import Node
from ..state.scope import FAILURE, Failure


@frozen(eq=False)
class StepValue:
    """What a step leaves, by name: images, and the buffers of a kernel."""

    name: str
    left: Mapping[str, Image | Elements]


Made = StepValue | Image | Elements | Previous | FromHost | Failure
"""The value of an expression about steps."""


@record
class Numbers:
    """The numbers that the host computes for a frame; the plan refers to them by their places."""

    nodes: list[Node] = fresh(factory=list)

    def number(self, node: Node | Failure) -> int | Failure:
        """The place of a value among them."""
        if isinstance(node, Failure):
            return FAILURE
        self.nodes.append(node)
        return len(self.nodes) - 1
