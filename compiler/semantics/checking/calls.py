"""Calls of functions, builtins, constructors and texture reads; and ``with``."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import takewhile
from typing import TYPE_CHECKING, TypeGuard

from ....stdlib.builtins import BUILTINS
from ....stdlib.builtins.row import nowhere
from ....support.frozen import changed
from ...diagnostics import rules
from ...diagnostics.fixes import Edit, Fix, FixIt, Hint, fix_it
from ...diagnostics.source import Span
from ...ir.node import Node, bare
from ...ir.operations import CALL
from ...ir.types import TEXTURES, TextureType
from ...syntax import ast
from ...syntax.quoting import shortened
from ...syntax.rewriting import called_here
from ..declarations import assignments, enumerations
from ..hints import advice
from ..inheritance.records import Definition
from ..names.duplicates import check_once
from ..state.context import Context
from ..state.evaluation import plain
from ..state.scope import FAILURE, OUTERMOST, Failure, Instance, Members, Scope, Undecided, Value
from . import lookup, textures
from .aggregates import structure
from .applications import apply_best
from .builtin_calls import builtin_call
from .constructors import construct, is_constructor
from .members import member_of
from .slots import like_overridden, slot
from .step_needs import applied, is_drawn, is_frame
from .surfaces import shaded, slots_given
from .unknown_names import is_declared, is_known, unknown, unknown_here

if TYPE_CHECKING:
    from ....stdlib.other_names import Instead


def operands_of_call(e: ast.Call, scope: Scope) -> list[ast.Expression]:
    """The parts evaluated before a call: its arguments, and a callee that is no mere name."""
    operands = [a for a in e.arguments if not _has_no_value(e, a, scope)]
    callee = e.callee
    if isinstance(callee, ast.Field):
        operands.append(callee.operand)
    elif not isinstance(callee, ast.Reference):
        operands.append(callee)
    return operands


def call(ctx: Context, e: ast.Call, operands: Sequence[Value], scope: Scope) -> Value:
    """``f(…)`` for every kind of f."""
    if e.names and not _is_ordered(ctx, e):
        return FAILURE
    callee = e.callee
    if isinstance(callee, ast.Reference):
        arguments, failed = _arguments(ctx, e, operands, scope)
        return _named(ctx, e, callee, arguments, scope, failed)
    *given, owner = operands
    arguments, failed = _arguments(ctx, e, given, scope)
    if not isinstance(callee, ast.Field):
        texture = plain(ctx, owner, callee)
        return FAILURE if failed else textures.read(ctx, texture, arguments, e)
    return _of_value(ctx, e, owner, callee, arguments, failed)


def _is_ordered(ctx: Context, e: ast.Call) -> bool:
    """True if the names in a call are behind other arguments; few calls have names."""
    from .arguments import is_ordered

    return is_ordered(ctx, e)


def _of_value(
    ctx: Context,
    e: ast.Call,
    owner: Value,
    callee: ast.Field,
    arguments: tuple[Node, ...],
    failed: bool,
) -> Value:
    """``x.read(…)`` or ``x.map(…)``: only textures are called that have no name of their own."""
    if isinstance(owner, Node) and isinstance(owner.type, TextureType):
        if not textures.can_read(ctx, owner.type, callee.name, e) or failed:
            return FAILURE
        return textures.read(ctx, owner, arguments, e, callee.name)
    member = member_of(ctx, owner, callee)
    return FAILURE if failed else textures.read(ctx, member, arguments, e)


def _arguments(
    ctx: Context, e: ast.Call, values: Sequence[Value], scope: Scope
) -> tuple[tuple[Node, ...], bool]:
    """The values of a call's arguments as plain ones, and whether one of them failed."""
    written: Sequence[ast.Expression] = e.arguments
    if any(isinstance(value, Undecided) for value in values):
        from .wanted import decided_arguments

        values = decided_arguments(ctx, e, values, scope)
    if len(values) < len(written):
        written = [a for a in written if not _has_no_value(e, a, scope)]
    nodes = [plain(ctx, value, a) for value, a in zip(values, written, strict=True)]
    arguments = tuple(node for node in nodes if isinstance(node, Node))
    return arguments, len(arguments) < len(e.arguments)


def _has_no_value(e: ast.Call, argument: ast.Expression, scope: Scope) -> bool:
    """True if the call is reported, and not this argument of it."""
    return _is_drawn(argument, scope) or _is_sampler(e, argument, scope)


