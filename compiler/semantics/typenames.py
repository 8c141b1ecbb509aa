"""Written types to representation types.

Geometry types name a space (``point<world>``); spaces are checked to exist, and what a value means
beyond its representation is carried as the declared text and, for ``direction``, as a fact.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...frozen import frozen
from ...stdlib.builtins.facts import UNIT, UNKNOWN, Fact
from ..diagnostics import rules
from ..diagnostics.diagnostic import Report
from ..diagnostics.nearest import suggestion
from ..ir.types import (
    BOOL,
    FLOAT,
    INT,
    TEXTURES,
    UINT,
    VEC3,
    VEC4,
    Array,
    Matrix,
    ScalarKind,
    Struct,
    Type,
    Vector,
)
from ..syntax import ast

SCALAR_KINDS: tuple[ScalarKind, ...] = ("float", "int", "uint", "bool")
SPACES = frozenset({"object", "world", "view", "clip", "tangent", "light"})


@frozen
class Meaning:
    """A named type: representation, how many spaces it names, and what holds by contract."""

    representation: Type
    spaces: int = 0
    fact: Fact = UNKNOWN


NAMED: Mapping[str, Meaning] = {
    "bool": Meaning(BOOL),
    "int": Meaning(INT),
    "uint": Meaning(UINT),
    "float": Meaning(FLOAT),
    **{
        str(vector): Meaning(vector)
        for vector in (Vector(kind, size) for kind in SCALAR_KINDS for size in (2, 3, 4))
    },
    **{f"mat{size}": Meaning(Matrix(size)) for size in (2, 3, 4)},
    "rgb": Meaning(VEC3),
    "rgba": Meaning(VEC4),
    "angle": Meaning(FLOAT),
    "point": Meaning(VEC3, spaces=1),
    "vector": Meaning(VEC3, spaces=1),
    "normal": Meaning(VEC3, spaces=1),
    "direction": Meaning(VEC3, spaces=1, fact=UNIT),
    "transform": Meaning(Matrix(4), spaces=2),
    **{str(texture): Meaning(texture) for texture in TEXTURES},
}


@frozen
class Declared:
    """A resolved written type."""

    type: Type
    text: str
    """As the user wrote it, for the reflection and for messages."""
    fact: Fact = UNKNOWN


def described(name: ast.TypeName, count: int | None = None) -> str:
    """The written type as one line of text."""
    spaces = ", ".join(argument.text for argument in name.arguments)
    text = f"{name.name.text}<{spaces}>" if spaces else name.name.text
    return f"{text}[{count}]" if count is not None else text


class TypeResolver:
    """Looks written types up; reports what it cannot find."""

    def __init__(self, report: Report) -> None:
        self._report = report

    def resolve(
        self,
        name: ast.TypeName,
        structs: Mapping[str, Struct],
        spaces: frozenset[str],
        variables: Mapping[str, Type] | None = None,
    ) -> Declared | None:
        """The written type without its array count, or ``None`` after reporting."""
        text = name.name.text
        if variables and text in variables:
            return Declared(variables[text], text)
        if text in structs:
            return Declared(structs[text], text)
        meaning = NAMED.get(text)
        if meaning is None:
            known = [*NAMED, *structs, *(variables or ())]
            self._report.add(
                rules.UNKNOWN_NAME, name.name.span, kind="type", name=text,
                hint=suggestion(text, known),
            )  # fmt: skip
            return None
        if not self._check_spaces(name, meaning, spaces):
            return None
        return Declared(meaning.representation, described(name), meaning.fact)

    def _check_spaces(self, name: ast.TypeName, meaning: Meaning, spaces: frozenset[str]) -> bool:
        if name.arguments and len(name.arguments) != meaning.spaces:
            self._report.add(
                rules.SPACE_COUNT, name.span, type=name.name.text,
                expected=meaning.spaces, found=len(name.arguments),
            )  # fmt: skip
            return False
        for argument in name.arguments:
            if argument.text not in SPACES and argument.text not in spaces:
                self._report.add(
                    rules.UNKNOWN_NAME, argument.span, kind="space", name=argument.text,
                    hint=suggestion(argument.text, [*SPACES, *spaces]),
                )  # fmt: skip
                return False
        return True


def array_of(declared: Declared, name: ast.TypeName, count: int) -> Declared:
    """An array of ``count`` elements of a resolved type."""
    return Declared(Array(declared.type, count), described(name, count), declared.fact)
