"""The parameter that each argument of a call is for: the one at its place, or of its name.

Functions, terms, structures and reads of textures are called in the same way: first arguments by
position, then others by name, in any order, and some may be left out. ``calls`` asks ``is_ordered``
for every call with names; whoever then knows what is called asks ``placed``. A call of as many
arguments as there are parameters, without names, needs none of this.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ....support.frozen import frozen
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.fixes import Hint, fix_it
from ...diagnostics.nearest import nearest_in
from ...diagnostics.source import Span
from ...syntax import ast
from ...syntax.quoting import counted, shortened
from ..state.context import Context


@frozen
class Head:
    """What can be called with names: a function, a structure, a read of a texture."""

    name: str
    parameters: tuple[str, ...]
    optional: frozenset[str]
    """The parameters that a call may leave out."""
    usage: str
    """The form in which it is called, with types and defaults."""
    declared: tuple[Label, ...] = ()
    """The place of its declaration."""


def takers(
    parameters: Sequence[str], names: Sequence[ast.Name | None], count: int
) -> list[int] | None:
    """The number of the parameter for each of ``count`` arguments; ``None`` if one has none.

    Nothing is reported, so that overloads can be tried.
    """
    if count > len(parameters):
        return None
    numbers = {name: number for number, name in enumerate(parameters)}
    found = {}
    for place, name in enumerate(names or [None] * count):
        number = place if name is None else numbers.get(name.text)
        if number is None or number in found:
            return None
        found[number] = place
    return list(found)


def placed(ctx: Context, e: ast.Call, head: Head) -> list[int] | None:
    """The number of the parameter for each argument of a call, which gives all that it has to.

    ``None`` if it does not, which is reported.
    """
    found = takers(head.parameters, e.names, len(e.arguments))
    if found is None:
        _report_unplaced(ctx, e, head)
        return None
    given = {head.parameters[number] for number in found}
    missing = [name for name in head.parameters if name not in given | head.optional]
    if not missing:
        return found
    if e.names or head.optional:
        _report_missing(ctx, e, head, missing)
    else:
        _report_count(ctx, e, head)
    return None


def is_ordered(ctx: Context, e: ast.Call) -> bool:
    """True if arguments with names are behind all others, each name once; reports if not."""
    first: dict[str, ast.Name] = {}
    right = True
    for value, name in zip(e.arguments, e.names, strict=True):
        if name is None and first:
            ctx.report.add(rules.POSITION_AFTER_NAME, value.span, hint=_in_order(e))
            return False
        if name is not None and first.setdefault(name.text, name) is not name:
            _report_twice(ctx, name, first[name.text].span)
            right = False
    return right


def refuse_names(ctx: Context, e: ast.Call) -> bool:
    """True if a call of something whose arguments have no names gives some; reports that."""
    named = [name for name in e.names if name is not None]
    if not named:
        return False
    values = [value for value, name in zip(e.arguments, e.names, strict=True) if name is not None]
    edits = [
        (Span(name.span.source, name.span.start, value.span.start), "")
        for name, value in zip(named, values, strict=True)
    ]
    plain = ", ".join(value.span.text for value in e.arguments)
    called = e.callee.span.text
    ctx.report.add(
        rules.NOT_BY_NAME, named[0].span, name=shortened(called),
        hint=fix_it(f"give them by position: `{shortened(f'{called}({plain})')}`", *edits),
    )  # fmt: skip
    return True


def unknown_argument(
    ctx: Context,
    name: ast.Name,
    function: str,
    known: Iterable[str],
    usages: Sequence[str],
    labels: Sequence[Label],
) -> None:
    """Report an argument that is given by a name which no parameter has."""
    meant = nearest_in(name.span.source, name.text, known)
    listed = " or ".join(f"`{usage}`" for usage in usages)
    hint: Hint = f"it is {listed}"
    if meant is not None:
        hint = fix_it(f"did you mean `{meant}`? It is {listed}", (name.span, meant))
    ctx.report.add(
        rules.UNKNOWN_ARGUMENT, name.span, function=function, name=name.text,
        labels=labels, hint=hint,
    )  # fmt: skip


def _report_unplaced(ctx: Context, e: ast.Call, head: Head) -> None:
    """Report the arguments for which there is no parameter, or one that has a value already."""
    names = e.names or [None] * len(e.arguments)
    by_place = [value for value, name in zip(e.arguments, names, strict=True) if name is None]
    if len(by_place) > len(head.parameters):
        _report_count(ctx, e, head)
        return
    taken = dict(zip(head.parameters, by_place, strict=False))
    named = {name.text for name in e.names if name is not None}
    free = [each for each in head.parameters if each not in taken and each not in named]
    for name in e.names:
        if name is not None and name.text in taken:
            _report_twice(ctx, name, taken[name.text].span)
        elif name is not None and name.text not in head.parameters:
            unknown_argument(ctx, name, head.name, free, (head.usage,), head.declared)


def _report_count(ctx: Context, e: ast.Call, head: Head) -> None:
    """Report a wrong number of arguments."""
    most = len(head.parameters)
    least = most - len(head.optional)
    between = "or" if most == least + 1 else "to"
    expected = counted(most if least == most else f"{least} {between} {most}", "argument")
    ctx.report.add(
        rules.WRONG_COUNT, e.span, name=head.name, expected=expected, found=len(e.arguments),
        labels=head.declared, hint=f"it is `{head.usage}`",
    )  # fmt: skip


def _report_missing(ctx: Context, e: ast.Call, head: Head, missing: Sequence[str]) -> None:
    """Report arguments that are left out and have no default."""
    listed = " and ".join(f"`{name}`" for name in missing)
    values = "a value" if len(missing) == 1 else "values"
    ctx.report.add(
        rules.MISSING_ARGUMENT, e.span, name=head.name, missing=f"{values} for {listed}",
        labels=head.declared, hint=f"it is `{head.usage}`",
    )  # fmt: skip


def _report_twice(ctx: Context, name: ast.Name, first: Span) -> None:
    labels = [Label(first, "first given here")]
    ctx.report.add(rules.ARGUMENT_TWICE, name.span, name=name.text, labels=labels)


def _in_order(e: ast.Call) -> Hint:
    """The hint to write the arguments without names in front."""
    pairs = list(zip(e.arguments, e.names, strict=True))
    plain = [value.span.text for value, name in pairs if name is None]
    named = [f"{name.text} = {value.span.text}" for value, name in pairs if name is not None]
    written = ", ".join((*plain, *named))
    start = e.arguments[0].span if e.names[0] is None else e.names[0].span
    shown = shortened(f"{e.callee.span.text}({written})")
    said = f"arguments without names come first: `{shown}`"
    return fix_it(said, (start.to(e.arguments[-1].span), written))
