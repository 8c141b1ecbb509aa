"""Writes types and declarations of values in one language."""

from __future__ import annotations

from ...compiler.ir.types import Array, Matrix, Scalar, Struct, TallMatrix, Type, Vector
from ..description.spellings import TypeNames

_NAME = "\0"
"""Stands for the name in declarations that are kept; no text contains it."""


class TypeSpeller:
    """Writes types and declarations; struct names come from the program's names."""

    def __init__(self, names: TypeNames, structs: dict[str, str]) -> None:
        self._names = names
        self._structs = structs
        self._written: dict[Type, str] = {}
        self._declared: dict[tuple[Type, bool], str] = {}

    def type(self, type_: Type) -> str:
        """The type where no name stands beside it, as in a constructor or a result."""
        written = self._written.get(type_)
        if written is None:
            written = self._written[type_] = self._type(type_)
        return written

    def _type(self, type_: Type) -> str:
        match type_:
            case Scalar(kind=kind):
                return self._names.scalars[kind]
            case Vector(kind=kind, size=size):
                return self._names.vectors[kind].format(n=size)
            case Matrix(size=size):
                return self._names.matrix.format(n=size)
            case TallMatrix(columns=columns):
                return self._names.tall_matrix.format(n=columns)
            case Struct(name=name):
                return self._structs.get(name, name)
            case Array(element=element, count=count):
                form = self._names.array or "{element}[{count}]"
                return form.format(element=self.type(element), count=count)
        raise TypeError(f"{type_} is no value's type")

    def declare(self, name: str, type_: Type) -> str:
        """The declaration of a variable, parameter or member of a struct."""
        return self._declare(name, type_, stored=False)

    def declare_stored(self, name: str, type_: Type) -> str:
        """The declaration of a block's member, whose type may be another one in memory."""
        return self._declare(name, type_, stored=True)

    def _declare(self, name: str, type_: Type, stored: bool) -> str:
        pattern = self._declared.get((type_, stored))
        if pattern is None:
            pattern = self._declared[type_, stored] = self._pattern(type_, stored)
        return pattern.replace(_NAME, name)

    def _pattern(self, type_: Type, stored: bool) -> str:
        """A declaration of something called ``_NAME``."""
        element, name = type_, _NAME
        if isinstance(type_, Array) and not self._names.array:
            element, name = type_.element, f"{_NAME}[{type_.count}]"
        text = self.type(element)
        if stored and self._names.stored:
            text = self._names.stored.get(str(element), text)
        inner = element.element if isinstance(element, Array) else element
        if stored and isinstance(inner, Matrix | TallMatrix):
            text = self._names.stored_matrix.format(type=text)
        return self._names.declaration.format(type=text, name=name)
