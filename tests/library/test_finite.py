"""Functions of colours, curves and ramps give numbers for all numbers that their files name."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.library import FOLDER
from burnish.compiler.syntax import ast
from burnish.compiler.syntax.parser import parse

from .functions import values
from .kit import Floats

MODULES = ("blending", "color", "easing", "tone_mapping")
AWKWARD = (0.0, 1.0, 0.5, -1.0, 2.0, 1e-20, -1e-9, 1e9, -1e9, 0.25, 65504.0)
LIMITS = {"stops": 64.0, "exponent": 4.0, "slope": 16.0, "power": 3.0, "colorfulness": 16.0}
"""The arguments of powers; their comments limit them."""
LANES = {"float": 1, "angle": 1, "T": 1, "rgb": 3, "vec3": 3, "rgba": 4, "vec4": 4}
LARGEST = 3.4e38


def functions() -> Iterator[tuple[str, ast.Function]]:
    for module in MODULES:
        path = FOLDER / f"{module}.burnish"
        for each in parse(Source(path.name, path.read_text("utf-8")), Report()).declarations:
            if isinstance(each, ast.Function) and all(a.type.count is None for a in each.arguments):
                yield module, each


FUNCTIONS = list(functions())


def awkward(argument: ast.Argument, rows: int, start: int) -> Floats:
    """Values of an argument, in another order for each, so that many pairs occur."""
    lanes = LANES[argument.type.name.text]
    chance = np.random.default_rng(start)
    found = chance.choice(AWKWARD, (rows, lanes))
    if argument.name.text in LIMITS:
        limit = LIMITS[argument.name.text]
        found = np.clip(found, -limit if argument.name.text == "stops" else 0, limit)
    return found if lanes > 1 else found[:, 0]


@pytest.mark.parametrize(
    ("module", "function"), FUNCTIONS, ids=[f"{m}.{f.name.text}" for m, f in FUNCTIONS]
)
def test_a_function_gives_numbers(module: str, function: ast.Function) -> None:
    """Lanes of the result are below the largest float of 32 bits, too."""
    given = {
        f"a{place}": awkward(argument, 60, place)
        for place, argument in enumerate(function.arguments)
    }
    written = [
        f"{name} * 1rad" if argument.type.name.text == "angle" else name
        for name, argument in zip(given, function.arguments, strict=True)
    ]
    call = f"{function.name.text}({', '.join(written)})"
    rgba = function.result is not None and function.result.name.text == "rgba"
    found = values(module, f"{call}.rgb" if rgba else call, **given)
    assert np.isfinite(found).all()
    assert (np.abs(found) < LARGEST).all()
