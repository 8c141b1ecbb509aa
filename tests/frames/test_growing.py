"""Twice the plan, or reflection, is twice the work, whichever part of it is larger."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial
from typing import Any

import pytest

from burnish.compiler.budget import BudgetError
from burnish.compiler.documents.plan import FramePlan
from burnish.compiler.documents.reading import read
from burnish.compiler.documents.reflection import Reflection
from burnish.targets.runner.frames.checks.names import check_names
from burnish.targets.runner.frames.checks.needs import check_needs
from burnish.targets.runner.frames.checks.order import check_order
from burnish.targets.runner.frames.checks.reflections import check_reflection
from burnish.targets.runner.frames.checks.repeats import check_repeats
from burnish.targets.runner.frames.checks.rows import PlanError
from burnish.targets.runner.frames.checks.shaders import check_shaders

from ..diagnostics.test_growth import calls
from ..fuzz.hostile.plans import received
from .growing import Growing, growing, grown
from .kit import of_text

FRAME = received("reaction")
SHADERS = [read(Reflection, each) for each in FRAME.reflections.values()]
ONCE = 100
"""The number of elements at first; the second document has twice as many."""
OTHER = 3000
"""The number of additional calls that are allowed for work that does not grow."""


WRONG = (PlanError, BudgetError, LookupError)
"""The errors that may end a check of a document.

Some checks rely on earlier ones; here each check runs by itself, also on wrong documents.
"""


def of_a_plan(document: Any) -> None:
    """All that is done with a plan. Most of these are wrong, which each check finds for itself."""
    plan = read(FramePlan, document)
    checks: list[Callable[[], None]] = [
        partial(check, plan) for check in (check_names, check_needs, check_order)
    ]
    checks += [partial(check, plan, SHADERS) for check in (check_repeats, check_shaders)]
    for check in checks:
        with suppress(*WRONG):
            check()


def of_a_reflection(document: Any) -> None:
    """All that is done with a reflection."""
    reflection = read(Reflection, document)
    with suppress(*WRONG):
        check_reflection("x", reflection)


DOCUMENTS: Mapping[type, tuple[Any, Callable[[Any], None]]] = {
    FramePlan: (FRAME.plan, of_a_plan),
    Reflection: (next(iter(FRAME.reflections.values())), of_a_reflection),
}
"""A document of each kind, and what is done with such."""
PLACES = {
    f"{kind.__name__} {where.name}": (kind, where) for kind in DOCUMENTS for where in growing(kind)
}


@pytest.mark.parametrize("place", PLACES)
def test_twice_the_document_is_twice_the_work(place: str) -> None:
    kind, where = PLACES[place]
    once, twice = (calls(_work(kind, where, count)) for count in (ONCE, 2 * ONCE))
    assert twice < 2.2 * once + OTHER


def _work(kind: type, where: Growing, count: int) -> Callable[[], None]:
    document, done = DOCUMENTS[kind]
    return partial(done, grown(document, kind, where, count))


def test_new_lists_of_documents_are_found() -> None:
    assert len(PLACES) > 100
    assert {
        "FramePlan steps/*/DrawStep/draws/*/uses/*/inputs",
        "Reflection derived/*/steps/*/CallStep/args",
    } < {*PLACES}


CHAIN = """
import std.frames.{FullScreen}
pass Read : FullScreen {
    map source : texture2d with { filter = nearest, mip = none }
    target value : rgba16f = source.load(ivec2(frag_coord.xy)) + 1
}
pass First : FullScreen { target value : rgba16f = vec4(uv, 0, 1) }
frame Chain {
    step0 = First(screen)
    {steps}
    output picture = step{last}.value
}
"""


def test_twice_the_steps_are_twice_the_work() -> None:
    work = []
    for count in (20, 40):
        steps = "\n".join(
            f"step{number} = Read(screen) with {{ source = step{number - 1}.value }}"
            for number in range(1, count)
        )
        text = CHAIN.replace("{steps}", steps).replace("{last}", str(count - 1))
        frame = of_text(text)
        work.append(calls(partial(of_a_whole, frame.plan, [s.reflection for s in frame.shaders])))
    assert work[1] < 2.2 * work[0]


def of_a_whole(plan: Any, reflections: Any) -> None:
    """All checks of a good plan."""
    for check in (check_names, check_needs, check_order):
        check(plan)
    check_repeats(plan, reflections)
    check_shaders(plan, reflections)