def _is_drawn(argument: ast.Expression, scope: Scope) -> bool:
    """True if an argument says what a pass of a frame draws.

    Then something is called here that is no pass, or a step is used as a number.
    """
    return scope.instance is not None and is_drawn(argument, scope.instance.record)


def _is_sampler(e: ast.Call, argument: ast.Expression, scope: Scope) -> bool:
    """True if an undeclared name is given to another language's read of a texture.

    There it may be a sampler, or the texture itself; it is the read that is reported.
    """
    if not isinstance(argument, ast.Reference) or is_known(scope, argument.name):
        return False
    from ....stdlib.builtins.elsewhere import METHODS
    from ....stdlib.other_names import FUNCTIONS

    if isinstance(e.callee, ast.Field):
        return e.callee.name.text in METHODS
    read = FUNCTIONS.get(e.callee.name) if isinstance(e.callee, ast.Reference) else None
    return read is not None and read.is_read


def _named(
    ctx: Context,
    e: ast.Call,
    callee: ast.Reference,
    arguments: tuple[Node, ...],
    scope: Scope,
    failed: bool,
) -> Value:
    name = callee.name
    if name in scope.locals or _is_own_map(scope, name):
        texture = lookup.value(ctx, name, callee.span, scope)
        return FAILURE if failed else textures.read(ctx, texture, arguments, e)
    symbols = scope.module.find(name)
    functions = [s for s in symbols if isinstance(s.declaration, ast.Function)]
    if functions:
        return FAILURE if failed else apply_best(ctx, functions, arguments, e, scope)
    if symbols and isinstance(symbols[0].declaration, ast.StructDeclaration):
        return FAILURE if failed else structure(ctx, symbols[0], arguments, e)
    if _is_built_in(name):
        return FAILURE if failed else _built_in(ctx, name, arguments, e, scope)
    surface = scope.surface
    if surface is not None and is_texture(surface.record.definitions.get(name)):
        texture = slot(ctx, surface, name, callee.span)
        return FAILURE if failed else textures.read(ctx, texture, arguments, e)
    return _no_function(ctx, e, callee, scope, failed)


def _no_function(
    ctx: Context, e: ast.Call, callee: ast.Reference, scope: Scope, failed: bool
) -> Failure:
    """Reports a call of something that cannot be called; a slot may have failed by itself."""
    name = callee.name
    if scope.instance is not None and scope.instance.has(name):
        known = slot(ctx, scope.instance, name, callee.span)
        failed = failed or isinstance(known, Failure)
    drawn = any(_is_drawn(argument, scope) for argument in e.arguments)
    if not failed or drawn or not is_declared(scope, name):
        _not_callable(ctx, name, e, scope)
    return FAILURE


NOT_CALLED = frozenset(
    name for name, row in BUILTINS.items() if row.operator or row.method is not None
)
"""Rows that are written in another way than as a call."""


def _is_built_in(name: str) -> bool:
    callable_row = name in BUILTINS and name not in NOT_CALLED
    return callable_row or name == "unguarded" or is_constructor(name)


def _built_in(
    ctx: Context, name: str, arguments: tuple[Node, ...], e: ast.Call, scope: Scope
) -> Value:
    if e.names:
        return _by_names(ctx, name, arguments, e, scope)
    if name == "unguarded":
        return _unguarded(ctx, arguments, e)
    if is_constructor(name):
        return construct(ctx, name, arguments, e)
    return builtin_call(ctx, name, arguments, e.span, name, e.arguments, scope)


def _by_names(
    ctx: Context, name: str, arguments: tuple[Node, ...], e: ast.Call, scope: Scope
) -> Node | Failure:
    """A builtin with names for arguments: only a choice between members has some."""
    from .arguments import refuse_names
    from .member_choices import NAME, chosen

    found = chosen(ctx, e, arguments, scope) if name == NAME else None
    if found is None:
        refuse_names(ctx, e)
    return found or FAILURE


_TEXTURE_NAMES = frozenset(map(str, TEXTURES))


def _is_own_map(scope: Scope, name: str) -> bool:
    """True if a name is a texture of the record that contains the text, or of its ancestors."""
    instance = scope.instance
    return (
        instance is not None
        and instance.declares(name, scope.level)
        and is_texture(instance.record.definitions.get(name))
    )


