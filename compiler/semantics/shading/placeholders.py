"""What stands in for values that are not known where a declaration is checked by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...ir.node import Formal, Node
from ...syntax import ast
from ..declarations.contracts import assumed
from ..declarations.written_types import declared_type
from ..inheritance.records import Definition, is_abstract
from ..lowering.lookup import OUTERMOST
from ..names.modules import Module
from ..state.scope import FAILURE, Failure, Instance
from ..types.typenames import Variables

if TYPE_CHECKING:
    from ..state.context import Lowering


def some(
    low: Lowering, name: ast.Name, type_: ast.TypeName, module: Module, variables: Variables
) -> Node | Failure:
    """Any value of a written type."""
    declared = declared_type(low, type_, module, variables)
    if declared is None:
        return FAILURE
    variable = low.graph.node("formal", declared.type, (), Formal(name.text))
    low.stand_ins.add(variable)
    return assumed(low, variable, declared)


def stand_in(low: Lowering, instance: Instance) -> None:
    """Give the slots without a value one of their type, as if a base or an heir had set them."""
    for name, definitions in instance.record.definitions.items():
        if is_abstract(definitions[-1].member):
            _stand_in(low, instance, name, definitions)


def _stand_in(
    low: Lowering, instance: Instance, name: str, definitions: tuple[Definition, ...]
) -> None:
    written = definitions[-1]
    assert written.member.type is not None
    value = some(low, written.member.name, written.member.type, written.owner.module, {})
    instance.values[name, written.level] = value
    if all(is_abstract(definition.member) for definition in definitions):
        instance.values[name, OUTERMOST] = value
