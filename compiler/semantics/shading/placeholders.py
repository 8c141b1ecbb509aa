"""What stands in for values that are not known where a declaration is checked by itself."""

from __future__ import annotations

from ...ir.node import Formal, Node
from ...syntax import ast
from ..declarations.contracts import assumed
from ..declarations.written_types import declared_type
from ..inheritance.records import Definition, is_abstract
from ..names.modules import Module
from ..state.context import Context
from ..state.scope import FAILURE, OUTERMOST, Failure, Instance
from ..types.typenames import Variables


def some(
    ctx: Context, name: ast.Name, type_: ast.TypeName, module: Module, variables: Variables
) -> Node | Failure:
    """Any value of a written type."""
    declared = declared_type(ctx, type_, module, variables)
    if declared is None:
        return FAILURE
    variable = ctx.tree.node("formal", declared.type, (), Formal(name.text))
    ctx.placeholders.add(variable)
    return assumed(ctx, variable, declared)


def stand_in(ctx: Context, instance: Instance) -> None:
    """Give the slots without a value one of their type, as if a base or a derived record had."""
    for name, definitions in instance.record.definitions.items():
        if is_abstract(definitions[-1].member):
            _stand_in(ctx, instance, name, definitions)


def _stand_in(
    ctx: Context, instance: Instance, name: str, definitions: tuple[Definition, ...]
) -> None:
    written = definitions[-1]
    assert written.member.type is not None
    value = some(ctx, written.member.name, written.member.type, written.owner.module, {})
    instance.values[name, written.level] = value
    if all(is_abstract(definition.member) for definition in definitions):
        instance.values[name, OUTERMOST] = value
