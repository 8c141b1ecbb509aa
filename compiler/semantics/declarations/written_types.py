"""Written types in the context of a file: its structs, its spaces, array counts."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping
from functools import cache, partial
from itertools import chain

from ....support.frozen import EMPTY
from ...diagnostics import rules
from ...diagnostics.fixes import Hint, fix_it
from ...diagnostics.source import Span
from ...ir import build
from ...ir.types import INT, Array, Opaque, RuntimeArray, Struct, TextureType, Type, numbers
from ...syntax import ast
from ..names.modules import Module, Symbol
from ..names.not_types import not_a_type
from ..state.context import Context
from ..state.evaluation import Demand, plain, settle
from ..state.scope import Failure, Scope, Value
from ..types.typenames import NAMED, Declared, Variables, array_of, structure, unsized_array_of
from .enumerations import enumeration_of
from .fitting import fit

MOST_ELEMENTS = 4096
"""The largest number of elements of an array."""

MOST_LEVELS, MOST_PARTS = 64, 4096
"""The limits of structures: how deep they nest, and the number of parts of one.

Parts are numbers, vectors and matrices.
"""

MOST_NUMBERS = 1 << 18
"""The largest number of numbers in a value, with those of all its elements and members.

They take a megabyte. No API has uniform blocks of more than a sixteenth of that.
"""


_OPAQUE_MEMBER: Mapping[type, str] = {
    TextureType: "textures are declared with `map`, in a material, light or pass",
    RuntimeArray: "a member is an array of a known length, `T[4]`; any number of elements is a "
    "`buffer` of a material, light or pass",
}
"""Hints how to declare types that cannot be members of a structure."""


def declared_type(
    ctx: Context,
    written: ast.TypeName,
    module: Module,
    variables: Variables = EMPTY,
) -> Declared | None:
    """The written type as seen from ``module``, or ``None`` after reporting."""
    if variables:
        return _resolved(ctx, written, module, variables)
    if written not in ctx.types.declared:
        ctx.types.declared[written] = _resolved(ctx, written, module, variables)
    return ctx.types.declared[written]


def _resolved(
    ctx: Context, written: ast.TypeName, module: Module, variables: Variables
) -> Declared | None:
    symbols = module.find(written.name.text)
    structs = {}
    if symbols and isinstance(symbols[0].declaration, ast.StructDeclaration):
        struct = struct_of(ctx, symbols[0])
        if struct is None:
            return None
        structs[written.name.text] = struct
    if symbols and isinstance(symbols[0].declaration, ast.Enumeration):
        enumeration = enumeration_of(ctx, symbols[0])
        if enumeration is None:
            return None
        structs[written.name.text] = enumeration
    spaces = frozenset(
        argument.text
        for argument in written.arguments
        if (found := module.find(argument.text)) and isinstance(found[0].declaration, ast.Space)
    )
    is_known = written.name.text in NAMED or written.name.text in variables or structs
    other: Hint = ""
    if not is_known:
        other = not_a_type(symbols) or _read_there(ctx, written, module)
    declared = ctx.types.resolver.resolve(
        written, structs, spaces, variables, other, _types_of(module)
    )
    if declared is not None and written.unsized:
        return _unsized(ctx, written, declared)
    if declared is None or written.count is None:
        return declared
    count = count_of(ctx, written.count, module, variables)
    return None if count is None else _fitting(ctx, array_of(declared, count), written.span)


def _types_of(module: Module) -> Iterator[str]:
    """The names of structures and enumerations that a file sees, as far as somebody asks."""
    for visible in dict.fromkeys(module.visible()):
        for symbol in module.known(visible):
            if isinstance(symbol.declaration, ast.StructDeclaration | ast.Enumeration):
                yield symbol.name


def _read_there(ctx: Context, written: ast.TypeName, module: Module) -> Hint:
    """The hint for a slot whose type is the name of a value: ``color : base`` for ``=``."""
    for symbol in chain.from_iterable(module.declared.values()):
        if not isinstance(symbol.declaration, ast.Record):
            continue
        for member in symbol.declaration.members:
            if not isinstance(member, ast.Slot) or member.type is not written:
                continue
            if written.name.text in ctx.records.of(symbol).definitions:
                name, value = member.name, written.name
                between = Span(name.span.source, name.span.end, value.span.start)
                if "\n" in between.text:
                    return ""  # The type is missing, and the next equation follows.
                said = f"`{value.text}` is a value, and no type: `{name.text} = {value.text}`"
                return fix_it(said, (between, " = "))
    return ""


def _fitting(ctx: Context, declared: Declared, span: Span) -> Declared | None:
    """A type whose values are not too large, or ``None`` after reporting."""
    count = numbers(declared.type)
    if count <= MOST_NUMBERS:
        return declared
    ctx.report.add(
        rules.VALUE_TOO_LARGE, span,
        type=declared.text, count=f"{count:,}", most=f"{MOST_NUMBERS:,}",
    )  # fmt: skip
    return None


def _unsized(ctx: Context, written: ast.TypeName, declared: Declared) -> Declared | None:
    """``T[]``, the type of a storage buffer."""
    if isinstance(declared.type, TextureType):
        ctx.report.add(
            rules.WRONG_TYPE, written.span, expected="a type of values", found=declared.text,
            hint="layers of one texture are a `texture2d_array`",
        )  # fmt: skip
        return None
    return unsized_array_of(declared)


def numbers_of(ctx: Context, variables: Variables) -> dict[str, Value]:
    """The type parameters that stand for numbers, as values."""
    return {
        name: build.constant(ctx.tree, INT, number)
        for name, number in variables.items()
        if isinstance(number, int)
    }


def count_of(
    ctx: Context, expression: ast.Expression, module: Module, variables: Variables = EMPTY
) -> int | None:
    """A compile-time count of at least one, or ``None`` after reporting."""
    key = (expression, tuple(n for n in variables.items() if isinstance(n[1], int)))
    counts = ctx.types.counts
    if key not in counts:
        if key in ctx.progress.active:
            return None
        scope = Scope(module, locals=numbers_of(ctx, variables))
        keep = partial(_keep_count, ctx, key, expression)
        settle(ctx, Demand(key, "", expression.span, expression, scope, keep))
    return counts[key]


def _keep_count(ctx: Context, key: Hashable, expression: ast.Expression, value: Value) -> None:
    node = fit(ctx, plain(ctx, value, expression), INT, "int", expression.span)
    count = None if isinstance(node, Failure) else ctx.constants.integer(node, expression.span)
    if count is not None and not 1 <= count <= MOST_ELEMENTS:
        ctx.report.add(rules.BAD_COUNT, expression.span, count=count)
        count = None
    ctx.types.counts[key] = count


def struct_of(ctx: Context, symbol: Symbol) -> Declared | None:
    """The struct a symbol declares; structs may contain structs but never themselves."""
    if symbol not in ctx.types.structs:
        found = _struct(ctx, symbol)
        ctx.types.structs.setdefault(symbol, found)
    return ctx.types.structs[symbol]


def _struct(ctx: Context, symbol: Symbol) -> Declared | None:
    declaration = symbol.declaration
    assert isinstance(declaration, ast.StructDeclaration)
    if symbol in ctx.progress.active:
        start = list(ctx.progress.active).index(symbol)
        names = [name for name, _ in list(ctx.progress.active.values())[start:] if name]
        ctx.report.add(
            rules.CYCLIC_DEFINITION,
            declaration.name.span,
            name=symbol.name,
            cycle=" → ".join([*names, symbol.name]),
            hint="a structure cannot hold itself; an index into an array can stand for it",
        )
        ctx.types.structs[symbol] = None
        return None
    if not declaration.members:
        # Unreadable text of the file may have been its members.
        if not ctx.report.unread_names:
            ctx.report.add(rules.EMPTY_STRUCT, declaration.name.span, name=symbol.name)
        return None
    if sum(_is_struct(active) for active in ctx.progress.active) == MOST_LEVELS:
        _too_large(ctx, declaration)
        return None
    members = _members(ctx, symbol, declaration)
    if len(members) < len(declaration.members):
        return None
    struct = named_struct(ctx, symbol.name, tuple((name, m.type) for name, m in members))
    levels, parts = _extent(struct)
    if levels > MOST_LEVELS or parts > MOST_PARTS:
        _too_large(ctx, declaration)
        return None
    return _fitting(ctx, structure(struct, symbol.name, tuple(members)), declaration.name.span)


def _members(
    ctx: Context, symbol: Symbol, declaration: ast.StructDeclaration
) -> list[tuple[str, Declared]]:
    """The members that have a type, each with it; errors in the others are reported."""
    members = []
    ctx.progress.active[symbol] = (symbol.name, declaration.name.span)
    try:
        for member in declaration.members:
            type_ = declared_type(ctx, member.type, symbol.module)
            if type_ is not None and isinstance(type_.type, Opaque):
                ctx.report.add(
                    rules.WRONG_TYPE, member.type.span, expected="a value", found=type_.text,
                    hint=_OPAQUE_MEMBER[type(type_.type)],
                )  # fmt: skip
            elif type_ is not None:
                members.append((member.name.text, type_))
    finally:
        del ctx.progress.active[symbol]
    return members


def named_struct(ctx: Context, name: str, members: tuple[tuple[str, Type], ...]) -> Struct:
    """A structure for the texts, where one name cannot stand for two.

    Files may each have a ``Layer``, and lights of one kind have fewer members where a rig sets one
    of them.
    """
    numbers_behind = range(2, 3 + len(ctx.types.struct_members))
    names = chain([name], (f"{name}_{number}" for number in numbers_behind))
    free = next(n for n in names if ctx.types.struct_members.get(n, members) == members)
    ctx.types.struct_members[free] = members
    return Struct(free, members)


def _is_struct(active: object) -> bool:
    return isinstance(active, Symbol) and isinstance(active.declaration, ast.StructDeclaration)


def _too_large(ctx: Context, declaration: ast.StructDeclaration) -> None:
    ctx.report.add(
        rules.STRUCT_TOO_LARGE, declaration.name.span, name=declaration.name.text,
        parts=MOST_PARTS, levels=MOST_LEVELS,
    )  # fmt: skip


@cache
def _extent(type_: Type) -> tuple[int, int]:
    """Levels of structures, and parts that are none; the elements of an array are one part.

    Members are measured before their structure, so the cache keeps this from recursing deeply.
    """
    match type_:
        case Array(element=element):
            return _extent(element)
        case Struct(members=members):
            extents = [_extent(member) for _, member in members]
            return 1 + max(levels for levels, _ in extents), sum(parts for _, parts in extents)
        case _:
            return 0, 1
