"""Arithmetic with bounds: the possible values of a device, beside those that a program means.

The reference's pictures evaluate graphs with it, as with numbers: a lane is a ``Bounded``, and the
array library is a ``Bounds``. It needs NumPy, so nothing that compiles imports it.
"""

from .bounded import Bounded, as_bounded, exact, joined
from .functions import Bounds, Errors
from .lanes import all_remembered, between, given, hull, remembered

__all__ = [
    "Bounded",
    "Bounds",
    "Errors",
    "all_remembered",
    "as_bounded",
    "between",
    "exact",
    "given",
    "hull",
    "joined",
    "remembered",
]
