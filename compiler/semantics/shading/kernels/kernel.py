"""A kernel as a shader: each result is a function of the element's number.

``Frontend`` calls ``kernel_shader`` for each kernel of a file that is not abstract.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from .....support.frozen import changed, frozen
from ....diagnostics import rules
from ....diagnostics.diagnostic import Label, Report
from ....diagnostics.source import Span
from ....ir.kernel import MOST_INVOCATIONS, USUAL, WorkGroup, invocations
from ....ir.node import Graph, Node
from ....ir.shader import BufferInfo, Notes, Result, Shader, TextureInfo
from ....ir.stages import COMPUTE, COMPUTED, EXTENT
from ....ir.types import INT, Opaque, width
from ....syntax import ast
from ...checking.expressions import RULES
from ...declarations.contracts import as_declared
from ...declarations.externs import read_externs
from ...declarations.fitting import typed
from ...declarations.parameters import all_parameters, leaves_of, of_kind
from ...declarations.written_types import declared_type
from ...inheritance.flattening import Records
from ...inheritance.records import Record
from ...lowering.outlining import lowered
from ...names.modules import Module, Symbol
from ...state.context import Context
from ...state.evaluation import node_of
from ...state.scope import Failure, Instance, Scope
from ..instances import instance_of
from ..intents import with_intents
from ..room import has_room
from ..slot_checks import check_instance
from ..unread_slots import NamedIn, warn_of_unread
from .extents import ELEMENTS, declared_extent, exists_in_kernels, known_extent, written_buffer
from .group_results import check_no_groups, is_per_group, of_each_group
from .images import (
    extent_type,
    extent_words,
    image_result,
    is_image,
    is_other_image,
    mixed,
    report_other_image,
)
from .scattering import scattered
from .stored_parts import is_writable, stores


def work_group_of(ctx: Context, record: Record, dimensions: int) -> WorkGroup:
    """The size of a kernel's work groups; the usual one after reporting an error in it."""
    usual = USUAL[dimensions]
    found = next(iter(record.every(ast.WorkGroup)), None)
    if found is None:
        return usual
    member, owner, _level = found
    if len(member.sides) > dimensions:
        ctx.report.add(
            rules.WORK_GROUP_SIDES, member.span, sides=len(member.sides), dimensions=dimensions
        )
        return usual
    scope = Scope(owner.module)
    values = [
        ctx.constants.integer(typed(ctx, side, scope, INT, "int"), side.span)
        for side in member.sides
    ]
    sides = [value for value in values if value is not None]
    if len(sides) < len(values):
        return usual
    x, y, z = (*sides, 1, 1)[:3]
    group = (x, y, z)
    if min(group) < 1 or invocations(group) > MOST_INVOCATIONS:
        ctx.report.add(
            rules.WORK_GROUP_SIZE, member.span, size=" by ".join(map(str, sides)),
            most=MOST_INVOCATIONS,
        )  # fmt: skip
        return usual
    return group


@frozen
class _Extent:
    """The number of elements for which a kernel runs, as one of its members says it."""

    node: Node
    name: str
    said_by: str
    """The words for that member in messages."""
    span: Span
    what: str


@frozen
class _Written:
    """The part that a kernel writes by one of its members."""

    buffer: BufferInfo | None
    """The buffer that it writes; ``None`` for an image."""
    results: list[Result]


def kernel_shader(
    symbol: Symbol, module: Module, report: Report, records: Records
) -> Shader | None:
    """The shader of a kernel, or ``None`` after reporting why there is none."""
    if not has_room(symbol, records, report):
        return None
    ctx = Context(report, records, RULES)
    record = records.of(symbol)
    leaves = leaves_of(ctx, record)
    instance = instance_of(ctx, record, leaves)
    declaration = symbol.declaration
    assert isinstance(declaration, ast.Record)
    if not _writes_something(ctx, record, declaration):
        return None
    extents = _extents(ctx, record, instance)
    if not extents:
        return None
    ctx.extent = extents[0].node
    group = work_group_of(ctx, record, width(ctx.extent.type))
    written = _all_written(ctx, record, instance, group)
    if ctx.extent.type != INT:
        drawn = [result for each in written for result in each.results]
        check_no_groups(ctx, drawn, "a kernel over images", declaration.name.span)
    check_instance(ctx, instance)
    read_externs(ctx, module)
    ctx.deferred.report()
    if report.failed:
        return None
    warn_of_unread(ctx, record, beside=NamedIn(record.symbol.module))
    results = [Result(EXTENT, COMPUTE, ctx.extent)]
    results += [result for each in written for result in each.results]
    made = _lowered(ctx, results, extents)
    if made is None:
        return None
    lowered_results, graph, notes = made
    externs = ctx.externs.infos
    return Shader(
        name=symbol.name,
        doc=declaration.doc,
        pass_name="",
        rig_name="",
        graph=graph,
        notes=notes,
        parameters=all_parameters(leaves, externs),
        textures=with_intents(
            of_kind(TextureInfo, leaves), ctx.meanings, [each.value for each in results]
        ),
        attributes=(),
        results=lowered_results,
        externs=externs,
        buffers=of_kind(BufferInfo, leaves),
        written=tuple(each.buffer for each in written if each.buffer is not None),
        chain=COMPUTED,
        work_group=group,
    )  # fmt: skip


