"""Calls, by what is called: functions, builtins, constructors, texture reads; and ``with``."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from ....frozen import changed
from ....stdlib.builtins import BUILTINS
from ....stdlib.builtins.elsewhere import Instead
from ...diagnostics import rules
from ...diagnostics.fixes import Edit, Fix, FixIt, Hint, fix_it
from ...diagnostics.source import Span
from ...ir.node import Node, bare
from ...ir.types import TEXTURES, Texture
from ...syntax import ast
from ...trampoline import Reply, Step
from ..declarations import assignments
from ..hints import advice
from ..hints.rewriting import called_here
from ..inheritance.records import Definition
from ..names.duplicates import check_once
from ..state.scope import FAILURE, Failure, Replacement, Scope, Value
from . import lookup, textures
from .aggregates import structure
from .applications import apply_best
from .constructors import construct, is_constructor

if TYPE_CHECKING:
    from ..state.context import Lowering


def call(low: Lowering, e: ast.Call, scope: Scope) -> Step[Value]:
    """``f(…)`` for every kind of f."""
    arguments, failed = yield from _arguments(low, e, scope)
    if isinstance(e.callee, ast.Reference):
        result: Value = yield _named(low, e, e.callee, arguments, scope, failed)
        return result
    read: Value = yield _of_value(low, e, arguments, scope, failed)
    return read


def _of_value(
    low: Lowering, e: ast.Call, arguments: tuple[Node, ...], scope: Scope, failed: bool
) -> Step[Value]:
    """``x.read(…)`` or ``x.map(…)``: only textures are called that have no name of their own."""
    if not isinstance(e.callee, ast.Field):
        callee = yield low.node(e.callee, scope)
        return FAILURE if failed else textures.read(low, callee, arguments, e)
    owner = yield low.expression(e.callee.operand, scope)
    if isinstance(owner, Node) and isinstance(owner.type, Texture):
        method = e.callee.name
        if not textures.can_read(low, owner.type, method) or failed:
            return FAILURE
        return textures.read(low, owner, arguments, e, method)
    member = yield low.part(owner, e.callee)
    return FAILURE if failed else textures.read(low, member, arguments, e)


def _arguments(low: Lowering, e: ast.Call, scope: Scope) -> Step[tuple[tuple[Node, ...], bool]]:
    """The values of a call's arguments, and whether one of them failed."""
    arguments: list[Node] = []
    failed = False
    for argument in e.arguments:
        if _is_sampler(e, argument, scope):
            failed = True
            continue
        node = yield low.node(argument, scope)
        failed = failed or isinstance(node, Failure)
        arguments.append(node)
    return tuple(arguments), failed


def _is_sampler(e: ast.Call, argument: ast.Expression, scope: Scope) -> bool:
    """Whether a name that nothing declares is given to another language's read of a texture.

    There it may be a sampler; it is the read that is reported.
    """
    if not isinstance(argument, ast.Reference) or lookup.is_known(scope, argument.name):
        return False
    from ....stdlib.builtins.elsewhere import FUNCTIONS, METHODS

    if isinstance(e.callee, ast.Field):
        return e.callee.name.text in METHODS
    read = FUNCTIONS.get(e.callee.name) if isinstance(e.callee, ast.Reference) else None
    return read is not None and read.is_read and argument is not e.arguments[0]


def _named(
    low: Lowering,
    e: ast.Call,
    callee: ast.Reference,
    arguments: tuple[Node, ...],
    scope: Scope,
    failed: bool,
) -> Reply[Value]:
    name = callee.name
    own = scope.instance is not None and _is_map(scope.instance.record.definitions.get(name))
    if own or name in scope.locals:
        texture = lookup.value(low, name, callee.span, scope)
        return _read(low, texture, arguments, e, failed)
    symbols = scope.module.find(name)
    functions = [s for s in symbols if isinstance(s.declaration, ast.Function)]
    if functions:
        return FAILURE if failed else apply_best(low, functions, arguments, e, scope)
    if symbols and isinstance(symbols[0].declaration, ast.StructDeclaration):
        return FAILURE if failed else structure(low, symbols[0], arguments, e)
    if _is_built_in(name):
        return FAILURE if failed else _built_in(low, name, arguments, e, scope)
    surface = scope.surface
    if surface is not None and _is_map(surface.record.definitions.get(name)):
        texture = lookup.slot(low, surface, name, callee.span)
        return _read(low, texture, arguments, e, failed)
    return _no_function(low, e, callee, scope, failed)


def _read(
    low: Lowering, named: Reply[Value], arguments: tuple[Node, ...], e: ast.Call, failed: bool
) -> Step[Value]:
    """``albedo(uv)``: a read of what is named."""
    texture = yield named
    return FAILURE if failed else textures.read(low, texture, arguments, e)


def _no_function(
    low: Lowering, e: ast.Call, callee: ast.Reference, scope: Scope, failed: bool
) -> Step[Value]:
    """A call of what cannot be called; if that is a slot, it may have failed by itself."""
    name = callee.name
    if scope.instance is not None and scope.instance.has(name):
        known = yield lookup.slot(low, scope.instance, name, callee.span)
        failed = failed or isinstance(known, Failure)
    if not failed or not lookup.is_declared(scope, name):
        _not_callable(low, name, e, scope)
    return FAILURE


NOT_CALLED = frozenset(
    name for name, row in BUILTINS.items() if row.operator or row.method is not None
)
"""Rows that are written in another way than as a call."""


def _is_built_in(name: str) -> bool:
    callable_row = name in BUILTINS and name not in NOT_CALLED
    return callable_row or name == "unguarded" or is_constructor(name)


