"""Functions and terms are checked once for each signature, with variables for their arguments.

``applications`` asks this module for every call of a function. The first call with a signature has
the body checked with variables in the place of its arguments; then each call with that signature is
this body with its own arguments. A signature is what checks may ask of arguments: the type and the
meaning of each, its form if it is constant, and if it has one number in all lanes. That of a term
also has the surface whose slots the term reads. Some calls have no signature, and each of them is
checked by itself: where a body depends on more (as where the range of an argument bounds a loop),
and where checks look into an argument (a choice between literals, a large constant expression).

A call in a body is the called body once more. If each function calls the one before it twice, the
number of bodies doubles with every function. So a call that would come to more than ``MOST_BODIES``
bodies (``call_sizes``) is an ``apply`` of one body, which all calls with its signature share, terms
included. Their signature also says which arguments have length one and which slots ``with`` has
replaced.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from ....stdlib.builtins.facts import UNIT
from ....support.frozen import EMPTY, frozen
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir import build
from ...ir.binding import close
from ...ir.node import Formal, Node, bare, reachable
from ...ir.types import (
    Matrix,
    Scalar,
    Struct,
    Type,
    Vector,
    width,
)
from ...syntax import ast
from ..names.modules import Symbol
from ..state.context import Context, Given, KeptBody, Shape, SharedBody, Signature, Unfixed
from ..state.scope import FAILURE, Failure, Instance
from ..types.coercion import is_constant
from .bodies import settle_body
from .call_marks import kinds_of
from .call_sizes import bodies_of
from .functions import fit_result, scope_of_body, used
from .kept_bodies import of_operands, repeated_kept, taken
from .loop_contents import changing, needs_others
from .shapes import computed_shape, is_fixed, is_unit, literal_shape, shape_of, varying_part
from .surfaces import shaded, slots_given

MOST_BODIES = 96
"""A call that comes to more bodies than this applies its body instead of repeating it."""


@frozen
class SharedCall:
    """A call of a function by its signature."""

    signature: Signature
    parts: tuple[Node, ...]
    """The numbers, vectors and matrices of its arguments, and then of the replaced slots.

    Of a vector with one number in all lanes, this is the number.
    """


def shared_call(
    ctx: Context, symbol: Symbol, arguments: tuple[Node, ...], surface: Instance | None
) -> SharedCall | None:
    """A call by its signature; ``None`` if there is none that says enough of the arguments."""
    repeated = bodies_of(ctx, symbol) <= MOST_BODIES
    # A repeated body reads this very surface; one that is applied has replaced slots as variables.
    base, slots = surface, EMPTY
    if surface is not None and not repeated:
        base, slots = slots_given(ctx, surface)
    values = tuple(value for value in slots.values() if isinstance(value, Node))
    kinds = kinds_of(ctx, (*arguments, *values))
    if kinds is None or len(values) < len(slots):
        return None
    given, parts = kinds
    shapes = tuple(shape_of(ctx, part) if repeated else literal_shape(part) for part in parts)
    # A signature with the value of a large constant is for bodies that are kept, and no others:
    # what is found here about such a constant is told of its own expression.
    is_for_kept = Unfixed.ADAPTS in shapes
    if is_for_kept:
        shapes = tuple(map(partial(computed_shape, ctx), parts, shapes))
    if Unfixed.ADAPTS in shapes:
        return None
    units = () if repeated else tuple(is_unit(ctx, part) for part in parts)
    signature = Signature(symbol, given, shapes, units, base, tuple(slots), repeated)
    call = SharedCall(signature, tuple(map(varying_part, parts, shapes)))
    return None if is_for_kept and not _is_known(ctx, call) else call


def applied(ctx: Context, call: SharedCall, span: Span) -> Node | Failure | None:
    """The result of the body for a signature; ``None`` if no body serves all arguments."""
    signature = call.signature
    if not _is_known(ctx, call):
        check_body(ctx, call, span)
    body = ctx.bodies.known[signature]
    if body is None or isinstance(body, Failure):
        return body
    if isinstance(body, KeptBody):
        return repeated_kept(ctx, body, call.parts)
    if signature.repeated:
        return _repeated(ctx, body, call.parts)
    if not body.formals:
        return body.value
    pairs = zip(call.parts, signature.shapes, strict=True)
    arguments = tuple(part for part, shape in pairs if not is_fixed(shape))
    return _parted(ctx, body.value, build.apply(ctx.tree, body.value, arguments))


def failed(ctx: Context, signature: Signature, before: int) -> None:
    """Notes that a call failed with its own arguments, too, so that no further one is checked.

    If nothing was reported since ``before``, the errors in the shared body are.
    """
    if ctx.report.count == before:
        ctx.report.extend(ctx.bodies.withheld[signature])
    ctx.bodies.known[signature] = FAILURE


def _is_known(ctx: Context, call: SharedCall) -> bool:
    """True if the body for a call has been checked, here or in another elaboration."""
    signature, known = call.signature, ctx.bodies.known
    if signature not in known:
        pairs = zip(call.parts, signature.shapes, strict=True)
        fixed = [part for part, shape in pairs if is_fixed(shape)]
        body = None if any(map(ctx.deferred.concerns, fixed)) else taken(ctx, signature, call.parts)
        if body is None:
            return False
        known[signature] = body
    return True


# --- checking a body -----------------------------------------------------------------------------


def check_body(ctx: Context, call: SharedCall, span: Span) -> None:
    """Check a function's body with variables where calls differ."""
    signature = call.signature
    function = signature.symbol.declaration
    assert isinstance(function, ast.Function)
    pairs = zip(call.parts, signature.shapes, strict=True)
    fixed = [part if is_fixed(shape) else shape for part, shape in pairs]
    first = len(ctx.tree)
    names = (*(a.name.text for a in function.arguments), *signature.slots)
    stand_in = stand_ins(ctx, names, signature.given, fixed, signature.units)
    count = len(function.arguments)
    arguments, surface = stand_in.values[:count], signature.surface
    if surface is not None and signature.slots:
        replaced = zip(signature.slots, stand_in.values[count:], strict=True)
        surface = shaded(ctx, surface, dict(replaced))
    scope = scope_of_body(ctx, signature.symbol, arguments, surface)
    around = ctx.report.count, len(ctx.deferred), ctx.progress.unproven
    ctx.progress.unproven = 0
    in_use = None
    if any(map(is_fixed, signature.shapes)):
        in_use = used(signature.symbol, scope, span)
    finish = partial(_finish, ctx, signature, stand_in, arguments, first, around, in_use)
    settle_body(ctx, signature.symbol, span, scope, finish)


