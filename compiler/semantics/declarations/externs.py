"""Blocks that the host already owns: their declarations, checked against every backend."""

from __future__ import annotations

from collections.abc import Iterable

from ....support.frozen import changed
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.fixes import either
from ...diagnostics.source import Span
from ...ir.leaves import LARGEST_PLACE, HostPlace
from ...ir.node import Node
from ...ir.shader import ExternInfo, ExternMemberInfo, ParameterInfo
from ...ir.storage import alignment, byte_size, stored_type
from ...ir.types import Array, Scalar, Type, Vector
from ...syntax import ast
from ..inheritance.records import Definition
from ..names.modules import Module, Symbol
from ..state.context import Context
from ..state.scope import FAILURE, Failure
from .parameters import parameter_of

LARGEST_OFFSET = 65532
"""The last scalar of 64 KiB, beyond which no profile has a block."""


def extern_value(ctx: Context, symbol: Symbol, span: Span) -> Node | Failure:
    """The read of the member that ``symbol`` stands for, where it is written at ``span``."""
    if symbol.module in ctx.externs.reading:
        ctx.report.add(rules.NOT_CONSTANT, span)
        return FAILURE
    read_externs(ctx, symbol.module)
    info = ctx.externs.parameters.get((symbol.module, symbol.name))
    if info is None:
        return FAILURE
    return ctx.tree.node("parameter", info.leaf.type, (), info.leaf)


def read_externs(ctx: Context, module: Module) -> None:
    """Read all blocks that a file declares; each once."""
    externs = ctx.externs
    externs.reading.add(module)
    try:
        for symbols in module.declared.values():
            declaration = symbols[0].declaration
            if isinstance(declaration, ast.ExternBlock) and symbols[0] not in externs.known:
                externs.known[symbols[0]] = _block(ctx, symbols[0], declaration)
    finally:
        externs.reading.discard(module)


def _block(ctx: Context, symbol: Symbol, block: ast.ExternBlock) -> ExternInfo:
    place = HostPlace(
        block.name.text,
        _whole(ctx, block.bind_group, LARGEST_PLACE),
        _whole(ctx, block.binding, LARGEST_PLACE),
    )
    _check_place(ctx, block, place)
    members = []
    for member in block.members:
        info = _member(ctx, symbol, block, member, place)
        ctx.externs.parameters[symbol.module, member.name.text] = info
        offset = _whole(ctx, member.offset, LARGEST_OFFSET)
        if info is not None and _fits(ctx, member, info.leaf.type, offset):
            members.append(ExternMemberInfo(member.name.text, offset, info))
    members.sort(key=lambda info: info.offset)
    _check_overlaps(ctx, members)
    return ExternInfo(place, _group(block), block.doc, block.name.span, tuple(members))


def _member(
    ctx: Context, symbol: Symbol, block: ast.ExternBlock, member: ast.ExternMember, place: HostPlace
) -> ParameterInfo | None:
    group = block.group or ast.Name("frame", block.name.span)
    declared = ast.Param(
        member.span, member.doc, member.name, member.type, None, group, member.default
    )
    definition = Definition(declared, symbol, 0)
    info = parameter_of(ctx, definition, member.name.text, block.name.text)
    return info and changed(info, leaf=changed(info.leaf, host=place))


def _whole(ctx: Context, number: ast.Number, largest: int) -> int:
    """A number from 0 to ``largest``; 0 after reporting another one."""
    if number.kind == "int" and len(number.text) < 10 and int(number.text) <= largest:
        return int(number.text)
    ctx.report.add(rules.EXTERN_NUMBER, number.span, largest=largest)
    return 0


def _check_place(ctx: Context, block: ast.ExternBlock, place: HostPlace) -> None:
    for other in ctx.externs.known.values():
        if other.place.name == place.name:
            ctx.report.add(
                rules.DUPLICATE_NAME, block.name.span, name=place.name,
                labels=[Label(other.span, "first declared here")],
            )  # fmt: skip
        elif (other.place.group, other.place.binding) == (place.group, place.binding):
            span = block.bind_group.span.to(block.binding.span)
            ctx.report.add(
                rules.EXTERN_PLACE_TAKEN, span, name=place.name, other=other.place.name,
                labels=[Label(other.span, "declared here")],
            )  # fmt: skip


def _fits(ctx: Context, member: ast.ExternMember, type_: Type, offset: int) -> bool:
    """True if every backend can read a type at an offset; reports why not."""
    if isinstance(type_, Array) and _is_packed(type_.element):
        ctx.report.add(
            rules.EXTERN_ARRAY, member.type.span, element=type_.element, count=type_.count
        )
        return False
    needed = alignment(stored_type(type_))
    if offset % needed:
        before = offset - offset % needed
        behind = before + needed
        ctx.report.add(
            rules.EXTERN_ALIGNMENT, member.offset.span,
            name=member.name.text, offset=offset, type=type_, alignment=needed,
            hint=either(
                f"{before} and {behind} are such offsets",
                member.offset.span, str(before), str(behind),
            ),
        )  # fmt: skip
        return False
    return True


def _check_overlaps(ctx: Context, members: Iterable[ExternMemberInfo]) -> None:
    end, last = 0, None
    for member in members:
        if last is not None and member.offset < end:
            ctx.report.add(
                rules.EXTERN_OVERLAP, member.info.span,
                name=member.name, offset=member.offset, other=last.name, end=end,
                labels=[Label(last.info.span, f"ends at byte {end}")],
            )  # fmt: skip
        end = member.offset + byte_size(stored_type(member.info.leaf.type))
        last = member


def _group(block: ast.ExternBlock) -> str:
    return "frame" if block.group is None else block.group.text


def _is_packed(element: Type) -> bool:
    """True if Burnish's blocks keep several such elements in 16 bytes, as no host does."""
    return isinstance(element, Scalar) or (isinstance(element, Vector) and element.size == 2)
