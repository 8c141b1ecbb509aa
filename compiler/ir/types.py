"""Representation types: the numbers of a value, without their meaning.

The types of the language that carry meaning (``rgb``, ``angle``, ``point<world>`` …) cost nothing
at run time; ``semantics`` maps each of them onto one of these types. All are frozen, and equal
types are one object, because every node's key contains its type.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import ClassVar, Literal, get_args

from ...support.frozen import frozen
from ..constraints import Spelling, dashed

ScalarKind = Literal["float", "int", "uint", "bool"]
Dimension = Literal["2d", "2d_array", "3d", "cube", "cube_array"]
DIMENSION_WORDS: Spelling = dashed(get_args(Dimension))
"""WebGPU's words, ``GPUTextureViewDimension``."""
Sample = Literal["float", "depth", "int", "uint"]
"""The content of a texture: colours, depths to compare with, or whole numbers."""
Intent = Literal["color", "data"]
"""The sense of a texture's numbers: a picture's colours, or others, such as a height."""
Wrap = Literal["repeat", "clamp", "mirror", "border"]
"""The texels beyond the edges: those of copies, those at the edge, or a border of one colour."""
Border = Literal["transparent", "black", "white"]
"""The texel of a border; of a texture of depths, 0 is black and 1 is white."""
AXES = ("u", "v", "w")
"""The axes along which a texture can wrap, by the ends of their settings' names."""


@frozen(interned=True)
class Scalar:
    """One lane."""

    kind: ScalarKind

    def __str__(self) -> str:
        return self.kind


@frozen(interned=True)
class Vector:
    """Two to four lanes of one scalar kind; a column where matrices are concerned."""

    kind: ScalarKind
    size: int

    def __str__(self) -> str:
        prefix = {"float": "", "int": "i", "uint": "u", "bool": "b"}[self.kind]
        return f"{prefix}vec{self.size}"


@frozen(interned=True)
class Matrix:
    """Two to four columns of floats with ``rows`` lanes each."""

    columns: int
    rows: int
    kind: ClassVar[ScalarKind] = "float"

    @property
    def column(self) -> Vector:
        """The type of a column."""
        return Vector("float", self.rows)

    @property
    def is_square(self) -> bool:
        """True if there are as many columns as rows."""
        return self.columns == self.rows

    def __str__(self) -> str:
        return f"mat{self.columns}" if self.is_square else f"mat{self.columns}x{self.rows}"


@frozen(interned=True)
class Array:
    """A fixed number of elements."""

    element: Type
    count: int

    def __str__(self) -> str:
        return f"{self.element}[{self.count}]"


@frozen(interned=True)
class RuntimeArray:
    """The elements of a storage buffer, whose number only the host knows."""

    element: Type

    def __str__(self) -> str:
        return f"{self.element}[]"


@frozen(interned=True)
class Struct:
    """Named members in declaration order."""

    name: str
    members: tuple[tuple[str, Type], ...]

    def member(self, name: str) -> Type:
        """The type of member ``name``; ``KeyError`` if there is none."""
        return dict(self.members)[name]

    def __str__(self) -> str:
        return self.name


@frozen(interned=True)
class TextureType:
    """A texture; dimension and sample type are part of it, since WebGPU layouts need them."""

    dimension: Dimension = "2d"
    sample: Sample = "float"

    @property
    def layered(self) -> bool:
        """True if a read says which layer."""
        return self.dimension in ("2d_array", "cube_array")

    @property
    def is_cube(self) -> bool:
        """True if a coordinate is a direction, which meets one of six faces."""
        return self.dimension in ("cube", "cube_array")

    @property
    def texel(self) -> Numeric:
        """The type of one texel."""
        return FLOAT if self.sample == "depth" else Vector(self.sample, 4)

    @property
    def axes(self) -> int:
        """Numbers in a coordinate by which it is filtered."""
        return 3 if self.dimension == "3d" or self.is_cube else 2

    @property
    def extents(self) -> int:
        """Numbers in its size, and in the place of a texel; layers are counted apart."""
        return 3 if self.dimension == "3d" else 2

    def __str__(self) -> str:
        return _PREFIXES[self.sample] + _SUFFIXES[self.dimension]


Type = Scalar | Vector | Matrix | Array | RuntimeArray | Struct | TextureType
Numeric = Scalar | Vector
Opaque = TextureType | RuntimeArray
"""Types that are read in place, and are never values by themselves."""

FLOAT = Scalar("float")
INT = Scalar("int")
UINT = Scalar("uint")
BOOL = Scalar("bool")
VEC2 = Vector("float", 2)
IVEC2 = Vector("int", 2)
IVEC4 = Vector("int", 4)
VEC3 = Vector("float", 3)
VEC4 = Vector("float", 4)
MATRICES = (
    *(Matrix(size, size) for size in (2, 3, 4)),
    *(Matrix(columns, rows) for columns in (2, 3, 4) for rows in (2, 3, 4) if columns != rows),
)
"""All types of matrices, the square ones first."""

_PREFIXES: Mapping[Sample, str] = {
    "float": "texture", "depth": "depth", "int": "itexture", "uint": "utexture",
}  # fmt: skip
_SUFFIXES: Mapping[Dimension, str] = {
    "2d": "2d", "2d_array": "2d_array", "3d": "3d", "cube": "_cube",
    "cube_array": "_cube_array",
}  # fmt: skip

TEXTURES = (
    *(TextureType(dimension, "float") for dimension in _SUFFIXES),
    *(TextureType(dimension, "depth") for dimension in _SUFFIXES if dimension != "3d"),
    *(
        TextureType(dimension, sample)
        for sample in ("int", "uint")
        for dimension in _SUFFIXES
        if dimension not in ("cube", "cube_array")
    ),
)
"""All texture types.

No API compares volumes, and the texels of a cube cannot be named by numbers, so integer cubes could
not be read.
"""


def width(type_: Type) -> int:
    """Lanes of a scalar or vector; components of a matrix."""
    match type_:
        case Scalar():
            return 1
        case Vector(size=size):
            return size
        case Matrix(columns=columns, rows=rows):
            return columns * rows
        case _:
            raise TypeError(f"{type_} has no width")


@cache
def numbers(type_: Type) -> int:
    """The number of numbers in a value, with those of all its elements and members.

    It is 0 of types that are no values, such as textures.
    """
    match type_:
        case Scalar() | Vector() | Matrix():
            return width(type_)
        case Array(element=element, count=count):
            return count * numbers(element)
        case Struct(members=members):
            return sum(numbers(member) for _, member in members)
        case _:
            return 0


_KINDS: tuple[ScalarKind, ...] = ("float", "int", "uint", "bool")
_NUMERIC: dict[tuple[ScalarKind, int], Numeric] = {
    (kind, lanes): Scalar(kind) if lanes == 1 else Vector(kind, lanes)
    for kind in _KINDS
    for lanes in (1, 2, 3, 4)
}


def square(size: int) -> Matrix:
    """The matrix with as many rows as columns."""
    return Matrix(size, size)


def with_width(kind: ScalarKind, lanes: int) -> Numeric:
    """The scalar or vector of ``lanes`` lanes."""
    return _NUMERIC[kind, lanes]


def of_floats(type_: Type) -> Type:
    """The type of as many floats, of a number or a vector; any other type itself."""
    return with_width("float", width(type_)) if isinstance(type_, Scalar | Vector) else type_


def scalar_kind(type_: Type) -> ScalarKind | None:
    """The kind of a type's lanes; ``None`` for aggregates and textures."""
    return type_.kind if isinstance(type_, Scalar | Vector | Matrix) else None