@frozen
class StandIns:
    """The placeholders with which a body is checked."""

    values: tuple[Node, ...]
    """A placeholder for each argument, and then for each replaced slot."""
    parts: tuple[Node, ...]
    """The numbers, vectors and matrices in ``values``.

    They are variables, and constants that are the same in all calls.
    """
    formals: tuple[Formal, ...]


def stand_ins(
    ctx: Context,
    names: Sequence[str],
    given: Sequence[Given],
    fixed: Sequence[Node | Shape],
    units: Sequence[bool] = (),
) -> StandIns:
    """Variables for the parts of values that are not ``fixed``, and the values made of these.

    Where a shape stands in ``fixed``, there is a variable for what varies in a part of this shape.
    """
    parts: list[Node] = []
    formals: list[Formal] = []
    constants, unit = iter(fixed), iter(units)

    def leaf(name: str, type_: Type) -> Node:
        constant, is_unit = next(constants), next(unit, False)
        if isinstance(constant, Node):
            parts.append(constant)
            return constant
        is_splat = constant is Unfixed.SPLAT
        formals.append(Formal(name))
        varying = Scalar(type_.kind) if is_splat and isinstance(type_, Vector) else type_
        variable = ctx.tree.node("formal", varying, (), formals[-1])
        if is_unit:
            ctx.ranges.assume(variable, UNIT)
        parts.append(variable)
        return build.splat(ctx.tree, variable, width(type_)) if is_splat else variable

    values: list[Node] = []
    for name, kind in zip(names, given, strict=True):
        if isinstance(kind, Node):
            values.append(kind)
            continue
        type_, meaning = kind
        leaves = [leaf(short, inner) for short, inner in build.named_parts(name, type_)]
        whole = build.assembled(ctx.tree, type_, iter(leaves))
        values.append(ctx.meanings.ascribed(whole, meaning))
    return StandIns(tuple(values), tuple(parts), tuple(formals))


