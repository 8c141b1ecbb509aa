"""Enumerations: types whose values have names, such as ``Mode`` of ``enum Mode { add, mix }``.

A value is an ``int``, the place of its member among the others, with a meaning that says of which
enumeration. ``meaning_rules`` keeps numbers and members apart. After that they are numbers.
"""

from __future__ import annotations

from collections.abc import Sequence

from ....stdlib.builtins.facts import Fact
from ...diagnostics import rules
from ...diagnostics.fixes import Hint, either, fix_it
from ...diagnostics.nearest import nearest_in
from ...diagnostics.source import Span
from ...ir import build
from ...ir.meaning import Choice, Enumeration, Meaning
from ...ir.node import Node
from ...ir.types import INT
from ...syntax import ast
from ...syntax.quoting import shortened
from ..hints import advice
from ..names.modules import Module, Symbol
from ..state.context import Context
from ..state.scope import FAILURE, Failure
from ..types.meaning_rules import is_enum
from ..types.typenames import Declared

_FEW = 4
"""The largest number of members that a hint shows."""


def enumeration_of(ctx: Context, symbol: Symbol) -> Declared | None:
    """The type that a symbol declares; ``None`` if it has no members, which is reported."""
    declaration = symbol.declaration
    assert isinstance(declaration, ast.Enumeration)
    if symbol not in ctx.types.enumerations:
        ctx.types.enumerations[symbol] = _declared(symbol.module, declaration)
        if not declaration.members and not ctx.report.unread_names:
            ctx.report.add(rules.EMPTY_ENUM, declaration.name.span, name=symbol.name)
    return ctx.types.enumerations[symbol]


def _declared(module: Module, declaration: ast.Enumeration) -> Declared | None:
    if not declaration.members:
        return None
    choices = tuple(Choice(member.name.text, member.doc) for member in declaration.members)
    name = declaration.name.text
    meaning = Meaning("enum", enumeration=Enumeration(name, str(module.path or ""), choices))
    return Declared(INT, name, Fact(0, len(choices) - 1, kind="int"), meaning)


def limits_of_members(declared: Declared) -> tuple[int, int] | None:
    """The range of the numbers of an enumeration's members; ``None`` for any other type."""
    if not is_enum(declared.meaning):
        return None
    return int(declared.fact.lo), int(declared.fact.hi)


def member(ctx: Context, symbol: Symbol, name: ast.Name) -> Node | Failure:
    """The value of ``Mode.add``; a failure after reporting a member that there is not."""
    declared = enumeration_of(ctx, symbol)
    if declared is None:
        return FAILURE
    assert declared.meaning is not None and declared.meaning.enumeration is not None
    names = declared.meaning.enumeration.names
    if name.text not in names:
        ctx.report.add(
            rules.UNKNOWN_NAME, name.span, kind=f"member of `{symbol.name}`", name=name.text,
            hint=advice.nearest_or_all(name.text, name.span, names),
        )  # fmt: skip
        return FAILURE
    number = build.constant(ctx.tree, INT, names.index(name.text))
    return ctx.meanings.ascribed(number, declared.meaning)


def with_member(module: Module, name: str) -> list[str]:
    """The members of this name in all enumerations that a file sees, as they are written there."""
    return [f"{of}.{name}" for of, members in _seen(module).items() if name in members]


def _seen(module: Module) -> dict[str, list[str]]:
    """The members of all enumerations that a file sees, by the names of these."""
    return {
        symbol.name: [member.name.text for member in symbol.declaration.members]
        for visible in dict.fromkeys(module.visible())
        for symbol in module.known(visible)
        if isinstance(symbol.declaration, ast.Enumeration)
    }


def shown_type(ctx: Context, node: Node) -> str:
    """The type of a value for messages: the name of an enumeration, if it is a member of one."""
    meaning = ctx.meanings.of(node)
    return str(meaning if is_enum(meaning) else node.type)


