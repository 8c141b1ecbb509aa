"""The host's functions of builtins against the reference's: all overloads of all builtins."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from burnish.compiler.reference.functions import evaluate
from burnish.stdlib.builtins.overloads import COMPUTING, Shape, overloads

from ..builtins.samples import SPECIAL, SPECIAL_INTEGERS
from .kit import in_node

SAMPLES = 60
CLOSE = 1e-11
"""The relative difference of two libraries in double precision."""


def lanes(shape: Shape, chance: np.random.Generator) -> list[Any]:
    if shape.columns:
        return [lanes(Shape(shape.kind, shape.width), chance) for _ in range(shape.columns)]
    match shape.kind:
        case "float":
            some = np.where(
                chance.random(shape.width) < 0.3,
                chance.choice(SPECIAL, shape.width),
                chance.normal(0, 3, shape.width),
            )
            return [float(np.float32(lane)) for lane in some]
        case "bool":
            return [bool(lane) for lane in chance.integers(0, 2, shape.width)]
    some = np.where(
        chance.random(shape.width) < 0.5,
        chance.choice(SPECIAL_INTEGERS, shape.width),
        chance.integers(-(2**31), 2**31, shape.width),
    )
    return [int(lane) & 0xFFFFFFFF if shape.kind == "uint" else int(lane) for lane in some]


def tuples(value: Any) -> Any:
    return tuple(map(tuples, value)) if isinstance(value, list) else value


def alike(found: Any, wanted: Any) -> bool:
    if isinstance(wanted, tuple):
        return len(found) == len(wanted) and all(map(alike, found, wanted))
    one, other = float(found), float(wanted)
    if not math.isfinite(one) or not math.isfinite(other):
        return str(one) == str(other)
    return math.isclose(one, other, rel_tol=CLOSE, abs_tol=1e-300)


def test_all_functions_mean_what_they_mean_elsewhere() -> None:
    chance = np.random.default_rng(5)
    cases = [
        (overload, [lanes(shape, chance) for shape in overload.operands])
        for row in COMPUTING
        for overload in overloads(row)
        for _ in range(SAMPLES)
    ]
    given = [[each.row.name, operands, each.operands[0].kind] for each, operands in cases]
    body = "([name, operands, kind]) => call(name, operands.map(numbers), kind)"
    numbers = "const numbers = (v) => Array.isArray(v) ? v.map(numbers) : Number(v);"
    body = f"(() => {{ {numbers} return {body}; }})()"
    wrong = []
    for (overload, operands), found in zip(
        cases, in_node("steps.js", "evaluate", body, given), strict=True
    ):
        kind: Any = overload.operands[0].kind
        wanted = evaluate(overload.row.name, tuples(operands), kind=kind)
        if not alike(found, wanted):
            wrong.append(f"{overload}: {operands} is {found}, and means {wanted}")
    assert not wrong, f"{len(wrong)} of {len(cases)}\n" + "\n".join(wrong[:40])
