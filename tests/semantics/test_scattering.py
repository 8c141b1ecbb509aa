"""The scattered results of kernels, and the elements that need a check."""

from __future__ import annotations

import pytest

from burnish.compiler.ir.kernel import ScatterOperator, neutral
from burnish.compiler.ir.stages import CONDITION, EXTENT, LENGTH, PLACE, SCATTER, STORE
from burnish.compiler.passes.pipeline import Options, stage

from .kit import shader

COUNTS = "kernel K {{ buffer b : float[]  runs over b.count  scatter few : uint[9] add 1u at {} }}"


def test_each_scatter_has_four_results() -> None:
    made = shader(COUNTS.format("index where b[index] > 0"))
    assert [result.kind for result in made.results] == [EXTENT, SCATTER, PLACE, CONDITION, LENGTH]
    (store,) = {result.store for result in made.results[1:]}
    assert store is not None
    assert (store.buffer.name, store.operator) == ("few", "add")
    assert [info.leaf.name for info in made.written] == ["few"]


def test_results_say_for_how_many_elements_a_kernel_runs() -> None:
    made = shader("kernel K { result r : int[5] = index  scatter few : int[9] max index at 2 }")
    assert [result.kind for result in made.results[:3]] == [EXTENT, STORE, SCATTER]


@pytest.mark.parametrize(
    ("place", "always"),
    [
        ("index mod 9", True),
        ("int(saturate(b[index]) * 8)", True),
        ("index", False),
        ("index mod 9 - 1", False),
        ("index mod 10", False),
    ],
)
def test_only_elements_that_may_not_exist_need_a_check(place: str, always: bool) -> None:
    program = stage(shader(COUNTS.format(place)), Options()).program
    ((scattered,),) = [each.scattered for each in program.stages]
    is_known = scattered.condition.op == "constant" and scattered.condition.data is True
    assert is_known == always


@pytest.mark.parametrize(
    ("operator", "signed", "unsigned"),
    [
        ("add", 0, 0),
        ("or", 0, 0),
        ("and", -1, 2**32 - 1),
        ("min", 2**31 - 1, 2**32 - 1),
        ("max", -(2**31), 0),
    ],
)
def test_elements_begin_with_what_changes_nothing(
    operator: ScatterOperator, signed: int, unsigned: int
) -> None:
    assert neutral(operator, signed=True) == signed
    assert neutral(operator, signed=False) == unsigned


def test_a_derived_kernel_may_run_over_something_else() -> None:
    text = """
    abstract kernel Base { runs over 3  scatter few : uint[9] add 1u at index }
    kernel K : Base { runs over 7 }
    """
    made = shader(text)
    assert made.results_of(EXTENT)[0].value.data == 7
    assert made.results_of(LENGTH)[0].value.data == 9
