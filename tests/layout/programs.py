"""The smallest programs around given parameters: fragment shaders that put out one value."""

from __future__ import annotations

from collections.abc import Sequence

from burnish.compiler.ir.build import constant
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Graph, Node
from burnish.compiler.ir.program import Field, Program, Region, Stage
from burnish.compiler.ir.types import VEC4
from burnish.compiler.layout import layout_blocks

SHOWN = Parameter("shown", VEC4, "material")
"""The parameter that the shader reads, so that no compiler drops the block."""


def program_of(
    parameters: Sequence[Parameter], graph: Graph | None = None, value: Node | None = None
) -> Program:
    """A program whose material block holds ``parameters`` and then ``SHOWN``.

    It puts out ``value``, a vec4 of ``graph``, or ``SHOWN``.
    """
    graph = graph or Graph()
    blocks = layout_blocks([*parameters, SHOWN])
    nothing = Region(())
    vertex = Stage(
        name="vertex",
        inputs=(),
        outputs=(),
        blocks=(),
        resources=(),
        functions=(),
        region=nothing,
        position=constant(graph, VEC4, (0.0, 0.0, 0.0, 1.0)),
        results=(),
        discard=None,
    )
    fragment = Stage(
        name="fragment",
        inputs=(),
        outputs=(Field("color", VEC4, 0),),
        blocks=blocks,
        resources=(),
        functions=(),
        region=nothing,
        position=None,
        results=(value or graph.node("parameter", VEC4, (), SHOWN),),
        discard=None,
    )
    return Program("Sample", "", vertex, fragment, blocks, (), ())
