"""Pictures that other processes have drawn are those that this one would draw."""

from __future__ import annotations

import json
import sys

import numpy as np
import pytest

import burnish
from burnish.compiler.budget import BudgetError, raised
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.picture import Expected, RasterRules
from burnish.targets.runner import reference_process
from burnish.targets.runner.meshes import plane
from burnish.targets.runner.reference import expected
from burnish.targets.runner.reference_process import References
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import set_up
from burnish.targets.toolchain.workers import Worker

MATERIAL = burnish.compile("material M { color = vec3(sin(uv.x * 9), uv.y, 0.5) }", ["wgsl"])["M"]
QUESTION = (
    MATERIAL.shader,
    set_up(MATERIAL.instance(), plane(2), Scene(), (8, 8)),
    RasterRules(8, 8, 8),
    Errors(("vulkan",)),
)


def _same(one: Expected, other: Expected) -> bool:
    ends = [(*each.targets, *each.low, *each.high, each.covered) for each in (one, other)]
    return all(np.array_equal(a, b) for a, b in zip(*ends, strict=True))


def test_a_process_draws_the_same() -> None:
    with References(1) as references:
        assert _same(references.expected(*QUESTION), expected(*QUESTION))


@pytest.mark.parametrize("text", ["pass", "raise SystemExit(3)", "print('{}', flush=True)"])
def test_if_the_process_ends_the_picture_is_drawn_here(
    text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        reference_process, "Worker", lambda *_: Worker(lambda: [sys.executable, "-c", text])
    )
    with References(1) as references:
        assert _same(references.expected(*QUESTION), expected(*QUESTION))


def test_a_graph_that_is_too_deep_to_be_sent_is_drawn_here() -> None:
    terms = " + ".join(f"sin(uv.x * {number}.5)" for number in range(800))
    material = burnish.compile(f"material M {{ color = vec3({terms}) }}", ["wgsl"])["M"]
    question = (material.shader, *QUESTION[1:])
    with References(1) as references:
        assert _same(references.expected(*question), expected(*question))


def test_a_process_has_the_limits_of_whoever_asks() -> None:
    with References(1) as references:
        with raised({"memory": 1000}), pytest.raises(BudgetError) as told:
            references.expected(*QUESTION)
        assert _same(references.expected(*QUESTION), expected(*QUESTION))
    assert str(told.value).startswith("the picture of `M` needs ")


@pytest.mark.parametrize(
    ("reply", "error"),
    [({"refused": "it is too large"}, BudgetError), ({"lacks_memory": ""}, MemoryError)],
)
def test_what_a_process_refuses_is_not_drawn_here(
    reply: dict[str, str], error: type[Exception], monkeypatch: pytest.MonkeyPatch
) -> None:
    answer = f"print({json.dumps(json.dumps(reply))}, flush=True)"
    monkeypatch.setattr(
        reference_process, "Worker", lambda *_: Worker(lambda: [sys.executable, "-c", answer])
    )
    with References(1) as references, pytest.raises(error):
        references.expected(*QUESTION)


def test_without_processes_none_is_started(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reference_process, "pickle", None)
    with References(0) as references:
        assert _same(references.expected(*QUESTION), expected(*QUESTION))
