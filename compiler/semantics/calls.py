"""Calls: functions and terms, builtins, constructors, texture reads, ``with``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...frozen import changed
from ...stdlib.builtins import BUILTINS
from ..diagnostics import rules
from ..diagnostics.diagnostic import Label
from ..diagnostics.source import Span
from ..ir.node import Node, bare
from ..ir.types import TEXTURES, Texture
from ..syntax import ast
from ..trampoline import Reply, Step
from . import advice, fitting, lights, lookup, overriding, textures
from .aggregates import structure
from .callees import marked
from .coerce import coerce
from .construct import construct, is_constructor
from .declared import declared_type, numbers_of
from .functions import bound, entered, fit_result, usage
from .generics import shown, unfounded, untold
from .modules import Symbol
from .operands import listed
from .records import Definition
from .scope import FAILURE, Application, Failure, Instance, Replacement, Scope, Value
from .unique import check_once
from .wording import counted

if TYPE_CHECKING:
    from .lower import Lowering


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
    member = yield low.part(owner, e.callee.name)
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
    from ...stdlib.builtins.elsewhere import FUNCTIONS, METHODS

    if isinstance(e.callee, ast.Field):
        return e.callee.name.text in METHODS
    read = FUNCTIONS.get(e.callee.name) if isinstance(e.callee, ast.Reference) else None
    return read is not None and "albedo" in read.hint and argument is not e.arguments[0]


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
        return FAILURE if failed else _function(low, functions, arguments, e, scope)
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
        hint = "" if is_slot or not symbols else advice.unshaded(symbols[0])
        hint = hint or f"it is a value: `{name}`, or a product, `{name} * (…)`"
        low.report.add(rules.NOT_CALLABLE, span, found=f"`{name}`", hint=hint)
        return
    callables = {n for n in BUILTINS if n not in NOT_CALLED} | set(scope.module.visible())
    for instance in (scope.instance, scope.surface):
        if instance is not None:
            callables |= {n for n, d in instance.record.definitions.items() if _is_map(d)}
    if hint := _elsewhere(name, e.arguments):
        low.report.add(rules.UNKNOWN_NAME, span, kind="function", name=name, hint=hint)
        return
    lookup.unknown_here(low, "function", name, span, sorted(callables), scope.module)


def _elsewhere(name: str, arguments: tuple[ast.Expression, ...]) -> str:
    """What to write for a function or a constructor of another shading language."""
    from ...stdlib.builtins.elsewhere import FUNCTIONS, KEYWORDS, TYPES

    if name in FUNCTIONS:
        hint = FUNCTIONS[name].hint
        texture = arguments[0] if arguments else None
        return hint.replace("albedo", texture.name) if isinstance(texture, ast.Reference) else hint
    if name in KEYWORDS:
        return KEYWORDS[name]
    if advice.is_read(name):
        return f"it is a read of a texture, written `map.{name}(…)`"
    return f"it is `{TYPES[name]}` here" if name in TYPES else ""


def _unguarded(low: Lowering, arguments: tuple[Node, ...], e: ast.Call) -> Value:
    """``unguarded(f(x))``: the outermost operation as the hardware does it."""
    if len(arguments) != 1 or bare(arguments[0]).op != "call":
        low.report.add(rules.UNGUARDED, e.span)
        return FAILURE
    node = bare(arguments[0])
    native = low.graph.node("native", node.type, node.operands, node.data)
    return low.meanings.ascribed(native, low.meanings.of(arguments[0]))


# --- functions and terms -------------------------------------------------------------------------


def _function(
    low: Lowering,
    overloaded: list[Symbol],
    arguments: tuple[Node, ...],
    e: ast.Call,
    scope: Scope,
) -> Reply[Value]:
    symbol = overloaded[0] if len(overloaded) == 1 else best(low, overloaded, arguments)
    if symbol is not None:
        return _apply(low, symbol, arguments, e, scope)
    low.report.add(
        rules.NO_OVERLOAD, e.span, name=overloaded[0].name, arguments=listed(arguments),
        labels=[Label(s.declaration.name.span, "a candidate") for s in overloaded],
    )  # fmt: skip
    return FAILURE


def best(low: Lowering, overloaded: list[Symbol], arguments: tuple[Node, ...]) -> Symbol | None:
    """The overload that takes the arguments most nearly as they are.

    What need not adapt comes before what must, concrete types before type parameters, and then the
    order of the file decides.
    """
    ranked: list[tuple[bool, bool, int]] = []
    for number, symbol in enumerate(overloaded):
        adapts = accepts(low, symbol, arguments)
        function = symbol.declaration
        assert isinstance(function, ast.Function)
        if adapts is not None:
            ranked.append((adapts, bool(function.type_parameters), number))
    return overloaded[min(ranked)[2]] if ranked else None


def accepts(low: Lowering, symbol: Symbol, arguments: tuple[Node, ...]) -> bool | None:
    """Whether an overload takes these arguments only if one adapts; ``None`` if not at all.

    Reports nothing.
    """
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    if len(function.arguments) != len(arguments):
        return None
    variables = bound(low, function, arguments)
    if variables is None:
        return None
    adapts = False
    for formal, argument in zip(function.arguments, arguments, strict=True):
        wanted = declared_type(low, formal.type, symbol.module, variables)
        generic = formal.type.name.text in variables
        fits = None if wanted is None else fitting.adapts(low, argument, wanted, broadcast=generic)
        if fits is None:
            return None
        adapts = adapts or fits
    return adapts


def _apply(
    low: Lowering, symbol: Symbol, arguments: tuple[Node, ...], e: ast.Call, scope: Scope
) -> Reply[Value]:
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    fitted = _fit_arguments(low, symbol, arguments, e, scope)
    if fitted is None:
        return FAILURE
    if function.per is not None:
        return lights.per_light(low, symbol, fitted, e.span, scope)
    surface = scope.surface if function.kind == "term" else None
    if function.kind == "term" and surface is None:
        low.report.add(rules.TERM_WITHOUT_SURFACE, e.span, name=symbol.name)
        return FAILURE
    return apply_body(low, symbol, fitted, e.span, surface)


def _fit_arguments(
    low: Lowering, symbol: Symbol, arguments: tuple[Node, ...], e: ast.Call, scope: Scope
) -> tuple[Node, ...] | None:
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    if len(arguments) != len(function.arguments):
        low.report.add(
            rules.WRONG_COUNT, e.span, name=symbol.name,
            expected=counted(len(function.arguments), "argument"), found=len(arguments),
            labels=[Label(function.name.span, "declared here")], hint=f"it is `{usage(function)}`",
        )  # fmt: skip
        return None
    variables = bound(low, function, arguments)
    if variables is None and (untold(function) or unfounded(function)):  # Which is reported.
        return None
    if variables is None:
        low.report.add(
            rules.NO_OVERLOAD, e.span, name=symbol.name, arguments=listed(arguments),
            labels=[Label(function.name.span, "declared here")], hint=f"it is `{usage(function)}`",
        )  # fmt: skip
        return None
    fitted = []
    for formal, argument, written in zip(function.arguments, arguments, e.arguments, strict=True):
        wanted = declared_type(low, formal.type, symbol.module, variables)
        if wanted is None:
            return None
        wanted = changed(wanted, text=f"{wanted.text} for `{formal.name.text}`")
        generic = formal.type.name.text in variables
        broadcast = coerce(low.graph, argument, wanted.type, broadcast=generic)
        node = low.as_declared(broadcast or argument, wanted, written, scope)
        if isinstance(node, Failure):
            return None
        fitted.append(node)
    return tuple(fitted)


def apply_body(
    low: Lowering,
    symbol: Symbol,
    arguments: tuple[Node, ...],
    span: Span,
    surface: Instance | None = None,
    use: str = "called here",
) -> Reply[Node | Failure]:
    """A function's value for fitted arguments; the same call is lowered once.

    ``use`` is what messages about a generic body say of ``span``.
    """
    key = (symbol, tuple(argument.id for argument in arguments), surface)
    if key in low.applied:
        return low.applied[key]
    if not entered(low, symbol, span):
        return FAILURE
    return _new_application(low, key, arguments, span, use)


def _new_application(
    low: Lowering, key: Application, arguments: tuple[Node, ...], span: Span, use: str
) -> Step[Node | Failure]:
    symbol, _, surface = key
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    locals_ = {
        formal.name.text: argument
        for formal, argument in zip(function.arguments, arguments, strict=True)
    }
    variables = bound(low, function, arguments) or {}
    values = {**numbers_of(low, variables), **locals_}
    scope = Scope(symbol.module, surface=surface, locals=values, variables=variables)
    before = low.report.count
    result: Node | Failure = yield lookup.body(low, function, scope)
    result = fit_result(low, symbol, result, arguments)
    if variables:
        label = Label(span, f"in `{shown(symbol.name, variables)}`, {use}")
        low.report.explain(before, label)
    low.active.pop(symbol)
    if isinstance(result, Node) and result.operands:
        low.notes.roles.setdefault(result.id, symbol.name)
        if surface is None:
            result = marked(low, symbol, arguments, result)
            low.notes.roles.setdefault(result.id, symbol.name)
    low.applied[key] = result
    return result


def called(
    low: Lowering, symbol: Symbol, arguments: tuple[Node, ...], span: Span
) -> Step[Node | Failure]:
    """A library function's value for arguments that it is known to take."""
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    variables = bound(low, function, arguments)
    assert variables is not None
    fitted = []
    for formal, argument in zip(function.arguments, arguments, strict=True):
        declared = declared_type(low, formal.type, symbol.module, variables)
        assert declared is not None
        fitted.append(low.meanings.ascribed(argument, declared.meaning))
    result: Node | Failure = yield apply_body(low, symbol, tuple(fitted), span)
    return result


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
        node = overriding.given(
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
