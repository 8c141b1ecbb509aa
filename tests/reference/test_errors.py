"""The errors of functions, as numbers: those measured of a driver, and those promised."""

from __future__ import annotations

import numpy as np

from burnish.compiler.reference.bounds.errors import Errors
from burnish.stdlib.builtins.accuracy import Bound, Error, Within

ROUGH = 1e-4
SMALL = 1e-7


def error(name: str, measured: dict[str, Bound]) -> float:
    errors = Errors(("vulkan",), tuple(measured.items()))
    return float(errors(name, np.array(0.3), np.array(1.3)))


def test_a_function_may_be_less_accurate_than_the_one_that_defines_it() -> None:
    accurate: dict[str, Bound] = {"atan2": Within(Error(absolute=SMALL))}
    assert error("acos", accurate) < 10 * SMALL
    assert error("acos", accurate | {"acos": Within(Error(absolute=ROUGH))}) == ROUGH


def test_what_was_measured_allows_no_more_than_what_is_promised() -> None:
    huge: dict[str, Bound] = {"acos": Within(Error(absolute=1.0))}
    assert error("acos", huge) == error("acos", {}) < 1e-2
