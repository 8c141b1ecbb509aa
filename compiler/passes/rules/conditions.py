"""Conditions of rules, of types and of constants. Those of ranges are comparisons of terms."""

from __future__ import annotations

from ...ir.node import Node
from ...ir.types import Matrix, Scalar, Type, Vector, scalar_kind
from .builder import Builder
from .terms import condition


@condition("the result is a float")
def gives_float(_builder: Builder, type_: Type) -> bool:
    """True if the result is a float, or a vector of floats."""
    return not isinstance(type_, Matrix) and scalar_kind(type_) == "float"


@condition("the result is a vector")
def gives_vector(_builder: Builder, type_: Type) -> bool:
    """True if the result is a vector."""
    return isinstance(type_, Vector)


@condition("{} is as wide as the result")
def is_whole(_builder: Builder, type_: Type, value: Node) -> bool:
    """True if a value has the type of the result: it is no scalar beside vectors."""
    return value.type == type_


@condition("{} is a scalar")
def is_scalar(_builder: Builder, _type: Type, value: Node) -> bool:
    """True if a value is a scalar."""
    return isinstance(value.type, Scalar)


@condition("{} is a vector")
def is_vector(_builder: Builder, _type: Type, value: Node) -> bool:
    """True if a value is a vector."""
    return isinstance(value.type, Vector)


@condition("{} is a matrix")
def is_matrix(_builder: Builder, _type: Type, value: Node) -> bool:
    """True if a value is a matrix."""
    return isinstance(value.type, Matrix)


@condition("{} is no matrix")
def is_no_matrix(_builder: Builder, _type: Type, value: Node) -> bool:
    """True if a value is a scalar or a vector."""
    return not isinstance(value.type, Matrix)


@condition("none of {} is a matrix")
def are_no_matrices(_builder: Builder, _type: Type, values: tuple[Node, ...]) -> bool:
    """True if all of several values are scalars and vectors."""
    return not any(isinstance(value.type, Matrix) for value in values)


@condition("{} are one value")
def are_same(_builder: Builder, _type: Type, values: tuple[Node, ...]) -> bool:
    """True if all values are the same one."""
    return all(value is values[0] for value in values)


@condition("{} is signed")
def is_signed(_builder: Builder, _type: Type, value: Node) -> bool:
    """True if the type of a value allows negative numbers."""
    return scalar_kind(value.type) != "uint"
