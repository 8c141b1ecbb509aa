"""A linked program whose every input is known to be filled."""

from __future__ import annotations

from collections.abc import Iterable

import moderngl

from ..checks import check_block_size, lane_count
from ..draw import DriverError, Pipeline
from .context import Functions

KINDS = {"float32": "f", "sint32": "i", "uint32": "u"}
"""From the kind of a ``VertexFormat`` to moderngl's letter."""


def link(context: moderngl.Context, functions: Functions, pipeline: Pipeline) -> moderngl.Program:
    """Compiles and links, and gives every block and texture a binding: its number in the pipeline.

    Raises ``DriverError`` with the driver's log, and where the text and the pipeline disagree.
    """
    try:
        program = context.program(pipeline.stages["vertex"].text, pipeline.stages["fragment"].text)
    except moderngl.Error as error:
        raise DriverError(str(error).strip()) from None
    _refuse_strangers(program, pipeline)
    for number, block in enumerate(pipeline.blocks):
        member = program.get(block.place.identifier, None)
        if isinstance(member, moderngl.UniformBlock):
            check_block_size(block, member.size)
            member.binding = number
    functions.glUseProgram(program.glo)
    for number, slot in enumerate(pipeline.textures):
        sampler = program.get(slot.texture.identifier, None)
        if isinstance(sampler, moderngl.Uniform):
            # moderngl does not know samplers of all kinds.
            functions.glUniform1i(sampler.location, number)
    return program


def attribute_layout(format: str) -> str:
    """A ``VertexFormat`` as moderngl spells it: ``float32x3`` is ``3f``."""
    return f"{lane_count(format)}{KINDS[format.partition('x')[0]]}"


def _refuse_strangers(program: moderngl.Program, pipeline: Pipeline) -> None:
    """OpenGL itself reads zeros, or whatever is bound to 0, for what nobody has filled."""
    kinds = {slot.identifier: attribute_layout(slot.format)[-1] for slot in pipeline.inputs}
    _require("vertex attribute", kinds, _members(program, moderngl.Attribute))
    blocks = {slot.place.identifier for slot in pipeline.blocks}
    _require("uniform block", blocks, _members(program, moderngl.UniformBlock))
    uniforms = {slot.texture.identifier for slot in pipeline.textures} | {*pipeline.host_uniforms}
    _require("uniform", uniforms, _members(program, moderngl.Uniform))
    for name, kind in kinds.items():
        attribute = program.get(name, None)
        # moderngl says ``i`` of unsigned attributes too; and its stubs, that the letter is an int.
        if isinstance(attribute, moderngl.Attribute) and (
            (str(attribute.shape) == "f") != (kind == "f")
        ):
            raise DriverError(f"vertex attribute {name!r} is of another kind in the shader")


def _members(program: moderngl.Program, kind: type) -> list[str]:
    return [name for name in program if isinstance(program[name], kind)]


def _require(what: str, filled: Iterable[str], read: Iterable[str]) -> None:
    for name in read:
        if name not in filled and not name.startswith("gl_"):
            raise DriverError(f"the shader reads {what} {name!r}, which the job does not have")
