"""Prints the body of a geometry stage: a loop for each group of strips, and one for their vertices.

``stage.py`` calls ``Strips.emitted`` where a stage emits vertices.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from ...compiler.ir.node import Formal, Node
from ...compiler.ir.program import Output, Stage
from ...compiler.ir.statements import EmittedGroup, EmittedPart
from ...compiler.ir.types import INT
from .literals import literal
from .statements import Lines, Statements

Delivered = Callable[[Output, str], Iterator[str]]
"""The lines that hand on the value of an output, whose text is given."""


class Strips(Statements):
    """The statements of a body that emits vertices."""

    def emitted(self, stage: Stage, delivered: Delivered) -> list[str]:
        """The statements that all groups share, and then the groups, one after the other."""
        return self.laid_out(self._all(stage, delivered))

    def _all(self, stage: Stage, delivered: Delivered) -> Lines:
        yield from self._region(stage.region)
        for part in stage.emitted:
            yield from self._where(part.condition, self._part(part, stage.results, delivered))

    def _where(self, condition: Node, block: Lines) -> Lines:
        """A block inside an ``if`` with a condition; without the test if it always holds."""
        if condition.op == "constant":
            if condition.data:
                yield from block
            return
        text = self._expressions.text(condition)
        yield self._mark(self._forms.if_.format(condition=text), condition)
        with self._inside():
            yield block
        yield self._forms.end

    def _counted(self, number: Formal, count: str, about: Node, block: Lines) -> Lines:
        """A loop. Its variable is visible behind the loop, too, as some compilers remark."""
        index = self._namer.declare(number.name)
        self._expressions.formals[number] = index
        text = self._forms.loop.format(
            index=index,
            index_typed=self._types.declare(index, INT),
            zero=literal(0, "int", self._literals),
            count=count,
        )
        yield self._mark(text, about)
        with self._inside():
            yield block
        yield self._forms.end

    def _part(self, part: EmittedPart, outputs: Sequence[Output], delivered: Delivered) -> Lines:
        yield from self._region(part.region)
        for group in part.groups:
            strip = self._strip(group, self._vertex(group, outputs, delivered))
            if group.strips.strips > 1:
                yield from self._counted(group.strip, self._count_of(group), group.count, strip)
            else:
                yield from strip

    def _count_of(self, group: EmittedGroup) -> str:
        """The number of strips; never more than the bound, whatever the host has set."""
        bound = literal(group.strips.strips, "int", self._literals)
        if group.count.op == "constant":
            return bound
        return self._forms.at_most.format(value=self._expressions.text(group.count), bound=bound)

    def _strip(self, group: EmittedGroup, vertex: Lines) -> Lines:
        yield from self._region(group.head)
        yield from self._where(group.emitted, self._vertices(group, vertex))

    def _vertices(self, group: EmittedGroup, vertex: Lines) -> Lines:
        yield from self._region(group.entered)
        count = literal(group.strips.vertices, "int", self._literals)
        yield from self._counted(group.vertex, count, group.delivered[0], vertex)
        if not _stands_alone(group):
            yield self._mark(self._forms.end_strip, group.delivered[0])

    def _vertex(
        self, group: EmittedGroup, outputs: Sequence[Output], delivered: Delivered
    ) -> Lines:
        yield from self._region(group.body)
        for output, value in zip(outputs, group.delivered, strict=True):
            for line in delivered(output, self._expressions.text(value)):
                yield self._mark(line, value)
        value = group.delivered[0]
        yield self._mark(self._forms.emit_vertex, value)
        if _stands_alone(group) and group.strips.kind.emits == "triangle":
            last = self._expressions.formals[group.vertex]
            yield self._mark(self._forms.if_.format(condition=f"{last} % 3 == 2"), value)
            yield iter([self._mark(self._forms.end_strip, value)])
            yield self._forms.end


def _stands_alone(group: EmittedGroup) -> bool:
    """True if no strip joins the group: several separate triangles, or points.

    Each of the triangles is a strip of its own; points are in no strip.
    """
    kind = group.strips.kind
    return not kind.is_joined and (kind.emits == "point" or group.strips.primitives > 1)
