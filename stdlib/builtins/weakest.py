"""The largest error that any platform allows: by how much range rules widen a result's range.

A program is analysed once for all its targets, and runs on devices that nobody has seen. So a guard
may be left out only if no platform needs it, and of all promises in ``accuracy.py`` the weakest
counts. ``intervals.py`` and the range rules of builtins ask for it.

A promise that is inherited has no number of its own. A rule for such a function adds up the errors
of the operations that the function is made of.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from .accuracy import CORRECT, PLATFORMS, Accuracy, Bound, Error, Inherited, Rounded, Within
from .facts import ULP


def relative(*steps: Accuracy, operand: float = 0.0) -> float:
    """The largest error of operations in turn, as a part of the result; absolute errors aside.

    ``operand`` is the magnitude of the operand on which the errors may depend.
    """
    whole = 1.0
    for step in steps:
        whole *= 1.0 + max(_relative(error, operand) for error in _errors(step, operand))
    return whole - 1.0


def absolute(accuracy: Accuracy) -> float:
    """The largest absolute error that is allowed whatever the operand and the result are."""
    least = [bound.at_least for bound in _bounds(accuracy) if isinstance(bound, Inherited)]
    return max((*least, *(error.absolute for error in _errors(accuracy, 0.0))))


def limit(accuracy: Accuracy) -> float:
    """Up to which magnitude of the operand the usual error is the only one."""
    return min(bound.limit for bound in _bounds(accuracy) if isinstance(bound, Within))


def _bounds(accuracy: Accuracy) -> Iterator[Bound]:
    return (accuracy.on(platform).bound for platform in PLATFORMS)


def _errors(accuracy: Accuracy, operand: float) -> Iterator[Error]:
    """The errors of all platforms that name one, for operands up to a magnitude."""
    for bound in _bounds(accuracy):
        if isinstance(bound, Rounded):
            yield Error(ulp=1.0)
        elif isinstance(bound, Within):
            yield bound.error
            if bound.limit < (math.inf if bound.of == "result" else operand):
                yield bound.beyond


def _relative(error: Error, operand: float) -> float:
    by_operand = error.ulp_by_operand * operand if error.ulp_by_operand else 0.0
    return (error.ulp + by_operand) * ULP + error.relative


ROUNDING = relative(CORRECT)
"""The largest error of a correctly rounded result: it may be either neighbour."""
