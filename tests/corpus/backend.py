"""A backend of somebody else: shader arithmetic with NumPy's float32, which knows no Burnish.

``compute`` has the form that docs/corpus.md asks for. Integers are Python's, wrapped to 32 bits.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

F = np.float32
SMALL = F(2.0**-126)
Function = Callable[..., Any]


def _wrapped(value: int, kind: str) -> int:
    low = value & 0xFFFFFFFF
    return low - 2**32 if kind == "int" and low >= 2**31 else low


def _pow(x: Any, y: Any) -> Any:
    if x < SMALL:
        return F(1) if abs(y) < SMALL else F(0)
    return F(np.power(x, y))


def _smoothstep(low: Any, high: Any, x: Any) -> Any:
    width = high - low if abs(high - low) >= F(2.0**-64) else F(2.0**-64)
    t = np.clip((x - low) / width, F(0), F(1))
    return t * t * (F(3) - F(2) * t)


FLOATS: dict[str, Function] = {
    "add": lambda x, y: x + y,
    "sub": lambda x, y: x - y,
    "mul": lambda x, y: x * y,
    "div": lambda x, y: F(0) if abs(y) < SMALL else x / y,
    "mod": lambda x, y: F(0) if abs(y) < SMALL else x - y * np.floor(x / y),
    "neg": lambda x: -x,
    "abs": np.abs,
    "sign": np.sign,
    "floor": np.floor,
    "ceil": np.ceil,
    "round": np.rint,
    "trunc": np.trunc,
    "fract": lambda x: x - np.floor(x),
    "min": np.minimum,
    "max": np.maximum,
    "clamp": lambda x, low, high: np.minimum(np.maximum(x, low), high),
    "saturate": lambda x: np.clip(x, F(0), F(1)),
    "mix": lambda x, y, a: x * (F(1) - a) + y * a,
    "fma": lambda x, y, z: x * y + z,
    "step": lambda edge, x: F(x >= edge),
    "smoothstep": _smoothstep,
    "sqrt": lambda x: np.sqrt(np.maximum(x, F(0))),
    "inversesqrt": lambda x: F(1) / np.sqrt(np.maximum(x, SMALL)),
    "pow": _pow,
    "exp": np.exp,
    "exp2": np.exp2,
    "log": lambda x: np.log(np.maximum(x, SMALL)),
    "log2": lambda x: np.log2(np.maximum(x, SMALL)),
    "log10": lambda x: np.log10(np.maximum(x, SMALL)),
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": lambda x: np.arcsin(np.clip(x, F(-1), F(1))),
    "acos": lambda x: np.arccos(np.clip(x, F(-1), F(1))),
    "atan": np.arctan,
    "atan2": lambda y, x: np.arctan2(F(0) if abs(y) < SMALL else y, x + F(0)),
    "radians": np.radians,
    "degrees": lambda x: x * F(180 / math.pi),  # NumPy's own has the second-nearest constant
    "tanh": np.tanh,
    "to_int": lambda x: math.trunc(min(max(float(x), -(2.0**31)), 2.0**31 - 128)),
    "to_uint": lambda x: math.trunc(min(max(float(x), 0.0), 2.0**32 - 256)),
}
INTEGERS: dict[str, Function] = {
    "add": lambda x, y: x + y,
    "sub": lambda x, y: x - y,
    "mul": lambda x, y: x * y,
    "div": lambda x, y: x if y == 0 else abs(x) // abs(y) * (1 if (x < 0) == (y < 0) else -1),
    "mod": lambda x, y: 0 if y == 0 else x % y,
    "neg": lambda x: -x,
    "abs": abs,
    "min": min,
    "max": max,
    "bit_and": lambda x, y: x & y,
    "bit_or": lambda x, y: x | y,
    "bit_xor": lambda x, y: x ^ y,
    "bit_not": lambda x: ~x,
    "shift_left": lambda x, by: x << (by & 31),
    "shift_right": lambda x, by: x >> (by & 31),
    "count_bits": lambda x: (x & 0xFFFFFFFF).bit_count(),
}
ANY: dict[str, Function] = {
    "eq": lambda x, y: x == y,
    "ne": lambda x, y: x != y,
    "lt": lambda x, y: x < y,
    "le": lambda x, y: x <= y,
    "gt": lambda x, y: x > y,
    "ge": lambda x, y: x >= y,
    "and": lambda x, y: x and y,
    "or": lambda x, y: x or y,
    "not": lambda x: not x,
    "choose": lambda c, x, y: x if c else y,
    "to_float": F,
}


def _dot(x: Sequence[Any], y: Sequence[Any]) -> Any:
    total = x[0] * y[0]
    for a, b in zip(x[1:], y[1:], strict=True):
        total = total + a * b
    return total


def _length(v: Sequence[Any]) -> Any:
    return np.sqrt(_dot(v, v))


def _normalize(v: Sequence[Any]) -> list[Any]:
    factor = F(1) / np.sqrt(np.maximum(_dot(v, v), SMALL))
    return [lane * factor for lane in v]


VECTORS: dict[str, Function] = {
    "any": lambda v: [any(v)],
    "all": lambda v: [all(v)],
    "dot": lambda x, y: [_dot(x, y)],
    "length": lambda v: [_length(v)],
    "distance": lambda x, y: [_length([a - b for a, b in zip(x, y, strict=True)])],
    "normalize": _normalize,
    "cross": lambda x, y: [
        x[i] * y[j] - x[j] * y[i] for i, j in ((1, 2), (2, 0), (0, 1))
    ],
    "reflect": lambda i, n: [a - F(2) * _dot(n, i) * b for a, b in zip(i, n, strict=True)],
}  # fmt: skip


def compute(
    name: str, types: Sequence[dict[str, Any]], operands: Sequence[Sequence[float]]
) -> list[float] | None:
    """The lanes of the result; ``None`` for what there is not."""
    if any(type_["columns"] for type_ in types):
        return None
    kind = types[0]["kind"]
    values: list[list[Any]] = [
        [F(lane) if type_["kind"] == "float" else lane for lane in lanes]
        for type_, lanes in zip(types, operands, strict=True)
    ]
    with np.errstate(all="ignore"):
        if name in VECTORS:
            found = VECTORS[name](*values)
        else:
            function = ANY.get(name) or (FLOATS if kind == "float" else INTEGERS).get(name)
            if function is None:
                return None
            width = max(map(len, values))
            spread = [lanes * width if len(lanes) == 1 else lanes for lanes in values]
            found = [function(*lanes) for lanes in zip(*spread, strict=True)]
    if kind in ("int", "uint") and (name in INTEGERS or name == "dot"):
        of = "int" if name == "count_bits" else kind
        return [_wrapped(lane, of) for lane in found]
    return [float(lane) for lane in found]
