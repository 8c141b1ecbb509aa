"""What a name stands for: locals, the record's own names, the file's, the surface's; in that order.

A term or a light is written once and shades any material, so the names of its own file come before
those of a surface that happens to define the same name.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ....frozen import changed
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.nearest import nearest
from ...diagnostics.source import Span
from ...ir.node import Formal, Node, bare
from ...ir.stages import SYSTEM_INPUTS
from ...ir.types import Array, Texture
from ...syntax import ast
from ...trampoline import Reply, Step
from ..declarations import assignments, contracts
from ..declarations.written_types import declared_type
from ..hints import advice
from ..hints.rewriting import called_here
from ..inheritance.records import Definition, Record
from ..names.modules import Module, Symbol
from ..state.scope import (
    FAILURE,
    Failure,
    FunctionParts,
    Inherited,
    Instance,
    LightVariable,
    Replacement,
    Scope,
    Value,
)

if TYPE_CHECKING:
    from ..state.context import Lowering

OUTERMOST = -1
"""The level at which a name means what was given from outside, if anything was."""


def value(low: Lowering, name: str, span: Span, scope: Scope) -> Reply[Value]:
    """The value of a bare name."""
    if name in scope.locals:
        return scope.locals[name]
    if scope.parts is not None and name in scope.parts.declared:
        part: Value = yield _part(low, scope.parts, name, span)
        return part
    if name == "inherited" and scope.instance is not None:
        return Inherited(scope.instance, scope.level)
    if scope.instance is not None and scope.instance.has(name):
        return slot(low, scope.instance, name, span)
    symbols = scope.module.find(name)
    if symbols:
        return _symbol_value(low, symbols[0], span)
    if scope.surface is not None and scope.surface.has(name):
        return slot(low, scope.surface, name, span)
    if name in SYSTEM_INPUTS and scope.surface is not None:
        return low.stages.supplied(SYSTEM_INPUTS[name])
    _unknown_name(low, name, span, scope)
    return FAILURE


def _symbol_value(low: Lowering, symbol: Symbol, span: Span) -> Step[Value]:
    declaration = symbol.declaration
    if isinstance(declaration, ast.ExternMember):
        return low.externs.value(symbol, span)
    if not isinstance(declaration, ast.Constant):
        hint = advice.unshaded(symbol)
        if isinstance(declaration, ast.Function | ast.StructDeclaration):
            hint = f"call it: `{symbol.name}(…)`"
        elif isinstance(declaration, ast.ExternBlock) and declaration.members:
            hint = f"its members are names of the file: `{declaration.members[0].name.text}`"
        low.report.add(
            rules.NOT_A_VALUE, span, hint=hint,
            labels=[Label(declaration.name.span, "declared here")],
        )  # fmt: skip
        return FAILURE
    key = (symbol, (), None)
    if key in low.applied:
        return low.applied[key]
    if _is_cycle(low, key, symbol.name, span):
        return FAILURE
    scope = Scope(symbol.module)
    result: Node | Failure = yield low.node(declaration.value, scope)
    if declaration.type is not None:
        wanted = declared_type(low, declaration.type, symbol.module)
        if wanted is not None:
            result = low.as_declared(result, wanted, declaration.value)
    low.active.pop(key)
    low.applied[key] = result
    if isinstance(result, Node) and isinstance(result.type, Array):
        # Anything else is written where it is used.
        low.notes.names.setdefault(result.id, symbol.name)
    return result


def _unknown_name(low: Lowering, name: str, span: Span, scope: Scope) -> None:
    if name == "light":
        in_term = scope.surface is not None and scope.instance is None
        hint = "sum over the lights: write `per light` in front of the term's `=`"
        low.report.add(rules.OUTSIDE_LIGHT, span, name=name, hint=hint if in_term else "")
        return
    parts = () if scope.parts is None else scope.parts.declared
    known = [*scope.locals, *parts, *scope.module.visible(), *SYSTEM_INPUTS]
    for instance in (scope.instance, scope.surface):
        if instance is not None and instance.record.baseless:
            return
        if instance is not None:
            known += instance.record.definitions
    from ....stdlib.builtins.elsewhere import KEYWORDS, VALUES

    here = called_here(name, span, VALUES[name]) if name in VALUES else ""
    lit = advice.of_a_light(name, low.rig)
    elsewhere = here or lit or advice.of_a_record(name, scope) or KEYWORDS.get(name, "")
    if elsewhere:
        low.report.add(rules.UNKNOWN_NAME, span, kind="name", name=name, hint=elsewhere)
        return
    if hint := advice.uncalled(name):
        low.report.add(rules.NOT_A_VALUE, span, hint=hint)
        return
    unknown_here(low, "name", name, span, known, scope.module)


def is_known(scope: Scope, name: str) -> bool:
    """Whether a name means something in an expression."""
    seen = scope.surface is not None and scope.surface.has(name)
    return name in scope.locals or seen or is_declared(scope, name)


def is_declared(scope: Scope, name: str) -> bool:
    """Whether the record or the file gives a name to something, called or not."""
    own = scope.instance is not None and scope.instance.has(name)
    return own or bool(scope.module.find(name))


def unknown(low: Lowering, kind: str, name: str, span: Span, known: Iterable[str]) -> None:
    """Report a name that nothing declares, with the nearest one that something does."""
    hint = advice.nearest_or_all(name, span, known)
    low.report.add(rules.UNKNOWN_NAME, span, kind=kind, name=name, hint=hint)


def unknown_here(
    low: Lowering, kind: str, name: str, span: Span, known: Iterable[str], module: Module
) -> None:
    """The same for a name that an import could bring, or should have brought."""
    if name not in module.missing:
        known = list(known)
        hint = module.hint(ast.Name(name, span), known) or advice.undeclared(kind, name)
        if module.incomplete and nearest(name, known) is None:
            return
        low.report.add(rules.UNKNOWN_NAME, span, kind=kind, name=name, hint=hint)


# --- functions -----------------------------------------------------------------------------------


def body(low: Lowering, function: ast.Function, scope: Scope) -> Step[Node | Failure]:
    """A function's body, where ``scope`` has the arguments. Parts that it does not read are lowered
    too, so that their mistakes are found."""
    if not function.parts:
        whole: Node | Failure = yield low.node(function.body, scope)
        return whole
    parts = FunctionParts({part.name.text: part for part in function.parts}, scope)
    within = parts.scope = changed(scope, parts=parts)
    result: Node | Failure = yield low.node(function.body, within)
    for name, part in parts.declared.items():
        yield _part(low, parts, name, part.name.span)
    return result


def _part(low: Lowering, parts: FunctionParts, name: str, span: Span) -> Step[Node | Failure]:
    if name in parts.values:
        return parts.values[name]
    if _is_cycle(low, (parts, name), name, span):
        return FAILURE
    written, scope = parts.declared[name], parts.scope
    assert written.value is not None
    result: Node | Failure = yield low.node(written.value, scope)
    if written.type is not None:
        wanted = declared_type(low, written.type, scope.module, scope.variables)
        result = (
            FAILURE if wanted is None else low.as_declared(result, wanted, written.value, scope)
        )
    low.active.pop((parts, name))
    parts.values[name] = result
    if isinstance(result, Node) and result.operands:
        low.notes.names.setdefault(result.id, name)
        if written.doc:
            low.notes.docs.setdefault(result.id, written.doc)
    return result


# --- slots ---------------------------------------------------------------------------------------


def slot_or_report(low: Lowering, instance: Instance, name: str, span: Span) -> Reply[Value]:
    """``instance.name`` where it is written with the dot."""
    if not instance.has(name):
        if instance.record.baseless:
            return FAILURE
        unknown(low, f"slot of `{instance.record.name}`", name, span, instance.record.definitions)
        return FAILURE
    return slot(low, instance, name, span)


def inherited(low: Lowering, instance: Instance, level: int, name: ast.Name) -> Reply[Value]:
    """``inherited.name``: the definition above the one in which this is written."""
    above = instance.record.above(name.text, level)
    if above is not None:
        return slot(low, instance, name.text, name.span, above.level)
    surface = instance.surface
    if surface is not None and name.text in surface.record.definitions:
        return slot(low, surface, name.text, name.span, 0)
    if not instance.record.baseless:
        _unknown_inherited(low, instance.record, name)
    return FAILURE


def _unknown_inherited(low: Lowering, record: Record, name: ast.Name) -> None:
    """A mixin, where no record has it, knows of the chain behind it only what it declares."""
    if isinstance(record.symbol.declaration, ast.Mixin) and name.text in record.definitions:
        hint = f"say of which type it has to be: `{name.text} : … = …`"
        kind = "inherited slot"
        low.report.add(rules.UNKNOWN_NAME, name.span, kind=kind, name=name.text, hint=hint)
    else:
        unknown(low, "inherited slot", name.text, name.span, record.definitions)


def slot(
    low: Lowering, instance: Instance, name: str, span: Span, level: int = OUTERMOST
) -> Reply[Node | Failure]:
    """The value that ``name`` has in ``instance``, as defined at ``level`` or further up."""
    key = (name, level)
    if key in instance.values:
        return instance.values[key]
    if _is_cycle(low, (instance, *key), name, span):
        return FAILURE
    return _new_slot(low, instance, name, span, level)


def _new_slot(
    low: Lowering, instance: Instance, name: str, span: Span, level: int
) -> Step[Node | Failure]:
    result: Node | Failure = yield _slot_value(low, instance, name, span, level)
    low.active.pop((instance, name, level))
    instance.values[name, level] = result
    if isinstance(result, Node) and result.operands:
        _note(low, instance, name, level, result)
    return result


def _definition(instance: Instance, name: str, level: int) -> Definition:
    """What the record says of ``name`` at ``level`` or further up."""
    return next(d for d in instance.record.definitions[name] if d.level >= level)


def _slot_value(
    low: Lowering, instance: Instance, name: str, span: Span, level: int
) -> Reply[Node | Failure]:
    replacement = instance.replaced.get(name) if level == OUTERMOST else None
    if replacement is not None:
        return _replacement_value(low, instance, replacement, name)
    definition = _definition(instance, name, level)
    member = definition.member
    if not isinstance(member, ast.Slot):
        return _leaf(low, instance, member)
    if member.value is None:
        record = instance.record
        outermost = record.definitions[name][0] is definition
        low.report.add(
            rules.ABSTRACT_SLOT, record.symbol.declaration.name.span if outermost else span,
            name=name, record=record.name,
            labels=[Label(member.name.span, "declared here without a value")],
            hint=_setting(low, instance, definition),
        )  # fmt: skip
        return FAILURE
    scope = Scope(definition.owner.module, instance, definition.level, instance.surface or instance)
    return _defined(low, instance, name, member.value, scope)


def _setting(low: Lowering, instance: Instance, definition: Definition) -> str:
    """How an abstract slot is set, or what else was meant by declaring it."""
    member = definition.member
    assert isinstance(member, ast.Slot)
    name, record = member.name.text, instance.record
    declared = (
        None if member.type is None else declared_type(low, member.type, definition.owner.module)
    )
    if declared is not None and isinstance(declared.type, Texture):
        return f"declare a texture with `map {name} : {declared.text}`"
    if record.definitions[name][0] is not definition:
        return f"`inherited.{name}` has no value, so nothing can be computed from it"
    if definition.owner is record.symbol:
        return f"give it a value, `{name} : {declared.text} = …`" if declared is not None else ""
    own = (n for n, found in record.definitions.items() if found[-1].owner is record.symbol)
    slip = nearest(name, own)
    if slip is not None:
        return f"`{slip}` is declared in `{record.name}`: did you mean `{name}`?"
    about = f": {member.doc}" if member.doc else ""
    return f"add `{name} = …` to `{record.name}`{about}"


def _leaf(low: Lowering, instance: Instance, member: ast.ReadMember) -> Node | Failure:
    """What a member reads whose value comes from outside; nothing if its declaration is wrong."""
    name = member.name.text
    match ast.kind_of(member).contribution:
        case "parameter":
            return instance.parameters.get(name, FAILURE)
        case "resource":
            return instance.resources.get(name, FAILURE)
        case _:
            read = instance.attributes.get(name)
            return FAILURE if read is None else low.stages.attribute(read)


def _replacement_value(
    low: Lowering, instance: Instance, replacement: Replacement, name: str
) -> Reply[Node | Failure]:
    definition = replacement.definition
    if definition is None:
        assert replacement.value is not None
        return replacement.value
    assert isinstance(definition.member, ast.Slot) and definition.member.value is not None
    within = replacement.within or instance
    scope = Scope(definition.owner.module, within, definition.level, within.surface or within)
    return _defined(low, instance, name, definition.member.value, scope)


def _defined(
    low: Lowering, instance: Instance, name: str, expression: ast.Expression, scope: Scope
) -> Step[Node | Failure]:
    """The value of an equation as the type that its slot was declared with."""
    locals_ = {"material": scope.surface} if scope.surface is not None else {}
    result: Node | Failure = yield low.node(expression, scope.binding(locals_))
    record = _typing(instance, name)
    assert scope.instance is not None
    level = scope.level if record is scope.instance.record else OUTERMOST
    return assignments.given(low, record, name, result, expression, scope, level)


def _typing(instance: Instance, name: str) -> Record:
    """The record whose written type holds: a pass's slot keeps that of the one it overrides."""
    surface = instance.surface
    given = None if surface is None else surface.replaced.get(name)
    if surface is None or given is None or given.within is not instance:
        return instance.record
    return surface.record


