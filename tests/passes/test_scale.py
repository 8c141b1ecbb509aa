"""Large programs: no recursion over the graph, and flat text that every front end takes."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler.ir.node import Folding, Formal, Graph, reachable
from burnish.compiler.ir.types import FLOAT
from burnish.compiler.passes.pipeline import Options, stage
from burnish.compiler.reference.evaluate import evaluate
from burnish.compiler.semantics.folds import folded
from burnish.targets.toolchain import Job, Toolchain

from .kit import ops, shader, shaders
from .test_random import TARGETS

LONG = 4_000
"""Many times what Python's stack holds; 100 000 work as well, and take a minute."""


def chain(length: int) -> str:
    """A material whose colour is the end of a chain of equations."""
    links = "\n".join(f"s{i} = sin(s{i - 1}) * 0.5 + uv.x" for i in range(1, length))
    return f"material M {{\ns0 = uv.y\n{links}\ncolor = vec3(s{length - 1})\n}}"


def long_sum(length: int) -> str:
    """A material whose colour is one sum."""
    terms = " + ".join(f"sin(uv.x * {i}.0)" for i in range(1, length + 1))
    return f"material M {{ color = vec3({terms}) }}"


def nested(depth: int) -> str:
    """A material whose colour is chosen by a long ``else if``."""
    links = "".join(f"if x < {i}.5 then pow(x, sin(x * {i}.5)) else " for i in range(depth))
    return f"material M {{ x = uv.x\ncolor = vec3({links}0) }}"


@pytest.mark.parametrize("target", TARGETS)
def test_a_long_else_if_nests_no_deeper_than_front_ends_take(target: str) -> None:
    text = burnish.compile(nested(1_000), (target,)).materials[0].text(target, "fragment")
    deepest = max(len(line) - len(line.lstrip()) for line in text.split("\n")) // 4
    assert deepest < 64


def test_a_long_chain_of_equations_compiles() -> None:
    given = shader(chain(LONG))
    assert len(reachable([given.targets[0].value])) > 3 * LONG
    stage(given, Options())


def test_a_sum_of_many_terms_compiles() -> None:
    stage(shader(long_sum(LONG)), Options())


def test_deeply_nested_folds_are_evaluated_without_recursion() -> None:
    graph = Graph()
    body = graph.node("constant", FLOAT, (), 1.0)
    for _ in range(2000):
        body = folded(graph, "add", 1, body, Formal("i"), lambda _old, _new: None)
    assert evaluate(body) == (1.0,)


def test_equal_folds_are_one_node() -> None:
    text = """
    material M {
        first  = sum i in 0..5 : sin(uv.x * float(i))
        second = sum other in 0..5 : sin(uv.x * float(other))
        color  = vec3(first, second, 0)
    }
    """
    (given,) = shaders(text)
    folds = ops([given.targets[0].value], "fold")
    assert len(folds) == 1
    assert isinstance(folds[0].data, Folding) and folds[0].data.bound == 5


@pytest.mark.parametrize("text", [chain(1700), long_sum(1700)], ids=["chain", "sum"])
def test_five_thousand_nodes_are_accepted(text: str) -> None:
    (material,) = burnish.compile(text, TARGETS).materials
    jobs = [
        Job(checker, stage_[:4], file.text, entry, file.name)
        for file in material.files
        for stage_, entry in file.entry_points.items()
        for checker in file.checkers
    ]
    with Toolchain() as toolchain:
        verdicts = toolchain.check(jobs)
    assert [v.report() for v in verdicts if v.status != "accepted"] == []
