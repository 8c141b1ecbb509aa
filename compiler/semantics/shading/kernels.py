"""A kernel as a shader: each result is a function of the element's number.

``Frontend`` calls ``kernel_shader`` for each kernel of a file that is not abstract.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ....frozen import changed
from ...diagnostics import rules
from ...diagnostics.diagnostic import Report
from ...ir import build
from ...ir.kernel import WRITTEN_GROUP
from ...ir.leaves import Buffer
from ...ir.node import Graph, Node, reachable
from ...ir.shader import BufferInfo, Notes, ParameterInfo, Result, Shader, Store
from ...ir.stages import COMPUTE, COMPUTED, EXTENT, STORE
from ...ir.storage import elements_in_row
from ...ir.types import (
    UINT,
    Array,
    Matrix,
    Opaque,
    RuntimeArray,
    Scalar,
    Struct,
    Type,
    Vector,
    width,
    with_width,
)
from ...syntax import ast
from ..checking.expressions import RULES
from ..declarations.buffers import element_info
from ..declarations.contracts import as_declared
from ..declarations.externs import read_externs
from ..declarations.fitting import fit
from ..declarations.parameters import leaves_of
from ..declarations.written_types import declared_type
from ..inheritance.flattening import Records
from ..lowering.outlining import lowered
from ..names.modules import Module, Symbol
from ..state.context import Context
from ..state.crossings import missing_in_kernels
from ..state.evaluation import node_of
from ..state.scope import Failure, Instance, Scope
from ..types.typenames import Declared
from .images import extent_type, extent_words, image_result, is_image, mixed, reads_only_sizes
from .instances import instance_of
from .slot_checks import check_instance
from .work_groups import work_group_of

_KNOWN_TO_HOST = frozenset(
    {"constant", "parameter", "call", "native", "select", "vector", "splat", "matrix", "as"}
    | {"swizzle", "index", "member", "called", "struct", "array", "resource"}
)
"""Operations by which a host computes how many elements a result has, or of which size it is."""

Written = tuple[BufferInfo, Node] | Result
"""A buffer, and the value of one of its elements; or an image."""


def kernel_shader(
    symbol: Symbol, module: Module, report: Report, records: Records
) -> Shader | None:
    """The shader of a kernel, or ``None`` after reporting why there is none."""
    ctx = Context(report, records, RULES)
    record = records.of(symbol)
    leaves = leaves_of(ctx, record)
    instance = instance_of(ctx, record, leaves)
    statements = list(record.every(ast.Result))
    declaration = symbol.declaration
    assert isinstance(declaration, ast.Record)
    if not statements and not record.baseless:
        report.add(rules.NO_RESULT, declaration.name.span, name=symbol.name)
    if statements and mixed(ctx, [member for member, _owner, _level in statements]):
        return None
    extents = [_extent(ctx, member, _scope(owner, instance, level))
               for member, owner, level in statements]  # fmt: skip
    ctx.extent = next((each for each in extents if each is not None), None)
    if ctx.extent is None:
        return None
    found = [_result(ctx, member, _scope(owner, instance, level))
             for member, owner, level in statements]  # fmt: skip
    check_instance(ctx, instance)
    group = work_group_of(ctx, record, width(ctx.extent.type))
    read_externs(ctx, module)
    ctx.deferred.report()
    if report.failed:
        return None
    results = [Result(EXTENT, COMPUTE, ctx.extent)]
    buffers = [written for written in found if isinstance(written, tuple)]
    for info, value in buffers:
        results += _stores(ctx, info, value)
    results += [written for written in found if isinstance(written, Result)]
    made = _lowered(ctx, results, statements, [each for each in extents if each is not None])
    if made is None:
        return None
    lowered_results, graph, notes = made
    counts = [info.count for info in leaves.buffers]
    externs = ctx.externs.infos
    return Shader(
        name=symbol.name,
        doc=declaration.doc,
        pass_name="",
        rig_name="",
        graph=graph,
        notes=notes,
        parameters=(
            *leaves.parameters, *counts, *(m.info for block in externs for m in block.members),
        ),
        resources=leaves.resources,
        attributes=(),
        results=lowered_results,
        externs=externs,
        buffers=leaves.buffers,
        written=tuple(info for info, _value in buffers),
        chain=COMPUTED,
        work_group=group,
    )  # fmt: skip


def _lowered(
    ctx: Context,
    results: Sequence[Result],
    statements: Sequence[tuple[ast.Result, Symbol, int]],
    extents: Sequence[Node],
) -> tuple[tuple[Result, ...], Graph, Notes] | None:
    """The results as one graph; ``None`` after reporting that their extents differ.

    Where they are written, equal extents are values of their own; in the graph they are one.
    """
    every, graph, notes = lowered(ctx, [*(result.value for result in results), *extents])
    values, same = every[: len(results)], every[len(results) :]
    differ = [
        member
        for (member, _owner, _level), extent in zip(statements, same, strict=True)
        if extent is not same[0]
    ]
    for member in differ:
        ctx.report.add(
            rules.EXTENTS_DIFFER, member.type.span, name=member.name.text, what=extent_words(member)
        )
    pairs = zip(results, values, strict=True)
    found = tuple(changed(result, value=value) for result, value in pairs)
    return None if differ else (found, graph, notes)


def _scope(owner: Symbol, instance: Instance, level: int) -> Scope:
    return Scope(owner.module, instance, level)


def _extent(ctx: Context, member: ast.Result, scope: Scope) -> Node | None:
    """How many elements or texels a result has: the same all over a dispatch, and known to the
    host."""
    written, type_ = member.type.count, extent_type(member)
    name, what = member.name.text, extent_words(member)
    if written is None:
        ctx.report.add(rules.NO_EXTENT, member.type.span, name=name, what=what)
        return None
    node = fit(ctx, node_of(ctx, written, scope), type_, str(type_), written.span)
    if isinstance(node, Failure):
        return None
    if not all(_is_known_to_host(part) for part in reachable((node,))):
        ctx.report.add(rules.EXTENT_VARIES, written.span, name=name, what=what)
        return None
    return node


def _is_known_to_host(node: Node) -> bool:
    return node.op in _KNOWN_TO_HOST and reads_only_sizes(node)


def _result(ctx: Context, member: ast.Result, scope: Scope) -> Written | None:
    """What a result declares, and the value of an element."""
    if is_image(member):
        image = image_result(ctx, member, scope)
        return image if image is not None and _exists(ctx, image.value, member) else None
    element = declared_type(ctx, changed(member.type, count=None), scope.module)
    if element is None:
        return None
    if isinstance(element.type, Opaque) or not _is_writable(element.type):
        ctx.report.add(rules.NOT_WRITABLE, member.type.span, type=element.text)
        return None
    value = as_declared(ctx, node_of(ctx, member.value, scope), element, member.value, scope)
    if isinstance(value, Failure) or not _exists(ctx, value, member):
        return None
    return _info(member, element), value


def _exists(ctx: Context, value: Node, member: ast.Result) -> bool:
    """Whether a kernel has all that a value is computed by; reported if not."""
    missing = missing_in_kernels(value)
    if missing is not None:
        span = ctx.places.within(missing, member.value.span)
        ctx.report.add(rules.NOT_IN_KERNEL, span, what=f"`{missing.data}`")
    return missing is None


def _info(member: ast.Result, element: Declared) -> BufferInfo:
    name, span = member.name.text, member.name.span
    buffer = Buffer(name, RuntimeArray(element.type), WRITTEN_GROUP, element.fact)
    count = ParameterInfo(buffer.count, "int", None, 0, "", span)
    return BufferInfo(buffer, element_info(element, span), count, member.doc, span)


def _is_writable(type_: Type, *, inside: bool = False) -> bool:
    """Whether the texts can write values of a type part by part. A matrix is written as the columns
    that it is stored in, which only a buffer of matrices has as elements."""
    match type_:
        case Matrix():
            return not inside
        case Array(element=element):
            return isinstance(element, Scalar | Vector)
        case Struct(members=members):
            return all(_is_writable(inner, inside=True) for _, inner in members)
        case _:
            return True


# --- parts ---------------------------------------------------------------------------------------


def _stores(ctx: Context, info: BufferInfo, value: Node) -> Iterator[Result]:
    """A result for each part of an element, as it is stored."""
    graph, buffer = ctx.tree, info.buffer
    if isinstance(value.type, Matrix):
        size = value.type.size
        for column in range(size):
            part = _padded(graph, build.part(graph, value, column), 4)
            yield Result(STORE, COMPUTE, part, store=Store(buffer, (), size, column))
        return
    for path, part in _parts(graph, value):
        whole = not path and isinstance(part.type, Vector) and part.type.size == 3
        node = _padded(graph, _as_stored(graph, part), 4) if whole else _as_stored(graph, part)
        ctx.notes.names.setdefault(node.id, "_".join([buffer.name, *map(str, path)]))
        yield Result(STORE, COMPUTE, node, store=Store(buffer, path))


def _parts(
    graph: Graph, value: Node, path: tuple[str | int, ...] = ()
) -> Iterator[tuple[tuple[str | int, ...], Node]]:
    """The numbers and vectors that a value consists of; of an array, the rows that store it."""
    match value.type:
        case Struct(members=members):
            for name, _ in members:
                yield from _parts(graph, build.member(graph, value, name), (*path, name))
        case Array(Scalar() | Vector() as element, count):
            in_row = elements_in_row(element)
            parts = [_as_stored(graph, build.part(graph, value, i)) for i in range(count)]
            for row, first in enumerate(range(0, count, in_row)):
                joined = build.vector(graph, tuple(parts[first : first + in_row]))
                yield (*path, row), _padded(graph, joined, 4)
        case _:
            yield path, value


def _as_stored(graph: Graph, part: Node) -> Node:
    """A part as memory has it: bools are uints."""
    type_ = part.type
    if not isinstance(type_, Scalar | Vector) or type_.kind != "bool":
        return part
    one, zero = (build.constant(graph, UINT, number) for number in (1, 0))
    if isinstance(type_, Scalar):
        return graph.node("select", UINT, (part, one, zero))
    lanes = (build.swizzle(graph, part, (lane,)) for lane in range(type_.size))
    return build.vector(graph, tuple(graph.node("select", UINT, (x, one, zero)) for x in lanes))


def _padded(graph: Graph, part: Node, lanes: int) -> Node:
    """A vector with zeros in its last lanes."""
    assert isinstance(part.type, Scalar | Vector)
    own = part.type.size if isinstance(part.type, Vector) else 1
    if own == lanes:
        return part
    zero = 0.0 if part.type.kind == "float" else 0
    missing = build.splat(
        graph, build.constant(graph, with_width(part.type.kind, 1), zero), lanes - own
    )
    return build.vector(graph, (part, missing))
