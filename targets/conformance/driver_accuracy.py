"""The measured accuracy of a driver's functions: its envelope.

Specifications promise much less than most drivers keep, so a driver could become a thousand times
less accurate and still conform. ``measured.py`` has the largest errors that were found on each
driver, and a picture is first compared with bounds of ``MARGIN`` times as much.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...stdlib.builtins.accuracy import Bound, Error, Rounded, Within
from ...support.frozen import changed

MARGIN = 4.0
"""The factor of measured errors that is allowed: samples need not have found the largest one."""
ROUGH = 2.0**-16
"""The absolute error above which a driver approximates the function by a curve."""
MARGIN_OF_ROUGH = 1.25
"""The factor for such an error: it is smooth, so many samples come close to the largest one."""


@dataclass(frozen=True, slots=True)
class Envelope:
    """The largest errors that were found on one version of a driver."""

    device: str
    """The device with its version, as its API names them."""
    errors: Mapping[str, Error]
    """The largest errors, by builtin."""

    def allowed(self) -> dict[str, Bound]:
        """The bounds with which a picture is compared, by builtin."""
        return {name: _allowed(error) for name, error in self.errors.items()}


def _allowed(error: Error) -> Bound:
    """The bound for an error that was measured.

    An error of at most half a step is correct rounding, which no factor makes larger.
    """
    if error == Error(ulp=0.5):
        return Rounded()
    allowed = times(error, MARGIN)
    if error.absolute > ROUGH:
        allowed = changed(allowed, absolute=error.absolute * MARGIN_OF_ROUGH)
    return Within(allowed)


def times(error: Error, factor: float) -> Error:
    """A larger error of the same form."""
    return changed(
        error,
        ulp=error.ulp * factor,
        ulp_by_operand=error.ulp_by_operand * factor,
        relative=error.relative * factor,
        absolute=error.absolute * factor,
        absolute_by_operand=error.absolute_by_operand * factor,
    )
