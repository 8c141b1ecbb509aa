"""Formulas that are built alike and differ by little are proven to do so in few boxes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from burnish.compiler.equivalence.pairs import _RULES, Ends

from .kit import compared

NAMES = "abcdefgh"
EIGHT = "\n".join(f"param {name} : float in 0..1 = 0.5" for name in NAMES)

BY_LITTLE = {
    "a root, an exponential and a power": (
        "sqrt(0.1 + a * b) * exp(-c * d) + pow(0.2 + e, 1 + f)",
        "sqrt(0.10001 + a * b) * exp(-c * d) + pow(0.20001 + e, 1 + f)",
    ),
    "a mix, divided": (
        "mix(a * b, c * d, e) / (1 + f + g * a)",
        "mix(a * b, c * d, e) / (1.00002 + f + g * a)",
    ),
    "a choice": (
        "if a < b then log2(1 + c * d) else sin(e + f * g) / sqrt(0.5 + h)",
        "if a < b then log2(1.00001 + c * d) else sin(e + f * g) / sqrt(0.50001 + h)",
    ),
    "a distribution and a mask": (
        "a * b / ((c * c + 0.2) * (c * c + 0.2)) * max(d * e - f, 0) * abs(g - h)",
        "b * a / ((c * c + 0.2000001) * (c * c + 0.2)) * max(d * e - f, 0) * abs(g - h)",
    ),
}


@pytest.mark.parametrize("pair", BY_LITTLE.values(), ids=BY_LITTLE)
def test_a_small_change_with_many_variables_is_the_same(pair: tuple[str, str]) -> None:
    found = compared(*pair, parameters=EIGHT, boxes=20)
    assert (found.verdict, found.means) == ("same", "bounds")
    assert 0 < found.bound <= 1e-4


@pytest.mark.parametrize("pair", BY_LITTLE.values(), ids=BY_LITTLE)
def test_what_is_proven_is_no_less_than_what_is_seen(pair: tuple[str, str]) -> None:
    found = compared(*pair, parameters=EIGHT, boxes=20, epsilon=1e-3)
    assert found.verdict == "same"
    assert compared(*pair, parameters=EIGHT, boxes=20, epsilon=1e-9).verdict == "different"


def test_a_large_change_differs() -> None:
    first, second = "sqrt(0.1 + a * b) * exp(-c * d)", "sqrt(0.11 + a * b) * exp(-c * d)"
    assert compared(first, second, parameters=EIGHT).verdict == "different"


FUNCTIONS: dict[str, Callable[..., object]] = {
    "add": np.add, "mul": np.multiply, "reciprocal": np.reciprocal, "abs": np.abs,
    "min": np.minimum, "max": np.maximum, "sqrt": np.sqrt, "power": np.power,
    "inverse_root": lambda x: x**-0.5,
    "exp2": np.exp2, "log2": np.log2, "sin": np.sin, "cos": np.cos, "tanh": np.tanh,
    "arctan": np.arctan,
}  # fmt: skip
POSITIVE = ("sqrt", "inverse_root", "log2")
COUNT = 2000


def test_every_rule_has_a_function() -> None:
    assert _RULES.keys() - {"where"} == FUNCTIONS.keys()


@pytest.mark.parametrize("name", FUNCTIONS)
def test_differences_lie_between_their_bounds(name: str) -> None:
    """NumPy's differences at random numbers lie in the bounds from these numbers' intervals."""
    chance = np.random.default_rng(len(name))
    function = FUNCTIONS[name]
    both = name in ("add", "mul", "min", "max", "power")
    pairs = []
    for number in range(2 if both else 1):
        one = chance.normal(size=COUNT) * 3
        if name in POSITIVE or (name == "power" and not number):
            one = np.abs(one) + 1e-3
        other = one * (1 + chance.normal(size=COUNT) * chance.choice([1e-6, 0.1], COUNT))
        other = np.abs(other) + 1e-6 if name in POSITIVE or name == "power" else other
        pairs.append((one, other))
    widths = np.abs(chance.normal(size=(2, COUNT))) * 0.01
    places = []
    for number, (one, other) in enumerate(pairs):
        low = [np.maximum(x - widths[0], 1e-9) if name in POSITIVE else x - widths[0]
               for x in (one, other)]  # fmt: skip
        if name == "power" and not number:
            low = [np.maximum(x, 1e-9) for x in low]
        difference = one - other
        slack = np.abs(difference) * 0.3
        places.append((
            Ends(low[0], one + widths[1]), Ends(low[1], other + widths[1]),
            Ends(difference - slack, difference + slack),
        ))  # fmt: skip
    with np.errstate(all="ignore"):
        found = np.asarray(function(*(one for one, _ in pairs))) - np.asarray(
            function(*(other for _, other in pairs))
        )
        low, high = _RULES[name](*places)
        known = ~(np.isnan(low) | np.isnan(high))
        slack = 1e-11 * (1 + np.abs(low) + np.abs(high))
    assert known.mean() > 0.5
    assert (found >= low - slack)[known].all()
    assert (found <= high + slack)[known].all()
