"""Tells the reflection about one emission: final names, bindings and conventions.

``compiler/reflection`` knows no language. ``compiled.py`` gives it a row for each profile.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypedDict

from ...compiler.diagnostics.source import Span
from ...compiler.documents.backends import (
    BackendRow,
    BindingRow,
    BlockBindingRow,
    FileRow,
    SourceMapRow,
    VertexInputNameRow,
)
from ...compiler.ir.program import Block, Program, StoredMember
from ...compiler.ir.render_state import Winding
from ...compiler.ir.stages import CAPTURE
from ..description.profile import Profile
from ..description.shading_language import BindingKind, Language
from ..legalise.bindings import BindingSlot
from .emitter import Emission
from .names import Names


def backend_row(
    program: Program,
    language: Language,
    profile: Profile,
    emission: Emission,
    files: Mapping[str, str],
    *,
    front: Winding,
    flip_y: bool,
    source_maps: Mapping[str, Mapping[int, Span]],
) -> BackendRow:
    """The row of one emission.

    ``files`` are names of files, by stage or for ``all`` of them; ``front`` is the winding of front
    faces, and ``source_maps`` has, by the name of a file, the place in Burnish's text for each
    line.
    """
    names, bindings = emission.names, emission.bindings
    sampled = program.sampled
    turned = flip_y and not profile.framebuffer.clip_y_down
    return BackendRow(
        language=language.name,
        files=tuple(
            FileRow(stage=stage, file=files[file.stage], entry_point=entry)
            for file in emission.files
            for stage, entry in file.entries.items()
        ),
        blocks={
            block.name: BlockBindingRow(
                **_point(
                    language, profile, "" if profile.loose_uniforms else names.blocks[block.name],
                    bindings.blocks[block.name], "block",
                ),
                members=_members(block, names, profile),
            )
            for block in program.blocks
        },
        buffers={
            buffer.name: BindingRow(**_point(
                language, profile,
                names.buffers[buffer.name], bindings.buffers[buffer.name],
                "written" if buffer in program.written else "buffer",
            ))
            for buffer in program.buffers
        },
        images={
            image.name: BindingRow(**_point(
                language, profile,
                names.images[image.name], bindings.images[image.name], "image",
            ))
            for image in program.images
        },
        textures={
            item.name: BindingRow(**_point(
                language, profile,
                names.textures[item.name], bindings.textures[item.name], "texture",
            ))
            for item in program.textures
        },
        samplers={}
        if profile.samplers.combined
        else {
            item.name: BindingRow(**_point(
                language, profile,
                names.samplers[item.name], bindings.samplers[item.name], "sampler",
            ))
            for item in program.textures
            if item in sampled
        },
        vertex_inputs={
            field.name: _name(names.attributes[field.name], names.semantics[field.name])
            for field in program.vertex_inputs
        },
        captures={
            field.name: _name(
                names.varyings[field.name],
                language.semantic("varying", field.name, field.location),
            )
            for output in program.results_of(CAPTURE)
            if (field := output.field) is not None and profile.stream_output
        },
        stream_output=profile.stream_output.told if profile.stream_output else None,
        host_uniforms=emission.host_uniforms,
        clip_depth=profile.framebuffer.clip_depth,
        clip_control=profile.framebuffer.clip_control,
        flip_y=flip_y,
        front_face="cw" if (front == "clockwise") != turned else "ccw",
        first_row="bottom" if profile.framebuffer.rows_up != turned else "top",
        source_maps={name: _source_map(spans) for name, spans in sorted(source_maps.items())},
    )  # fmt: skip


def _members(block: Block, names: Names, profile: Profile) -> dict[str, str]:
    """The names of a block's members, for a host.

    Those of structures are among them if hosts have to name them: ``Lamp.place``.
    """
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


class _Place(TypedDict):
    """The fields of a row that say where something is bound."""

    identifier: str
    group: int | None
    binding: int | None
    register: str | None


def _point(
    language: Language, profile: Profile, identifier: str, slot: BindingSlot, kind: BindingKind
) -> _Place:
    if not profile.explicit_bindings:
        return {"identifier": identifier, "group": None, "binding": None, "register": None}
    return {
        "identifier": identifier,
        "group": slot.set,
        "binding": slot.binding,
        "register": language.register(kind, slot.binding) or None,
    }


def _name(identifier: str, semantic: str) -> VertexInputNameRow:
    return VertexInputNameRow(identifier=identifier, semantic=semantic or None)


def _source_map(spans: Mapping[int, Span]) -> SourceMapRow:
    """Rows of a line of the text, and of source, line, column and length in Burnish."""
    sources = tuple({span.source.name_in_outputs: None for span in spans.values()})
    numbers = {source: number for number, source in enumerate(sources)}
    return SourceMapRow(
        sources=sources,
        lines=tuple(
            (
                line,
                numbers[span.source.name_in_outputs],
                *span.source.position(span.start),
                span.end - span.start,
            )
            for line, span in sorted(spans.items())
        ),
    )
