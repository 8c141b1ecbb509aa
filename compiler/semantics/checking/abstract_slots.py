"""Hints for slots without a value."""

from __future__ import annotations

from ...diagnostics.nearest import nearest_in
from ...ir.types import RuntimeArray, TextureType
from ...syntax import ast
from ..inheritance.records import Definition
from ..state.scope import Instance
from ..types.typenames import Declared


def way_to_set(instance: Instance, definition: Definition, declared: Declared) -> str:
    """A hint how to set an abstract slot, or what else its declaration may have meant."""
    member, record = definition.member, instance.record
    name, owner = member.name.text, definition.owner
    declaration = record.symbol.declaration
    assert isinstance(declaration, ast.Record | ast.Mixin)
    kind = declaration.kind
    if isinstance(declared.type, TextureType):
        return f"declare a texture with `map {name} : {declared.text}`"
    if isinstance(declared.type, RuntimeArray):
        return f"declare a buffer with `buffer {name} : {declared.text}`"
    if record.definitions[name][0] is not definition:
        return f"`inherited.{name}` has no value, so nothing can be computed from it"
    is_own, surface = owner is record.symbol, instance.surface
    is_here = is_own or isinstance(owner.declaration, ast.Mixin)
    if is_here and surface is not None and surface.has(name):
        return f"leave it out: a {kind} reads `{name}` of a material without declaring it"
    if is_own:
        value = f"give it a value, `{name} : {declared.text} = …`"
        return f"{value}, or let others extend it: `abstract {kind} {record.name}`"
    own = (n for n, found in record.definitions.items() if found[-1].owner is record.symbol)
    slip = nearest_in(member.name.span.source, name, own)
    if slip is not None:
        return f"`{slip}` is declared in `{record.name}`: did you mean `{name}`?"
    about = f": {member.doc}" if member.doc else ""
    return f"add `{name} = …` to `{record.name}`{about}"
