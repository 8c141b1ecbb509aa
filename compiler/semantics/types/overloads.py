"""Finds the signature of a builtin that fits the operands.

A signature that fits without conversions (``ir/signatures.py``) comes first. Beyond that, constants
adapt: an integer literal may stand for a float, and a scalar may stand for a vector of equal lanes
where the letter's family has both.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache

from ....stdlib.builtins import BUILTINS
from ....stdlib.builtins.row import Builtin
from ....support.frozen import frozen
from ...ir.node import Node
from ...ir.signatures import (
    DEPENDENT,
    FAMILIES,
    FIXED,
    NUMBER_KINDS,
    TEXTURE_FAMILIES,
    Family,
    dependent,
    is_factor,
    meaning,
    parsed,
    result_type,
)
from ...ir.types import Matrix, Scalar, ScalarKind, Type, Vector, scalar_kind, width, with_width
from .coercion import is_constant
from .operand import Operand

WRITTEN_FAMILIES: Mapping[str, Family] = {
    "floats": FAMILIES["T"],
    "vectors": FAMILIES["V"],
    "numbers": FAMILIES["N"],
    "integers": FAMILIES["I"],
    "scalars": Family(NUMBER_KINDS, (1,)),
    "bools": FAMILIES["B"],
}
"""The families of numbers and vectors that a function's type parameters may name."""


@frozen
class Resolution:
    """The operand types to coerce to, and the type of the result."""

    operands: tuple[Type, ...]
    result: Type


@lru_cache(maxsize=4096)
def resolve(name: str, operands: tuple[Operand, ...]) -> Resolution | None:
    """The first signature of builtin ``name`` that takes ``operands``; exact matches come first."""
    types = tuple(operand.type for operand in operands)
    exact = result_type(name, types)
    if exact is not None:
        return Resolution(types, exact)
    matches = (_match(signature, operands) for signature in BUILTINS[name].signatures)
    return next((match for match in matches if match is not None), None)


def operand(node: Node) -> Operand:
    """A node as resolution sees it."""
    return Operand(node.type, is_constant(node))


def takes(name: str, count: int) -> bool:
    """True if some signature of ``name`` has ``count`` operands."""
    return any(len(parsed(signature)[0]) == count for signature in BUILTINS[name].signatures)


def signatures(row: Builtin) -> str:
    """The candidates as one line for a message, as functions of a user's are declared."""
    shown: list[str] = []
    used: set[str] = set()
    for signature in row.signatures:
        operands, result = parsed(signature)
        used.update(operands)
        words = [str(FIXED.get(word, word)) for word in (*operands, result)]
        shown.append(f"`{row.name}({', '.join(words[:-1])}) -> {words[-1]}`")
    told = {
        letter: name
        for name, family in WRITTEN_FAMILIES.items()
        for letter in sorted(used)
        if FAMILIES.get(letter) is family
    }
    if "M" in used:
        told["M"] = "matrices"
    families = [f"`{letter}` one of the {name}" for letter, name in told.items()]
    if any(parsed(signature)[1] == "A" for signature in row.signatures):
        families.append("`A` its transpose")
    return f"{', '.join(shown)}{' with ' if families else ''}{' and '.join(families)}"


def adapts(operand: Operand, kind: ScalarKind) -> bool:
    """True if an operand's lanes have ``kind``, or are a constant that can be taken as it."""
    found = scalar_kind(operand.type)
    return found == kind or (operand.constant and found == "int" and kind in NUMBER_KINDS)


def _match(signature: str, operands: tuple[Operand, ...]) -> Resolution | None:
    words, result = parsed(signature)
    if len(words) != len(operands):
        return None
    bound: dict[str, Type] = {}
    for letter in sorted(dict.fromkeys(words), key=DEPENDENT.__contains__):
        uses = [operand for word, operand in zip(words, operands, strict=True) if word == letter]
        type_ = _bind(letter, uses, bound)
        if type_ is None:
            return None
        bound[letter] = type_
    return Resolution(tuple(bound[word] for word in words), meaning(result, bound))


def _bind(letter: str, uses: Sequence[Operand], bound: Mapping[str, Type]) -> Type | None:
    fixed = FIXED.get(letter) or dependent(letter, bound)
    if fixed is not None:
        return fixed if all(_fits(use, fixed) for use in uses) else None
    if letter == "M":
        types = {use.type for use in uses}
        return uses[0].type if len(types) == 1 and isinstance(uses[0].type, Matrix) else None
    if letter == "Z":
        return uses[0].type if is_factor(bound.get("M"), uses[0].type) else None
    if letter in TEXTURE_FAMILIES:
        return uses[0].type if uses[0].type in TEXTURE_FAMILIES[letter] else None
    if letter == "R":
        return uses[0].type if len({use.type for use in uses}) == 1 else None
    return common_type(FAMILIES[letter], uses)


def common_type(family: Family, uses: Sequence[Operand]) -> Type | None:
    """The one type of a family that all operands can stand for."""
    widths = {width(use.type) for use in uses if isinstance(use.type, Scalar | Vector)}
    if len(widths) > 1 and (not family.broadcasts or len(widths - {1}) > 1):
        return None
    kind = _common_kind(uses, family)
    if kind is None or not all(isinstance(use.type, Scalar | Vector) for use in uses):
        return None
    type_ = with_width(kind, max(widths))
    return type_ if family.contains(type_) else None


def _common_kind(uses: Sequence[Operand], family: Family) -> ScalarKind | None:
    fixed = {scalar_kind(use.type) for use in uses if not use.constant}
    kinds = fixed or {scalar_kind(use.type) for use in uses}
    if len(kinds) > 1 and not fixed:
        kinds = {"float"}
    if len(kinds) != 1:
        return None
    kind = kinds.pop()
    if kind not in family.kinds and kind == "int" and not fixed:
        kind = "float"
    if kind is None or not all(adapts(use, kind) for use in uses):
        return None
    return kind


def _fits(operand: Operand, type_: Type) -> bool:
    if operand.type == type_:
        return True
    if not isinstance(type_, Scalar):
        return False
    return isinstance(operand.type, Scalar) and adapts(operand, type_.kind)
