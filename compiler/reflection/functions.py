"""The document of functions, made of a program of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

from ..documents.functions import (
    ArgumentRow,
    FunctionMemberRow,
    FunctionRow,
    Functions,
    FunctionsBackendRow,
    FunctionTextureRow,
    OwnPassRow,
    SlotRow,
)
from ..ir.default_textures import OF_SAMPLES
from ..ir.functions import OwnPass, SlotInfo
from ..ir.program import Program, Stage
from ..ir.shader import ArgumentInfo, ParameterInfo, TextureInfo
from ..ir.types import TextureType
from .parameters import choices_of
from .roles import role_of
from .textures import sampler_state

LIGHTS = "rig"


def functions_document(
    program: Program,
    slots: Sequence[SlotInfo],
    own_pass: OwnPass | None,
    backends: Mapping[str, FunctionsBackendRow],
) -> Functions:
    """Everything that an engine has to know; ``slots`` are those of all results, in order."""
    shader = program.shader
    described = iter(slots)
    functions = tuple(
        _function(stage, [next(described) for _ in stage.results]) for stage in program.stages
    )
    read = {info.leaf for stage in program.stages for info in stage.arguments}
    arguments = tuple(_argument(info) for info in shader.arguments if info.leaf in read)
    is_lit = any(row.group == LIGHTS for row in arguments)
    return Functions(
        signatures=1,
        material=shader.name,
        doc=shader.doc,
        rig=shader.rig_name if is_lit else None,
        own_pass=None if own_pass is None else _own_pass(own_pass),
        functions=functions,
        arguments=arguments,
        textures=tuple(
            _texture(info, program) for info in shader.textures if info.leaf in program.textures
        ),
        backends=backends,
    )


def _own_pass(given: OwnPass) -> OwnPassRow:
    return OwnPassRow(name=given.name, cull=given.cull, blend=given.blend, covers=given.covers)


def _function(stage: Stage, slots: Sequence[SlotInfo]) -> FunctionRow:
    return FunctionRow(
        name=stage.name,
        stage=stage.row.name,
        slots=tuple(
            SlotRow(
                name=slot.name, type=slot.declared_type,
                representation=str(output.value.type), doc=slot.doc, role=slot.word or None,
            )
            for slot, output in zip(slots, stage.results, strict=True)
        ),
        arguments=tuple(info.leaf.name for info in stage.arguments),
        textures=tuple(texture.name for texture in stage.textures),
    )  # fmt: skip


def _argument(info: ArgumentInfo) -> ArgumentRow:
    is_between = info.source in ("surface", "attribute", "varying")
    flat: Literal["perspective", "flat"] = "flat" if info.mode == "flat" else "perspective"
    parameter = info.parameter
    return ArgumentRow(
        name=info.leaf.name,
        source=info.source,
        given=info.name_there,
        type=info.declared_type or str(info.leaf.type),
        representation=str(info.leaf.type),
        interpolation=flat if is_between else None,
        doc=info.doc if parameter is None else parameter.doc,
        group=None if parameter is None else parameter.leaf.group,
        default=None if parameter is None else parameter.default,
        range=None if parameter is None else parameter.range,
        choices=None if parameter is None else choices_of(parameter.leaf),
        library=None if parameter is None else parameter.library or None,
        role=None if parameter is None else role_of(parameter),
        members=() if parameter is None else tuple(map(_member, parameter.members)),
    )


def _member(info: ParameterInfo) -> FunctionMemberRow:
    return FunctionMemberRow(
        name=info.leaf.short_name,
        type=info.declared_type,
        representation=str(info.leaf.type),
        default=info.default,
        doc=info.doc,
    )


def _texture(info: TextureInfo, program: Program) -> FunctionTextureRow:
    texture, type_ = info.leaf, info.leaf.type
    assert isinstance(type_, TextureType)
    return FunctionTextureRow(
        name=texture.name,
        type=str(type_),
        dimension=type_.dimension,
        sample=type_.sample,
        intent=info.intent or "data",
        state=sampler_state(texture) if texture in program.sampled else None,
        default=texture.default,
        default_texel=OF_SAMPLES[type_.sample][texture.default],
        doc=info.doc,
        library=info.library or None,
    )
