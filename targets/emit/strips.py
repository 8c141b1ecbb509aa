"""Prints what a geometry stage does: a loop for each group of strips, and one for their vertices.

``stage.py`` calls ``Strips.lines_of`` where a stage emits vertices.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from ...compiler.ir.node import Formal, Node
from ...compiler.ir.program import EmittedGroup, Output
from ...compiler.ir.types import INT
from .literals import literal
from .statements import Lines, Statements

Delivered = Callable[[Output, str], Iterator[str]]
"""The lines that hand on the value of an output, whose text is given."""


class Strips(Statements):
    """The statements of a body that emits vertices."""

    def lines_of(self, groups: Sequence[EmittedGroup], delivered: Delivered) -> list[str]:
        """All groups, one after the other."""
        return self.laid_out(line for group in groups for line in self._group(group, delivered))

    def _group(self, group: EmittedGroup, delivered: Delivered) -> Lines:
        if group.strips.strips > 1:
            yield self._counting(group.strip, group.strips.strips, group.emitted)
            with self._inside():
                yield self._strip(group, delivered)
            yield self._forms.end
            self._namer.leave()
        else:
            yield from self._strip(group, delivered)

    def _counting(self, number: Formal, count: int, about: Node) -> str:
        """The line that opens a loop; what is declared after this call is inside of it."""
        index = self._namer.declare(number.name)
        self._namer.enter()
        self._expressions.formals[number] = index
        text = self._forms.loop.format(
            index=index,
            index_typed=self._types.declare(index, INT),
            zero=literal(0, "int", self._literals),
            count=literal(count, "int", self._literals),
        )
        return self._mark(text, about)

    def _strip(self, group: EmittedGroup, delivered: Delivered) -> Lines:
        yield from self._region(group.head)
        emitted = group.emitted
        if emitted.op == "constant":
            if emitted.data:
                yield from self._vertices(group, delivered)
            return
        condition = self._expressions.text(emitted)
        yield self._mark(self._forms.if_.format(condition=condition), emitted)
        with self._inside():
            yield self._vertices(group, delivered)
        yield self._forms.end

    def _vertices(self, group: EmittedGroup, delivered: Delivered) -> Lines:
        value = group.results[0].value
        yield self._counting(group.vertex, group.strips.vertices, value)
        yield self._vertex(group, delivered)
        yield self._forms.end
        self._namer.leave()
        if not _stands_alone(group):
            yield self._mark(self._forms.end_strip, value)

    def _vertex(self, group: EmittedGroup, delivered: Delivered) -> Lines:
        with self._inside():
            yield from self._region(group.body)
            for output in group.results:
                for line in delivered(output, self._expressions.text(output.value)):
                    yield self._mark(line, output.value)
            value = group.results[0].value
            yield self._mark(self._forms.emit_vertex, value)
            if _stands_alone(group) and group.strips.triangles:
                last = self._expressions.formals[group.vertex]
                yield self._mark(self._forms.if_.format(condition=f"{last} % 3 == 2"), value)
                yield iter([self._mark(self._forms.end_strip, value)])
                yield self._forms.end


def _stands_alone(group: EmittedGroup) -> bool:
    """Whether there are several triangles that share no vertices, so that each is a strip of its
    own; or points, which are in no strip."""
    strips = group.strips
    return strips.shape == "points" or (strips.shape == "list" and strips.triangles > 1)
