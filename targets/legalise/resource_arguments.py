"""Finds what every function reads from outside, for languages without global resources.

In such a language (``Language.resource_arguments``) an entry point gets all that its stage reads as
arguments. In every language, a function that an engine calls does. A function gets what it reads
itself, or hands on to the functions that it calls. Samplers go with their textures.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...compiler.ir.leaves import Buffer, Parameter, Texture
from ...compiler.ir.node import Node
from ...compiler.ir.program import Program, Stage, StageName
from ...support.frozen import frozen
from ..description.shading_language import Language


@frozen
class Passed:
    """The blocks, buffers and textures that a function gets as arguments.

    They have their names in the program, and its order.
    """

    blocks: tuple[str, ...] = ()
    buffers: tuple[str, ...] = ()
    textures: tuple[str, ...] = ()


NOTHING = Passed()

ResourceArguments = Mapping[tuple[StageName, Node], Passed]
"""The resources of functions, by stage and the function's body. Functions that read none are left
out."""


def resource_arguments(program: Program, language: Language) -> ResourceArguments:
    """The resources that each function of ``program`` gets; empty if they are global variables."""
    if not (language.resource_arguments or program.has_functions):
        return {}
    return {
        (stage.name, body): passed
        for stage in program.stages
        for body, passed in _passed(program, stage).items()
        if passed != NOTHING
    }


def _passed(program: Program, stage: Stage) -> dict[Node, Passed]:
    """The resources that each function of a stage gets; functions follow those that they call."""
    owners = {
        member.parameter: block.name
        for block in program.blocks
        for member in block.members
        if member.parameter is not None
    }
    found: dict[Node, Passed] = {}
    for function in stage.functions:
        blocks: set[str] = set()
        buffers: set[str] = set()
        textures: set[str] = set()
        for node in function.nodes:
            if isinstance(node.data, Parameter):
                blocks.add(owners[node.data])
            elif isinstance(node.data, Buffer):
                buffers.add(node.data.name)
            elif isinstance(node.data, Texture):
                textures.add(node.data.name)
            elif node.op == "apply":
                inner = found[node.operands[0]]
                blocks.update(inner.blocks)
                buffers.update(inner.buffers)
                textures.update(inner.textures)
        found[function.body] = Passed(
            tuple(block.name for block in program.blocks if block.name in blocks),
            tuple(buffer.name for buffer in program.buffers if buffer.name in buffers),
            tuple(texture.name for texture in program.textures if texture.name in textures),
        )
    return found
