"""Reads of textures: ``albedo(uv)``, ``albedo.level(uv, 2)``, ``shadow(uv, depth)`` and others.

Each is a row of ``stdlib/builtins/texture.py``, found by how it is written and by the texture.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ....stdlib.builtins import BUILTINS
from ....stdlib.builtins.row import Builtin
from ....support.frozen import frozen
from ...diagnostics import rules
from ...diagnostics.fixes import Hint, fix_it
from ...diagnostics.nearest import respelling
from ...diagnostics.source import Span
from ...ir import build
from ...ir.node import Node
from ...ir.signatures import FIXED, TEXTURE_FAMILIES, dependent, meaning, parsed
from ...ir.types import INT, TextureType, Type
from ...syntax import ast
from ...syntax.quoting import shortened, spanned
from ..declarations.fitting import fit
from ..state.context import Context
from ..state.scope import FAILURE, Failure, Value
from .builtin_calls import builtin_call

_READS = tuple(row for row in BUILTINS.values() if row.method is not None)


@frozen
class _Way:
    """One way of reading textures of one type."""

    row: Builtin
    names: tuple[str, ...]
    """The names of the operands behind the texture, for messages."""
    operands: tuple[Type, ...]
    result: Type

    def usage(self, callee: str) -> str:
        """The form in which it is written, with types."""
        given = len(self.operands) - len(self.row.optional)
        defaults = ("",) * given + tuple(f" = {value}" for value in self.row.optional)
        rows = zip(self.names, self.operands, defaults, strict=True)
        return f"{callee}({', '.join(f'{name}: {type_}{value}' for name, type_, value in rows)})"


def read(
    ctx: Context,
    texture: Value,
    arguments: tuple[Node, ...],
    e: ast.Call,
    method: ast.Name | None = None,
) -> Value:
    """A texture called, or one of its methods."""
    if isinstance(texture, Failure):
        return FAILURE
    if not isinstance(texture, Node) or not isinstance(texture.type, TextureType):
        place = Span(e.callee.span.source, e.callee.span.end, e.callee.span.end)
        said = f"a product is written `{spanned(e.callee.span)} * (…)`"
        hint = fix_it(said, (place, " * "))
        ctx.report.add(rules.NOT_CALLABLE, e.callee.span, found="this", hint=hint)
        return FAILURE
    name = "" if method is None else method.text
    way = next(_ways(texture.type, name), None)
    if way is None:
        _no_way(ctx, texture.type, name, e.callee.span if method is None else method.span)
        return FAILURE
    operands = _operands(ctx, way, arguments, e)
    if operands is None:
        return FAILURE
    return builtin_call(ctx, way.row.name, (texture, *operands), e.span, "a texture read")


def can_read(ctx: Context, type_: TextureType, method: ast.Name, e: ast.Call) -> bool:
    """True if textures of a type have a read, which ``e`` calls; reports if they have not."""
    if next(_ways(type_, method.text), None) is None:
        _no_way(ctx, type_, method.text, method.span, _foreign(e, method.text))
        return False
    return True


def operand_names(type_: TextureType, method: str) -> tuple[str, ...]:
    """The names of what a read of a texture takes, for pictures; none if there is no such read."""
    way = next(_ways(type_, method), None)
    return () if way is None else way.names


def _ways(type_: TextureType, method: str) -> Iterator[_Way]:
    """The reads of textures of a type by a method: one, if at all."""
    for row in _READS:
        for signature in row.signatures if row.method == method else ():
            (first, *rest), result = parsed(signature)
            if type_ == FIXED.get(first) or type_ in TEXTURE_FAMILIES.get(first, ()):
                bound: dict[str, Type] = {first: type_}
                types = tuple(FIXED.get(word) or dependent(word, bound) for word in rest)
                names = list(row.parameters)
                if len(names) < len(types):
                    names.insert(1, "layer")
                operands = tuple(type_ for type_ in types if type_ is not None)
                yield _Way(row, tuple(names), operands, meaning(result, bound))


def _no_way(ctx: Context, type_: TextureType, method: str, span: Span, foreign: Hint = "") -> None:
    """Report a read that no texture of a type has; ``foreign`` is the hint if others have it."""
    known = {str(row.method): None for row in _READS if next(_ways(type_, str(row.method)), None)}
    listed = ", ".join(f"`{name}`" for name in known if name)
    if "" in known:
        listed = f"a read by coordinate, {listed}"
    if method and all(row.method != method for row in _READS):
        ctx.report.add(
            rules.UNKNOWN_NAME, span, kind=f"read of `{type_}`", name=method,
            hint=foreign or respelling(method, span, known) or f"it has {listed}",
        )  # fmt: skip
        return
    what = f"`{method}`" if method else "read by coordinate"
    ctx.report.add(rules.TEXTURE_LACKS_READ, span, type=type_, read=what, hint=f"it has {listed}")


def _foreign(e: ast.Call, method: str) -> Hint:
    """The hint for a read of a texture by a method of another language's."""
    from ....stdlib.builtins.elsewhere import METHODS

    pattern, callee = METHODS.get(method, ""), e.callee
    if not pattern or not isinstance(callee, ast.Field):
        return ""
    head, _, rest = pattern.removesuffix(")").partition("(")
    read = head.replace("name", callee.operand.span.text, 1)
    wanted = rest.count(",") + bool(rest)
    given = [argument.span.text for argument in e.arguments]
    if len(given) > wanted and isinstance(e.arguments[0], ast.Reference):
        del given[0]  # The sampler, which belongs to the texture here.
    if len(given) != wanted:
        return f"it is `{read}({rest})` here"
    written = f"{read}({', '.join(given)})"
    return fix_it(f"it is `{shortened(written)}` here", (e.span, written))


def _operands(
    ctx: Context, way: _Way, arguments: tuple[Node, ...], e: ast.Call
) -> tuple[Node, ...] | None:
    """The operands behind the texture as the read takes them."""
    numbers: Sequence[int] | None = range(len(arguments))
    least = len(way.operands) - len(way.row.optional)
    if e.names or not least <= len(arguments) <= len(way.operands):
        numbers = _placed(ctx, way, e)
    if numbers is None:
        return None
    given: dict[int, Node] = {}
    for node, number, argument in zip(arguments, numbers, e.arguments, strict=True):
        type_ = way.operands[number]
        operand = fit(ctx, node, type_, str(type_), argument.span)
        if isinstance(operand, Failure):
            return None
        given[number] = operand
    for number, value in enumerate(way.row.optional, least):
        if number not in given:  # It is left out.
            given[number] = build.constant(ctx.tree, INT, value)
    operands = tuple([given[number] for number in range(len(way.operands))])
    for place in way.row.constants:
        lane = ctx.constants.known_integer(operands[place])
        if lane is None and ctx.is_left_to_a_use(operands[place]):
            continue
        if lane is None or not 0 <= lane <= 3:
            written = e.arguments[numbers.index(len(operands) + place)]
            ctx.report.add(rules.NOT_A_LANE, written.span)
            return None
    return operands


def _placed(ctx: Context, way: _Way, e: ast.Call) -> list[int] | None:
    """The number of the operand for each argument of a read, with names or a wrong number."""
    from .arguments import Head, placed

    span = e.callee.span
    written = span.source.text[span.start : span.end]
    least = len(way.operands) - len(way.row.optional)
    head = Head(written, way.names, frozenset(way.names[least:]), way.usage(written))
    return placed(ctx, e, head)