def _note(low: Lowering, instance: Instance, name: str, level: int, node: Node) -> None:
    """Keep the user's name and doc comment for a value."""
    given = instance.replaced.get(name)
    own = _definition(instance, name, level)
    definition = own if level != OUTERMOST or given is None else given.definition
    if definition is not None and isinstance(definition.member, ast.Attribute):
        return
    overridden = given is not None or own is not instance.record.definitions[name][0]
    is_inherited = level != OUTERMOST and overridden and isinstance(own.member, ast.Slot)
    shown = f"{instance.prefix}_{name}" if instance.prefix else name
    crossing = bare(node)
    for named in (node, *crossing.operands) if crossing.op == "interpolate" else (node,):
        if is_inherited and named.id not in low.notes.names:
            low.notes.wholes[named.id] = shown
        low.notes.names.setdefault(named.id, f"inherited_{shown}" if is_inherited else shown)
        if definition is not None and definition.member.doc:
            low.notes.docs.setdefault(named.id, definition.member.doc)


def _is_cycle(low: Lowering, key: object, name: str, span: Span) -> bool:
    """Whether ``key`` is being lowered already; reports the way round. Otherwise it is from now."""
    if key not in low.active:
        low.active[key] = (name, span)
        return False
    if key in low.cyclic:
        return True
    low.cyclic.add(key)
    steps = list(low.active.values())
    start = list(low.active).index(key)
    cycle = [step for step, _ in steps[start:]] + [name]
    labels = [Label(place, f"`{step}` is needed here") for step, place in steps[start + 1 :]]
    shown = " → ".join(cycle)
    hint = ""
    if isinstance(key, tuple) and isinstance(key[0], Instance):
        above = len(key[0].record.definitions.get(name, ())) > 1
        hint = f"what it is otherwise is `inherited.{name}`" if above else ""
    low.report.add(
        rules.CYCLIC_DEFINITION, span, name=name, cycle=shown, labels=labels[:8], hint=hint
    )
    return True


