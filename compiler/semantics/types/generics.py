"""Binds the type parameters of a function in one call.

Written types of arguments are patterns (``T``, ``T[N]``, ``vec<K, N>``, ``point<S>``), which are
matched with the types and meanings of the arguments. A pattern never fails because of a meaning: a
value in the wrong space is reported when it is fitted to the resulting type.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product

from ....support.frozen import frozen
from ...ir.meaning import Meaning
from ...ir.signatures import Family
from ...ir.types import MATRICES as ALL_MATRICES
from ...ir.types import TEXTURES as ALL_TEXTURES
from ...ir.types import Array, Scalar, Type, Vector, square
from ...syntax import ast
from . import overloads
from .meaning_rules import joined, weakened
from .operand import Operand
from .typenames import GENERIC_VECTOR, NAMED, Declared, Variable, Variables

SPACES, WIDTHS, COUNTS = "spaces", "widths", "counts"
MATRICES, TEXTURES = "matrices", "textures"
FAMILIES = (*overloads.WRITTEN_FAMILIES, MATRICES, TEXTURES, SPACES, WIDTHS, COUNTS)
"""The families that a type parameter may range over."""

SOME_SPACE, SOME_COUNT = ("world",), (16,)
"""The examples of any space, and of any number of elements."""

_WHOLE: Mapping[str, tuple[Type, ...]] = {
    MATRICES: tuple(matrix for matrix in ALL_MATRICES if matrix.is_square),
    TEXTURES: ALL_TEXTURES,
}
"""Families of types without lanes that could adapt."""


@frozen
class Use:
    """An argument, or a part of it, where a pattern is matched with it."""

    operand: Operand
    meaning: Meaning | None


def bind(
    function: ast.Function, formals: Sequence[ast.Argument], uses: Sequence[Use]
) -> Variables | None:
    """The value of each type parameter; ``None`` where the arguments do not say, or disagree.

    ``formals`` are those that a call gives, each with its use.
    """
    binding = _Binding(function)
    for formal, use in zip(formals, uses, strict=True):
        if not binding.match(formal.type, use):
            return None
    return binding.result()


def examples(function: ast.Function) -> Iterator[Variables]:
    """Possible values of the type parameters of a function, each combination once.

    Any space and any number of elements are like all others.
    """
    names = [parameter.name.text for parameter in function.type_parameters]
    families = (_members(parameter.family.text) for parameter in function.type_parameters)
    for members in product(*families):
        yield dict(zip(names, members, strict=True))


def _members(family: str) -> Sequence[Variable]:
    match family:
        case "spaces":
            return SOME_SPACE
        case "widths":
            return (2, 3, 4)
        case "counts":
            return SOME_COUNT
        case "matrices":
            types: tuple[Type, ...] = (square(3), square(4), square(2))
        case "textures":
            types = ALL_TEXTURES
        case _:
            types = overloads.WRITTEN_FAMILIES[family].types()
    return [Declared(type_, str(type_)) for type_ in types]


def uninferable(function: ast.Function) -> list[ast.TypeParameter]:
    """Type parameters that no argument without a default mentions, so that some calls lack them."""
    given = [argument for argument in function.arguments if argument.default is None]
    inferable = {name for argument in given for name in _names(argument.type)}
    return [each for each in function.type_parameters if each.name.text not in inferable]


def of_unknown_family(function: ast.Function) -> list[ast.TypeParameter]:
    """Type parameters whose family of types does not exist."""
    return [each for each in function.type_parameters if each.family.text not in FAMILIES]


def _names(written: ast.TypeName) -> list[str]:
    """The names that a written type is made of."""
    names = [written.name.text, *(argument.text for argument in written.arguments)]
    if isinstance(written.count, ast.Reference):
        names.append(written.count.name)
    return names


def shown(name: str, variables: Variables) -> str:
    """A generic function with the values of its type parameters, as messages show it."""
    values = (v.text if isinstance(v, Declared) else str(v) for v in variables.values())
    known = [value for value in values if value]
    return f"{name}<{', '.join(known)}>" if known else name


class _Binding:
    def __init__(self, function: ast.Function) -> None:
        self._families = {p.name.text: p.family.text for p in function.type_parameters}
        self._uses: dict[str, list[Use]] = {}
        self._known: dict[str, Variable] = {}

    def match(self, pattern: ast.TypeName, use: Use) -> bool:
        """Learns from one argument; False where it cannot have the written type."""
        if pattern.count is not None:
            matched = self._array(pattern.count, use)
            if matched is None:
                return self._families.keys().isdisjoint(_names(pattern))
            use = matched
        name = pattern.name.text
        if name in self._families:
            self._uses.setdefault(name, []).append(use)
            return True
        if name == GENERIC_VECTOR:
            return self._vector(pattern.arguments, use.operand.type)
        if name in NAMED:
            self._spaces(pattern.arguments, use.meaning)
        return True

    def result(self) -> Variables | None:
        """All parameters; a space of which no argument tells is the empty name."""
        found: dict[str, Variable] = {}
        for name, family in self._families.items():
            if family == SPACES:
                found[name] = self._known.get(name, "")
            elif name in self._known:
                found[name] = self._known[name]
            else:
                type_ = _common(family, self._uses.get(name, ()))
                if type_ is None:
                    return None
                found[name] = type_
        return found

    def _array(self, count: ast.Expression, use: Use) -> Use | None:
        """The elements of an array, whose number ``count`` may name."""
        type_ = use.operand.type
        if not isinstance(type_, Array):
            return None
        named = count.name if isinstance(count, ast.Reference) else ""
        if self._families.get(named) == COUNTS and not self._learn(named, type_.count):
            return None
        return Use(Operand(type_.element), use.meaning)

    def _vector(self, arguments: tuple[ast.Name, ...], type_: Type) -> bool:
        if not isinstance(type_, Vector) or len(arguments) != 2:
            return False
        kind, size = (argument.text for argument in arguments)
        lane = Scalar(type_.kind)
        if kind in self._families:
            family = overloads.WRITTEN_FAMILIES.get(self._families[kind])
            if family is None or not family.contains(lane):
                return False
            if not self._learn(kind, Declared(lane, str(lane))):
                return False
        return self._families.get(size) != WIDTHS or self._learn(size, type_.size)

    def _spaces(self, arguments: tuple[ast.Name, ...], meaning: Meaning | None) -> None:
        spaces = () if meaning is None else meaning.spaces
        for argument, space in zip(arguments, spaces, strict=False):
            if self._families.get(argument.text) == SPACES:
                self._known.setdefault(argument.text, space)

    def _learn(self, name: str, value: Variable) -> bool:
        return self._known.setdefault(name, value) == value


def _common(family: str, uses: Sequence[Use]) -> Declared | None:
    """The one type of a family for all arguments of a type parameter, with their common meaning."""
    if not uses:
        return None
    operands = [use.operand for use in uses]
    if family in _WHOLE:
        types = {operand.type for operand in operands}
        type_ = operands[0].type if len(types) == 1 else None
        type_ = type_ if type_ in _WHOLE[family] else None
    else:
        known: Mapping[str, Family] = overloads.WRITTEN_FAMILIES
        type_ = overloads.common_type(known[family], operands) if family in known else None
    if type_ is None:
        return None
    meaning = weakened(_shared(uses, type_))
    return Declared(type_, str(meaning or type_), meaning=meaning)


def _shared(uses: Sequence[Use], type_: Type) -> Meaning | None:
    """The common meaning of arguments of the common type; where they disagree, the first one's."""
    first: Meaning | None = None
    for use in uses:
        if use.operand.type == type_:
            first = use.meaning if first is None else joined(first, use.meaning) or first
    return first
