"""Compares a number of a fragment with the one in the attachment: its depth, or a reference."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ...ir.render_state import Compare
from .scene import Bools

_COMPARISONS: Mapping[str, Callable[[Any, Any], Any]] = {
    "less": np.less,
    "equal": np.equal,
    "less_equal": np.less_equal,
    "greater": np.greater,
    "not_equal": np.not_equal,
    "greater_equal": np.greater_equal,
}


def compared(compare: Compare, new: Any, there: Any) -> Bools:
    """True for fragments for which the comparison holds; their own numbers stand on the left."""
    if compare in ("never", "always"):
        return np.full(there.shape, compare == "always")
    holds: Bools = _COMPARISONS[compare](new, there)
    return holds
