"""The undefined elements of kernels, as the reference computes them by itself."""

from __future__ import annotations

import numpy as np
import pytest

import burnish
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.kernel import computed
from burnish.compiler.reference.picture import RasterRules
from burnish.compiler.reference.storage_buffers import Contents
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.reference import values_for
from burnish.targets.runner.reference_kernels import elements_by_reference

BOTH = pytest.mark.parametrize("errors", [None, Errors(("vulkan",))], ids=["plain", "bounds"])
RULES = RasterRules(1, 1, unguarded_is_nan=True)
ROOT = "unguarded(sqrt(float(index - 2)))"
"""An expression that is undefined in the first two of eight invocations."""


def undecided(text: str, errors: Errors | None) -> list[list[int]]:
    """The undefined elements of each result of a kernel."""
    kernel = burnish.compile(f"kernel K {{ {text} }}", ("wgsl",))["K"]
    instance = Instance(kernel.reflection)
    lanes = computed(
        kernel.shader, values_for(kernel.shader, instance), {}, instance.extent(),
        instance.result_counts(), errors, RULES,
    )  # fmt: skip
    return [np.flatnonzero(lane.undecided).tolist() for lane in lanes]


@BOTH
@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        (f"result r : float[8] = {ROOT}", [0, 1]),
        (f"result r : float[8] = if index < 2 then 0 else {ROOT}", []),
        (f"result r : int[8] = int({ROOT})", [0, 1]),
        ("result r : int[8] = unguarded(8 / (index - 3))", [3]),
        ("result r : vec2[8] = normalize(nonzero(vec2(float(index - 5), 0)))", [5]),
        (f"work_group of 4  result r : float[8] = group_sum({ROOT})", [0, 1, 2, 3]),
        (
            "work_group of 4  result r : int[8] = group_sum(unguarded(8 / (index - 3)))",
            [0, 1, 2, 3],
        ),
        (f"runs over 8  scatter r : int[3] add 1 at 0 where {ROOT} > 1", [0, 1, 2]),
        ("runs over 8  scatter r : int[3] add 1 at 0", []),
    ],
)
def test_nothing_is_defined_where_a_promise_is_broken_or_a_domain_left(
    text: str, wanted: list[int], errors: Errors | None
) -> None:
    assert all(found == wanted for found in undecided(text, errors))


READS = """
kernel K {{
    buffer given : {element}[]
    result r : float[4] = {value}
}}
"""


@BOTH
@pytest.mark.parametrize(
    ("element", "value", "wanted"),
    [
        ("float", "given[index]", [1]),
        ("int", "float(given[index])", [1]),
        ("uint", "if given[index] > 3u then 1 else 0", [1]),
        ("bool", "if given[index] then 1 else 0", [1]),
        ("vec2", "if index < 2 then 0 else given[1].x", [2, 3]),
    ],
)
def test_what_is_read_of_undefined_elements_is_undefined(
    element: str, value: str, wanted: list[int], errors: Errors | None
) -> None:
    text = READS.format(element=element, value=value)
    kernel = burnish.compile(text, ("wgsl",))["K"]
    instance = Instance(kernel.reflection)
    words = 2 if element == "vec2" else 1
    numbers = np.array([0, np.nan, 1, 1]).repeat(words)
    contents = Contents(bytes(4 * len(numbers)), np.stack([numbers] * 3))
    instance.set_bytes("given", contents.data)
    held = {"given": contents}
    (found,) = elements_by_reference(kernel.shader, instance, {}, held, RULES, errors).values()
    assert found.ends is not None
    assert np.flatnonzero(np.isnan(found.ends[0])).tolist() == wanted
