"""The results of kernels for their work groups: one element for each group, and joined values."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.ir.stages import LENGTH, STORE

from .kit import shader

TOTALS = """kernel K {{
    {group}
    param n : int in 0..10000 = 10
    runs over n
    result totals : {type}[] per group = {value}
}}"""


def kernel(group: str = "", type_: str = "int", value: str = "group_sum(index)") -> str:
    """A kernel with one result per group."""
    return TOTALS.format(group=group, type=type_, value=value)


def test_the_first_invocation_of_a_group_writes_its_element() -> None:
    made = shader(kernel("work_group of 32", "mat2", "mat2(float(group_sum(index)))"))
    stores = [result.store for result in made.results_of(STORE)]
    assert [(store.of_group, store.stride, store.offset) for store in stores if store] == [
        (32, 2, 0),
        (32, 2, 1),
    ]
    assert len(made.results_of(LENGTH)) == 1


@pytest.mark.parametrize(
    ("group", "n", "count"),
    [("", 0, 0), ("", 1, 1), ("", 64, 1), ("", 65, 2), ("work_group of 37", 75, 3)],
)
def test_the_host_computes_how_many_groups_there_are(group: str, n: int, count: int) -> None:
    instance = burnish.compile(kernel(group), ("wgsl",))["K"].instance()
    instance.set("n", n)
    assert instance.extent() == n
    assert instance.result_counts() == {"totals": count}


def test_the_length_is_nothing_that_a_device_computes() -> None:
    (made,) = burnish.compile(kernel(), ("wgsl",))
    assert [row.name for row in made.reflection.parameters] == ["n"]
    assert not made.reflection.derived


@pytest.mark.parametrize(
    ("call", "type_"),
    [
        ("group_sum(1)", "int"),
        ("group_min(uvec3(uint(index)))", "uvec3"),
        ("group_max(#ffffff * float(index))", "rgb"),
        ("group_inclusive_sum(vec2(float(index)))", "vec2"),
        ("group_exclusive_sum(index)", "int"),
    ],
)
def test_numbers_and_vectors_are_joined(call: str, type_: str) -> None:
    made = shader(f"kernel K {{ result r : {type_}[8] = {call} }}")
    assert made.results_of(STORE)


def test_what_a_group_comes_to_is_no_constant() -> None:
    text = "kernel K { result r : int[8] = 3 + group_sum(1) * 2 }"
    (made,) = burnish.compile(text, ("wgsl",))
    assert "group_sum(1, " in made.text("wgsl", "compute")


@pytest.mark.parametrize(
    ("member", "code", "message"),
    [
        ("result r : float[] per frame = 1", "B0201", "unknown rate `frame`"),
        (
            "result r : bool[9] = group_sum(true)",
            "B0302",
            "`group_sum` cannot be called with (bool)",
        ),
        (
            "result r : float[group_sum(3)] = 1",
            "B0512",
            "the number of elements of `r` is not known to the host",
        ),
    ],
)
def test_mistakes(member: str, code: str, message: str) -> None:
    with pytest.raises(CompileError) as error:
        burnish.compile(f"kernel K {{ runs over 9  {member} }}", ("wgsl",))
    (found,) = error.value.diagnostics
    assert (found.rule.code, found.message) == (code, message)
