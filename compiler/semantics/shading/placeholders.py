"""Placeholders for unknown values, where a declaration is checked by itself."""

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
    """Gives each slot that a declaration leaves without a value a placeholder of its type.

    So an expression that reads such a slot, or builds on it as ``inherited.name``, is checked as if
    a base or a derived record had set it.
    """
    for name, definitions in instance.record.definitions.items():
        for definition in definitions:
            if is_abstract(definition.member):
                value = _placeholder(ctx, definition)
                instance.values[name, definition.level] = value
                if definition is definitions[0] and name not in instance.replaced:
                    # The slot may have failed already: a declaration cannot change a slot's type.
                    instance.values.setdefault((name, OUTERMOST), value)


def _placeholder(ctx: Context, definition: Definition) -> Node | Failure:
    member = definition.member
    assert member.type is not None
    return some(ctx, member.name, member.type, definition.owner.module, {})
