"""Steps: how a host computes a value of parameters, one operation after the other.

``reflection/values.py`` makes steps of expressions, and ``targets/runner/instances/derived.py``
computes them. The arguments of a step are the numbers of earlier steps in its list; the last step
is the value.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Annotated, Literal

from ...support.frozen import frozen
from ..constraints import Count, Lanes, Length, Range

NoArguments = tuple[()]
Some = Annotated[tuple[Count, ...], Length(1)]
"""One argument or more."""


@frozen(kw_only=True)
class ParameterStep:
    """The value of a parameter."""

    op: Literal["parameter"]
    type: str
    """Type of the result."""
    args: NoArguments
    parameter: str
    """Name of the parameter."""


@frozen(kw_only=True)
class ConstantStep:
    """A number, a vector or a matrix."""

    op: Literal["constant"]
    type: str
    """Type of the result."""
    args: NoArguments
    value: Lanes
    """The value."""


@frozen(kw_only=True)
class TextureStep:
    """A texture, of which only the size is asked for."""

    op: Literal["texture"]
    type: str
    """Type of the texture."""
    args: NoArguments
    texture: str
    """Name of the texture."""


@frozen(kw_only=True)
class BoundStep:
    """A variable of a body: of ``fold`` the number of the term, of ``apply`` an argument."""

    op: Literal["bound"]
    type: str
    """Type of the result."""
    args: NoArguments
    binder: Count
    """The enclosing variable, counted outwards from 0.

    Outside of all bodies, this is the number of the element.
    """


@frozen(kw_only=True)
class CallStep:
    """The call of a builtin, as Burnish defines it, or as hardware does."""

    op: Literal["call", "native"]
    type: str
    """Type of the result."""
    args: Some
    """The builtin's arguments."""
    function: str
    """The builtin's name."""


@frozen(kw_only=True)
class ComposedStep:
    """Parts that are put together.

    Numbers and vectors make a vector, columns a matrix, and elements an array. For ``apply``, the
    parts are a body and then the values of its variables.
    """

    op: Literal["vector", "matrix", "array", "apply"]
    type: str
    """Type of the result."""
    args: Some
    """The parts."""


@frozen(kw_only=True)
class SplatStep:
    """A vector whose lanes are all one number."""

    op: Literal["splat"]
    type: str
    """Type of the result."""
    args: tuple[Count]
    """The number."""


@frozen(kw_only=True)
class SwizzleStep:
    """A swizzle: some lanes of a vector."""

    op: Literal["swizzle"]
    type: str
    """Type of the result."""
    args: tuple[Count]
    """The vector."""
    lanes: tuple[Annotated[int, Range(least=0, most=3)], ...]
    """The lanes taken, in order."""


@frozen(kw_only=True)
class MemberStep:
    """A member of a struct."""

    op: Literal["member"]
    type: str
    """Type of the result."""
    args: tuple[Count]
    """The struct."""
    member: str
    """Name of the member."""


@frozen(kw_only=True)
class IndexStep:
    """An element of an array, a column of a matrix or a lane of a vector."""

    op: Literal["index"]
    type: str
    """Type of the result."""
    args: tuple[Count, Count]
    """The array, and the number of the element."""


@frozen(kw_only=True)
class SelectStep:
    """One of two values."""

    op: Literal["select"]
    type: str
    """Type of the result."""
    args: tuple[Count, Count, Count]
    """A bool, the value if it is true, and the value if it is false."""


@frozen(kw_only=True)
class FoldStep:
    """Terms that are combined one after the other."""

    op: Literal["fold"]
    type: str
    """Type of the result."""
    args: tuple[Count, Count, Count]
    """Number of terms, the value to begin with, and the body that is a term."""
    operator: Literal["add", "mul", "min", "max", "and", "or"]
    """Operator that combines the terms."""
    bound: Count
    """The largest number of terms."""


StepRow = (
    ParameterStep
    | ConstantStep
    | TextureStep
    | BoundStep
    | CallStep
    | ComposedStep
    | SplatStep
    | SwizzleStep
    | MemberStep
    | IndexStep
    | SelectStep
    | FoldStep
)
"""One operation; ``op`` says which."""

STEPS: Mapping[str, Callable[..., StepRow]] = {
    "parameter": ParameterStep,
    "constant": ConstantStep,
    "texture": TextureStep,
    "bound": BoundStep,
    "call": CallStep,
    "native": CallStep,
    "vector": ComposedStep,
    "matrix": ComposedStep,
    "array": ComposedStep,
    "apply": ComposedStep,
    "splat": SplatStep,
    "swizzle": SwizzleStep,
    "member": MemberStep,
    "index": IndexStep,
    "select": SelectStep,
    "fold": FoldStep,
}
"""The record of each operation."""
