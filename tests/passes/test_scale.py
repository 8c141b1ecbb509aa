"""Large programs: no recursion over the graph, and flat text that every front end takes."""

from __future__ import annotations

from typing import Any

import pytest

import burnish
from burnish.compiler.ir import binding
from burnish.compiler.ir.node import Formal, Graph, Node, reachable
from burnish.compiler.ir.operations import FOLD
from burnish.compiler.ir.stages import TARGET
from burnish.compiler.ir.types import FLOAT
from burnish.compiler.passes.pipeline import Options, stage
from burnish.compiler.reference.evaluate import evaluate
from burnish.compiler.semantics.checking.loop_contents import DEEPEST
from burnish.compiler.semantics.checking.loops import folded
from burnish.targets.toolchain import Job, Toolchain

from ..suite.verdicts import refused
from ..targets.standings import PROFILES
from .kit import ops, shader, shaders

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


@pytest.mark.parametrize("target", PROFILES)
def test_a_long_else_if_nests_no_deeper_than_front_ends_take(target: str) -> None:
    text = burnish.compile(nested(1_000), (target,)).materials[0].text(target, "fragment")
    deepest = max(len(line) - len(line.lstrip()) for line in text.split("\n")) // 4
    assert deepest < 64


def test_a_long_chain_of_equations_compiles() -> None:
    given = shader(chain(LONG))
    assert len(reachable([given.results_of(TARGET)[0].value])) > 3 * LONG
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
    folds = ops([given.results_of(TARGET)[0].value], "fold")
    assert len(folds) == 1
    assert FOLD.data(folds[0]).bound == 5


def folds(length: int) -> str:
    """A chain of folds, each of which reads the one before in every turn."""
    links = "\n".join(f"s{i} = sum j in 0..9 : sin(s{i - 1} * float(j))" for i in range(1, length))
    return f"material M {{\ns0 = uv.y\n{links}\ncolor = vec3(s{length - 1})\n}}"


def loops(length: int) -> str:
    """A chain of loops over states."""
    links = "\n".join(
        f"s{i} = iterate x from s{i - 1} up to 9 while x < uv.x : x + s{i - 1} * 0.1"
        for i in range(1, length)
    )
    return f"material M {{\ns0 = uv.y\n{links}\ncolor = vec3(s{length - 1})\n}}"


def structures(length: int) -> str:
    """A chain of choices between structures."""
    links = "\n".join(
        f"s{i} = if uv.x < {i}.5 then s{i - 1} else Two(s{i - 1}.b, s{i - 1}.a + 0.5)"
        for i in range(1, length)
    )
    return (
        "struct Two { a : float, b : float }\n"
        f"material M {{\ns0 = Two(uv.x, uv.y)\n{links}\ncolor = vec3(s{length - 1}.a)\n}}"
    )


def doublings(depth: int) -> str:
    """A material that would be exponentially long if sharing were lost."""
    links = "\n".join(f"s{i} = twice(s{i - 1}) + twice(s{i - 1})" for i in range(1, depth))
    function = "fn twice(x: float) -> float = f(f(x) + f(x))\nfn f(x: float) -> float = sin(x + x)"
    return f"{function}\nmaterial M {{\ns0 = uv.y\n{links}\ncolor = vec3(s{depth - 1})\n}}"


SHAPES = {"folds": folds, "loops": loops, "structures": structures, "doublings": doublings}


@pytest.mark.parametrize("name", SHAPES)
def test_work_and_text_grow_with_the_program(name: str) -> None:
    """Counted in nodes that were made and in lines: nothing is done again and again."""
    nodes, lines = [], []
    for length in (100, 200):
        given = shader(SHAPES[name](length))
        stage(given, Options())
        nodes.append(len(given.graph))
        text = burnish.compile(SHAPES[name](length), ("wgsl",)).materials[0]
        lines.append(len(text.text("wgsl", "fragment").split("\n")))
    assert nodes[1] < 2.2 * nodes[0]
    assert lines[1] < 2.2 * lines[0]


def test_what_a_turn_changes_is_all_that_closing_looks_at(monkeypatch: pytest.MonkeyPatch) -> None:
    looked: list[int] = []
    transform = binding._transform

    def counted(graph: Graph, root: Node, leaf: Any, affected: Any, moved: Any) -> Node:
        def counting(node: Node, depth: int) -> bool:
            looked.append(node.id)
            return bool(affected(node, depth))

        return transform(graph, root, leaf, counting, moved)

    monkeypatch.setattr(binding, "_transform", counted)
    stage(shader(folds(200)), Options())
    assert len(looked) < 200 * 60


def loops_in_loops(depth: int) -> str:
    """Loops in each other, each of which leaves early."""
    head = "".join(
        f"iterate x{i} from x{i - 1} up to 9 while x{i} < {i}.5 : " for i in range(1, depth + 1)
    )
    return f"material M {{ x0 = uv.x\ncolor = vec3({head}sin(x{depth})) }}"


LARGE = {"chain": chain(1700), "sum": long_sum(1700), "loops": loops_in_loops(DEEPEST)}


@pytest.mark.parametrize("name", LARGE)
def test_every_front_end_accepts_large_programs(name: str) -> None:
    text = LARGE[name]
    (material,) = burnish.compile(text, PROFILES).materials
    jobs = [
        Job(checker, stage_[:4], file.text, entry, file.name)
        for file in material.files
        for stage_, entry in file.entry_points.items()
        for checker in file.checkers
    ]
    with Toolchain() as toolchain:
        assert [each.report() for each in refused(jobs, toolchain)] == []
