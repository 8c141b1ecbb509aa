"""Looks names up: locals, the record's own names, the file's, the surface's; in that order.

A term or a light is written once and shades any material, so the names of its own file come before
those of a surface that happens to define the same name.
"""

from __future__ import annotations

from functools import partial

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir.node import Node
from ...ir.stages import VIEW_INDEX
from ...ir.types import Array
from ...syntax import ast
from ..declarations.contracts import as_declared
from ..declarations.externs import extern_value
from ..declarations.written_types import declared_type
from ..hints import advice
from ..names.modules import Symbol
from ..state.context import Context
from ..state.crossings import INPUTS, KERNEL_INPUTS
from ..state.evaluation import Demand, plain, settle
from ..state.scope import FAILURE, Application, Inherited, Instance, Members, Scope, Value
from .bodies import part_value
from .cycles import is_cycle
from .slots import slot
from .unknown_names import unknown_name


def value(ctx: Context, name: str, span: Span, scope: Scope) -> Value:
    """The value of a bare name."""
    if name in scope.locals:
        return scope.locals[name]
    if scope.parts is not None and name in scope.parts.declared:
        return part_value(ctx, scope.parts, name, span)
    if name == "inherited" and scope.instance is not None:
        return Inherited(scope.instance, scope.level)
    instance = instance_of(name, scope)
    if instance is not None:
        return slot(ctx, instance, name, span)
    symbols = scope.module.find(name)
    if symbols:
        return _symbol_value(ctx, symbols[0], span)
    if name in ctx.lights.named:
        return ctx.lights.named[name]
    row = KERNEL_INPUTS.get(name)
    if row is not None and ctx.extent is not None and row.type == ctx.extent.type:
        return ctx.tree.node("input", row.type, (), row)
    surface = scope.surface
    inputs = INPUTS if surface is None or surface.made is None else surface.made.inputs
    if name in inputs and surface is not None:
        if name == VIEW_INDEX.name:
            _check_view(ctx, scope.instance, span)
        return ctx.crossings.supplied(inputs[name], surface.origin)
    unknown_name(ctx, name, span, scope)
    return FAILURE


def instance_of(name: str, scope: Scope) -> Instance | None:
    """The record or the surface whose slot a bare name is; ``None`` if it is that of no slot.

    Names of the file come before slots that the text of a record did not know of.
    """
    own, surface = scope.instance, scope.surface
    if own is not None and own.declares(name, scope.level):
        return own
    if scope.module.known(name):
        return None
    if own is not None and own.has(name):
        return own
    return surface if surface is not None and surface.has(name) else None


def _check_view(ctx: Context, instance: Instance | None, span: Span) -> None:
    """Notes that the number of the view is read; reports a pass that reads it and has no views.

    Materials may read it under any pass: one that says nothing of views draws one, with number 0.
    """
    ctx.progress.reads_view = True
    if instance is None or instance.record.baseless:
        return
    record = instance.record
    declaration = record.symbol.declaration
    if not isinstance(declaration, ast.Record) or declaration.abstract:
        return
    if declaration.kind == "pass" and not any(record.every(ast.Views)):
        ctx.report.add(rules.ONE_VIEW, span, name=record.name)


def _symbol_value(ctx: Context, symbol: Symbol, span: Span) -> Value:
    declaration = symbol.declaration
    if isinstance(declaration, ast.ExternMember):
        return extern_value(ctx, symbol, span)
    if isinstance(declaration, ast.Enumeration):
        return Members(symbol)
    if not isinstance(declaration, ast.Constant):
        hint = advice.unshaded(symbol)
        if isinstance(declaration, ast.Function | ast.StructDeclaration):
            hint = f"call it: `{symbol.name}(…)`"
        elif isinstance(declaration, ast.ExternBlock) and declaration.members:
            hint = f"its members are names of the file: `{declaration.members[0].name.text}`"
        ctx.report.add(
            rules.NOT_A_VALUE, span, hint=hint,
            labels=[Label(declaration.name.span, "declared here")],
        )  # fmt: skip
        return FAILURE
    key: Application = (symbol, (), None)
    if key not in ctx.applied:
        if is_cycle(ctx, key, symbol.name, span):
            return FAILURE
        finish = partial(_finish_constant, ctx, key, declaration)
        written = declaration.value
        settle(ctx, Demand(key, symbol.name, span, written, Scope(symbol.module), finish))
    return ctx.applied[key]


def _finish_constant(
    ctx: Context, key: Application, declaration: ast.Constant, value: Value
) -> None:
    symbol, *_ = key
    wanted = None
    if declaration.type is not None:
        wanted = declared_type(ctx, declaration.type, symbol.module)
    result = plain(ctx, value, declaration.value, wanted)
    if wanted is not None:
        result = as_declared(ctx, result, wanted, declaration.value)
    ctx.applied[key] = result
    if isinstance(result, Node) and isinstance(result.type, Array):
        # Anything else is written where it is used.
        ctx.notes.names.setdefault(result.id, symbol.name)
