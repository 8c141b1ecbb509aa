"""Written types in the context of a file: its structs, its spaces, array counts."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from ....frozen import EMPTY
from ...diagnostics import rules
from ...ir import build
from ...ir.types import INT, Array, Struct, Texture, Type
from ...syntax import ast
from ...trampoline import run
from ..names.modules import Module, Symbol
from ..state.scope import Failure, Scope, Value
from ..types.typenames import Declared, Variables, array_of, structure

if TYPE_CHECKING:
    from ..state.context import Lowering


MOST_LEVELS, MOST_PARTS = 64, 4096
"""How deep structures nest, and into how many numbers, vectors and matrices one is taken apart."""


def declared_type(
    low: Lowering,
    written: ast.TypeName,
    module: Module,
    variables: Variables = EMPTY,
) -> Declared | None:
    """The written type as seen from ``module``, or ``None`` after reporting."""
    if variables:
        return _resolved(low, written, module, variables)
    if written not in low.declared:
        low.declared[written] = _resolved(low, written, module, variables)
    return low.declared[written]


def _resolved(
    low: Lowering, written: ast.TypeName, module: Module, variables: Variables
) -> Declared | None:
    symbols = module.find(written.name.text)
    structs = {}
    if symbols and isinstance(symbols[0].declaration, ast.StructDeclaration):
        struct = struct_of(low, symbols[0])
        if struct is None:
            return None
        structs[written.name.text] = struct
    spaces = frozenset(
        argument.text
        for argument in written.arguments
        if (found := module.find(argument.text)) and isinstance(found[0].declaration, ast.Space)
    )
    declared = low.types.resolve(written, structs, spaces, variables)
    if declared is None or written.count is None:
        return declared
    count = count_of(low, written.count, module, variables)
    return None if count is None else array_of(declared, count)


def numbers_of(low: Lowering, variables: Variables) -> dict[str, Value]:
    """The type parameters that stand for numbers, as values."""
    return {
        name: build.constant(low.graph, INT, number)
        for name, number in variables.items()
        if isinstance(number, int)
    }


def count_of(
    low: Lowering, expression: ast.Expression, module: Module, variables: Variables = EMPTY
) -> int | None:
    """A compile-time count of at least one, or ``None`` after reporting."""
    scope = Scope(module, locals=numbers_of(low, variables))
    node = run(low.typed(expression, scope, INT, "int"))
    count = None if isinstance(node, Failure) else low.constants.integer(node, expression.span)
    if count is not None and not 1 <= count <= 4096:
        low.report.add(rules.BAD_COUNT, expression.span, count=count)
        return None
    return count


def struct_of(low: Lowering, symbol: Symbol) -> Declared | None:
    """The struct a symbol declares; structs may contain structs but never themselves."""
    if symbol not in low.structs:
        found = _struct(low, symbol)
        low.structs.setdefault(symbol, found)
    return low.structs[symbol]


def _struct(low: Lowering, symbol: Symbol) -> Declared | None:
    declaration = symbol.declaration
    assert isinstance(declaration, ast.StructDeclaration)
    if symbol in low.active:
        start = list(low.active).index(symbol)
        names = [name for name, _ in low.active.values()][start:]
        low.report.add(
            rules.CYCLIC_DEFINITION,
            declaration.name.span,
            name=symbol.name,
            cycle=" → ".join([*names, symbol.name]),
            hint="a structure cannot hold itself; an index into an array can stand for it",
        )
        low.structs[symbol] = None
        return None
    if not declaration.members:
        # What could not be read of the file may have been its members.
        if not low.report.unread_names:
            low.report.add(rules.EMPTY_STRUCT, declaration.name.span, name=symbol.name)
        return None
    if sum(_is_struct(active) for active in low.active) == MOST_LEVELS:
        _too_large(low, declaration)
        return None
    low.active[symbol] = (symbol.name, declaration.name.span)
    members = []
    for member in declaration.members:
        type_ = declared_type(low, member.type, symbol.module)
        if type_ is not None and isinstance(type_.type, Texture):
            low.report.add(
                rules.WRONG_TYPE, member.type.span, expected="a value", found=type_.text,
                hint="textures are declared with `map`, in a material, light or pass",
            )  # fmt: skip
        elif type_ is not None:
            members.append((member.name.text, type_))
    low.active.pop(symbol)
    if len(members) < len(declaration.members):
        return None
    struct = named_struct(low, symbol.name, tuple((name, m.type) for name, m in members))
    levels, parts = _extent(struct)
    if levels > MOST_LEVELS or parts > MOST_PARTS:
        _too_large(low, declaration)
        return None
    return structure(struct, symbol.name, tuple(members))


def named_struct(low: Lowering, name: str, members: tuple[tuple[str, Type], ...]) -> Struct:
    """A structure for the texts, where one name cannot stand for two: files may each have a
    ``Layer``, and lights of one kind have fewer members where a rig sets one of them."""
    names = (name, *(f"{name}_{number}" for number in range(2, 3 + len(low.struct_members))))
    free = next(n for n in names if low.struct_members.get(n, members) == members)
    low.struct_members[free] = members
    return Struct(free, members)


def _is_struct(active: object) -> bool:
    return isinstance(active, Symbol) and isinstance(active.declaration, ast.StructDeclaration)


def _too_large(low: Lowering, declaration: ast.StructDeclaration) -> None:
    low.report.add(
        rules.STRUCT_TOO_LARGE, declaration.name.span, name=declaration.name.text,
        parts=MOST_PARTS, levels=MOST_LEVELS,
    )  # fmt: skip


@cache
def _extent(type_: Type) -> tuple[int, int]:
    """Levels of structures, and parts that are none; the elements of an array are one part.

    Members are measured before what holds them, so the cache keeps this from recursing deeply.
    """
    match type_:
        case Array(element=element):
            return _extent(element)
        case Struct(members=members):
            extents = [_extent(member) for _, member in members]
            return 1 + max(levels for levels, _ in extents), sum(parts for _, parts in extents)
        case _:
            return 0, 1
