"""Functions that code of derived values calls where Python's own would raise."""

from __future__ import annotations

from collections.abc import Mapping

FUNCTIONS: Mapping[str, str] = {
    "_total": '''\
def _total(function: Callable[[float], float], x: float) -> float:
    """A function of `math`: infinity where it is too large, and no number of infinity."""
    try:
        return function(x)
    except OverflowError:
        return math.inf
    except ValueError:
        return math.nan
''',
    "_power": '''\
def _power(x: float, y: float) -> float:
    """A power of a positive number, which may be infinite."""
    try:
        return math.pow(x, y)
    except OverflowError:
        return math.inf
''',
    "_sinh": '''\
def _sinh(x: float) -> float:
    """The hyperbolic sine, which may be infinite."""
    try:
        return math.sinh(x)
    except OverflowError:
        return math.copysign(math.inf, x)
''',
    "_ldexp": '''\
def _ldexp(x: float, n: int) -> float:
    """`x` times two to the power of `n`, which may be infinite."""
    try:
        return math.ldexp(x, n)
    except OverflowError:
        return math.copysign(math.inf, x)
''',
    "_rounded": '''\
def _rounded(function: Callable[[float], int], x: float) -> float:
    """A whole number as a float; infinity stays as it is."""
    return float(function(x)) if math.isfinite(x) else x
''',
    "_whole": '''\
def _whole(x: float) -> int:
    """The number without its fraction; 0 of infinity."""
    return int(x) if math.isfinite(x) else 0
''',
    "_wrapped": '''\
def _wrapped(x: int) -> int:
    """The lowest 32 bits, as a number with a sign."""
    return ((x + 0x80000000) & 0xFFFFFFFF) - 0x80000000
''',
}
