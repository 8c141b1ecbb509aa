"""Tells the places of elements that are constant in each turn of a loop from all others.

In some languages only such places are allowed (``Profile.computed_indices``): expressions of
constants and of the numbers of turns, which name no other variable. ``values.py`` refuses all
others, and ``legalise`` has these printed where they are used, instead of giving them names.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ...compiler.ir.node import Formal, Node, Op
from ...compiler.ir.operations import NATIVE
from ...compiler.ir.program import Program, Stage
from ...compiler.ir.stages import FRAGMENT
from ...compiler.ir.statements import Iterate, Loop, Region
from ...compiler.passes.walks import visible

COUNTED = frozenset({"add", "div", "mod", "mul", "neg", "sub"})
"""The operations of which such a place is made."""
LARGEST = 16
"""Of how many operations at most, as they are written again wherever the place is used."""


def computed_places(stage: Stage) -> Iterator[int]:
    """The ids of the elements and lanes whose places are others, besides those of storage buffers,
    of which more is told, and of arrays of uniforms where vertices are computed."""
    for node, counted in _elements(stage):
        source = _source(node.operands[0])
        is_free = source == "buffer" or (source == "parameter" and stage.row != FRAGMENT)
        if counted is None and not is_free:
            yield node.id


def counted_places(program: Program) -> frozenset[Node]:
    """The operations of which the places are made that are constant in each turn."""
    found: set[Node] = set()
    for stage in program.stages:
        found.update(*(counted for _node, counted in _elements(stage) if counted))
    return frozenset(found)


def _elements(stage: Stage) -> Iterator[tuple[Node, list[Node] | None]]:
    """The elements and lanes that a stage reads by a place, each with the operations that the place
    is made of; ``None`` if it is computed."""
    counters = frozenset(_counters(stage.regions))
    for node in visible(stage.roots, into_bodies=True):
        if node.op == "index":
            yield node, _counted(node.operands[1], counters)


def _counters(regions: Iterable[Region]) -> Iterator[Formal]:
    """The numbers of turns of all loops."""
    pending = list(regions)
    while pending:
        for statement in pending.pop().statements:
            if isinstance(statement, Loop | Iterate):
                yield statement.index
            pending += statement.regions


def _source(aggregate: Node) -> Op:
    """The operation that an aggregate comes from, or that of which it is a part."""
    while aggregate.op in ("index", "member"):
        aggregate = aggregate.operands[0]
    return aggregate.op


def _counted(place: Node, counters: frozenset[Formal]) -> list[Node] | None:
    """The operations that a place is made of, if it is made of constants and numbers of turns."""
    operations: list[Node] = []
    pending = [place]
    for node in pending:  # It grows on the way.
        if node.op == "constant" or (node.op == "formal" and node.data in counters):
            continue
        is_known = node.op == "native" and NATIVE.data(node) in COUNTED
        if not is_known or len(operations) == LARGEST:
            return None
        operations.append(node)
        pending += node.operands
    return operations
