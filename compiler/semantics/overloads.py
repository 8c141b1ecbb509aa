"""Which signature of a builtin fits which operands.

Letters of a signature stand for the same type wherever they occur (``stdlib/builtins/row.py`` lists
them). Constants adapt: an integer literal may stand for a float, and a scalar may stand for a vector
of equal lanes where the letter's family has both.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from ...stdlib.builtins import BUILTINS
from ...stdlib.builtins.row import Builtin
from ..ir.node import Node
from ..ir.types import (
    BOOL,
    FLOAT,
    INT,
    UINT,
    Matrix,
    Scalar,
    ScalarKind,
    Texture,
    Type,
    Vector,
    scalar_kind,
    width,
    with_width,
)
from .coerce import is_constant


@dataclass(frozen=True, slots=True)
class Family:
    """What a signature letter ranges over."""

    kinds: tuple[ScalarKind, ...]
    widths: tuple[int, ...]
    broadcasts: bool = False
    """Whether a scalar operand may stand for a vector of equal lanes."""

    def contains(self, type_: Type) -> bool:
        """Whether a type belongs to the family."""
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
    "B": Family(("bool",), (1, 2, 3, 4)),
    "P": Family((*NUMBER_KINDS, "bool"), (1, 2, 3, 4)),
}
WRITTEN_FAMILIES: Mapping[str, Family] = {
    "floats": FAMILIES["T"],
    "vectors": FAMILIES["V"],
    "numbers": FAMILIES["N"],
    "integers": FAMILIES["I"],
    "scalars": Family(NUMBER_KINDS, (1,)),
}
"""The families a function's type parameters may name, besides ``matrices``."""

_PREFIXES: tuple[tuple[str, ScalarKind], ...] = (("i", "int"), ("u", "uint"), ("b", "bool"))
FIXED: Mapping[str, Type] = {
    "S": FLOAT, "float": FLOAT, "int": INT, "uint": UINT, "bool": BOOL, "texture2d": Texture(),
    **{f"vec{n}": Vector("float", n) for n in (2, 3, 4)},
    **{f"{p}vec{n}": Vector(k, n) for n in (2, 3, 4) for p, k in _PREFIXES},
    **{f"mat{n}": Matrix(n) for n in (2, 3, 4)},
}  # fmt: skip


_DEPENDENT = "CLQ"
"""Letters that follow from others and so are bound last."""


@dataclass(frozen=True, slots=True)
class Operand:
    """What resolution needs to know of an operand."""

    type: Type
    constant: bool = False
    """Constants of kind int adapt to the kind that is wanted."""


@dataclass(frozen=True, slots=True)
class Resolution:
    """The operand types to coerce to, and the type of the result."""

    operands: tuple[Type, ...]
    result: Type


@lru_cache(maxsize=None)
def _parsed(signature: str) -> tuple[tuple[str, ...], str]:
    operands, result = signature.split("->")
    return tuple(word.strip() for word in operands.split(",")), result.strip()


@lru_cache(maxsize=4096)
def resolve(name: str, operands: tuple[Operand, ...]) -> Resolution | None:
    """The first signature of builtin ``name`` that takes ``operands``; exact matches come first."""
    for exact in (True, False):
        for signature in BUILTINS[name].signatures:
            found = _match(signature, operands, exact)
            if found is not None:
                return found
    return None


def common_type(family: Family, operands: Sequence[Operand]) -> Type | None:
    """The one type of a family that all operands can stand for."""
    return _bind_family(family, operands, False)


def operand(node: Node) -> Operand:
    """A node as resolution sees it."""
    return Operand(node.type, is_constant(node))


def takes(name: str, count: int) -> bool:
    """Whether some signature of ``name`` has ``count`` operands."""
    return any(len(_parsed(signature)[0]) == count for signature in BUILTINS[name].signatures)


def signatures(row: Builtin) -> str:
    """The candidates as one line for a message."""
    return "; ".join(f"{row.name}({signature})" for signature in row.signatures)


def adapts(operand: Operand, kind: ScalarKind) -> bool:
    """Whether an operand's lanes have ``kind``, or are a constant that can be taken as it."""
    found = scalar_kind(operand.type)
    return found == kind or (operand.constant and found == "int" and kind in NUMBER_KINDS)


def _match(signature: str, operands: tuple[Operand, ...], exact: bool) -> Resolution | None:
    words, result = _parsed(signature)
    if len(words) != len(operands):
        return None
    bound: dict[str, Type] = {}
    for letter in sorted(dict.fromkeys(words), key=_DEPENDENT.__contains__):
        uses = [operand for word, operand in zip(words, operands, strict=True) if word == letter]
        type_ = _bind(letter, uses, bound, exact)
        if type_ is None:
            return None
        bound[letter] = type_
    return Resolution(tuple(bound[word] for word in words), _result(result, bound))


def _bind(
    letter: str, uses: Sequence[Operand], bound: Mapping[str, Type], exact: bool
) -> Type | None:
    fixed = FIXED.get(letter) or _dependent(letter, bound)
    if fixed is not None:
        return fixed if all(_fits(use, fixed, exact) for use in uses) else None
    if letter == "M":
        types = {use.type for use in uses}
        return uses[0].type if len(types) == 1 and isinstance(uses[0].type, Matrix) else None
    if letter == "R":
        return uses[0].type if len({use.type for use in uses}) == 1 else None
    return _bind_family(FAMILIES[letter], uses, exact)


def _bind_family(family: Family, uses: Sequence[Operand], exact: bool) -> Type | None:
    widths = {width(use.type) for use in uses if isinstance(use.type, Scalar | Vector)}
    if len(widths) > 1 and (exact or not family.broadcasts or len(widths - {1}) > 1):
        return None
    kind = _common_kind(uses, family, exact)
    if kind is None or not all(isinstance(use.type, Scalar | Vector) for use in uses):
        return None
    type_ = with_width(kind, max(widths))
    return type_ if family.contains(type_) else None


def _common_kind(uses: Sequence[Operand], family: Family, exact: bool) -> ScalarKind | None:
    fixed = {scalar_kind(use.type) for use in uses if not use.constant}
    kinds = fixed or {scalar_kind(use.type) for use in uses}
    if exact:
        kinds |= {scalar_kind(use.type) for use in uses}
    if len(kinds) > 1 and not fixed:
        kinds = {"float"}
    if len(kinds) != 1:
        return None
    kind = kinds.pop()
    if kind not in family.kinds and kind == "int" and not exact and not fixed:
        kind = "float"
    if kind is None or not all(adapts(use, kind) for use in uses):
        return None
    return kind


def _fits(operand: Operand, type_: Type, exact: bool) -> bool:
    if operand.type == type_:
        return True
    if exact or not isinstance(type_, Scalar):
        return False
    return isinstance(operand.type, Scalar) and adapts(operand, type_.kind)


def _dependent(letter: str, bound: Mapping[str, Type]) -> Type | None:
    """``L``, ``C`` and ``Q`` follow from a letter bound before them."""
    if letter == "C" and isinstance(matrix := bound.get("M"), Matrix):
        return Vector("float", matrix.size)
    if letter == "Q" and (base := bound.get("P")) is not None:
        return with_width("bool", width(base))
    if letter == "L":
        for source in ("N", "T", "I", "P"):
            kind = scalar_kind(bound[source]) if source in bound else None
            if kind is not None:
                return Scalar(kind)
    return None


def _result(letter: str, bound: Mapping[str, Type]) -> Type:
    result = bound.get(letter) or FIXED.get(letter) or _dependent(letter, bound)
    assert result is not None, letter
    return result
