"""What compares pixels is refused in loops that only some of them are in, and nowhere else."""

from __future__ import annotations

import pytest

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.diagnostics.source import Source, Span
from burnish.compiler.ir import build
from burnish.compiler.ir.leaves import Attribute, Parameter, Resource
from burnish.compiler.ir.node import Folding, Graph, Node
from burnish.compiler.ir.types import FLOAT, INT, VEC2, VEC4, Texture
from burnish.compiler.semantics.shader import Notes
from burnish.compiler.semantics.uniformity import check_loops

TEXT = "sum i in 0..n : albedo(uv * i).r"
EXPECTED = """\
error[B0352]: a texture read without a level in a loop whose turns differ from pixel to pixel
 --> <test>:1:17
  |
1 | sum i in 0..n : albedo(uv * i).r
  |                 ^^^^^^^^^^^^^^
  = help: say which level: `name.level(coordinate, 0)`, or `name.grad(coordinate, dx, dy)`"""


class Loop:
    """A sum of reads, made by hand: how often is for the test to say."""

    def __init__(self) -> None:
        self.graph = Graph()
        self.report, self.notes = Report(), Notes()
        leaf = self.graph.node("attribute", VEC2, (), Attribute("uv", VEC2))
        self.uv = self.graph.node("interpolate", VEC2, (leaf,), "perspective")

    def number(self, node: Node) -> Node:
        return self.graph.node("call", INT, (build.swizzle(self.graph, node, (0,)),), "to_int")

    def read(self, read: str, place: Node) -> Node:
        texture = self.graph.node("resource", Texture(), (), Resource("t", Texture(), "material"))
        level = () if read == "sample" else (build.floating(self.graph, 0.0),)
        node = self.graph.node("call", VEC4, (texture, place, *level), read)
        self.notes.spans[node.id] = Span(Source("<test>", TEXT), 16, 30)
        return build.swizzle(self.graph, node, (0,))

    def turning(self) -> Node:
        index = self.graph.node("bound", INT, (), 0)
        step = self.graph.node("call", FLOAT, (index,), "to_float")
        return self.graph.node("call", VEC2, (self.uv, step), "mul")

    def told(self, count: Node, body: Node) -> str:
        start = build.floating(self.graph, 0.0)
        loop = self.graph.node("fold", FLOAT, (count, start, body), Folding("add", 8))
        check_loops([loop], self.report, self.notes)
        return render_all(self.report.diagnostics)


def test_a_read_whose_turns_differ() -> None:
    loop = Loop()
    assert loop.told(loop.number(loop.uv), loop.read("sample", loop.turning())) == EXPECTED


@pytest.mark.parametrize("read", ["sample", "sample_level"])
def test_reads_that_all_pixels_make(read: str) -> None:
    loop = Loop()
    count = loop.graph.node("parameter", INT, (), Parameter("n", INT, "material"))
    assert loop.told(count, loop.read(read, loop.turning())) == ""


def test_a_read_that_is_made_before_the_loop() -> None:
    loop = Loop()
    assert loop.told(loop.number(loop.uv), loop.read("sample", loop.uv)) == ""


def test_a_read_that_names_its_level() -> None:
    loop = Loop()
    assert loop.told(loop.number(loop.uv), loop.read("sample_level", loop.turning())) == ""