def _finish(
    ctx: Context,
    signature: Signature,
    stand_in: StandIns,
    arguments: tuple[Node, ...],
    first: int,
    around: tuple[int, int, int],
    in_use: Label | None,
    result: Node | Failure,
) -> None:
    """Keep a body that serves all calls of its signature, if this one does.

    ``in_use`` tells where the constants come from that it was checked with.
    """
    symbol = signature.symbol
    before, deferred, ctx.progress.unproven, unproven = *around, ctx.progress.unproven
    value = fit_result(ctx, symbol, result, arguments)
    if ctx.report.count > before or isinstance(value, Failure):
        # The arguments of a call may supply the missing facts. If not, it is reported then. But
        # a function that calls itself does so for all arguments.
        found = ctx.report.since(before)
        ctx.report.forget(before)
        ctx.deferred.forget(deferred)
        ctx.report.extend([d for d in found if d.rule is rules.RECURSIVE_FUNCTION])
        ctx.bodies.withheld[signature] = tuple(
            d for d in found if d.rule is not rules.RECURSIVE_FUNCTION
        )
        ctx.bodies.known[signature] = None
        return
    if in_use is not None:
        ctx.deferred.explain(deferred, in_use)
    ctx.notes.roles.setdefault(value.id, symbol.name)
    if signature.repeated:
        own = _own(signature, value, stand_in.formals, first)
        body = None if unproven else SharedBody(value, stand_in.formals, stand_in.parts, own)
    elif value.variables.isdisjoint(stand_in.formals) and not value.free:
        body = SharedBody(value, ())
    elif _is_shareable(ctx, value, stand_in.formals):
        closed = _closed(ctx, symbol, value, stand_in.formals)
        ctx.bodies.applicable.add(closed)
        body = SharedBody(closed, stand_in.formals)
    else:
        body = None
    ctx.bodies.known[signature] = body


def _own(
    signature: Signature, value: Node, formals: tuple[Formal, ...], first: int
) -> tuple[Node, ...]:
    """The nodes of a body that each call repeats, operands before users; ``first`` is its first.

    A term also reads slots, whose values it may have been the first to ask for. They are not its
    own, so only what depends on its arguments is.
    """
    made = reachable((value,))
    if signature.surface is None:
        return tuple(node for node in made if node.id >= first)
    return tuple(node for node in made if not node.variables.isdisjoint(formals))


# --- a body once more ----------------------------------------------------------------------------


def _repeated(ctx: Context, body: SharedBody, parts: tuple[Node, ...]) -> Node:
    """A checked body with other arguments in the place of those that it was checked with."""
    made = dict(zip(body.parts, parts, strict=True))
    for variable, part in made.items():
        for table in (ctx.notes.names, ctx.notes.docs):
            if part.operands and variable.id in table:
                table.setdefault(part.id, table[variable.id])
    for node in body.own:
        if node in made:
            continue
        operands = tuple([made.get(operand, operand) for operand in node.operands])
        new = made[node] = of_operands(ctx, node, operands)
        ctx.follow(node, new)
    return made.get(body.value, body.value)


# --- a body to apply -----------------------------------------------------------------------------


def _parted(ctx: Context, body: Node, call: Node) -> Node:
    """The value of a call: of a structure, its members; of the body, where no argument counts.

    So checks see the constants of a structure, as they do where a body is repeated.
    """
    if build.parts_of(call.type) is None or bare(body).op != "struct":
        return call
    pairs = zip(build.flattened(ctx.tree, bare(body)), build.flattened(ctx.tree, call), strict=True)
    leaves = (own if not own.free else part for own, part in pairs)
    whole = build.assembled(ctx.tree, call.type, leaves)
    return ctx.meanings.ascribed(whole, ctx.meanings.of(call))


def _is_shareable(ctx: Context, body: Node, formals: tuple[Formal, ...]) -> bool:
    """True if a body means the same as where it is called.

    Choices between constants adapt to their use, and crossings and reads that depend on arguments
    are checked in the loop in which the call stands.
    """
    if not _is_delivered(body.type) or is_constant(body):
        return False
    inside = changing((body,), set(formals), ctx.bodies.applicable)
    return not any(node.op == "cross" or needs_others(node) for node in inside)


def _is_delivered(type_: Type) -> bool:
    """True if a function's result may be of this type: numbers, or a structure of them."""
    parts = build.parts_of(type_) if isinstance(type_, Struct) else None
    if parts is not None:
        return all(map(_is_delivered, parts))
    return isinstance(type_, Scalar | Vector | Matrix)


def _closed(ctx: Context, symbol: Symbol, body: Node, formals: tuple[Formal, ...]) -> Node:
    """A body with its variables bound, and with notes on the function for the texts."""
    closed = close(ctx.tree, body, formals, ctx.follow)
    ctx.notes.functions.setdefault(closed.id, symbol.name)
    ctx.notes.arguments.setdefault(closed.id, tuple(formal.name for formal in formals))
    if symbol.declaration.doc:
        ctx.notes.docs.setdefault(closed.id, symbol.declaration.doc)
    return closed
