"""Resolves written types to representation types.

Geometry types name a space (``point<world>``), which has to exist. A written type says the
representation of a value on the machine, its meaning, and the facts that hold by contract.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache

from ....stdlib.builtins.facts import UNIT, UNKNOWN, Fact
from ....support.frozen import changed, frozen
from ...diagnostics import rules
from ...diagnostics.diagnostic import Report
from ...diagnostics.fixes import Hint, fix_it
from ...diagnostics.nearest import respelling
from ...ir.meaning import Meaning, MeaningKind
from ...ir.types import (
    BOOL,
    FLOAT,
    INT,
    MATRICES,
    TEXTURES,
    UINT,
    VEC3,
    VEC4,
    Array,
    RuntimeArray,
    Scalar,
    ScalarKind,
    Struct,
    Type,
    Vector,
    square,
)
from ...syntax import ast
from ...syntax.quoting import counted
from ...syntax.rewriting import called_here, declared_space

SCALAR_KINDS: tuple[ScalarKind, ...] = ("float", "int", "uint", "bool")
SPACES = frozenset({"object", "world", "view", "clip", "tangent", "light"})


HOMOGENEOUS = "clip"
"""The space whose points have four lanes."""


@frozen
class Named:
    """A type with a name: representation, number of spaces that it names, and contract."""

    representation: Type
    spaces: int = 0
    fact: Fact = UNKNOWN
    meaning: MeaningKind | None = None


NAMED: Mapping[str, Named] = {
    "bool": Named(BOOL),
    "int": Named(INT),
    "uint": Named(UINT),
    "float": Named(FLOAT),
    **{
        str(vector): Named(vector)
        for vector in (Vector(kind, size) for kind in SCALAR_KINDS for size in (2, 3, 4))
    },
    **{str(matrix): Named(matrix) for matrix in MATRICES},
    "rgb": Named(VEC3, meaning="rgb"),
    "rgba": Named(VEC4, meaning="rgba"),
    "angle": Named(FLOAT, meaning="angle"),
    "point": Named(VEC3, spaces=1, meaning="point"),
    "vector": Named(VEC3, spaces=1, meaning="vector"),
    "normal": Named(VEC3, spaces=1, fact=UNIT, meaning="normal"),
    "covector": Named(VEC3, spaces=1, meaning="normal"),
    "direction": Named(VEC3, spaces=1, fact=UNIT, meaning="direction"),
    "transform": Named(square(4), spaces=2, meaning="transform"),
    "basis": Named(square(3), spaces=2, meaning="basis"),
    **{str(texture): Named(texture) for texture in TEXTURES},
}

IMAGE_TYPE = "image2d"
"""The word for the type of a kernel's result whose elements are texels."""

GENERIC_VECTOR = "vec"
"""``vec<K, N>`` in a function with such type parameters."""


@frozen
class Declared:
    """A resolved written type."""

    type: Type
    text: str
    """The type as the user wrote it, for the reflection and for messages."""
    fact: Fact = UNKNOWN
    """The fact that holds by contract; of a structure's or array's vectors, too."""
    meaning: Meaning | None = None
    members: tuple[tuple[str, Declared], ...] = ()
    """The members of a struct."""


Variable = Declared | str | int
"""The value of a type parameter: a type, a space (empty if unknown), or a number."""
_RENAMED: Mapping[str, str] = {"frame": "basis"}
"""Types that had another name in an earlier version of the language."""

Variables = Mapping[str, Variable]


_SEMANTICS = r"SV_\w+|(?:TEXCOORD|COLOR|POSITION|NORMAL|TANGENT|BINORMAL)[0-9]*"
"""A pattern of the semantics that HLSL writes behind the members of a structure, and behind
functions, in small letters or large ones. It is compiled when a mistake needs it."""


def described(name: ast.TypeName) -> str:
    """The written type as one line of text."""
    text = _written(name.name.text, [argument.text for argument in name.arguments])
    if name.unsized:
        return f"{text}[]"
    return f"{text}[{name.count.span.text}]" if name.count is not None else text


def _written(word: str, arguments: Sequence[str]) -> str:
    return f"{word}<{', '.join(arguments)}>" if arguments else word