def is_texture(definitions: tuple[Definition, ...] | None) -> bool:
    """True if a name is declared as a texture: by a member, or by its type, to be set later."""
    return any(
        isinstance(d.member, ast.Texture)
        or (d.member.type is not None and d.member.type.name.text in _TEXTURE_NAMES)
        for d in definitions or ()
    )


def _not_callable(ctx: Context, name: str, e: ast.Call, scope: Scope) -> None:
    assert e.callee is not None
    span = e.callee.span
    record = None if scope.instance is None else scope.instance.record
    if record is not None and is_frame(record) and applied(e, scope.module) is not None:
        ctx.report.add(rules.NOT_A_VALUE, e.span, hint=advice.OF_A_STEP)
        return
    if is_declared(scope, name):
        symbols = scope.module.find(name)
        is_slot = scope.instance is not None and scope.instance.has(name)
        hint: Hint = "" if is_slot or not symbols else advice.unshaded(symbols[0])
        if symbols and isinstance(symbols[0].declaration, ast.Enumeration):
            hint = enumerations.converted(symbols[0].name, e) or Members(symbols[0]).example
        if not hint:
            place = Span(span.source, span.end, span.end)
            said = f"it is a value: `{name}`, or a product, `{name} * (…)`"
            product, alone = Edit(place, " * "), Edit(e.span, name)
            hint = FixIt(said, (Fix((alone,)), Fix((product,))))
        ctx.report.add(rules.NOT_CALLABLE, span, found=f"`{name}`", hint=hint)
        return
    if hint := _elsewhere(name, e, scope):
        ctx.report.add(rules.UNKNOWN_NAME, span, kind="function", name=name, hint=hint)
        return
    unknown_here(ctx, "function", name, span, _callables(scope), scope.module)


def _callables(scope: Scope) -> Iterator[str]:
    """The names that can be called, as far as somebody asks: for the nearest to an unknown one."""
    yield from (name for name in BUILTINS if name not in NOT_CALLED)
    yield from scope.module.visible()
    for instance in (scope.instance, scope.surface):
        if instance is not None:
            yield from (name for name, d in instance.record.definitions.items() if is_texture(d))


def _elsewhere(name: str, e: ast.Call, scope: Scope) -> Hint:
    """The hint for a function or a constructor of another shading language."""
    from ....stdlib.builtins.elsewhere import COLUMNS_FIRST, KEYWORDS, TYPES
    from ....stdlib.other_names import FUNCTIONS, TEXTURE

    if name in FUNCTIONS:
        instead, texture = FUNCTIONS[name], e.arguments[0] if e.arguments else None
        read = texture.name if isinstance(texture, ast.Reference) else ""
        said = instead.hint_for(read) if read else instead.hint
        if read and instead.is_read and not is_known(scope, read):
            return f"{said}, with `map {read} : texture2d` in the material"
        if read and instead.written == (f"{TEXTURE}(uv)",) and len(e.arguments) == 2:
            written = f"{read}({e.arguments[1].span.text})"
            return fix_it(f"it is `{shortened(written)}` here", (e.span, written))
        return _same_arguments(e, said, instead)
    if name in KEYWORDS:
        return KEYWORDS[name]
    if advice.is_read(name):
        return f"it is a read of a texture, written `map.{name}(…)`"
    if name in TYPES:
        return called_here(name, e.callee.span, TYPES[name], COLUMNS_FIRST.get(name, ""))
    return _of_nodes(name, scope)


def _of_nodes(name: str, scope: Scope) -> str:
    """The hint for a node of an editor, if nothing that can be called here is named alike."""
    from ....stdlib.other_names import NODES_BY_FOLDED, folded

    plain = folded(name)
    if plain not in NODES_BY_FOLDED or any(folded(known) == plain for known in _callables(scope)):
        return ""
    return NODES_BY_FOLDED[plain].hint


_SAME = r"(\w+)\((\w+(?:, \w+)*)\)"
"""A call of one function with names for its arguments."""


def _same_arguments(e: ast.Call, said: str, instead: Instead) -> Hint:
    """A function of another language that takes the same arguments has its name changed."""
    found = re.fullmatch(_SAME, instead.written[0]) if len(instead.written) == 1 else None
    if found is None or len(found[2].split(", ")) != len(e.arguments) or instead.reason:
        return said
    return fix_it(said, (e.callee.span, found[1]))


