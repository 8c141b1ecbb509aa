"""Random declarations, as hypothesis strategies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from hypothesis import strategies as st

from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    MATRICES,
    UINT,
    VEC2,
    VEC3,
    VEC4,
    Array,
    Matrix,
    Scalar,
    ScalarKind,
    Struct,
    Type,
    Vector,
)

KINDS: tuple[ScalarKind, ...] = ("float", "int", "uint", "bool")

scalars = st.sampled_from(KINDS).map(Scalar)
vectors = st.builds(Vector, st.sampled_from(KINDS), st.integers(2, 4))
matrices = st.builds(Matrix, st.integers(2, 4), st.integers(2, 4))
plain = st.one_of(scalars, vectors, matrices)


def _struct(members: list[Type]) -> Struct:
    """A struct named after what is in it, so that no two differ under one name."""
    inside = "_".join(str(member).replace("[", "x").replace("]", "") for member in members)
    return Struct(f"S_{inside}", tuple((f"m{i}", type_) for i, type_ in enumerate(members)))


def _aggregates(inner: st.SearchStrategy[Type]) -> st.SearchStrategy[Type]:
    structs = st.lists(inner, min_size=1, max_size=5).map(_struct)
    return st.one_of(structs, st.builds(Array, st.one_of(plain, structs), st.integers(1, 9)))


types: st.SearchStrategy[Type] = st.recursive(plain, _aggregates, max_leaves=8)


def _parameters(found: list[Type]) -> list[Parameter]:
    return [Parameter(f"p{i}", type_, "material") for i, type_ in enumerate(found)]


parameters = st.lists(types, min_size=1, max_size=8).map(_parameters)


ELEMENTS: Sequence[Type] = [
    FLOAT,
    BOOL,
    UINT,
    VEC2,
    Vector("bool", 2),
    VEC3,
    Vector("bool", 3),
    VEC4,
    *MATRICES,
]
"""The types that an array can hold, one of each stored form."""

SCALAR_VALUES: Mapping[ScalarKind, st.SearchStrategy[object]] = {
    "float": st.integers(-1000, 1000).map(lambda number: number / 8),
    "int": st.integers(-(2**31), 2**31 - 1),
    "uint": st.integers(0, 2**32 - 1),
    "bool": st.booleans(),
}


def values(type_: Type) -> st.SearchStrategy[object]:
    """Values of a declared type that survive a float32."""
    match type_:
        case Scalar(kind):
            return SCALAR_VALUES[kind]
        case Vector(kind, size):
            return st.tuples(*[SCALAR_VALUES[kind]] * size)
        case Matrix(columns):
            return st.tuples(*[values(type_.column)] * columns)
        case Array(element, count):
            return st.tuples(*[values(element)] * count)
        case Struct(members=members):
            return st.tuples(*[values(member) for _, member in members])
        case _:
            raise TypeError(type_)
