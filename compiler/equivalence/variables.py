"""Variables: what comes from outside of both programs, and the domain over which it is compared.

Parameters of one name are one variable in both programs, and so are vertex inputs and what the
pipeline supplies. ``leaves.py`` makes variables of the graph's leaves.
"""

from __future__ import annotations

from ...support.frozen import frozen


@frozen(key=True)
class Variable:
    """One lane of a parameter, a vertex input or an input of the pipeline."""

    name: str
    """The host's name, with the lane: ``base.x``, ``lamps[2].place.z``."""
    kind: str
    """``f`` for floats, ``i`` for whole numbers, ``b`` for conditions."""
    low: float
    high: float
    is_varying: bool = False
    """True if it may differ between the pixels of a triangle."""
    vector: str = ""
    """The name of the vector of length one that it is a lane of."""
    near: str = ""
    """The name of the variable whose value at a neighbouring pixel it is."""
    default: float | None = None
    """The declared default, which is one of the points that are tried first."""

    def __str__(self) -> str:
        return self.name
