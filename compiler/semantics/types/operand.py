"""The properties of an operand for overload resolution.

An operand is part of keys more often than anything else, and so a named tuple, whose hash is fast.
"""

# Annotations are evaluated in this module: a named tuple compiles those that are texts, and to load
# Python's compiler for them would take a hundredth of a short compile.

from typing import NamedTuple

from ...ir.types import Type


class Operand(NamedTuple):
    """The type of an operand, and whether it is a constant."""

    type: Type
    constant: bool = False
    """Constants of kind int adapt to the kind that is wanted."""
