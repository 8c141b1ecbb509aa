"""Reads one of several numbers at many positions at once.

``operations.py`` asks this first where an array of numbers is indexed, such as the places of all
instances. To choose each number by itself takes as many operations on whole arrays as there are.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .bounds.bounded import Bounded, as_bounded, exact
from .namespace import Lane


def in_table(numbers: Sequence[Lane], position: Lane) -> Lane | None:
    """The number at each position, the first one where there is none.

    It is ``None`` unless all positions and numbers are known exactly, and the numbers are the same
    for all positions: then each has to be chosen by itself.
    """
    if type(position) is Bounded and position.is_exact and np.ndim(position.value):
        found = [
            each.value
            for each in map(as_bounded, numbers)
            if each.low is each.high and each.value.ndim == 0
        ]
        if len(found) == len(numbers):
            return exact(_read(found, position.value))
    if type(position) is np.ndarray and all(map(np.isscalar, numbers)):
        return _read(numbers, position)
    return None


def _read(numbers: Sequence[Any], position: Any) -> Any:
    inside = (position >= 0) & (position < len(numbers))
    return np.array(numbers)[np.where(inside, position, 0)]
