"""Written types in the context of a file: its structs, its spaces, array counts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...frozen import EMPTY
from ..diagnostics import rules
from ..ir import build
from ..ir.types import INT, Struct, Texture
from ..syntax import ast
from ..trampoline import run
from .modules import Module, Symbol
from .scope import Failure, Scope, Value
from .typenames import Declared, Variables, array_of, structure

if TYPE_CHECKING:
    from .lower import Lowering


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
    types = tuple((name, member.type) for name, member in members)
    return structure(Struct(symbol.name, types), tuple(members))
