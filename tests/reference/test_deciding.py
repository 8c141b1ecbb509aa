"""Bounds by cases contain every device, and are narrow where both sides of a decision agree."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest

from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.bounds import Bounded, Bounds, as_bounded
from burnish.compiler.reference.bounds.deciding import MOST, Case, Deciding
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.evaluate import Evaluator
from burnish.compiler.reference.picture import RasterRules
from burnish.stdlib.builtins.accuracy import Platform

from .device import HABITS, Device
from .kit import geometry, picture, shader
from .random_graphs import RandomGraph, Values, flat, leaves
from .test_soundness import _bounds_of, _operations, _stored

PLATFORMS: tuple[Platform, ...] = ("wgsl", "vulkan")
ERROR = 2.0**-20
"""The relative error of parameters, as of interpolated values."""
COUNT = 64


def _by_cases(roots: Sequence[Node], given: Any, errors: Errors) -> list[tuple[Any, Any]]:
    """The ends of all lanes of some nodes, over all cases of their decisions."""
    found: list[tuple[Any, Any]] = []
    number = most = 0
    while number < 2**most:
        xp = Deciding(errors, lambda _node: False)
        evaluator = Evaluator(given, xp, stored=_stored)
        case = Case(np.int64(number))
        xp.begin(evaluator.outermost, case)
        lanes = [as_bounded(lane) for root in roots for lane in flat(evaluator.value(root))]
        ends = [(lane.low, lane.high) for lane in lanes]
        found = [
            (np.minimum(low, least), np.maximum(high, largest))
            for (low, high), (least, largest) in zip(found or ends, ends, strict=True)
        ]
        most = min(max(most, case.most), MOST)
        number += 1
    return found


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("platform", PLATFORMS)
def test_no_device_leaves_all_cases(platform: Platform) -> None:
    errors = Errors((platform,))
    for seed in range(12):
        nodes, values = _operations(RandomGraph(seed)), Values(seed)
        found = _by_cases(nodes, leaves(values, _bounds_of), errors)
        for number, habits in enumerate(HABITS):
            device = Device(errors, habits, seed * len(HABITS) + number)
            evaluator = Evaluator(leaves(values, device.given), device)
            lanes = [lane for node in nodes for lane in flat(evaluator.value(node))]
            for lane, (low, high) in zip(lanes, found, strict=True):
                got = device.lane(lane).value
                known = np.isfinite(low * 1.0) & np.isfinite(high * 1.0)
                assert (~known | ((low <= got) & (got <= high))).all(), f"seed {seed}"


CONTINUOUS = {
    "a zigzag": "abs(fract(x) - 0.5)",
    "the nearest of many places": "(x + 0.5 - round(x + 0.5)) * (x + 0.5 - round(x + 0.5))",
    "a remainder": "abs(x mod 2.0 - 1.0)",
    "a choice of two that agree": "if x < 3.0 then 2.0 * x else x + 3.0",
    "a noise": "mix(sin(floor(x)), sin(floor(x) + 1.0), fract(x))",
    "octaves of a noise": (
        "sum i in 0..4 : mix(sin(floor(x * exp2(float(i)))),"
        " sin(floor(x * exp2(float(i))) + 1.0), fract(x * exp2(float(i))))"
    ),
    "the end of a loop": "abs((iterate n from 0.0 up to 12 while n < x : n + 1.0) - x - 0.5)",
    "steps to the nearest place": "iterate t from x + 0.5 up to 6 : t + 2.0 * abs(t - round(t))",
}


def _of_text(text: str, made: Any, xp: Any) -> Any:
    """The value of a text in which ``x`` is a parameter, close to whole numbers."""
    drawn = shader(f"material M {{\nparam x : float\ncolor = vec3({text})\n}}")
    (target,) = drawn.results_of(TARGET)

    def given(node: Node) -> Any:
        near = np.repeat([1.0, 2.0, 3.0, 7.0], COUNT // 4)
        return (made(near, ERROR, "x"),) if isinstance(node.data, Parameter) else None

    if isinstance(xp, Errors):
        return _by_cases([target.value], given, xp)[0]
    return Evaluator(given, xp, stored=_stored).value(target.value)[0]


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("name", CONTINUOUS)
def test_cases_are_narrow_where_both_sides_agree(name: str) -> None:
    text, errors = CONTINUOUS[name], Errors(("vulkan",))
    low, high = _of_text(text, _bounds_of, errors)
    assert (high - low < 0.02).all()
    whole: Bounded = _of_text(text, _bounds_of, Bounds(errors))
    assert (whole.high - whole.low).max() > 2 * (high - low).max() or name.startswith("a choice")
    for number, habits in enumerate(HABITS):
        device = Device(errors, habits, number)
        got = device.lane(_of_text(text, device.given, device)).value
        assert ((low <= got) & (got <= high)).all(), f"device {number}"


def test_a_jump_stays_as_wide_as_it_is() -> None:
    low, high = _of_text("fract(x)", _bounds_of, Errors(("vulkan",)))
    assert (low < 1e-4).all()
    assert (high > 1.0 - 1e-4).all()


def test_pictures_are_narrow_where_both_sides_agree() -> None:
    """A square that lies in a plane where a noise has its cells' border."""
    square = geometry(
        [[0, 1, 2], [0, 2, 3]],
        vertex_position=[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]],
    )
    text = "mix(sin(floor(p)), sin(floor(p) + 1.0), fract(p))"
    drawn = shader(
        "material M {\nclip_position = (vec4(vertex_position, 1.0) as point<clip>)\n"
        "p = vertex_position.z + 3.0 + 0.000001 * vertex_position.x\n"
        f"color = vec3({text})\n}}"
    )
    found = picture(drawn, square, RasterRules(16, 16, 8), errors=Errors(("vulkan",)))
    assert found.covered.all()
    apart = (found.high[0] - found.low[0])[..., 0]
    assert apart.max() < 0.01


def test_the_error_of_a_rough_function_is_shared_by_all_that_use_its_value() -> None:
    """Vulkan lets a sine be off by 2^-11, of which hardly more than the square is left here."""
    triangle = geometry([[0, 1, 2]], vertex_position=[[-1, -1, 0], [3, -1, 0], [-1, 3, 0]])
    drawn = shader(
        "material M {\nclip_position = (vec4(vertex_position, 1.0) as point<clip>)\n"
        "a = sin(vertex_position.x + 2.0)\nb = vertex_position.y\n"
        "color = vec3(0.5 + 256.0 * (b / a * a - b))\n}"
    )
    found = picture(drawn, triangle, RasterRules(16, 16, 8), errors=Errors(("vulkan",)))
    assert found.covered.all()
    apart = (found.high[0] - found.low[0])[..., 0]
    assert np.median(apart) < 0.05
