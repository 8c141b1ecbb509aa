"""Functions of the library at many places at once, as arrays of NumPy."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.evaluate import evaluate

from ..semantics.kit import leaves, shader
from .kit import Floats

Values = NDArray[Any]


def sampled(imports: str, expression: str, /, **given: Values) -> Floats:
    """The value of an expression at many places, with a last axis for its lanes.

    The expression gives the lanes of a ``vec4``. It reads ``p`` and ``q``, each a ``vec4``, and
    ``k``, an ``ivec4``, as far as they are given: arrays whose last axis has the lanes. Lanes that
    an array does not have are 0.
    """
    whole = shader(
        f"{imports}\nmaterial M {{}}\npass P {{\n"
        "param p : vec4 = vec4(0)  param q : vec4 = vec4(0)  param k : ivec4 = ivec4(0)\n"
        f"target t : rgba32f = vec4({expression}) }}",
        pass_="P",
    )
    (target,) = whole.results_of(TARGET)
    known = {name: _lanes(array) for name, array in given.items()}
    found = evaluate(target.value, leaves(whole, known), np)
    shape = next(iter(given.values())).shape[:-1]
    return np.stack([np.broadcast_to(np.asarray(lane, float), shape) for lane in found], axis=-1)


def _lanes(array: Values) -> tuple[Any, ...]:
    """The four lanes of an array whose last axis has some of them."""
    missing = 4 - array.shape[-1]
    return (*np.moveaxis(array, -1, 0), *[np.zeros_like(array[..., 0])] * missing)
