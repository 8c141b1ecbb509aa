"""Finds out which well-known function of a parameter a derived value is.

``roles.py`` asks it for every derived value. The functions are written as the left sides of
simplification rules are: a value that looks like one is this function of some parameter. The
library says of which parameters such a function has a meaning in a scene (``scene.toml``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ...support.frozen import cached_property, frozen
from ..ir.leaves import Parameter
from ..ir.node import Node
from ..passes.rules.matching import Pattern
from ..passes.rules.terms import Operation, Variable, function
from ..passes.rules.vocabulary import abs_, c, select, x, y, z

cross, determinant, ge, matrix = map(function, ("cross", "determinant", "ge", ".matrix"))
volume = Variable("volume")


@frozen(eq=False)
class WellKnown:
    """A function of a matrix that engines have in their own libraries."""

    name: str
    looks: Operation
    """The computation of its value."""
    argument: Callable[[Mapping[str, Any]], Node | None]
    """Gives its argument by the values of the names in the computation.

    There is none where these are not parts of one argument, as the function's are.
    """

    @cached_property
    def pattern(self) -> Pattern:
        """The computation as something that is looked for."""
        return Pattern(self.looks)


def _matrix_of_columns(names: Mapping[str, Any]) -> Node | None:
    """The matrix whose columns are x, y and z; of one with four rows, their first three lanes."""
    columns = [_column(names[name]) for name in ("x", "y", "z")]
    matrices = {matrix for matrix, _ in columns}
    if len(matrices) > 1 or [number for _, number in columns] != [0, 1, 2]:
        return None
    return matrices.pop()


def _column(value: Node) -> tuple[Node, object]:
    """The matrix of which a value is a column, and the column's number; or the value itself."""
    first_three = value.op == "swizzle" and value.data == (0, 1, 2)
    column = value.operands[0] if first_three else value
    if column.op != "index":
        return value, None
    of, number = column.operands
    return of, number.data


ROWS = (
    WellKnown(
        "inverse_transpose",
        # The rows of an inverse are cross products of columns; a matrix without one becomes zeros.
        matrix(cross(y, z), cross(z, x), cross(x, y))
        * select(ge(abs_(volume @ determinant(matrix(x, y, z))), c), 1 / volume, 0),
        _matrix_of_columns,
    ),
)
"""The well-known functions."""


def well_known(value: Node) -> tuple[str, Parameter] | None:
    """The name of the function of a parameter that a value is, and that; ``None`` for others."""
    for row in ROWS:
        names = row.pattern.found_in(value)
        argument = None if names is None else row.argument(names)
        if argument is not None and isinstance(argument.data, Parameter):
            return row.name, argument.data
    return None
