"""The captures of a pass: values that it writes to a buffer for each vertex, instead of drawing.

``elaborate.py`` calls ``captures_of`` for every pass.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ....diagnostics import rules
from ....diagnostics.diagnostic import Label
from ....ir.capture import Capture, laid_out
from ....ir.node import Node
from ....ir.shader import Result
from ....ir.stages import CAPTURE, VERTEX
from ....ir.types import Scalar, Vector, scalar_kind, width
from ....syntax import ast
from ...declarations.contracts import as_declared
from ...declarations.written_types import declared_type
from ...inheritance.records import Record
from ...names.modules import Symbol
from ...state.context import Context
from ...state.evaluation import node_of
from ...state.scope import Failure, Instance
from ..instances import pass_scope

MOST_NUMBERS = 64
"""The number of a vertex's numbers that every device captures.

OpenGL, ES 3.0, Vulkan and Direct3D promise it.
"""


def captures(record: Record) -> bool:
    """True if a pass captures vertices, so that there are no fragments."""
    return any(True for _ in record.every(ast.Capture))


def capture_of(record: Record, results: Iterable[Result]) -> Capture | None:
    """The layout of the captured values in the buffer; ``None`` for a pass that draws."""
    written = {member.name.text: member.type for member, *_ in record.every(ast.Capture)}
    if not written:
        return None
    return laid_out(
        (result.name, result.value.type, written[result.name].span.text, result.doc)
        for result in results
        if result.kind == CAPTURE
    )


def captures_of(ctx: Context, passing: Instance) -> Iterator[Result]:
    """A result for each capture of a pass, in the order in which they lie in the buffer."""
    written = list(passing.record.every(ast.Capture))
    if written:
        _check_that_nothing_is_drawn(ctx, passing.record, written[0][0])
    count = 0
    for member, owner, level in written:
        value = _value(ctx, passing, member, owner, level)
        if value is not None:
            surface, name = passing.surface, member.name.text
            stage = VERTEX if surface is None else surface.vertex_stage
            ctx.notes.names.setdefault(value.id, name)
            yield Result(CAPTURE, stage, value, name, member.doc)
            count += width(value.type)
            if count > MOST_NUMBERS >= count - width(value.type):
                ctx.report.add(
                    rules.CAPTURES_TOO_MUCH, member.name.span, count=count, most=MOST_NUMBERS
                )


def _check_that_nothing_is_drawn(ctx: Context, record: Record, first: ast.Capture) -> None:
    kinds = ast.Target, ast.Discard, ast.Clear, ast.Layers, ast.Views, ast.Raster, ast.Depth
    drawn = [member for kind in kinds for member, *_ in record.every(kind)]
    if drawn:
        labels = [Label(member.span, "drawn here") for member in drawn]
        ctx.report.add(rules.CAPTURES_AND_DRAWS, first.name.span, name=record.name, labels=labels)


def _value(
    ctx: Context, passing: Instance, member: ast.Capture, owner: Symbol, level: int
) -> Node | None:
    """The captured value of each vertex; ``None`` after a report of why it cannot be."""
    declared = declared_type(ctx, member.type, owner.module)
    if declared is None:
        return None
    if not isinstance(declared.type, Scalar | Vector) or scalar_kind(declared.type) == "bool":
        ctx.report.add(rules.CANNOT_CAPTURE, member.type.span, type=declared.text)
        return None
    scope = pass_scope(owner, passing, level)
    node = node_of(ctx, member.value, scope, declared)
    found = as_declared(ctx, node, declared, member.value, scope)
    if isinstance(found, Failure):
        return None
    placed = ctx.crossings.checked_at_vertex(found, member.value.span)
    return None if isinstance(placed, Failure) else placed