def way_out(found: Meaning | None, wanted: Meaning | None, written: ast.Expression | None) -> Hint:
    """The hint for a value where a member of another enumeration is wanted, or a number."""
    span = None if written is None else written.span
    if wanted is None or wanted.enumeration is None:
        return number_of(span)
    of = wanted.enumeration
    if found is not None and (same := same_named(wanted, written)):
        return same
    if isinstance(written, ast.Number) and written.text.isdecimal():
        number = int(written.text) if len(written.text) < 10 else len(of.names)
        meant = [f"{of.name}.{name}" for name in of.names[number : number + 1]]
        return _instead(meant, span) or members_of(of)
    return members_of(of)


def same_named(wanted: Meaning, written: ast.Expression | None) -> Hint:
    """The hint to write the member of the wanted enumeration that has the same name, if any."""
    of = wanted.enumeration
    if of is None or not isinstance(written, ast.Field) or written.name.text not in of.names:
        return ""
    return _instead([f"{of.name}.{written.name.text}"], written.span)


def number_of(*spans: Span | None) -> Hint:
    """The hint how to take members, which stand at these places, as the numbers that they are."""
    places = [span for span in spans if span is not None and "\n" not in span.text]
    if len(places) < len(spans):
        return "`int(…)` is the number of a member, from 0"
    exact = [f"int({span.text})" for span in places]
    said = " and ".join(f"`{each}`" for each in exact)
    are = "is the number of the member" if len(exact) == 1 else "are the numbers of the members"
    return fix_it(f"{said} {are}, counted from 0", *zip(places, exact, strict=True))


def values_for(of: Enumeration, written: Sequence[ast.Expression]) -> Hint:
    """The hint for a choice between members whose values have no names."""
    form = ", ".join(f"{name} = …" for name in of.names)
    if len(written) != len(of.names) + 1:
        return f"each member has a value: `choose(of, {form})`"
    places = [Span(each.span.source, each.span.start, each.span.start) for each in written[1:]]
    names = [f"{name} = " for name in of.names]
    return fix_it(
        f"a value has the name of its member in front: `choose({written[0].span.text}, {form})`",
        *zip(places, names, strict=True),
    )


def members_of(of: Enumeration) -> str:
    """The hint for a value that is no member of an enumeration: the members, if they are few."""
    shown = ", ".join(f"`{of.name}.{name}`" for name in of.names[:_FEW])
    return f"its members are {shown}{', …' if len(of.names) > _FEW else ''}"


def converted(enumeration: str, e: ast.Call) -> Hint:
    """The hint for a number that is given to an enumeration, as other languages convert it."""
    if len(e.arguments) != 1 or e.names:
        return ""
    written = f"({e.arguments[0].span.text} as {enumeration})"
    return fix_it(f"the member of a number is `{shortened(written)}`", (e.span, written))


def compared(of: Enumeration, e: ast.Field) -> Hint:
    """The hint for a member behind a value of an enumeration, and not behind its name."""
    if e.name.text not in of.names:
        return members_of(of)
    member = f"{of.name}.{e.name.text}"
    equal = f"{e.operand.span.text} == {member}"
    return either(f"did you mean `{member}`, or `{equal}`?", e.span, member, f"({equal})")


def _instead(meant: list[str], span: Span | None) -> Hint:
    """The hint to write one of some members."""
    if not meant:
        return ""
    said = f"did you mean {' or '.join(f'`{each}`' for each in meant)}?"
    return said if span is None else either(said, span, *meant)


def qualified(module: Module, name: str, span: Span) -> Hint:
    """The hint for a member that is written without its enumeration; empty for other names."""
    return _instead(with_member(module, name), span)


def nearly_qualified(module: Module, name: str, span: Span) -> Hint:
    """The hint for a misspelt member without its enumeration; empty if none is nearly so called."""
    known = [member for declared in _seen(module).values() for member in declared]
    near = nearest_in(span.source, name, known)
    return "" if near is None else _instead(with_member(module, near), span)
