"""The bounds of ``mix``, whose two weights depend on one number.

Interval arithmetic forgets that ``1 - a`` is small where ``a`` is large. Where a decision that may
tip chooses by ``mix(x, y, step(…))``, it would say that the result lies between 0 and ``x + y``.
"""

from __future__ import annotations

import numpy as np

from .bounded import Bounded
from .lanes import either, limited
from .orders import Single, Sum, of_either
from .rounding import Array

_OPEN = 2.0**-12
"""A weight whose ends are farther apart than this makes the bounds of both formulas too wide."""


def blend(x: Bounded, y: Bounded, a: Bounded) -> Bounded:
    """A blend, computed as ``x * (1 - a) + y * a`` or as ``x + (y - x) * a``.

    WGSL and Vulkan name the first formula, Direct3D's ``lerp`` the second, and drivers of both
    use either.
    """
    rest, change = 1.0 - a, y - x
    part, other, moved = x * rest, y * a, change * a
    mean, shifted = part + other, x + moved
    found = either(mean, shifted)
    found._sum = _terms(mean, x, moved)
    if a.is_exact or not (a.high - a.low > _OPEN).any():
        return found
    error = np.maximum(
        x.magnitude * rest.rounding + part.rounding + other.rounding + mean.rounding,
        a.magnitude * change.rounding + moved.rounding + shifted.rounding,
    )
    # The weight is one number, but where it is a product or a sum, each use may combine its parts
    # with others in an order of its own: ``y * a`` may be ``(y * b) * c``.
    error = error + (x.magnitude + y.magnitude) * a.rounding
    low, high = _ends(x, y, a)
    return limited(
        found,
        np.where(np.isfinite(low + error), low - error, found.low),
        np.where(np.isfinite(high + error), high + error, found.high),
    )


def _terms(mean: Bounded, x: Bounded, moved: Bounded) -> Sum | None:
    """The terms that a compiler may combine with others: those of the formula with larger ones.

    Those of ``x`` itself are not among them: a loop that blends in each iteration would otherwise
    add up the magnitudes of all. Compilers that combine the terms of several blends, written by the
    second formula, are not allowed for.
    """
    if mean._sum is None:
        return None
    singles = (Single(lane.low, lane.high, lane.magnitude) for lane in (x, moved))
    return of_either(mean._sum, Sum(1, tuple(singles), is_exact=mean._sum.is_exact))


def _ends(x: Bounded, y: Bounded, a: Bounded) -> tuple[Array, Array]:
    """Between which numbers the unrounded blend lies.

    It is linear in each of the three operands, so its extremes are at their ends; and those of a
    sum are the sums of the extremes of its parts, which do not depend on each other.
    """
    with np.errstate(invalid="ignore"):
        least, most = zip(*(_at_weight(x, y, weight) for weight in (a.low, a.high)), strict=True)
    return np.minimum(*least), np.maximum(*most)


def _at_weight(x: Bounded, y: Bounded, weight: Array) -> tuple[Array, Array]:
    """The ends of the blend for a certain weight."""
    rest = 1.0 - weight
    ones, others = (x.low * rest, x.high * rest), (y.low * weight, y.high * weight)
    return np.minimum(*ones) + np.minimum(*others), np.maximum(*ones) + np.maximum(*others)
