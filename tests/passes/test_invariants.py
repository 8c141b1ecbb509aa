"""The ranges of the states of loops: found turn by turn, and given up if that would not end."""

from __future__ import annotations

import math
from collections.abc import Sequence

import pytest

from burnish.compiler.ir.invariants import PATIENCE, invariants
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.operations import FORMAL
from burnish.compiler.ir.ranges import Ranges
from burnish.compiler.passes.open_binders import open_binders
from burnish.stdlib.builtins.facts import Fact

from .kit import calls, history, ops, shader


def facts(text: str) -> dict[str, Fact]:
    """The facts about the loop variables in a material's text in every turn, by their names."""
    given = shader(f"material M {{ {text} }}")
    roots = given.roots
    opened = open_binders(given.graph, roots, given.notes)
    ranges = Ranges(opened)
    return {_name(node): ranges.of(node) for node in ops(opened, "formal")}


def _name(node: Node) -> str:
    return FORMAL.data(node).name


@pytest.mark.parametrize(
    ("loop", "low", "high"),
    [
        ("from 1.0 up to 3 : x + 1", 1.0, 3.0),
        ("from 0.5 up to 1 : x + 1", 0.5, 0.5),
        ("from 2.0 up to 90 : 0.5 * x", 0.0, 2.0),
        ("from 0.0 up to 90 : saturate(x + uv.x)", 0.0, 1.0),
        ("from 1.0 up to 90 : x * 2", 1.0, math.inf),
        ("from 1.0 up to 90 : -2 * x", -math.inf, math.inf),
    ],
)
def test_a_state_is_bounded_where_no_turn_takes_it_further(
    loop: str, low: float, high: float
) -> None:
    found = facts(f"color = vec3(iterate x {loop})").get("x", Fact(low, high))
    assert found.lo == pytest.approx(low, abs=1e-5)
    assert found.hi == pytest.approx(high)


def test_a_counter_that_may_wrap_is_any_number() -> None:
    found = facts("color = vec3(float(iterate n from 0 up to 90 : n + 1))")["n"]
    assert (found.lo, found.hi) == (-(2.0**31), 2.0**31 - 1)


def test_a_loop_in_a_loop_knows_what_holds_around_it() -> None:
    found = facts(
        "color = vec3(iterate x from 1.0 up to 90 : "
        "saturate(iterate y from abs(x) up to 90 : 1 / (1 + x + y)))"
    )
    assert found["x"].within(0.0, 1.0)
    assert found["y"].within(0.0, 1.00001)


def test_what_keeps_growing_is_given_up_after_some_turns() -> None:
    turns: list[float] = []

    def turn(states: Sequence[Fact]) -> Sequence[Fact]:
        turns.append(states[0].hi)
        return [Fact(0.0, states[0].hi + 1)]

    assert invariants([Fact(0.0, 0.0)], turn, PATIENCE)[0].hi == PATIENCE - 1
    turns.clear()
    assert invariants([Fact(0.0, 0.0)], turn, 10**6)[0] == Fact(0.0)
    assert len(turns) <= PATIENCE + 2


def test_bounds_that_move_towards_zero_end_there() -> None:
    def halved(states: Sequence[Fact]) -> Sequence[Fact]:
        return [Fact(0.5 * state.lo, 0.5 * state.hi) for state in states]

    found = invariants([Fact(1.0, 2.0), Fact(-3.0, -1.0)], halved, 10**6)
    assert found == [Fact(0.0, 2.0), Fact(-3.0, 0.0)]


def test_a_function_that_a_loop_calls_before_it_and_within_is_no_endless_question() -> None:
    given = shader(
        "import std.lights.{Point}\n"
        "import std.terms.{lambert}\n"
        "material M { color = lambert(iterate x from lambert(uv.xyx) up to 6 : lambert(x)) }\n"
        "rig R { a : Point  b : Point }"
    )
    assert ops(history(given).roots["guard"], "iterate")


def test_no_guard_stays_where_the_states_prove_it_needless() -> None:
    given = shader(
        "material M { color = vec3(iterate x from 1.0 up to 40 : sqrt(x) / (1 + x * u)) "
        "u = uv.x * uv.x }"
    )
    past = history(given)
    assert not past.staged.guards
    assert len(calls(past.roots["guard"], "sqrt")) == 1
