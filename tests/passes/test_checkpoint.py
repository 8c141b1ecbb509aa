"""Graphs are printed between passes for those who change these."""

from __future__ import annotations

import re

import pytest

import burnish
from burnish.compiler.ir.build import constant
from burnish.compiler.ir.node import Graph
from burnish.compiler.ir.types import FLOAT, VEC2
from burnish.compiler.watching import SHOWN

SOURCE = "material M { param k : float = 2\n color = vec3(uv.y / k) }\n"


def test_nodes_print_as_they_are_read() -> None:
    graph = Graph()
    two = constant(graph, FLOAT, 2.0)
    both = graph.node("vector", VEC2, (two, two))
    native = graph.node("native", VEC2, (both, two), "div")
    last = graph.node("swizzle", FLOAT, (native,), (1,))
    assert [str(node) for node in (two, both, native, last)] == [
        "%0 = 2.0 : float",
        "%1 = vector(%0, %0) : vec2",
        "%2 = native div(%1, %0) : vec2",
        "%3 = swizzle .y(%2) : float",
    ]


def test_variables_are_named_where_they_are_bound(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(SHOWN, "open_binders")
    burnish.compile(
        "material M {\n"
        "    param steps : int in 1..9 = 3\n"
        "    summed = sum i in 0..steps : uv.x / float(i + 1)\n"
        "    root   = iterate r from 1.0 up to 5 while r * r < uv.y : r + 0.25\n"
        "    color  = vec3(summed, root, 0)\n"
        "}\n",
        (),
    )
    said = capsys.readouterr().err
    assert re.search(r"^  %\d+ = fold add 9 \[i\]\(%\d+, %\d+, %\d+\) : float$", said, re.MULTILINE)
    assert re.search(r"^  %\d+ = iterate 5 \[\w+, r\]\(%\d+, .*\) : float$", said, re.MULTILINE)


def test_the_graph_after_a_pass(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(SHOWN, "simplify,guard")
    burnish.compile(SOURCE, ())
    said = capsys.readouterr().err
    assert re.findall("^after (.*):$", said, re.MULTILINE) == ["simplify", "guard"]
    assert said.startswith("shader M:\nafter simplify:\n")
    before, after = said.split("after guard")
    assert re.search(r"^  %\d+ = div\(%\d+, %\d+\) : float$", before, re.MULTILINE)
    assert re.search(r"^  %\d+ = native div\(%\d+, %\d+\) : float$", after, re.MULTILINE)


def test_a_name_that_no_pass_has(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(SHOWN, "guards, simplify")
    burnish.compile(SOURCE, ())
    said = capsys.readouterr().err
    assert said.startswith("BURNISH_SHOW: no pass is called `guards`; there are semantics, ")
    assert said.count("BURNISH_SHOW") == 1
    assert "after simplify:" in said
