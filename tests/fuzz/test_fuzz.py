"""A few random programs, and all that were ever found, pass every question.

``make fuzz`` tries other programs, for as long as one likes.
"""

from __future__ import annotations

import os
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.syntax.ast import declarations, expressions, members
from burnish.compiler.syntax.ast.member_kinds import MemberKind
from burnish.compiler.syntax.ast.members import ReadMember
from burnish.compiler.syntax.parser import parse
from burnish.stdlib.builtins import BUILTINS
from burnish.targets.runner.routes import ROUTES

from ..suite.processes import run
from . import rewritings
from .oracles import Case, Tools, ask
from .programs import program
from .rewritings import REWRITINGS, rewritten
from .shrink import shrunk
from .textures import KINDS
from .tree import Node, walk

REGRESSIONS = sorted((Path(__file__).parent / "regressions").glob("*.burnish"))
INSIDE = ("compiles", "facts", "passes")
"""The questions that need no other program."""


@pytest.fixture(scope="module")
def tools() -> Iterator[Tools]:
    with Tools([ROUTES["lavapipe:glsl"]]) as tools:
        yield tools


@pytest.mark.parametrize("number", range(60))
def test_the_compiler_keeps_the_meaning(number: int, tools: Tools) -> None:
    _pass(number, tools, *INSIDE)


@pytest.mark.parametrize("number", range(60, 66))
def test_the_texts_are_accepted(number: int, tools: Tools) -> None:
    _pass(number, tools, "accepted")


@pytest.mark.parametrize("number", range(66, 86))
def test_programs_that_mean_the_same_have_the_same_value(number: int, tools: Tools) -> None:
    _pass(number, tools, "rewritten")


@pytest.mark.parametrize("number", range(92, 104))
def test_passes_place_vertices_alike(number: int, tools: Tools) -> None:
    _pass(number, tools, "placed")


@pytest.mark.parametrize("number", range(86, 92))
def test_a_driver_draws_what_is_meant(number: int, tools: Tools) -> None:
    _pass(number, tools, "drawn")


@pytest.mark.parametrize("file", REGRESSIONS, ids=lambda file: file.stem)
def test_what_was_found_once_is_mended(file: Path, tools: Tools) -> None:
    _find_nothing(Case(file.read_text("utf-8"), 0, tools), *INSIDE, "accepted", "drawn")


def _pass(number: int, tools: Tools, *oracles: str) -> None:
    tree = program(f"test:{number}")
    _find_nothing(Case(str(tree), number, tools, tree), *oracles)


def _find_nothing(case: Case, *oracles: str) -> None:
    for oracle in oracles:
        for finding in ask(case, oracle).findings:
            pytest.fail(f"{finding.oracle} {finding.place}\n{finding.detail}\n{case.text}")


@pytest.mark.parametrize("name", [*REWRITINGS])
def test_every_rewriting_finds_a_place(name: str) -> None:
    places = (found for n in range(500) for found in rewritten(program(f"place:{n}"), "", name))
    assert next(places, None) is not None


def test_a_program_that_means_something_else_is_seen(
    tools: Tools, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(rewritings, "COMMUTATIVE", {"sub"})
    found = []
    for number in range(30):
        tree = program(f"swap:{number}")
        found += ask(Case(str(tree), number, tools, tree, "swap operands"), "rewritten").findings
    assert found


def test_nearly_all_programs_are_correct(tools: Tools) -> None:
    """The others are refused for an allowed reason."""
    answers = [ask(Case(str(program(f"rate:{n}")), n, tools), "facts") for n in range(100)]
    assert sum(answer.refused for answer in answers) <= 10
    assert not any(answer.findings for answer in answers)


def test_programs_use_the_whole_language() -> None:
    """Every class of the syntax tree, every builtin, and every kind of texture and read."""
    trees = [program(f"language:{number}") for number in range(1000)]
    written = Counter(node.role for tree in trees for _, node in walk(tree))
    texts = "\n".join(map(str, trees))
    found = {type(node) for tree in trees[:200] for node in _syntax(str(tree))}
    assert {each.__name__ for each in _syntax_classes() - found} == set()
    unread = {name for name, row in BUILTINS.items() if row.method is None}
    assert unread - {*written, "nonzero"} == set()
    methods = {f".{row.method}(" for row in BUILTINS.values() if row.method}
    assert [each for each in (*KINDS, *methods, "nonzero(") if each not in texts] == []


def _syntax_classes() -> set[type]:
    """The classes of all that can be written."""
    found = {
        each
        for module in (declarations, expressions, members)
        for each in vars(module).values()
        if isinstance(each, type) and each.__module__ == module.__name__
    }
    return {each for each in found if not each.__subclasses__()} - {MemberKind, ReadMember}


def _syntax(text: str) -> Iterator[object]:
    """Every node of the syntax tree of a text."""
    waiting: list[object] = [parse(Source("random", text), Report())]
    while waiting:
        node = waiting.pop()
        yield node
        if isinstance(node, list | tuple):
            waiting += node
        else:
            names = (name for each in type(node).__mro__ for name in getattr(each, "__slots__", ()))
            waiting += (getattr(node, name, None) for name in names)


def test_a_seed_always_gives_the_same_program() -> None:
    script = "from burnish.tests.fuzz.programs import program; print(program('same:1'))"
    texts = {
        run([sys.executable, "-c", script], env={**os.environ, "PYTHONHASHSEED": seed}).stdout
        for seed in ("1", "2")
    }
    assert texts == {f"{program('same:1')}\n"}


def test_a_finding_is_shrunk_to_what_shows_it(tools: Tools) -> None:
    def shows(tree: Node) -> bool:
        called = any(node.role == "sqrt" for _, node in walk(tree))
        return called and not ask(Case(str(tree), 0, tools), "facts").refused

    (number, *_) = (n for n in range(50) if shows(program(f"shrink:{n}")))
    small = shrunk(program(f"shrink:{number}"), shows, seconds=30)
    assert shows(small)
    assert len(str(small).splitlines()) <= 12, small
