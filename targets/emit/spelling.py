"""Writes types and declarations of values in one language."""

from __future__ import annotations

from collections.abc import Callable

from ...compiler.ir.types import Array, Matrix, Scalar, Struct, Type, Vector
from ...support.frozen import frozen
from ..description.spellings import TypeNames

_NAME = "\0"
"""A placeholder for the name in declarations that are kept; no text contains it."""


@frozen(eq=False)
class TypeTexts:
    """The texts of types that any program may use: scalars, vectors and matrices.

    A ``Dialect`` keeps them for all programs of a profile.
    """

    types: dict[Type, str]
    declared: dict[Type, str]
    """Declarations of a variable called ``_NAME``."""
    stored: dict[Type, str]
    """Declarations of a block's member called ``_NAME``."""


class _Written(dict[Type, str]):
    """The texts of types in one program. Each is written when it is first looked up."""

    def __init__(self, known: dict[Type, str], write: Callable[[Type], str]) -> None:
        super().__init__(known)
        self._known = known
        self._write = write

    def __missing__(self, type_: Type) -> str:
        text = self[type_] = self._write(type_)
        if not isinstance(type_, Struct | Array):
            self._known[type_] = text
        return text


class TypeSpeller:
    """Writes types and declarations; struct names come from the program's names."""

    def __init__(self, names: TypeNames, structs: dict[str, str], known: TypeTexts) -> None:
        self._names = names
        self._structs = structs
        self._types = _Written(known.types, self._type)
        self._declared = _Written(known.declared, self._pattern)
        self._stored = _Written(known.stored, self._stored_pattern)

    def type(self, type_: Type) -> str:
        """The type without a name beside it, as in a constructor or a result."""
        return self._types[type_]

    def declare(self, name: str, type_: Type) -> str:
        """The declaration of a variable, parameter or member of a struct."""
        return self._declared[type_].replace(_NAME, name)

    def declare_stored(self, name: str, type_: Type) -> str:
        """The declaration of a block's member, whose type may be another one in memory."""
        return self._stored[type_].replace(_NAME, name)

    def _type(self, type_: Type) -> str:
        match type_:
            case Scalar(kind=kind):
                return self._names.scalars[kind]
            case Vector(kind=kind, size=size):
                return self._names.vectors[kind].format(n=size)
            case Matrix(columns) if type_.is_square:
                return self._names.matrix.format(n=columns)
            case Matrix(columns, rows):
                return self._names.rectangular_matrix.format(columns=columns, rows=rows)
            case Struct(name=name):
                return self._structs.get(name, name)
            case Array(element=element, count=count):
                form = self._names.array or "{element}[{count}]"
                return form.format(element=self.type(element), count=count)
        raise TypeError(f"{type_} is no value's type")

    def _pattern(self, type_: Type) -> str:
        """The declaration of a variable called ``_NAME``."""
        element, name = self._element_and_name(type_)
        return self._names.declaration.format(type=self.type(element), name=name)

    def _stored_pattern(self, type_: Type) -> str:
        """The declaration of a block's member that is called ``_NAME``."""
        element, name = self._element_and_name(type_)
        text = self._names.stored.get(str(element)) or self.type(element)
        inner = element.element if isinstance(element, Array) else element
        if isinstance(inner, Matrix):
            text = self._names.stored_matrix.format(type=text)
        return self._names.declaration.format(type=text, name=name)

    def _element_and_name(self, type_: Type) -> tuple[Type, str]:
        """The type before the name, and the name, which an array's count may follow as in C."""
        if isinstance(type_, Array) and not self._names.array:
            return type_.element, f"{_NAME}[{type_.count}]"
        return type_, _NAME
