"""The smallest programs around given parameters: fragment shaders that put out one value."""

from __future__ import annotations

from collections.abc import Sequence

from burnish.compiler.diagnostics.source import Source, Span
from burnish.compiler.ir.build import constant
from burnish.compiler.ir.leaves import HostPlace, Parameter
from burnish.compiler.ir.node import Graph, Node
from burnish.compiler.ir.program import Block, Field, Output, Program, Stage
from burnish.compiler.ir.shader import ExternInfo, ExternMemberInfo, Notes, ParameterInfo, Shader
from burnish.compiler.ir.stages import CLIP_POSITION, FRAGMENT, TARGET, VERTEX
from burnish.compiler.ir.statements import Region
from burnish.compiler.ir.storage import alignment, byte_size, stored_type
from burnish.compiler.ir.types import VEC4, Type
from burnish.compiler.layout import layout_blocks

NOWHERE = Span(Source("host.burnish", ""), 0, 0)

SHOWN = Parameter("shown", VEC4, "material")
"""The parameter that the shader reads, so that no compiler drops the block."""


def program_of(
    parameters: Sequence[Parameter], graph: Graph | None = None, value: Node | None = None
) -> Program:
    """A program whose material block holds ``parameters`` and then ``SHOWN``.

    It puts out ``value``, a vec4 of ``graph``, or ``SHOWN``.
    """
    graph = graph or Graph()
    shown = value or graph.node("parameter", VEC4, (), SHOWN)
    return _showing(graph, layout_blocks([*parameters, SHOWN]), shown)


def extern_program_of(declared: Sequence[tuple[Type, int]]) -> Program:
    """A program that reads a block of the host's: types, each behind a gap of so many bytes."""
    place = HostPlace("Host", 1, 2)
    members: list[ExternMemberInfo] = []
    end = 0
    for number, (type_, gap) in enumerate((*declared, (VEC4, 0))):
        stored = stored_type(type_)
        offset = -(-(end + gap) // alignment(stored)) * alignment(stored)
        parameter = Parameter(f"Host.m{number}", type_, "frame", host=place)
        info = ParameterInfo(parameter, str(type_), "", NOWHERE)
        members.append(ExternMemberInfo(f"m{number}", offset, info))
        end = offset + byte_size(stored)
    extern = ExternInfo(place, "frame", "", NOWHERE, tuple(members))
    graph = Graph()
    shown = graph.node("parameter", VEC4, (), members[-1].info.leaf)
    return _showing(graph, layout_blocks((), externs=(extern,)), shown)


def _showing(graph: Graph, blocks: tuple[Block, ...], shown: Node) -> Program:
    nothing = Region(())
    origin = constant(graph, VEC4, (0.0, 0.0, 0.0, 1.0))
    vertex = Stage(
        row=VERTEX,
        inputs=(),
        blocks=(),
        textures=(),
        functions=(),
        region=nothing,
        results=(Output(CLIP_POSITION, origin),),
    )
    fragment = Stage(
        row=FRAGMENT,
        inputs=(),
        blocks=blocks,
        textures=(),
        functions=(),
        region=nothing,
        results=(Output(TARGET, shown, Field("color", VEC4, 0)),),
    )
    shader = Shader("Sample", "", "Forward", "Rig", graph, Notes(), (), (), (), ())
    return Program(shader, (vertex, fragment), blocks, (), ())
