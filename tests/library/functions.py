"""Functions of the library, called for many values at once."""

from __future__ import annotations

from typing import Any

import numpy as np

from burnish.compiler.ir.stages import TARGET

from ..semantics.kit import Given, at, shader
from .kit import Floats


def values(module: str, call: str, /, **arguments: Any) -> Floats:
    """Three lanes of a call in a material, for each row of its arguments.

    An argument is an array of numbers, or of vectors; each is a parameter, so that the compiler
    knows nothing of its value. A number that is called for has three equal lanes.
    """
    rows = {name: np.asarray(value, np.float64) for name, value in arguments.items()}
    types = {name: "float" if row.ndim == 1 else f"vec{row.shape[1]}" for name, row in rows.items()}
    members = "\n".join(f"param {name} : {kind}" for name, kind in types.items())
    whole = shader(f"import std.{module}\nmaterial M {{\n{members}\ncolor = vec3({call})\n}}")
    root = whole.results_of(TARGET)[0].value
    given: list[Given] = [
        {
            name: tuple(float(lane) for lane in np.atleast_1d(value))
            for name, value in zip(rows, each, strict=True)
        }
        for each in zip(*rows.values(), strict=True)
    ]
    return np.array([at(whole, root, each)[:3] for each in given])


def spread(count: int, low: float = 0.0, high: float = 1.0, lanes: int = 3) -> Floats:
    """Vectors without a pattern in a range, the same in each run."""
    chance = np.random.default_rng(count + lanes)
    return np.asarray(chance.uniform(low, high, (count, lanes)))
