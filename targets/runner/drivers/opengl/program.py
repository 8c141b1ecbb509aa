"""Links the program of a pipeline, and checks that all of its inputs are bound."""

from __future__ import annotations

from collections.abc import Iterable

import moderngl

from ..checks import check_block_size, lane_count
from ..device import DriverError
from ..pipeline import Pipeline
from .bindings import Linked, bound_at
from .context import Functions

KINDS = {"float32": "f", "sint32": "i", "uint32": "u"}
"""moderngl's letter for the lanes of a ``VertexFormat``."""


def link(context: moderngl.Context, functions: Functions, pipeline: Pipeline) -> moderngl.Program:
    """Compile and link; where the text does not bind blocks and textures itself, bind them.

    Raises ``DriverError`` with the driver's log, or if the text and the pipeline disagree.
    """
    try:
        texts = {name: code.text for name, code in pipeline.stages.items()}
        program = context.program(
            vertex_shader=texts["vertex"],
            tess_control_shader=texts.get("control"),
            tess_evaluation_shader=texts.get("evaluation"),
            geometry_shader=texts.get("geometry"),
            fragment_shader=texts.get("fragment"),
            varyings=_captured_by_name(pipeline),
        )
    except moderngl.Error as error:
        raise DriverError(str(error).strip()) from None
    _refuse_strangers(program, pipeline)
    _number(functions, program, pipeline)
    return program


def link_kernel(
    context: moderngl.Context, functions: Functions, pipeline: Pipeline
) -> moderngl.ComputeShader:
    """Compile and link a kernel; bind its blocks and textures if its text does not."""
    (code,) = pipeline.stages.values()
    try:
        program = context.compute_shader(code.text)
    except moderngl.Error as error:
        raise DriverError(str(error).strip()) from None
    _refuse_strangers(program, pipeline)
    _number(functions, program, pipeline)
    return program


def _captured_by_name(pipeline: Pipeline) -> tuple[str, ...]:
    """The captured outputs, in order, if the text does not list them itself."""
    captured = pipeline.stream_output
    if captured is None or captured.in_text:
        return ()
    return tuple(output.identifier for output in captured.outputs)


def _number(functions: Functions, program: Linked, pipeline: Pipeline) -> None:
    """Give blocks and textures that the text does not bind their numbers in the pipeline."""
    for number, block in enumerate(pipeline.blocks):
        member = program.get(block.place.identifier, None)
        if isinstance(member, moderngl.UniformBlock):
            check_block_size(block, member.size)
            if block.place.binding is None:
                member.binding = number
    functions.glUseProgram(program.glo)
    for number, slot in enumerate(pipeline.textures):
        sampler = program.get(slot.texture.identifier, None)
        if isinstance(sampler, moderngl.Uniform) and slot.texture.binding is None:
            # moderngl does not know all types of samplers.
            functions.glUniform1i(sampler.location, number)


def attribute_layout(format: str) -> str:
    """A ``VertexFormat`` as moderngl spells it: ``3f`` for ``float32x3``."""
    return f"{lane_count(format)}{KINDS[format.partition('x')[0]]}"


def _refuse_strangers(program: Linked, pipeline: Pipeline) -> None:
    """Refuse inputs that the pipeline does not have: OpenGL would read zeros, or binding 0."""
    kinds = {slot.identifier: attribute_layout(slot.format)[-1] for slot in pipeline.inputs}
    _require("vertex attribute", kinds, _members(program, moderngl.Attribute))
    blocks = {slot.place.identifier for slot in pipeline.blocks}
    _require("uniform block", blocks, _members(program, moderngl.UniformBlock))
    places = {bound_at(slot.place, number) for number, slot in enumerate(pipeline.buffers)}
    for name in program:
        member = program[name]
        if isinstance(member, moderngl.StorageBlock) and member.binding not in places:
            raise DriverError(f"the shader reads storage buffer {name!r}, which nobody binds")
    uniforms = {slot.texture.identifier for slot in pipeline.textures} | {*pipeline.host_uniforms}
    uniforms |= {slot.place.identifier for slot in pipeline.images}
    uniforms |= {each.identifier for block in pipeline.blocks for each in block.uniforms}
    _require("uniform", uniforms, _members(program, moderngl.Uniform))
    for name, kind in kinds.items():
        attribute = program.get(name, None)
        # moderngl also says ``i`` for unsigned attributes; and its stubs say that the letter is an
        # int.
        if isinstance(attribute, moderngl.Attribute) and (
            (str(attribute.shape) == "f") != (kind == "f")
        ):
            raise DriverError(f"vertex attribute {name!r} is of another kind in the shader")


def _members(program: Linked, kind: type) -> list[str]:
    return [name for name in program if isinstance(program[name], kind)]


def _require(what: str, filled: Iterable[str], read: Iterable[str]) -> None:
    for name in read:
        if name not in filled and not name.startswith("gl_"):
            raise DriverError(f"the shader reads {what} {name!r}, which the job does not have")
