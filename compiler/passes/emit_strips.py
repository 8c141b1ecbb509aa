"""Expansions for pipelines with a geometry stage, which emits them group by group.

``lower_stages.py`` calls ``count_strips`` before all passes where the stage itself is wanted, and
``split_stages`` calls ``groups_of`` at the end. In between, all groups are one graph, in which a
vertex has the number of its group, of its strip, and its own in the strip. In a text each group is
a loop of its own, so its number is known there, and the others become variables of loops.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from itertools import takewhile

from ...support.frozen import changed, frozen
from ..ir import build
from ..ir.expansion import EmittedStrips, Expansion
from ..ir.node import Formal, Graph, Node, reachable
from ..ir.operations import BUILTIN_OPS, INPUT, builtin_of
from ..ir.ranges import Ranges
from ..ir.rewrite import rewrite
from ..ir.shader import Notes, Shader
from ..ir.stages import GROUP, STRIP, STRIP_VERTEX
from ..ir.types import BOOL, INT, Vector, scalar_kind, width
from .simplify import Simplifier


def count_strips(shader: Shader) -> Shader:
    """Notes the ranges of the numbers of a shader's strips and vertices."""
    if shader.expansion is None:
        return shader
    groups = shader.expansion.groups
    most = {
        GROUP.name: len(groups),
        STRIP.name: max(group.strips for group in groups),
        STRIP_VERTEX.name: max(group.vertices for group in groups),
    }

    def rule(graph: Graph, node: Node, _operands: tuple[Node, ...]) -> Node | None:
        row = INPUT.data(node)
        if row.name not in most:
            return None
        return graph.node("input", row.type, (), changed(row, most=max(most[row.name] - 1, 0)))

    values = rewrite(shader.graph, shader.roots, rule, shader.notes.follow, ("input",))
    results = (changed(r, value=v) for r, v in zip(shader.results, values, strict=True))
    return changed(shader, results=tuple(results))


@frozen
class GroupValues:
    """The values that one group of strips needs."""

    strips: EmittedStrips
    strip: Formal
    vertex: Formal
    condition: Node
    """True if any strip is emitted."""
    count: Node
    """An upper bound of the number of strips."""
    emitted: Node
    """True if this strip is emitted; it is read only where ``condition`` holds."""
    delivered: tuple[Node, ...]
    """The values that are delivered at each vertex."""


def groups_of(
    graph: Graph, notes: Notes, expansion: Expansion, emitted: Sequence[Node], roots: Sequence[Node]
) -> tuple[GroupValues, ...]:
    """The values that each group needs of ``roots``; ``emitted`` has each group's condition."""
    ranges = Ranges(())
    simplifier = Simplifier(graph, ranges, notes)
    found = []
    for number, (strips, told) in enumerate(zip(expansion.groups, emitted, strict=True)):
        strip, vertex = Formal(strips.strip_name), Formal(strips.vertex_name)
        ranges.note_index(strip, strips.strips)
        ranges.note_index(vertex, strips.vertices)
        known = {
            GROUP.name: build.constant(graph, INT, number),
            STRIP.name: graph.node("formal", INT, (), strip)
            if strips.strips > 1
            else build.constant(graph, INT, 0),
            STRIP_VERTEX.name: graph.node("formal", INT, (), vertex),
        }
        value, *delivered = _known(simplifier, known, [told, *roots])
        if value.op != "constant" or value.data:
            conditions = _conditions(graph, strips, strip, value)
            found.append(GroupValues(strips, strip, vertex, *conditions, tuple(delivered)))
    return tuple(found) or (_nothing(graph, expansion, roots),)


def _conditions(
    graph: Graph, strips: EmittedStrips, strip: Formal, emitted: Node
) -> tuple[Node, Node, Node]:
    """Splits ``emitted``: is any strip emitted, how many at most, and is one of them.

    All three together say what ``emitted`` says. A condition may rely on those before it, so it
    comes before one only if it cannot: if it does not read what that is about.
    """
    count, told = build.constant(graph, INT, strips.strips), _joined(emitted)
    if builtin_of(told[0]) == "lt":
        number, end = told[0].operands
        if number.data == strip and strip not in end.variables:
            count, told = end, told[1:]
    common = list(takewhile(lambda each: _is_about_all(each, strip, count), told))
    return _all_of(graph, common), count, _all_of(graph, told[len(common) :])


def _is_about_all(condition: Node, strip: Formal, count: Node) -> bool:
    """True if a condition is the same for all strips, and does not depend on their number."""
    if strip in condition.variables:
        return False
    return count.op == "constant" or count not in reachable([condition])


def _joined(condition: Node) -> list[Node]:
    """The conditions that all have to hold, from left to right."""
    if builtin_of(condition) != "and":
        return [condition]
    return [part for operand in condition.operands for part in _joined(operand)]


def _all_of(graph: Graph, conditions: Sequence[Node]) -> Node:
    if not conditions:
        return build.constant(graph, BOOL, True)
    return reduce(lambda a, b: graph.node("native", BOOL, (a, b), "and"), conditions)


def _nothing(graph: Graph, expansion: Expansion, roots: Sequence[Node]) -> GroupValues:
    """The values of a group where no condition can hold, so that nothing is emitted.

    Compilers want to see some vertex, and one alone makes no triangle and no line. But it is a
    point, so of points there are none.
    """
    zeros = []
    for root in roots:
        kind = scalar_kind(root.type)
        assert kind is not None
        zero = build.neutral("add", kind)
        lanes = (zero,) * width(root.type) if isinstance(root.type, Vector) else zero
        zeros.append(build.constant(graph, root.type, lanes))
    emitted = build.constant(graph, BOOL, True)
    alone = EmittedStrips("strip", 1, 1)
    if expansion.emits == "point":
        alone = EmittedStrips("points", 0, 1)
    names = Formal(alone.strip_name), Formal(alone.vertex_name)
    one = build.constant(graph, INT, 1)
    return GroupValues(alone, *names, emitted, one, emitted, tuple(zeros))


def _known(
    simplifier: Simplifier, numbers: dict[str, Node], roots: Sequence[Node]
) -> Sequence[Node]:
    """The roots with these numbers put in.

    Choices between groups are made, and numbers of corners that have become certain. Nothing else
    is changed: the other passes have done their work.
    """

    def rule(_graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        if node.op == "input":
            return numbers.get(INPUT.data(node).name)
        constants = [operand.op == "constant" for operand in operands]
        if node.op == "select" and constants[0]:
            return operands[1] if operands[0].data else operands[2]
        is_known = all(constants) or node.data == "clamp"
        if node.op in BUILTIN_OPS and operands != node.operands and is_known:
            return simplifier.make(node.op, node.type, operands, node.data)
        return None

    return rewrite(simplifier.graph, roots, rule, simplifier.notes.follow)