def _built_in(
    low: Lowering, name: str, arguments: tuple[Node, ...], e: ast.Call, scope: Scope
) -> Value:
    if name == "unguarded":
        return _unguarded(low, arguments, e)
    if is_constructor(name):
        return construct(low, name, arguments, e)
    return low.builtin(name, arguments, e.span, name, e.arguments, scope)


_TEXTURE_NAMES = frozenset(map(str, TEXTURES))


def _is_map(definitions: tuple[Definition, ...] | None) -> bool:
    """Whether a name is declared as a texture: as a map, or by its type, for an heir to set."""
    return any(
        isinstance(d.member, ast.Map)
        or (d.member.type is not None and d.member.type.name.text in _TEXTURE_NAMES)
        for d in definitions or ()
    )


def _not_callable(low: Lowering, name: str, e: ast.Call, scope: Scope) -> None:
    assert e.callee is not None
    span = e.callee.span
    if lookup.is_declared(scope, name):
        symbols = scope.module.find(name)
        is_slot = scope.instance is not None and scope.instance.has(name)
        hint: Hint = "" if is_slot or not symbols else advice.unshaded(symbols[0])
        if not hint:
            place = Span(span.source, span.end, span.end)
            said = f"it is a value: `{name}`, or a product, `{name} * (…)`"
            product, alone = Edit(place, " * "), Edit(e.span, name)
            hint = FixIt(said, (Fix((alone,)), Fix((product,))))
        low.report.add(rules.NOT_CALLABLE, span, found=f"`{name}`", hint=hint)
        return
    callables = {n for n in BUILTINS if n not in NOT_CALLED} | set(scope.module.visible())
    for instance in (scope.instance, scope.surface):
        if instance is not None:
            callables |= {n for n, d in instance.record.definitions.items() if _is_map(d)}
    if hint := _elsewhere(name, e):
        low.report.add(rules.UNKNOWN_NAME, span, kind="function", name=name, hint=hint)
        return
    lookup.unknown_here(low, "function", name, span, sorted(callables), scope.module)


def _elsewhere(name: str, e: ast.Call) -> Hint:
    """What to write for a function or a constructor of another shading language."""
    from ....stdlib.builtins.elsewhere import FUNCTIONS, KEYWORDS, TYPES

    if name in FUNCTIONS:
        instead, texture = FUNCTIONS[name], e.arguments[0] if e.arguments else None
        read = texture.name if isinstance(texture, ast.Reference) else ""
        return _same_arguments(e, instead.hint_for(read) if read else instead.hint, instead)
    if name in KEYWORDS:
        return KEYWORDS[name]
    if advice.is_read(name):
        return f"it is a read of a texture, written `map.{name}(…)`"
    return called_here(name, e.callee.span, TYPES[name]) if name in TYPES else ""


_SAME = re.compile(r"(\w+)\((\w+(?:, \w+)*)\)")
"""A call of one function with names for its arguments."""


def _same_arguments(e: ast.Call, said: str, instead: Instead) -> Hint:
    """A function of another language that takes the same arguments has its name changed."""
    found = _SAME.fullmatch(instead.written[0]) if len(instead.written) == 1 else None
    if found is None or len(found[2].split(", ")) != len(e.arguments) or instead.reason:
        return said
    return fix_it(said, (e.callee.span, found[1]))


def _unguarded(low: Lowering, arguments: tuple[Node, ...], e: ast.Call) -> Value:
    """``unguarded(f(x))``: the outermost operation as the hardware does it."""
    if len(arguments) != 1 or bare(arguments[0]).op != "call":
        low.report.add(rules.UNGUARDED, e.span)
        return FAILURE
    node = bare(arguments[0])
    native = low.graph.node("native", node.type, node.operands, node.data)
    return low.meanings.ascribed(native, low.meanings.of(arguments[0]))


# --- with ----------------------------------------------------------------------------------------


def _names_term(callee: ast.Expression | None, scope: Scope) -> bool:
    symbols = scope.module.find(callee.name) if isinstance(callee, ast.Reference) else ()
    return any(
        isinstance(s.declaration, ast.Function) and s.declaration.kind == "term" for s in symbols
    )


def replaced(low: Lowering, e: ast.With, scope: Scope) -> Step[Value]:
    """``term(…) with { normal = coat }``: the surface's slots replaced while the term is shaded."""
    surface = scope.surface
    if surface is None:
        low.report.add(rules.TERM_WITHOUT_SURFACE, e.span, name="with")
        return FAILURE
    check_once(low.report, (name for name, _ in e.replacements))
    given: dict[str, Replacement] = {}
    for name, expression in e.replacements:
        if not surface.has(name.text):
            known = surface.record.definitions
            lookup.unknown(low, f"slot of `{surface.record.name}`", name.text, name.span, known)
            return FAILURE
        node = yield low.node(expression, scope)
        node = assignments.given(
            low, surface.record, name.text, node, expression, scope, lookup.OUTERMOST
        )
        given[name.text] = Replacement(value=node)
    term = e.operand.callee if isinstance(e.operand, ast.Call) else None
    if not isinstance(e.operand, ast.Call) or not _names_term(term, scope):
        low.report.add(rules.WITH_NEEDS_TERM, e.operand.span)
        return FAILURE
    assert isinstance(term, ast.Reference)
    arguments, failed = yield from _arguments(low, e.operand, scope)
    shaded = changed(scope, surface=surface.with_replaced(given))
    result: Value = yield _named(low, e.operand, term, arguments, shaded, failed)
    return result