def _unguarded(ctx: Context, arguments: tuple[Node, ...], e: ast.Call) -> Value:
    """``unguarded(f(x))``: the outermost operation as the hardware does it."""
    if len(arguments) != 1 or bare(arguments[0]).op != "call":
        ctx.report.add(rules.UNGUARDED, e.span)
        return FAILURE
    node = bare(arguments[0])
    name = CALL.data(node)
    if BUILTINS[name].domain is nowhere:
        hint = f"no hardware has `{name}`, so there is no guard to leave out"
        ctx.report.add(rules.UNGUARDED, e.span, hint=hint)
        return FAILURE
    native = ctx.tree.node("native", node.type, node.operands, node.data)
    if name in ("div", "mod") and ctx.constants.is_zero(node.operands[1]):
        found = ctx.report.finding(rules.ZERO_DIVISOR, e.arguments[0].span)
        ctx.deferred.add(native, found, *arguments)
    return ctx.meanings.ascribed(native, ctx.meanings.of(arguments[0]))


# --- with ----------------------------------------------------------------------------------------


def _names_term(callee: ast.Expression | None, scope: Scope) -> bool:
    symbols = scope.module.find(callee.name) if isinstance(callee, ast.Reference) else ()
    return any(
        isinstance(s.declaration, ast.Function) and s.declaration.kind == "term" for s in symbols
    )


def operands_of_with(e: ast.With, scope: Scope) -> list[ast.Expression]:
    """The new values of slots, and the arguments of the term; none where there is no surface."""
    if scope.surface is None:
        return []
    operands = [expression for _, expression in _known_replacements(e, scope.surface)]
    if len(operands) == len(e.replacements) and _is_call_of_term(e.operand, scope):
        operands += operands_of_call(e.operand, scope)
    return operands


def _known_replacements(e: ast.With, surface: Instance) -> list[tuple[ast.Name, ast.Expression]]:
    """The replacements up to one of a slot that the surface does not have."""
    return list(takewhile(lambda replacement: surface.has(replacement[0].text), e.replacements))


def _is_call_of_term(operand: ast.Expression, scope: Scope) -> TypeGuard[ast.Call]:
    return isinstance(operand, ast.Call) and _names_term(operand.callee, scope)


def _unknown_callee(e: ast.Call, scope: Scope) -> str:
    """The name that is called, if it means nothing: a term, or a pass of a frame, misspelt."""
    name = e.callee.name if isinstance(e.callee, ast.Reference) else ""
    return "" if is_known(scope, name) or _is_built_in(name) else name


def replaced(ctx: Context, e: ast.With, operands: Sequence[Value], scope: Scope) -> Value:
    """``term(…) with { normal = coat }``: the surface's slots replaced while the term is shaded."""
    surface = scope.surface
    if surface is None:
        ctx.report.add(rules.TERM_WITHOUT_SURFACE, e.span, name="with")
        return FAILURE
    check_once(ctx.report, (name for name, _ in e.replacements))
    if isinstance(e.operand, ast.Call) and (called := _unknown_callee(e.operand, scope)):
        _not_callable(ctx, called, e.operand, scope)
        return FAILURE
    known = _known_replacements(e, surface)
    given: dict[str, Node | Failure] = {}
    for (name, expression), value in zip(known, operands, strict=False):
        wanted = assignments.type_of(ctx, surface.record, name.text)
        node = plain(ctx, value, expression, wanted)
        base, _ = slots_given(ctx, surface)
        node = like_overridden(ctx, base, name.text, OUTERMOST, node)
        given[name.text] = assignments.assigned(
            ctx, surface.record, name.text, node, expression, scope, OUTERMOST
        )
    if len(known) < len(e.replacements):
        name, _ = e.replacements[len(known)]
        slots = surface.record.definitions
        unknown(ctx, f"slot of `{surface.record.name}`", name.text, name.span, slots)
        return FAILURE
    if not _is_call_of_term(e.operand, scope):
        ctx.report.add(rules.WITH_NEEDS_TERM, e.operand.span)
        return FAILURE
    term = e.operand.callee
    assert isinstance(term, ast.Reference)
    arguments, failed = _arguments(ctx, e.operand, operands[len(known) :], scope)
    within = changed(scope, surface=shaded(ctx, surface, given))
    return _named(ctx, e.operand, term, arguments, within, failed)
