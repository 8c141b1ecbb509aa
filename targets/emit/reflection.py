"""Tells the reflection about one emission: final names, bindings and conventions.

``compiler/reflection`` knows no language. ``compiled.py`` gives it a ``BackendTable`` for each
profile.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...compiler.diagnostics.source import Span
from ...compiler.ir.program import Block, Program, StoredMember
from ...compiler.ir.stages import CAPTURE
from ...compiler.reflection.tables import (
    BackendTable,
    BindingPoint,
    EmittedFile,
    FieldName,
)
from ..description.profile import Profile
from ..description.shading_language import BindingKind, Language
from ..legalise.bindings import BindingSlot
from .emitter import Emission
from .names import Names


def backend_table(
    program: Program,
    language: Language,
    profile: Profile,
    emission: Emission,
    files: Mapping[str, str],
    *,
    flip_y: bool,
    source_maps: Mapping[str, Mapping[int, Span]],
) -> BackendTable:
    """The table of one emission. ``files`` are names of files, by stage or for ``all`` of them."""
    names, bindings = emission.names, emission.bindings
    sampled = program.sampled
    turned = flip_y and not profile.framebuffer.clip_y_down
    return BackendTable(
        language=language.name,
        files=tuple(
            EmittedFile(stage, files[file.stage], entry)
            for file in emission.files
            for stage, entry in file.entries.items()
        ),
        blocks={
            block.name: _point(
                language, profile, "" if profile.loose_uniforms else names.blocks[block.name],
                bindings.blocks[block.name], "block",
                _members(block, names, profile),
            )
            for block in program.blocks
        },
        buffers={
            buffer.name: _point(
                language, profile,
                names.buffers[buffer.name], bindings.buffers[buffer.name],
                "written" if buffer in program.written else "buffer",
            )
            for buffer in program.buffers
        },
        images={
            image.name: _point(
                language, profile,
                names.images[image.name], bindings.images[image.name], "image",
            )
            for image in program.images
        },
        textures={
            item.name: _point(
                language, profile,
                names.textures[item.name], bindings.textures[item.name], "texture",
            )
            for item in program.resources
        },
        samplers={}
        if profile.samplers.combined
        else {
            item.name: _point(
                language, profile,
                names.samplers[item.name], bindings.samplers[item.name], "sampler",
            )
            for item in program.resources
            if item in sampled
        },
        vertex_inputs={
            field.name: FieldName(names.attributes[field.name], names.semantics[field.name])
            for field in program.vertex_inputs
        },
        captures={
            field.name: FieldName(
                names.varyings[field.name],
                language.semantic("varying", field.name, field.location),
            )
            for output in program.results_of(CAPTURE)
            if (field := output.field) is not None and profile.stream_output
        },
        stream_output=profile.stream_output.told if profile.stream_output else "",
        host_uniforms=emission.host_uniforms,
        clip_depth=profile.framebuffer.clip_depth,
        clip_control=profile.framebuffer.clip_control,
        flip_y=flip_y,
        front_face="cw" if turned else "ccw",
        first_row="bottom" if profile.framebuffer.rows_up != turned else "top",
        source_maps=source_maps,
    )  # fmt: skip


def _members(block: Block, names: Names, profile: Profile) -> dict[str, str]:
    """What the members of a block are called, and those of structures, if hosts have to name them:
    ``Lamp.place``."""
    found = {member.name: names.members[block.name, member.name] for member in _real(block)}
    if profile.loose_uniforms:
        found |= {
            f"{struct.name}.{name}": names.member(struct.name, name)
            for struct in block.structs
            for name, _type in struct.members
        }
    return found


def _real(block: Block) -> list[StoredMember]:
    return [member for member in block.members if member.parameter is not None]


def _point(
    language: Language,
    profile: Profile,
    identifier: str,
    slot: BindingSlot,
    kind: BindingKind,
    members: Mapping[str, str] | None = None,
) -> BindingPoint:
    if not profile.explicit_bindings:
        return BindingPoint(identifier, members=members or {})
    register = language.register(kind, slot.binding)
    return BindingPoint(identifier, slot.set, slot.binding, register, members or {})
