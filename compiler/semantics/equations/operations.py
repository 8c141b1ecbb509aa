"""The operation of an expression, as a node of a graph shows it: a name, and rows of operands.

``building.py`` calls ``operation`` for each expression of an equation. What is no operation of its
own (a sign, ``.rgb``, ``@vertex``) stands in the row that reads it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import chain
from typing import Any

from ....stdlib.builtins import BUILTINS
from ....support.frozen import changed, frozen
from ...diagnostics.source import Span
from ...ir.types import Matrix, TextureType, Vector
from ...syntax import ast
from ..checking.arguments import takers
from ..checking.constructors import is_constructor
from ..checking.textures import operand_names
from ..names.modules import Symbol
from ..types.typenames import NAMED
from .model import NodeKind
from .reads import Key, MeantSlot, Reads, Where, called, inherited, meant, reads_of, reads_of_callee

Operands = tuple[tuple[str, ast.Expression], ...]


@frozen
class Operation:
    """A node for an expression."""

    name: str
    operands: Operands
    kind: NodeKind = "operation"
    text: str = ""
    """The text of a loop, whose operands do not tell what becomes of them."""
    doc: str = ""
    reads: Reads | None = None
    """What it reads besides: a loop, whose operations are not shown, or the body of a function."""
    is_called: bool = False
    """True if a function is called, which may read slots that no operand shows."""


@frozen
class InRow:
    """An expression that is no node: ``form`` is what a row says of its operand, ``{}``."""

    form: str
    operand: ast.Expression


@frozen
class ConstantForm:
    """An expression that is the same everywhere."""

    text: str


@frozen
class SlotForm:
    """A slot of the material."""

    key: Key


@frozen
class Outside:
    """A value that neither the material nor a base declares."""

    name: str
    kind: NodeKind
    span: Span


Form = Operation | InRow | ConstantForm | SlotForm | Outside

SIGNS = {"+": "+", "-": "−", "*": "×", "/": "÷"}
WORDS = {
    "mod": "mod", "==": "is equal", "!=": "is different", "<": "is less", "<=": "is at most",
    ">": "is greater", ">=": "is at least", "and": "and", "or": "or", "&": "bits of both",
    "|": "bits of either", "^": "bits of one", "<<": "shift left", ">>": "shift right",
}  # fmt: skip
"""The names of the operators that do not make sums or products."""
LETTERS = ("x", "y", "z", "w")
"""The names of operands of builtins, as the manual writes them."""


def operation(e: ast.Expression, where: Where) -> Form:
    """What becomes of an expression."""
    return _FORMS[type(e)](e, where)


def _constant(e: ast.Number | ast.Color | ast.Boolean, _where: Where) -> Form:
    return ConstantForm(e.span.text)


def _reference(e: ast.Reference, where: Where) -> Form:
    found = meant(e.name, where)
    if isinstance(found, MeantSlot) and found.instance is where.surface:
        return SlotForm(found.key)
    if found is None:
        return Outside(e.name, "input", e.span)
    is_of_host = not isinstance(found, MeantSlot) and isinstance(
        found[0].declaration, ast.ExternMember
    )
    return Outside(e.name, "host", e.span) if is_of_host else ConstantForm(e.name)


def _field(e: ast.Field, where: Where) -> Form:
    slot = inherited(e, where)
    return InRow(f"{{}}.{e.name.text}", e.operand) if slot is None else SlotForm(slot.key)


def _unary(e: ast.Unary, _where: Where) -> Form:
    space = " " if e.operator == "not" else ""
    return InRow(f"{e.operator}{space}{{}}", e.operand)


def _binary(e: ast.Binary, _where: Where) -> Form:
    for plain, inverse, names in (("+", "-", "add subtract"), ("*", "/", "multiply divide")):
        if e.operator in (plain, inverse):
            operands = _chain(e, plain, inverse)
            signs = {sign for sign, _operand in operands[1:]}
            first, second = names.split()
            return Operation(second if signs == {SIGNS[inverse]} else first, operands)
    return Operation(WORDS[e.operator], (("x", e.left), ("y", e.right)))


def _chain(e: ast.Binary, plain: str, inverse: str) -> Operands:
    """The operands of a whole sum or product, each with its sign."""
    found: list[tuple[str, ast.Expression]] = []
    left: ast.Expression = e
    while isinstance(left, ast.Binary) and left.operator in (plain, inverse):
        found.append((SIGNS[left.operator], left.right))
        left = left.left
    return ((SIGNS[plain], left), *reversed(found))


def _conditional(e: ast.Conditional, _where: Where) -> Form:
    return Operation("if", (("if", e.condition), ("then", e.then), ("else", e.otherwise)))


def _index(e: ast.Index, _where: Where) -> Form:
    if isinstance(e.index, ast.Number):
        return InRow(f"{{}}[{e.index.text}]", e.operand)
    return Operation("element", (("of", e.operand), ("at", e.index)))


def _array(e: ast.Array, _where: Where) -> Form:
    return Operation("array", tuple((str(i), each) for i, each in enumerate(e.elements)))


def _at_rate(e: ast.AtRate, _where: Where) -> Form:
    return InRow(f"@{e.rate.text} {{}}", e.operand)


def _ascription(e: ast.Ascription, _where: Where) -> Form:
    return InRow("{}", e.operand)


def _conversion(e: ast.Conversion, _where: Where) -> Form:
    return InRow(f"{{}} in {e.space.text}", e.operand)


def _loop(e: ast.Fold | ast.FoldOver | ast.Iterate, where: Where) -> Form:
    name = "iterate" if isinstance(e, ast.Iterate) else e.operator
    return Operation(name, (), text=" ".join(e.span.text.split()), reads=reads_of((e,), where))


def _with(e: ast.With, where: Where) -> Form:
    replaced = tuple((name.text, value) for name, value in e.replacements)
    inner = operation(e.operand, changed(where, replaced=frozenset(n for n, _ in replaced)))
    if isinstance(inner, Operation) and inner.is_called:
        return changed(inner, operands=(*inner.operands, *replaced))
    return Operation("with", (("", e.operand), *replaced))


def _call(e: ast.Call, where: Where) -> Form:
    if not isinstance(e.callee, ast.Reference):
        return _method(e, where)
    name = e.callee.name
    found = called(name, where)
    if isinstance(found, MeantSlot):
        return _read(f"read {name}", e, e.callee, "", where)
    for symbol in found or ():
        if isinstance(symbol.declaration, ast.StructDeclaration):
            names = [member.name.text for member in symbol.declaration.members]
            return Operation(name, _labelled(names, e))
    if found:
        return _function(name, found, e, where)
    return Operation(name, _labelled(_letters(name, len(e.arguments)), e))


def _letters(name: str, count: int) -> Sequence[str]:
    """The names of the operands of something built in: those of lanes, if each has an operand."""
    if count < 2:
        return ()
    if not is_constructor(name):
        return LETTERS
    match NAMED[name].representation:
        case Vector(size=size) if size == count:
            return LETTERS
        case Matrix(columns=columns) if columns == count:
            return tuple(map(str, range(columns)))
        case _:
            return ()


def _function(name: str, symbols: Sequence[Symbol], e: ast.Call, where: Where) -> Form:
    """The call of a function or term of some file."""
    declared = [s.declaration for s in symbols if isinstance(s.declaration, ast.Function)]
    fitting = [f for f in declared if _takes(f, e)] or declared
    names = [argument.name.text for argument in fitting[0].arguments]
    is_term = fitting[0].kind == "term"
    return Operation(
        name, _labelled(names, e), "term" if is_term else "function",
        doc=fitting[0].doc, reads=reads_of_callee(e, where), is_called=True,
    )  # fmt: skip


def _takes(function: ast.Function, e: ast.Call) -> bool:
    """True if a function has an argument for each one of a call, and defaults for all others."""
    formals = function.arguments
    numbers = takers([formal.name.text for formal in formals], e.names, len(e.arguments))
    if numbers is None:
        return False
    return all(f.default is not None for n, f in enumerate(formals) if n not in numbers)


def _method(e: ast.Call, where: Where) -> Form:
    """A read such as ``albedo.level(uv, 2)``, or of a texture that has no name of its own."""
    if not isinstance(e.callee, ast.Field) or inherited(e.callee, where) is not None:
        return _read("read", e, e.callee, "", where)
    method, texture = e.callee.name.text, e.callee.operand
    if method in {row.method for row in BUILTINS.values()}:
        shown = f" {texture.name}" if isinstance(texture, ast.Reference) else ""
        return _read(f"{method}{shown}", e, texture, method, where)
    return _read("read", e, e.callee, "", where)


def _read(name: str, e: ast.Call, texture: ast.Expression, method: str, where: Where) -> Form:
    type_ = _texture_type(texture, where)
    names = () if type_ is None else operand_names(type_, method)
    return Operation(name, (("map", texture), *_labelled(names, e)))


def _texture_type(texture: ast.Expression, where: Where) -> TextureType | None:
    """The type of a texture that a record declares; ``None`` for one that is chosen."""
    found = None
    if isinstance(texture, ast.Reference):
        found = meant(texture.name, where)
    elif isinstance(texture, ast.Field):
        found = inherited(texture, where)
    if not isinstance(found, MeantSlot):
        return None
    typing = found.instance.record.typing(found.key[0])
    if typing is None or typing.member.type is None:
        return None
    named = NAMED.get(typing.member.type.name.text)
    type_ = None if named is None else named.representation
    return type_ if isinstance(type_, TextureType) else None


def _labelled(names: Iterable[str], e: ast.Call) -> Operands:
    """The arguments of a call with names: those that it gives, or those at their places."""
    labels = chain(names, ("" for _ in e.arguments))
    given = e.names or (None,) * len(e.arguments)
    return tuple(
        (label if name is None else name.text, value)
        for label, name, value in zip(labels, given, e.arguments, strict=False)
    )


_FORMS: Mapping[type, Callable[[Any, Where], Form]] = {
    ast.Number: _constant, ast.Color: _constant, ast.Boolean: _constant,
    ast.Reference: _reference, ast.Field: _field, ast.Unary: _unary, ast.Binary: _binary,
    ast.Conditional: _conditional, ast.Call: _call, ast.Index: _index, ast.With: _with,
    ast.AtRate: _at_rate, ast.Conversion: _conversion, ast.Ascription: _ascription,
    ast.Array: _array, ast.Fold: _loop, ast.FoldOver: _loop, ast.Iterate: _loop,
}  # fmt: skip
"""The form of each kind of expression."""
