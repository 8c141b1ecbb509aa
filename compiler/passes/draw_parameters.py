"""Names of the parameters that a host sets for each of several draws of one thing.

``lower_expansion`` and ``lower_views`` call this: they make several draws of what could be one.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import count

from ..ir.shader import ParameterInfo


def unused_name(wanted: str, parameters: Iterable[ParameterInfo]) -> str:
    """The wanted name, which ends in ``_`` if a light has a parameter of this name."""
    taken = {info.leaf.name for info in parameters}
    return next(n for n in (wanted + "_" * number for number in count()) if n not in taken)
