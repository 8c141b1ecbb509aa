"""Checks of what a shader does not read, so that every mistake in a file is found at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..diagnostics import rules
from ..diagnostics.nearest import suggestion
from ..ir.node import Formal, Node
from ..ir.types import BOOL
from ..syntax import ast
from ..trampoline import run
from . import lookup
from .calls import apply_body
from .declared import declared_type, struct_of
from .fitting import assumed
from .instances import instance_of
from .lights import light_instance, per_light
from .modules import Module, Symbol
from .parameters import leaves_of
from .records import Definition, is_abstract, records_of
from .rigs import light_entry
from .scope import FAILURE, Instance, Scope

if TYPE_CHECKING:
    from .lower import Lowering


def check_slots(low: Lowering, surface: Instance, passing: Instance) -> None:
    """Lower every slot of a material and its pass; warn of those that look misspelt."""
    read = {name for name, _ in surface.values}
    for instance in (surface, passing):
        _check_instance(low, instance)
    for name, definitions in surface.record.definitions.items():
        if name not in read:
            _check_spelling(low, surface, name, definitions)


def check_declarations(low: Lowering, module: Module, surface: Instance) -> None:
    """Lower a file's constants, structures, functions, lights and mixins.

    Generic functions wait for a use. Mixins are checked where some record has them, else alone.
    The terms of a file with materials are checked where these use them, since they may read slots
    that only some material has.
    """
    with_terms = not records_of(module, "material", abstract=False)
    used = {symbol for symbol, *_ in low.applied}
    for symbols in module.declared.values():
        for symbol in symbols:
            declaration = symbol.declaration
            if isinstance(declaration, ast.Constant):
                run(lookup.value(low, symbol.name, declaration.name.span, Scope(module)))
            elif isinstance(declaration, ast.StructDeclaration):
                struct_of(low, symbol)
            elif symbol in used:
                continue
            elif isinstance(declaration, ast.Function) and (declaration.kind == "fn" or with_terms):
                _check_function(low, symbol, declaration, surface)
    _check_rig(low, surface)
    for symbol in records_of(module, "light", abstract=False):
        entry = light_entry(low, low.records.of(symbol))
        if entry is not None:
            _check_instance(low, light_instance(low, entry, surface)[0])
    _check_mixins(low, module, surface)


def _check_mixins(low: Lowering, module: Module, surface: Instance) -> None:
    used = {
        mixin
        for kind in ("material", "light", "pass")
        for record in records_of(module, kind, abstract=False)
        for mixin in low.records.of(record).chain
    }
    for symbol, *_ in module.declared.values():
        if isinstance(symbol.declaration, ast.Mixin) and symbol not in used:
            _check_mixin(low, symbol, symbol.declaration.kind, surface)


def _check_mixin(low: Lowering, symbol: Symbol, kind: str, surface: Instance) -> None:
    """Lower what a mixin says, with stand-ins for what it needs of the records it is for."""
    record = low.records.alone(symbol)
    if kind == "light":
        entry = light_entry(low, record)
        if entry is None:
            return
        instance = light_instance(low, entry, surface)[0]
    else:
        instance = instance_of(low, record, leaves_of(low, record))
        instance.surface = surface if kind == "pass" else None
    for name, definitions in record.definitions.items():
        if is_abstract(definitions[-1].member):
            _stand_in(low, instance, name, definitions)
    _check_instance(low, instance)
    scope = Scope(symbol.module, instance, 0, surface, {"material": surface})
    for target, _, level in record.targets:
        if level == 0:
            run(low.node(target.value, scope))
    for discard, _, level in record.discards:
        if level == 0:
            run(low.typed(discard.condition, scope, BOOL, "bool"))


def _stand_in(
    low: Lowering, instance: Instance, name: str, definitions: tuple[Definition, ...]
) -> None:
    """Give a slot without a value one of its type, as if a base had set it."""
    written = definitions[-1]
    assert written.member.type is not None
    declared = declared_type(low, written.member.type, written.owner.module)
    value = (
        FAILURE if declared is None else low.graph.node("formal", declared.type, (), Formal(name))
    )
    instance.values[name, written.level] = value
    if all(is_abstract(definition.member) for definition in definitions):
        instance.values[name, lookup.OUTERMOST] = value


def _check_rig(low: Lowering, surface: Instance) -> None:
    """Lower what a rig sets of its lights, whether a term asks for it or not."""
    for entry in low.rig:
        instance, _ = light_instance(low, entry, surface)
        for name, replacement in entry.replaced.items():
            if replacement.definition is not None:
                run(lookup.slot(low, instance, name, replacement.definition.member.name.span))


def _check_instance(low: Lowering, instance: Instance) -> None:
    for name, definitions in instance.record.definitions.items():
        if isinstance(definitions[0].member, ast.Slot):
            run(lookup.slot(low, instance, name, definitions[0].member.name.span))


def _check_function(
    low: Lowering, symbol: Symbol, function: ast.Function, surface: Instance
) -> None:
    """Lower a body for arguments of the declared types."""
    if function.type_parameters:
        return
    types = [declared_type(low, argument.type, symbol.module) for argument in function.arguments]
    arguments: tuple[Node, ...] = tuple(
        assumed(low, low.graph.node("formal", type_.type, (), Formal(argument.name.text)), type_)
        for type_, argument in zip(types, function.arguments, strict=True)
        if type_ is not None
    )
    if len(arguments) < len(types):
        return
    span = function.name.span
    if function.per is not None:
        run(per_light(low, symbol, arguments, span, Scope(symbol.module, surface=surface)))
    else:
        within = surface if function.kind == "term" else None
        run(apply_body(low, symbol, arguments, span, within))


def _check_spelling(
    low: Lowering, surface: Instance, name: str, definitions: tuple[Definition, ...]
) -> None:
    """Warn of an own slot that nothing reads and that is nearly called like an inherited one.

    What an imported file declares is an offer, and its names are for that file to check.
    """
    root = surface.record.root
    member, owner = definitions[0].member, definitions[0].owner
    if not isinstance(member, ast.Slot) or definitions[-1].owner is root:
        return
    if owner.module is not surface.record.symbol.module:
        return
    inherited = [n for n, ds in surface.record.definitions.items() if ds[-1].owner is root]
    hint = suggestion(name, inherited)
    if hint and not surface.record.baseless:
        low.report.add(rules.MISSPELT_SLOT, member.name.span, name=name, hint=hint)
