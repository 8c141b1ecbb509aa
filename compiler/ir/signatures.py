"""Matches operands with the signatures of builtins, and derives the type of the result.

Semantics asks when it resolves overloads, and the verifier checks calls in this way. A letter in a
signature stands for the same type wherever it occurs; ``stdlib/builtins/row.py`` lists the letters.
Here types match exactly or not at all; ``semantics`` converts constants before it asks.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache, lru_cache

from ...stdlib.builtins import BUILTINS
from ...support.frozen import frozen
from .types import (
    BOOL,
    FLOAT,
    INT,
    MATRICES,
    TEXTURES,
    UINT,
    Matrix,
    Scalar,
    ScalarKind,
    TextureType,
    Type,
    Vector,
    scalar_kind,
    width,
    with_width,
)


@frozen
class Family:
    """The types that a signature letter ranges over."""

    kinds: tuple[ScalarKind, ...]
    widths: tuple[int, ...]
    broadcasts: bool = False
    """True if a scalar operand may stand for a vector of equal lanes."""

    def types(self) -> tuple[Type, ...]:
        """All types of the family, the simplest first."""
        return tuple(with_width(kind, lanes) for lanes in self.widths for kind in self.kinds)

    def contains(self, type_: Type) -> bool:
        """True if a type belongs to the family."""
        return (
            isinstance(type_, Scalar | Vector)
            and type_.kind in self.kinds
            and width(type_) in self.widths
        )


NUMBER_KINDS: tuple[ScalarKind, ...] = ("float", "int", "uint")
FAMILIES: Mapping[str, Family] = {
    "T": Family(("float",), (1, 2, 3, 4), broadcasts=True),
    "V": Family(("float",), (2, 3, 4)),
    "N": Family(NUMBER_KINDS, (1, 2, 3, 4), broadcasts=True),
    "I": Family(("int", "uint"), (1, 2, 3, 4), broadcasts=True),
    "B": Family(("bool",), (1, 2, 3, 4), broadcasts=True),
    "P": Family((*NUMBER_KINDS, "bool"), (1, 2, 3, 4), broadcasts=True),
}

TEXTURE_FAMILIES: Mapping[str, frozenset[TextureType]] = {
    "F": frozenset(t for t in TEXTURES if t.sample == "float" and not t.layered),
    "D": frozenset(t for t in TEXTURES if t.sample == "depth" and not t.layered),
    "G": frozenset(t for t in TEXTURES if t.dimension in ("2d", "3d")),
    "H": frozenset(t for t in TEXTURES if t.dimension == "2d_array"),
    "X": frozenset(TEXTURES),
}
"""The texture types that a letter ranges over."""

_PREFIXES: tuple[tuple[str, ScalarKind], ...] = (("i", "int"), ("u", "uint"), ("b", "bool"))
FIXED: Mapping[str, Type] = {
    "S": FLOAT, "float": FLOAT, "int": INT, "uint": UINT, "bool": BOOL,
    **{str(texture): texture for texture in TEXTURES},
    **{f"vec{n}": Vector("float", n) for n in (2, 3, 4)},
    **{f"{p}vec{n}": Vector(k, n) for n in (2, 3, 4) for p, k in _PREFIXES},
    **{str(matrix): matrix for matrix in MATRICES},
}  # fmt: skip
"""Words of a signature that are one type."""

_OF_KIND: Mapping[str, ScalarKind] = {"Q": "bool", "U": "uint", "J": "int"}
"""Letters for lanes of a kind, as many as another letter has."""

DEPENDENT = "COLQUJKWEZ"
"""Letters that follow from others and so are bound last."""


@cache
def parsed(signature: str) -> tuple[tuple[str, ...], str]:
    """The words for the operands and the one for the result."""
    operands, result = signature.split("->")
    return tuple(word.strip() for word in operands.split(",")), result.strip()


@lru_cache(maxsize=4096)
def result_type(name: str, operands: tuple[Type, ...]) -> Type | None:
    """The result of builtin ``name`` for operands of just these types; ``None`` if it has none."""
    for signature in BUILTINS[name].signatures:
        words, result = parsed(signature)
        bound = _bound(words, operands)
        if bound is not None:
            return meaning(result, bound)
    return None


def meaning(letter: str, bound: Mapping[str, Type]) -> Type:
    """The type of a result's letter, once those of the operands are bound."""
    result = bound.get(letter) or FIXED.get(letter) or dependent(letter, bound)
    assert result is not None, letter
    return result


def dependent(letter: str, bound: Mapping[str, Type]) -> Type | None:
    """The type that follows from a letter bound before: lanes, columns, how a texture is read."""
    if isinstance(matrix := bound.get("M"), Matrix) and letter in _OF_MATRIX:
        return _of_matrix(letter, matrix, bound)
    base = next((bound[source] for source in "NTIP" if source in bound), None)
    kind = scalar_kind(base) if base is not None else None
    if letter == "L" and kind is not None:
        return Scalar(kind)
    if letter in _OF_KIND and base is not None:
        return with_width(_OF_KIND[letter], width(base))
    texture = next((t for t in bound.values() if isinstance(t, TextureType)), None)
    return None if texture is None else _of_texture(letter, texture)


_OF_MATRIX = "COAY"


def _of_matrix(letter: str, matrix: Matrix, bound: Mapping[str, Type]) -> Type | None:
    """The type of a column, of a row, of the transpose, or of a product of matrices."""
    match letter, bound.get("Z"):
        case "C", _:
            return matrix.column
        case "O", _:
            return Vector("float", matrix.columns)
        case "A", _:
            return Matrix(matrix.rows, matrix.columns)
        case "Y", Matrix(columns):
            return Matrix(columns, matrix.rows)
        case _:
            return None


def is_factor(matrix: Type | None, type_: Type) -> bool:
    """True if a matrix can be multiplied by one of ``type_``: it has a column for each row."""
    if not isinstance(matrix, Matrix) or not isinstance(type_, Matrix):
        return False
    return matrix.columns == type_.rows


def _of_texture(letter: str, texture: TextureType) -> Type | None:
    """The type of a texture's coordinate, of its size, or of a texel."""
    match letter:
        case "K":
            return Vector("float", texture.axes)
        case "W":
            return Vector("int", texture.extents)
        case "E":
            return texture.texel
        case _:
            return None


def _bound(words: tuple[str, ...], operands: tuple[Type, ...]) -> dict[str, Type] | None:
    """The type of each letter, where the operands fit; otherwise ``None``."""
    if len(words) != len(operands):
        return None
    bound: dict[str, Type] = {}
    for letter in sorted(dict.fromkeys(words), key=DEPENDENT.__contains__):
        used = {type_ for word, type_ in zip(words, operands, strict=True) if word == letter}
        type_ = used.pop()
        if used or not _may_be(letter, type_, bound):
            return None
        bound[letter] = type_
    return bound


def _may_be(letter: str, type_: Type, bound: Mapping[str, Type]) -> bool:
    """True if a letter can stand for a type."""
    if letter in FAMILIES:
        return FAMILIES[letter].contains(type_)
    if letter in TEXTURE_FAMILIES:
        return type_ in TEXTURE_FAMILIES[letter]
    if letter == "M":
        return isinstance(type_, Matrix)
    if letter == "Z":
        return is_factor(bound.get("M"), type_)
    return letter == "R" or type_ == (FIXED.get(letter) or dependent(letter, bound))
