"""Tells the reflection about one emission: final names, bindings and conventions.

``compiler/reflection`` knows no language. ``compiled.py`` gives it a row for each profile.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, TypedDict

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
from ...support.frozen import changed
from ..description.binding_scheme import BindingKind
from ..description.profile import Profile
from ..description.shading_language import Language
from ..legalise.bindings import BindingSlot
from ..legalise.limits import demands
from .emitter import Emission
from .group_layouts import binding_id, layout_rows, push_constants_row
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
    names, bound = emission.names, _Bindings(language, profile, emission)
    turned = flip_y and not profile.framebuffer.clip_y_down
    row = BackendRow(
        language=language.name,
        files=_file_rows(emission, files),
        blocks={each.name: bound.block(each) for each in program.blocks},
        buffers={
            each.name: bound.buffer(each.name, is_written=each in program.written)
            for each in program.buffers
        },
        images={each.name: bound.image(each.name) for each in program.images},
        textures={each.name: bound.texture(each.name) for each in program.textures},
        samplers={
            each.name: bound.sampler(each.name)
            for each in program.textures
            if each in program.sampled and not profile.samplers.combined
        },
        layouts=layout_rows(program, profile, emission.bindings),
        push_constants=push_constants_row(program, emission.bindings),
        vertex_inputs={
            field.name: _name(names.attributes[field.name], names.semantics[field.name])
            for field in program.vertex_inputs
        },
        captures=_captures(program, language, names) if profile.stream_output else {},
        stream_output=profile.stream_output.told if profile.stream_output else None,
        host_uniforms=emission.host_uniforms,
        required_limits={
            profile.limit_names[demand.limit_name]: demand.count
            for demand in demands(program, profile)
        },
        clip_depth=profile.framebuffer.clip_depth,
        clip_control=profile.framebuffer.clip_control,
        flip_y=flip_y,
        front_face="cw" if (front == "clockwise") != turned else "ccw",
        first_row="bottom" if profile.framebuffer.rows_up != turned else "top",
        source_maps={name: _source_map(spans) for name, spans in sorted(source_maps.items())},
        binding_id="",
    )
    return changed(row, binding_id=binding_id(row, program))


def _file_rows(emission: Emission, files: Mapping[str, str]) -> tuple[FileRow, ...]:
    return tuple(
        FileRow(stage=stage, file=files[file.stage], entry_point=entry)
        for file in emission.files
        for stage, entry in file.entries.items()
    )


def _captures(program: Program, language: Language, names: Names) -> dict[str, VertexInputNameRow]:
    """The names of captured varyings, for a host."""
    fields = (result.field for result in program.results_of(CAPTURE))
    return {
        field.name: _name(
            names.varyings[field.name], language.semantic("varying", field.name, field.location)
        )
        for field in fields
        if field is not None
    }


if TYPE_CHECKING:  # Python would compile the annotations while it loads this module.

    class _Place(TypedDict):
        """The fields of a row that say where something is bound."""

        identifier: str
        group: int | None
        binding: int | None
        register: str | None


class _Bindings:
    """Makes the rows of everything that a host binds."""

    def __init__(self, language: Language, profile: Profile, emission: Emission) -> None:
        self._language = language
        self._profile = profile
        self._names = emission.names
        self._slots = emission.bindings

    def block(self, block: Block) -> BlockBindingRow:
        """The row of a uniform block; a block of loose uniforms has no name in the text."""
        name = "" if self._profile.loose_uniforms else self._names.blocks[block.name]
        place = self._place(name, self._slots.blocks[block.name], "block")
        if block.name == self._slots.push_constants:
            place = {"identifier": name, "group": None, "binding": None, "register": None}
        return BlockBindingRow(**place, members=_members(block, self._names, self._profile))

    def buffer(self, name: str, *, is_written: bool) -> BindingRow:
        """The row of a storage buffer."""
        kind: BindingKind = "written" if is_written else "buffer"
        return BindingRow(**self._place(self._names.buffers[name], self._slots.buffers[name], kind))

    def image(self, name: str) -> BindingRow:
        """The row of an image that a kernel writes."""
        return BindingRow(
            **self._place(self._names.images[name], self._slots.images[name], "image")
        )

    def texture(self, name: str) -> BindingRow:
        """The row of a texture, or of a texture with its sampler where a language has them."""
        return BindingRow(
            **self._place(self._names.textures[name], self._slots.textures[name], "texture")
        )

    def sampler(self, name: str) -> BindingRow:
        """The row of a texture's sampler."""
        return BindingRow(
            **self._place(self._names.samplers[name], self._slots.samplers[name], "sampler")
        )

    def _place(self, identifier: str, slot: BindingSlot, kind: BindingKind) -> _Place:
        if not self._profile.explicit_bindings:
            return {"identifier": identifier, "group": None, "binding": None, "register": None}
        return {
            "identifier": identifier,
            "group": slot.set,
            "binding": slot.binding,
            "register": self._language.register(kind, slot.binding) or None,
        }


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
