"""The bounds of loops that feed their state back grow like the errors, and not exponentially.

A state whose error is computed from its own error of the turn before is where intervals explode
although devices do not. Each loop here has 32 turns; its bounds must contain what random devices
compute, and be at most so many times the largest error among them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.stages import TARGET
from burnish.compiler.ir.types import width
from burnish.compiler.reference.bounds import (
    Bounded,
    Bounds,
    as_bounded,
    between,
    exact,
    remembered,
)
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.evaluate import Evaluator

from .device import HABITS, Device
from .kit import shader
from .test_soundness import _bounds_of, _stored

COUNT = 32
"""The number of values of each parameter."""
ERROR = 2.0**-20
"""The relative error of parameters, as of interpolated values."""


@dataclass(frozen=True)
class Loop:
    """A loop, and how wide it may be."""

    parameters: str
    text: str
    most: float
    """The largest ratio, in the median, of the bound to the largest error that is seen."""


TOWARDS = "origin : vec3, ray : vec3"
LOOPS: Mapping[str, Loop] = {
    "sphere tracing": Loop(
        TOWARDS, "iterate t from 0.0 for i in 0..32 : t + (length(origin + t * ray) - 1.0)", 15.0
    ),
    "Newton's square root": Loop(
        "a : float", "iterate x from a for i in 0..32 : 0.5 * (x + a / x)", 3.0
    ),
    "Newton's intersection": Loop(
        TOWARDS,
        "iterate t from 0.0 for i in 0..32 : t - (dot(origin + t * ray, origin + t * ray) - 1.0)"
        " / (2.0 * dot(origin + t * ray, ray))",
        3.0,
    ),
    "a geometric sum": Loop("a : float", "iterate s from 0.0 for i in 0..32 : s * 0.5 + a", 3.0),
    "blending": Loop(
        "a : float, b : float", "iterate s from a for i in 0..32 : mix(s, b, 0.1)", 5.0
    ),
    "layers": Loop(
        "a : float",
        "iterate s from 0.0 for i in 0..32 : s + (1.0 - s) * saturate(abs(a) * 0.1)",
        40.0,
    ),
    "a fractal's orbit": Loop(
        "c : vec2",
        "(iterate z from vec2(0.0) for i in 0..32 :"
        " vec2(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + 0.05 * c).x",
        4.0,
    ),
    "a rotation": Loop(
        "v0 : vec2",
        "(iterate v from v0 for i in 0..32 : vec2(0.8 * v.x - 0.6 * v.y, 0.6 * v.x + 0.8 * v.y)).x",
        200.0,
    ),
    "octaves": Loop(
        "c : vec2", "sum i in 0..32 : sin(c.x * exp2(float(i))) * exp2(-float(i))", 2.0
    ),
}


def _arrays(name: str, count: int) -> tuple[Any, ...]:
    """Values of a parameter; rays meet the unit sphere from afar."""
    chance = np.random.default_rng([5, *name.encode()])
    if name == "origin":
        return *(chance.uniform(-0.2, 0.2, COUNT) for _ in range(2)), np.full(COUNT, 3.0)
    if name == "ray":
        return *(chance.uniform(-0.05, 0.05, COUNT) for _ in range(2)), np.full(COUNT, -1.0)
    return tuple(chance.uniform(0.2, 3.0, COUNT).astype(np.float32) * 1.0 for _ in range(count))


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("name", LOOPS)
def test_bounds_of_loops_grow_like_errors(name: str) -> None:
    loop = LOOPS[name]
    bounds, worst = _compared(loop.parameters, loop.text)
    assert np.median(bounds.radius / worst) < loop.most


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_loop_that_rounding_may_end_goes_one_turn_further_at_most() -> None:
    bounds, worst = _compared("a : float", "iterate t from 0.0 up to 32 while t < 3.0 * a : t + a")
    (a,) = _arrays("a", 1)
    assert (worst > 0.9 * a).any(), "some device goes on"
    assert (bounds.radius < 1.001 * a).all()


def _compared(given: str, text: str) -> tuple[Bounded, Any]:
    """The bounds of a text with these parameters, and the largest errors of random devices."""
    parameters = "\n".join(f"param {each}" for each in given.split(", "))
    drawn = shader(f"material M {{\n{parameters}\ncolor = vec3({text})\n}}")
    (target,) = drawn.results_of(TARGET)

    def valued(made: Any) -> Any:
        def lanes(node: Node) -> Any:
            if not isinstance(node.data, Parameter):
                return None
            name = node.data.name
            arrays = enumerate(_arrays(name, width(node.type)))
            return tuple(made(np.asarray(a, np.float64), ERROR, f"{name}.{i}") for i, a in arrays)

        return lanes

    errors = Errors(("vulkan",))
    evaluator = Evaluator(valued(_bounds_of), Bounds(errors), stored=_stored)
    bounds = as_bounded(evaluator.value(target.value)[0])
    worst = np.zeros(COUNT)
    for number, habits in enumerate(HABITS):
        device = Device(errors, habits, number)
        value = device.lane(Evaluator(valued(device.given), device).value(target.value)[0]).value
        assert ((bounds.low <= value) & (value <= bounds.high)).all(), f"device {number}"
        worst = np.maximum(worst, np.abs(value - bounds.value))
    return bounds, worst


def test_errors_of_uniform_lanes_are_not_taken_for_pixels() -> None:
    """Lanes without axes have two shared errors here, and the array has two elements."""
    one, other = (remembered(between(x, x - 0.5, x + 0.5)) for x in (np.float64(1), np.float64(2)))
    found = (one + other) * exact(np.array([1.0, 100.0]))
    assert found.radius == pytest.approx([1.0, 100.0], rel=1e-5)


def test_a_choice_between_uniform_lanes_has_an_axis() -> None:
    one, other = (remembered(between(x, x - 0.5, x + 0.5)) for x in (np.float64(1), np.float64(2)))
    xp = Bounds(Errors(("wgsl",)))
    found = xp.where(exact(np.array([True, False])), one + other, one * exact(np.float64(4)))
    assert found.radius == pytest.approx([1.0, 2.0], rel=1e-5)
