"""Finds indices that are constant in each iteration of a loop, and all others.

Some languages only allow such indices (``Profile.computed_indices``): expressions of constants and
loop counters, which name no other variable. ``values.py`` refuses all others, and ``legalise`` has
these printed where they are used, instead of giving them names.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ...compiler.ir.node import Formal, Node, Op
from ...compiler.ir.operations import NATIVE
from ...compiler.ir.program import Program, Stage
from ...compiler.ir.stages import FRAGMENT
from ...compiler.ir.statements import Iterate, Loop, Region

COUNTED = frozenset({"add", "div", "mod", "mul", "neg", "sub"})
"""The operations that such an index may consist of."""
LARGEST = 16
"""The largest number of operations in such an index: it is repeated wherever it is used."""


def computed_places(stage: Stage) -> Iterator[int]:
    """The ids of elements and lanes with other indices, which a profile may not have.

    Storage buffers are left out, since other messages are about them, and so are arrays of uniforms
    in stages that compute vertices.
    """
    for node, counted in _elements(stage):
        source = _source(node.operands[0])
        is_free = source == "buffer" or (source == "parameter" and stage.row != FRAGMENT)
        if counted is None and not is_free:
            yield node.id


def counted_places(program: Program) -> frozenset[Node]:
    """The operations of the indices that are constant in each iteration."""
    found: set[Node] = set()
    for stage in program.stages:
        found.update(*(counted for _node, counted in _elements(stage) if counted))
    return frozenset(found)


def _elements(stage: Stage) -> Iterator[tuple[Node, list[Node] | None]]:
    """The elements and lanes that a stage reads, each with the operations of its index.

    The operations are ``None`` if the index is computed in another way.
    """
    counters = frozenset(_counters(stage.regions))
    for node in stage.nodes:
        if node.op == "index":
            yield node, _counted(node.operands[1], counters)


def _counters(regions: Iterable[Region]) -> Iterator[Formal]:
    """The counters of all loops."""
    pending = list(regions)
    while pending:
        for statement in pending.pop().statements:
            if isinstance(statement, Loop | Iterate):
                yield statement.index
            pending += statement.regions


def _source(aggregate: Node) -> Op:
    """The operation that an aggregate, or the aggregate around it, comes from."""
    while aggregate.op in ("index", "member"):
        aggregate = aggregate.operands[0]
    return aggregate.op


def _counted(place: Node, counters: frozenset[Formal]) -> list[Node] | None:
    """The operations of an index that consists of constants and loop counters; else ``None``."""
    operations: list[Node] = []
    pending = [place]
    for node in pending:  # The list grows on the way.
        if node.op == "constant" or (node.op == "formal" and node.data in counters):
            continue
        is_known = node.op == "native" and NATIVE.data(node) in COUNTED
        if not is_known or len(operations) == LARGEST:
            return None
        operations.append(node)
        pending += node.operands
    return operations
