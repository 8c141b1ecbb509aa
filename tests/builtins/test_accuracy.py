"""The accuracy of the rows: against the specifications' tables, and evaluated as numbers."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from burnish.compiler.reference.bounds.errors import Errors, Floats, ulp
from burnish.stdlib.builtins import BUILTINS, texture
from burnish.stdlib.builtins.accuracy import (
    PLATFORMS,
    Exact,
    Inherited,
    Platform,
    Rounded,
    Within,
)
from burnish.stdlib.builtins.row import nowhere
from burnish.targets.runner.routes import ROUTES

from .specifications import TABLES

platforms = pytest.mark.parametrize("platform", PLATFORMS)
FUNCTIONS: dict[str, Callable[[Any], Any]] = {
    "exp": np.exp, "exp2": np.exp2, "log": np.log, "log2": np.log2, "sin": np.sin, "cos": np.cos,
    "sqrt": np.sqrt, "inversesqrt": lambda x: 1 / np.sqrt(x), "atan": np.arctan,
}  # fmt: skip


def within(name: str, platform: Platform) -> Within:
    """The numbers of a row."""
    bound = BUILTINS[name].accuracy.on(platform).bound
    assert isinstance(bound, Within), name
    return bound


@platforms
def test_what_is_correctly_rounded(platform: Platform) -> None:
    names = TABLES[platform].correctly_rounded.split()
    promised = [BUILTINS[name].accuracy.on(platform) for name in names]
    assert all(each.bound == Rounded() and not each.assumed for each in promised)


@platforms
def test_errors_in_ulp_are_those_of_the_tables(platform: Platform) -> None:
    table = TABLES[platform]
    for name, expected in table.ulp.items():
        bound = within(name, platform)
        error = bound.beyond if name in table.absolute else bound.error
        assert error.ulp == expected, name
        assert error.ulp_by_operand == table.ulp_by_operand.get(name, 0.0), name
        assert error.relative == error.absolute == 0.0, name


@platforms
def test_relative_errors_are_those_of_the_tables(platform: Platform) -> None:
    table = TABLES[platform]
    for name, expected in table.relative.items():
        bound = within(name, platform)
        error = bound.beyond if name in table.absolute else bound.error
        assert (error.relative, error.ulp, error.absolute) == (expected, 0.0, 0.0), name


@platforms
def test_absolute_errors_are_those_of_the_tables(platform: Platform) -> None:
    for name, (expected, low, high) in TABLES[platform].absolute.items():
        bound = within(name, platform)
        assert bound.error.absolute == expected
        if bound.of == "operand":
            assert (-bound.limit, bound.limit) == (low, high)
        else:
            ends = [abs(float(FUNCTIONS[name](end))) for end in (low, high)]
            assert ends == pytest.approx([bound.limit] * 2, rel=1e-15)


@platforms
def test_inherited_errors_are_those_of_the_tables(platform: Platform) -> None:
    table = TABLES[platform]
    for name, definition in table.inherited.items():
        promise = BUILTINS[name].accuracy.on(platform)
        assert promise.bound == Inherited(definition, table.at_least.get(name, 0.0))
        assert not promise.assumed, name


@platforms
def test_what_a_specification_does_not_say_is_called_assumed(platform: Platform) -> None:
    """This concerns operations of the hardware; others inherit the error of their definition.

    Signs, whole numbers and operands are no matter of accuracy, nor are reads of textures here.
    """
    table = TABLES[platform]
    said = {
        *table.correctly_rounded.split(), *table.ulp, *table.relative, *table.absolute,
        *table.inherited, *table.by_equation.split(), "neg",
    }  # fmt: skip
    promised = {
        name
        for name, row in BUILTINS.items()
        if not row.accuracy.on(platform).assumed
        and row.accuracy.on(platform).bound != Exact()
        and row.domain is not nowhere
        and row not in texture.ROWS
    }
    assert promised - said == set()
    assumed = {name: BUILTINS[name].accuracy.on(platform) for name in BUILTINS.keys() - promised}
    assert all(promise.source for promise in assumed.values())
    assert {name for name in said & assumed.keys() if assumed[name].assumed} == set()


def test_beyond_a_limit_the_rule_is_called_assumed() -> None:
    for platform in PLATFORMS:
        promise = BUILTINS["sin"].accuracy.on(platform)
        assert promise.assumed or promise.beyond_assumed
        assert BUILTINS["div"].accuracy.on(platform).beyond_assumed


def test_ulp_is_the_spacing_of_float32() -> None:
    magnitudes = np.array([0.0, 2.0**-149, 2.0**-126, 1.0, 1.5, 2.0 - 2.0**-23, 2.0, 3e38])
    with np.errstate(all="ignore"):
        assert np.array_equal(ulp(magnitudes), np.spacing(magnitudes.astype(np.float32)))
    assert ulp(np.asarray(2.0 - 2.0**-30)) == 2.0**-23


@pytest.mark.parametrize(
    ("name", "platform", "operand", "result", "expected"),
    [
        ("exp2", "wgsl", 10.0, 1024.0, 23 * 2.0**-13),
        ("log2", "vulkan", 0.9, 0.152, 2.0**-21),
        ("log2", "vulkan", 8.0, 3.0, 3 * 2.0**-22),
        ("log2", "vulkan", 64.0, 6.0, 3 * 2.0**-21),
        ("sin", "wgsl", 3.0, 0.14, 2.0**-11),
        ("sin", "wgsl", 100.0, 0.5, 2.0**-11 + 100 * 2.0**-22),
        ("cos", "direct3d", 300.0, 0.5, 0.0008),
        ("inversesqrt", "es", 4.0, 0.5, 2 * 2.0**-24),
        ("inversesqrt", "direct3d", 4.0, 0.5, 2.0**-22),
        ("div", "wgsl", 3.0, 1.0, 2.5 * 2.0**-23),
        ("div", "direct3d", 3.0, 1.0, 2.0 * 2.0**-23),
        ("div", "wgsl", 2.0**127, 0.5, 0.5),
        ("atan", "vulkan", 1.0, 0.785, 4096 * 2.0**-24),
        ("floor", "opengl", 1.0, 1.0, 2.0**-23),
    ],
)
def test_values(
    name: str, platform: Platform, operand: float, result: float, expected: float
) -> None:
    found = Errors((platform,))(name, np.asarray(operand), np.asarray(result))
    assert float(found) == pytest.approx(expected, rel=1e-12)


def test_the_weakest_promise_counts() -> None:
    operand, result = np.asarray(300.0), np.asarray(1.0)
    found = [float(Errors((p,))("cos", operand, result)) for p in ("vulkan", "direct3d")]
    assert float(Errors(("vulkan", "direct3d"))("cos", operand, result)) == max(found)


def test_a_function_that_is_defined_by_others_has_no_error_of_its_own() -> None:
    with pytest.raises(LookupError, match="the error of dot follows from its definition only"):
        Errors(("wgsl",))("dot", np.asarray(1.0), np.asarray(1.0))


def test_routes_have_the_platforms_of_their_text_and_of_their_driver() -> None:
    assert ROUTES["lavapipe:glsl"].platforms == ("vulkan",)
    assert ROUTES["swiftshader:hlsl-dxc"].platforms == ("direct3d", "vulkan")
    assert ROUTES["chromium:webgpu"].platforms == ("wgsl",)
    assert {route.name for route in ROUTES.values() if not route.platforms} == set()


# --- inherited errors, against the expression that they are inherited from ------------------------

STEPS = np.random.default_rng(11)


def rounded(x: Floats) -> Floats:
    """A number rounded to either float32 beside it, at random."""
    nearest = x.astype(np.float32)
    towards = np.where(STEPS.random(x.shape) < 0.5, -np.inf, np.inf).astype(np.float32)
    other = np.nextafter(nearest, towards).astype(np.float64)
    off = (other - x) * (nearest - x) < 0
    return np.where(off & (STEPS.random(x.shape) < 0.5), other, nearest.astype(np.float64))


class Device:
    """Functions that are off by as much as a platform allows, upwards or downwards at random."""

    def __init__(self, platform: Platform) -> None:
        self.errors = Errors((platform,))

    def off(self, name: str, operand: Floats, exact: Floats) -> Floats:
        """The result of one function."""
        error = self.errors(name, np.abs(operand), np.abs(exact))
        direction: Floats = STEPS.choice([-1.0, 1.0, 0.0], exact.shape)
        return exact + error * direction

    def sqrt(self, x: Floats) -> Floats:
        """The square root by its definition, unless the platform has an operation for it."""
        if self.errors.platforms == ("direct3d",):
            return self.off("sqrt", x, np.sqrt(x))
        inverse = self.off("inversesqrt", x, 1.0 / np.sqrt(x))
        return self.off("div", inverse, 1.0 / inverse)

    def exp(self, x: Floats) -> Floats:
        """Likewise."""
        if self.errors.platforms == ("direct3d",):
            exponent = rounded(x * np.float32(math.log2(math.e)))
            return self.off("exp2", exponent, np.exp2(exponent))
        return self.off("exp", x, np.exp(x))

    def log(self, x: Floats) -> Floats:
        """Likewise."""
        if self.errors.platforms == ("direct3d",):
            return rounded(self.off("log2", x, np.log2(x)) * np.float32(math.log(2.0)))
        return self.off("log", x, np.log(x))

    def root_of_rest(self, x: Floats) -> Floats:
        """``sqrt(1 - x * x)``, which is zero or more."""
        rest = rounded(1.0 - rounded(x * x))
        return np.where(rest > 0, self.sqrt(np.maximum(rest, 2.0**-100)), 0.0)

    def evaluate(self, name: str, x: Floats) -> Floats:
        """A function as the specifications define it."""
        own = {"sqrt": self.sqrt, "exp": self.exp, "log": self.log}
        if name in own:
            return own[name](x)
        if name in ("asin", "acos"):
            root = self.root_of_rest(x)
            y, x = (x, root) if name == "asin" else (root, x)
            return self.off("atan2", x, np.arctan2(y, x))
        if name in ("sinh", "cosh"):
            rest = self.exp(-x) if name == "cosh" else -self.exp(-x)
            return rounded(self.exp(x) + rest) * 0.5
        if name == "tanh":
            cosine = self.evaluate("cosh", x)
            return self.off("div", cosine, self.evaluate("sinh", x) / cosine)
        if name == "atanh":
            below = rounded(1.0 - x)
            return self.log(self.off("div", below, rounded(1.0 + x) / below)) * 0.5
        one = 1.0 if name == "asinh" else -1.0
        square = rounded(rounded(x * x) + one)
        root = np.where(square > 0, self.sqrt(np.maximum(square, 2.0**-100)), 0.0)
        return self.log(rounded(x + root))


INHERITED: dict[str, tuple[Callable[[Any], Any], float, float]] = {
    "sqrt": (np.sqrt, 1e-6, 1e6), "exp": (np.exp, -80.0, 80.0), "log": (np.log, 1e-30, 1e30),
    "asin": (np.arcsin, -1.0, 1.0), "acos": (np.arccos, -1.0, 1.0),
    "sinh": (np.sinh, -80.0, 80.0), "cosh": (np.cosh, -80.0, 80.0), "tanh": (np.tanh, -16.0, 16.0),
    "asinh": (np.arcsinh, 0.0, 1e9), "acosh": (np.arccosh, 1.0, 1e9),
    "atanh": (np.arctanh, -1.0, 1.0),
}  # fmt: skip


@pytest.mark.parametrize("name", INHERITED)
@platforms
def test_no_device_exceeds_an_inherited_error(name: str, platform: Platform) -> None:
    function, low, high = INHERITED[name]
    operands = _spread(low, high)
    exact = function(operands)
    with np.errstate(all="ignore"):
        found = Device(platform).evaluate(name, operands)
    allowed = Errors((platform,))(name, np.abs(operands), np.abs(exact))
    share = np.abs(found - exact) / allowed
    assert share.max() <= 1.0 + 1e-6, operands[share.argmax()]
    assert share.max() >= 0.1


def _spread(low: float, high: float) -> Floats:
    """Operands over a range: even, by magnitude, and close to its ends."""
    count = 20_000
    even = STEPS.uniform(low, high, count)
    small = low + (high - low) * 2.0 ** STEPS.uniform(-60.0, 0.0, count)
    near_end = high - (high - low) * 2.0 ** STEPS.uniform(-24.0, 0.0, count)
    inside = np.nextafter(np.float32(1.0), np.float32(0.0)) if (low, high) == (-1.0, 1.0) else high
    numbers = np.concatenate([even, small, near_end]).astype(np.float32).astype(np.float64)
    return np.clip(numbers, -inside if low == -1.0 else low, inside)