# --- light ---------------------------------------------------------------------------------------


def light_slot(low: Lowering, light: LightVariable, name: ast.Name) -> Step[Value]:
    """``light.name`` in a term: a variable of the body that all lights share."""
    if not light.instance.has(name.text):
        definitions = light.record.definitions
        if any(name.text in entry.record.definitions for entry in low.rig):
            label = Label(light.record.symbol.declaration.name.span, "this light")
            low.report.add(
                rules.LIGHT_LACKS_SLOT, name.span, light=light.record.name, slot=name.text,
                labels=[label],
            )  # fmt: skip
            return FAILURE
        unknown(low, f"slot of light `{light.record.name}`", name.text, name.span, definitions)
        return FAILURE
    sample = yield slot(low, light.instance, name.text, name.span)
    if isinstance(sample, Failure):
        return FAILURE
    if isinstance(sample.type, Texture):
        low.report.add(
            rules.WRONG_TYPE, name.span, expected="a value", found=sample.type,
            hint="read the texture in a slot of the light",
        )  # fmt: skip
        return FAILURE
    variable = light.variables.get(name.text)
    if variable is None:
        variable = low.graph.node("formal", sample.type, (), Formal(name.text))
        light.variables[name.text] = variable
    return contracts.light_variable(low, light, name.text, variable, sample)