class TypeResolver:
    """Looks written types up; reports those that it cannot find."""

    def __init__(self, report: Report) -> None:
        self._report = report

    def resolve(
        self,
        name: ast.TypeName,
        structs: Mapping[str, Declared],
        spaces: frozenset[str],
        variables: Variables,
        other: Hint = "",
        declared: Iterable[str] = (),
    ) -> Declared | None:
        """The written type without its array count, or ``None`` after reporting.

        ``other`` is the hint for a name that is declared, but as something else than a type, and
        ``declared`` are the names of types of which a misspelt name may be one.
        """
        text = name.name.text
        known = variables.get(text)
        if isinstance(known, Declared):
            return known
        if text == GENERIC_VECTOR and len(name.arguments) == 2:
            return self._generic_vector(name, variables)
        if text in structs:
            return structs[text]
        named = NAMED.get(text)
        if named is None:
            visible = [*NAMED, *declared, *variables]
            self._unknown("type", name.name, visible, other or _elsewhere(name.name))
            return None
        if not name.arguments:
            return _named(text, (), ())
        if not self._check_spaces(name, named, spaces, variables):
            return None
        written = tuple(argument.text for argument in name.arguments)
        found = (variables.get(argument, argument) for argument in written)
        return _named(text, written, tuple(s for s in found if isinstance(s, str) and s))

    def _generic_vector(self, name: ast.TypeName, variables: Variables) -> Declared | None:
        kind, size = name.arguments
        lane = variables.get(kind.text, NAMED.get(kind.text))
        scalar = lane.type if isinstance(lane, Declared) else getattr(lane, "representation", None)
        lanes = variables.get(size.text)
        if not isinstance(scalar, Scalar):
            self._unknown("kind of lanes", kind, [*SCALAR_KINDS, *variables])
            return None
        if not isinstance(lanes, int):
            self._unknown("width", size, variables)
            return None
        vector = Vector(scalar.kind, lanes)
        return Declared(vector, str(vector))

    def _check_spaces(
        self, name: ast.TypeName, named: Named, spaces: frozenset[str], variables: Variables
    ) -> bool:
        if len(name.arguments) != named.spaces:
            self._report.add(
                rules.SPACE_COUNT, name.span, type=name.name.text,
                expected=counted(named.spaces, "space"), found=len(name.arguments),
            )  # fmt: skip
            return False
        for argument in name.arguments:
            known_here = argument.text in SPACES or argument.text in spaces
            if not known_here and not isinstance(variables.get(argument.text), str):
                known = [*SPACES, *spaces]
                near = respelling(argument.text, argument.span, known)
                declared = near or declared_space(argument.text, argument.span)
                self._unknown("space", argument, known, declared)
                return False
        return True

    def _unknown(
        self, kind: str, name: ast.Name, known: Iterable[str], elsewhere: Hint = ""
    ) -> None:
        hint = elsewhere or respelling(name.text, name.span, known)
        self._report.add(rules.UNKNOWN_NAME, name.span, kind=kind, name=name.text, hint=hint)


@lru_cache(maxsize=1024)
def _named(word: str, arguments: tuple[str, ...], spaces: tuple[str, ...]) -> Declared:
    """The type that ``word`` names.

    Where a space among its arguments is unknown, ``spaces`` lacks it, and the type has no meaning.
    A compile asks for the same few types again and again.
    """
    named = NAMED[word]
    meaning = None
    if named.meaning is not None and len(spaces) == named.spaces:
        meaning = Meaning(named.meaning, spaces)
    homogeneous = named.meaning == "point" and spaces == (HOMOGENEOUS,)
    type_ = VEC4 if homogeneous else named.representation
    text = str(meaning) if spaces and meaning is not None else _written(word, arguments)
    return Declared(type_, text, named.fact, meaning)


def structure(type_: Struct, name: str, members: tuple[tuple[str, Declared], ...]) -> Declared:
    """A structure as the written type ``name``."""
    meanings = tuple((name, member.meaning) for name, member in members)
    meaning = Meaning("struct", members=meanings) if any(m for _, m in meanings) else None
    return Declared(type_, name, meaning=meaning, members=members)


def _elsewhere(name: ast.Name) -> Hint:
    """The hint for a type that has another name here than in another language, or than before."""
    from ....stdlib.builtins.elsewhere import COLUMNS_FIRST, TYPES

    if name.text in _RENAMED:
        now = _RENAMED[name.text]
        said = f"the type `{name.text}<A, B>` is called `{now}<A, B>` now"
        return fix_it(said, (name.span, now), sure=True)
    if name.text in TYPES:
        why = COLUMNS_FIRST.get(name.text, "")
        return called_here(name.text, name.span, TYPES[name.text], why)
    if name.text == IMAGE_TYPE:
        return (
            "an image is what a kernel writes, `result name : image2d<rgba8>[size] = …`; what is "
            "read is a texture, `map name : texture2d`"
        )
    if re.fullmatch(_SEMANTICS, name.text, re.IGNORECASE):
        return "a semantic is no type, and is not written: the compiler connects the stages"
    return ""


def unsized_array_of(declared: Declared) -> Declared:
    """Any number of elements of a resolved type."""
    return changed(declared, type=RuntimeArray(declared.type), text=f"{declared.text}[]")


def array_of(declared: Declared, count: int) -> Declared:
    """An array of ``count`` elements of a resolved type."""
    text = f"{declared.text}[{count}]"
    return changed(declared, type=Array(declared.type, count), text=text)