def _writes_something(ctx: Context, record: Record, declaration: ast.Record) -> bool:
    """True if a kernel has anything to write, each in one way; reported if not."""
    results = {member.name.text: member for member, _, _ in record.every(ast.Result)}
    scatters = [member for member, _, _ in record.every(ast.Scatter)]
    name = declaration.name
    is_empty = not results and not scatters and not record.baseless
    if is_empty and not ctx.report.unread_names:  # Unreadable text may have been a result.
        ctx.report.add(rules.NO_RESULT, name.span, name=name.text)
    for member in scatters:
        if (other := results.get(member.name.text)) is not None:
            ctx.report.add(
                rules.WRITTEN_TWICE, member.name.span, name=member.name.text,
                labels=[Label(other.name.span, "a result")],
            )  # fmt: skip
    tells = any(record.every(ast.Extent)) or any(each.per is None for each in results.values())
    if (results or scatters) and not tells:
        ctx.report.add(rules.NO_KERNEL_EXTENT, name.span, name=name.text)
    return not (results and mixed(ctx, [*results.values(), *scatters]))


def _scope(owner: Symbol, instance: Instance, level: int) -> Scope:
    return Scope(owner.module, instance, level)


# --- how many elements ---------------------------------------------------------------------------


def _extents(ctx: Context, record: Record, instance: Instance) -> list[_Extent]:
    """The extent by each member, which should all be the same."""
    found = []
    for own, owner, level in record.every(ast.Extent):
        node = known_extent(ctx, record.name, own.count, _scope(owner, instance, level))
        if node is not None:
            found.append(_Extent(node, record.name, "`runs over` says", own.count.span, ELEMENTS))
    for member, owner, level in record.every(ast.Result):
        if is_per_group(ctx, member):
            continue
        if is_other_image(member):
            report_other_image(ctx, member)
            continue
        name, what = member.name.text, extent_words(member)
        scope = _scope(owner, instance, level)
        node = declared_extent(ctx, name, member.type, scope, extent_type(member), what)
        if node is not None:
            found.append(_Extent(node, name, f"`{name}`", member.type.span, what))
    return found


def _lowered(
    ctx: Context, results: Sequence[Result], extents: Sequence[_Extent]
) -> tuple[tuple[Result, ...], Graph, Notes] | None:
    """The results as one graph; ``None`` after reporting that their extents differ.

    Where they are written, equal extents are values of their own; in the graph they are one.
    """
    roots = [*(result.value for result in results), *(extent.node for extent in extents)]
    every, graph, notes = lowered(ctx, roots)
    values, same = every[: len(results)], every[len(results) :]
    pairs = zip(extents, same, strict=True)
    differ = [extent for extent, node in pairs if node is not same[0]]
    for extent in differ:
        ctx.report.add(
            rules.EXTENTS_DIFFER, extent.span, name=extent.name, what=extent.what,
            first=extents[0].said_by,
        )  # fmt: skip
    found = tuple(changed(r, value=value) for r, value in zip(results, values, strict=True))
    return None if differ else (found, graph, notes)


# --- results -------------------------------------------------------------------------------------


def _all_written(
    ctx: Context, record: Record, instance: Instance, group: WorkGroup
) -> list[_Written]:
    """The parts that all members of a kernel write, without those with errors."""
    found = []
    for result, owner, level in record.every(ast.Result):
        found.append(_result(ctx, result, _scope(owner, instance, level), group))
    for scatter, owner, level in record.every(ast.Scatter):
        made = scattered(ctx, scatter, _scope(owner, instance, level))
        found.append(None if made is None else _Written(*made))
    return [each for each in found if each is not None]


def _result(ctx: Context, member: ast.Result, scope: Scope, group: WorkGroup) -> _Written | None:
    """The declaration of a result, and the value of an element or a texel."""
    if is_image(member):
        image = image_result(ctx, member, scope)
        if image is None or not exists_in_kernels(ctx, image.value, member.value.span):
            return None
        return _Written(None, [image])
    written = changed(member.type, count=None, unsized=False)
    element = declared_type(ctx, written, scope.module)
    if element is None:
        return None
    if isinstance(element.type, Opaque) or not is_writable(element.type):
        ctx.report.add(rules.NOT_WRITABLE, member.type.span, type=element.text)
        return None
    value = as_declared(
        ctx, node_of(ctx, member.value, scope, element), element, member.value, scope
    )
    if isinstance(value, Failure) or not exists_in_kernels(ctx, value, member.value.span):
        return None
    info = written_buffer(member.name, member.doc, element)
    parts: Iterable[Result] = stores(ctx, info, value)
    if member.per is not None:
        parts = of_each_group(ctx, info, parts, group)
    return _Written(info, list(parts))
