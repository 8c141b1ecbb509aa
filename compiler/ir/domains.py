"""Derives over which domain each value varies: a draw, a view, an instance, a vertex, a fragment.

Semantics asks for it in order to know what has to cross between stages, and the verifier in order
to make sure that no operation mixes values of two stages. A node's domain follows from those of its
operands, so it is derived once for each node.
"""

from __future__ import annotations

from .leaves import Attribute
from .node import AGE, Node
from .stages import INSTANCES, VERTICES, VIEWS, Crossing, Domain, SystemInput


class MixedDomainsError(Exception):
    """An operation of values that no stage has side by side."""

    def __init__(self, node: Node, reason: str) -> None:
        super().__init__(reason)
        self.node = node


class Domains:
    """The domains of the nodes of one graph, each worked out when it is first asked for."""

    def __init__(self) -> None:
        self._found: dict[int, Domain | None] = {}

    def of(self, root: Node) -> Domain | None:
        """The domain of a value; ``None`` where it is the same all over the draw.

        A variable of a binder counts as the same everywhere: its domain is that of its arguments.
        Raises ``MixedDomainsError`` where the value is made of values of different stages.
        """
        if root.id not in self._found:
            missing = {root}
            pending = [root]
            for node in pending:  # The list grows on the way.
                new = {o for o in node.operands if o.id not in self._found} - missing
                missing |= new
                pending += new
            for node in sorted(missing, key=AGE):
                self._found[node.id] = self._domain(node)
        return self._found[root.id]

    def _domain(self, node: Node) -> Domain | None:
        match node.data:
            case Attribute(step=step):
                return step
            case SystemInput(domain=domain):
                return domain
            case Crossing(origin=origin, destination=destination):
                value, *corner = node.operands
                if not exists(self._found[value.id], origin):
                    raise MixedDomainsError(node, f"crosses from another domain than {origin}")
                if not all(exists(self._found[number.id], destination) for number in corner):
                    raise MixedDomainsError(node, f"a corner that is none per {destination}")
                return destination
        found: Domain | None = None
        for operand in node.operands:
            other = self._found[operand.id]
            if exists(found, other):
                found = other
            elif {found, other} == {VIEWS, INSTANCES}:
                found = VERTICES
            elif not exists(other, found):
                raise MixedDomainsError(node, f"made of values per {found} and per {other}")
        return found


def exists(domain: Domain | None, other: Domain | None) -> bool:
    """True if a value that varies over ``domain`` also exists at each place of ``other``."""
    if domain is None or domain == other:
        return True
    if domain == VIEWS:
        return other not in (None, INSTANCES)
    return (domain, other) == (INSTANCES, VERTICES)
