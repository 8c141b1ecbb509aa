"""Functions that are evaluated once for each signature, with variables for their arguments.

A call is usually evaluated with its own arguments, so that everything is checked where it is
called. Where functions call each other more than once this grows exponentially. So a call that
would come to more than ``MOST_BODIES`` bodies (``call_sizes``) becomes an ``apply`` of a body that
all calls with the same signature share: the same kinds of arguments, the same constants among them,
and the same slots of the surface replaced by ``with``. Where the arguments have a say in what the
body is (a loop's bounds, for example), there is no such body, and the call is evaluated as usual.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from ....frozen import frozen
from ....stdlib.builtins.facts import UNIT
from ...diagnostics.source import Span
from ...ir import build
from ...ir.binding import close
from ...ir.node import Formal, Node
from ...ir.types import Matrix, Scalar, Vector
from ...syntax import ast
from ..names.modules import Symbol
from ..state.context import Context, Given, SharedBody, Signature
from ..state.scope import FAILURE, Failure, Instance
from ..types.coercion import is_constant
from .bodies import settle_body
from .call_marks import kinds_of
from .call_sizes import bodies_of
from .functions import fit_result, scope_of_body
from .loops import changing, compares_neighbours
from .surfaces import shaded, slots_given

MOST_BODIES = 64
"""A call that comes to more bodies than this is not evaluated with its own arguments."""


@frozen
class SharedCall:
    """A call of a function by its signature."""

    signature: Signature
    parts: tuple[Node, ...]
    """The numbers, vectors and matrices of its arguments, and then of the replaced slots."""


def shared_call(
    ctx: Context, symbol: Symbol, arguments: tuple[Node, ...], surface: Instance | None
) -> SharedCall | None:
    """A call by its signature, if that is how it is evaluated."""
    if bodies_of(ctx, symbol) <= MOST_BODIES:
        return None
    base, slots = (None, {}) if surface is None else slots_given(ctx, surface)
    values = tuple(value for value in slots.values() if isinstance(value, Node))
    kinds = kinds_of(ctx, (*arguments, *values))
    if kinds is None or len(values) < len(slots):
        return None
    given, parts = kinds
    constants = tuple(part if part.op == "constant" else None for part in parts)
    units = tuple(_is_unit(ctx, part) for part in parts)
    return SharedCall(Signature(symbol, given, constants, units, base, tuple(slots)), parts)


def applied(ctx: Context, call: SharedCall, span: Span) -> Node | Failure | None:
    """What the body for a signature gives for these arguments; ``None`` if no body serves all."""
    signature = call.signature
    if signature not in ctx.bodies:
        _settle_shared(ctx, signature, span)
    body = ctx.bodies[signature]
    if body is None or isinstance(body, Failure):
        return body
    if not body.applied:
        return body.body
    pairs = zip(call.parts, signature.constants, strict=True)
    return build.apply(ctx.tree, body.body, tuple(part for part, fixed in pairs if fixed is None))


def failed(ctx: Context, signature: Signature, before: int) -> None:
    """Note that a call failed with its own arguments, too, so that no further one is evaluated.

    If nothing was reported since ``before``, what went wrong with the shared body is.
    """
    if ctx.report.count == before:
        ctx.report.extend(ctx.withheld[signature])
    ctx.bodies[signature] = FAILURE


def _is_unit(ctx: Context, part: Node) -> bool:
    return isinstance(part.type, Vector) and ctx.ranges.of(part).unit


def _settle_shared(ctx: Context, signature: Signature, span: Span) -> None:
    """Evaluate a function's body with variables where calls differ."""
    function = signature.symbol.declaration
    assert isinstance(function, ast.Function)
    formals: list[Formal] = []
    names = (*(a.name.text for a in function.arguments), *signature.slots)
    variables = tuple(
        stand_ins(ctx, names, signature.given, signature.constants, formals, signature.units)
    )
    count = len(function.arguments)
    arguments, surface = variables[:count], signature.surface
    if surface is not None and signature.slots:
        replaced = zip(signature.slots, variables[count:], strict=True)
        surface = shaded(ctx, surface, dict(replaced))
    scope = scope_of_body(ctx, signature.symbol, arguments, surface)
    finish = partial(_finish, ctx, signature, arguments, tuple(formals), ctx.report.count)
    settle_body(ctx, signature.symbol, span, scope, finish)


def stand_ins(
    ctx: Context,
    names: Sequence[str],
    given: Sequence[Given],
    constants: Sequence[Node | None],
    formals: list[Formal],
    units: Sequence[bool] = (),
) -> Iterator[Node]:
    """The values with which a body is evaluated; its variables are added to ``formals``."""
    fixed, unit = iter(constants), iter(units)
    for name, kind in zip(names, given, strict=True):
        if isinstance(kind, Node):
            yield kind
            continue
        type_, meaning = kind
        leaves: list[Node] = []
        for short, inner in build.named_parts(name, type_):
            leaf, is_unit = next(fixed), next(unit, False)
            if leaf is None:
                formals.append(Formal(short))
                leaf = ctx.tree.node("formal", inner, (), formals[-1])
                if is_unit:
                    ctx.ranges.assume(leaf, UNIT)
            leaves.append(leaf)
        whole = build.assembled(ctx.tree, type_, iter(leaves))
        yield ctx.meanings.ascribed(whole, meaning)


def _finish(
    ctx: Context,
    signature: Signature,
    arguments: tuple[Node, ...],
    formals: tuple[Formal, ...],
    before: int,
    result: Node | Failure,
) -> None:
    """Keep a body that serves all calls of its signature, if this one does."""
    symbol = signature.symbol
    value = fit_result(ctx, symbol, result, arguments)
    if ctx.report.count > before or isinstance(value, Failure):
        # The arguments of a call may tell what is missing here. If not, it is reported then.
        ctx.withheld[signature] = ctx.report.since(before)
        ctx.report.forget(before)
        ctx.bodies[signature] = None
        return
    ctx.notes.roles.setdefault(value.id, symbol.name)
    if value.variables.isdisjoint(formals) and not value.free:
        ctx.bodies[signature] = SharedBody(value, applied=False)
    elif _is_shareable(value, formals):
        ctx.bodies[signature] = SharedBody(_closed(ctx, symbol, value, formals), applied=True)
    else:
        ctx.bodies[signature] = None


def _is_shareable(body: Node, formals: tuple[Formal, ...]) -> bool:
    """Whether a body means the same as where it is called.

    Choices between constants adapt to their use, and crossings and reads that depend on arguments
    are checked in the loop in which the call stands.
    """
    if not isinstance(body.type, Scalar | Vector | Matrix) or is_constant(body):
        return False
    inside = changing((body,), set(formals))
    return not any(node.op == "cross" or compares_neighbours(node) for node in inside)


def _closed(ctx: Context, symbol: Symbol, body: Node, formals: tuple[Formal, ...]) -> Node:
    """A body with its variables bound, and with what texts show of the function."""
    closed = close(ctx.tree, body, formals, ctx.notes.follow)
    ctx.notes.functions.setdefault(closed.id, symbol.name)
    ctx.notes.arguments.setdefault(closed.id, tuple(formal.name for formal in formals))
    if symbol.declaration.doc:
        ctx.notes.docs.setdefault(closed.id, symbol.declaration.doc)
    return closed
