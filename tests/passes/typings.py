"""The types that operations can have: of operands and results, for random operations."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from burnish.compiler.ir import signatures
from burnish.compiler.ir.types import (
    MATRICES,
    Array,
    Matrix,
    Scalar,
    Type,
    Vector,
)
from burnish.stdlib.builtins import BUILTINS


class UnsuitableError(Exception):
    """A random choice that does not go together with another."""


def part(whole: Type) -> tuple[Type, int]:
    """The type of a part that indexing gives, and the number of parts."""
    match whole:
        case Array(element=element, count=count):
            return element, count
        case Matrix(columns):
            return whole.column, columns
        case Vector(kind=kind, size=size):
            return Scalar(kind), size
        case _:
            raise UnsuitableError


def typed(name: str) -> list[tuple[tuple[Type, ...], Type]]:
    """Each way to type a builtin: its operands and its result."""
    if name not in _TYPED:
        _TYPED[name] = [
            (types, result)
            for types in dict.fromkeys(_operand_types(name))
            if (result := signatures.result_type(name, types)) is not None
        ]
    if not _TYPED[name]:
        raise UnsuitableError
    return _TYPED[name]


_TYPED: dict[str, list[tuple[tuple[Type, ...], Type]]] = {}


def _operand_types(name: str) -> Iterator[tuple[Type, ...]]:
    for signature in BUILTINS[name].signatures:
        words, _result = signatures.parsed(signature)
        for free in _free_types(words):
            bound = dict(free)
            for word in words:
                found = bound.get(word) or signatures.FIXED.get(word)
                found = found or signatures.dependent(word, bound)
                if found is None:
                    break
                bound[word] = found
            else:
                yield tuple(bound[word] for word in words)


def _free_types(words: Sequence[str]) -> Iterator[dict[str, Type]]:
    """The combinations of types for the letters of a signature that others do not determine."""
    letters = [w for w in dict.fromkeys(words) if w in signatures.FAMILIES or w in "MZ"]
    choices: list[dict[str, Type]] = [{}]
    for letter in letters:
        types: Sequence[Type] = MATRICES if letter in "MZ" else signatures.FAMILIES[letter].types()
        choices = [{**chosen, letter: type_} for chosen in choices for type_ in types]
    yield from choices
