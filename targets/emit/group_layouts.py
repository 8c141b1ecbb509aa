"""The layouts of bind groups for the reflection: what hosts make pipeline layouts of.

``reflection.py`` asks. A layout lists what is declared, so all materials of a rig have the same
ones in the sets that they share. Blocks and groups have digests of their own; ``binding_id`` is one
of all else that names, numbers and states say in a binding, which sees by it that it is stale.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from ...compiler.documents.backends import (
    BackendRow,
    EntryRow,
    GroupLayoutRow,
    PushConstantsRow,
)
from ...compiler.documents.digests import layout_digest
from ...compiler.ir.leaves import Texture
from ...compiler.ir.program import Program
from ...compiler.ir.stages import IMAGE, TARGET
from ...compiler.ir.texture_bindings import sample_type, sampler_type
from ...compiler.ir.types import Struct
from ..description.profile import Profile
from ..legalise.bindings import Bindings, BindingSlot, Bound


def layout_rows(
    program: Program, profile: Profile, bindings: Bindings
) -> tuple[GroupLayoutRow, ...]:
    """A row for each bind group in which something is declared, by number."""
    if profile.numbering != "set" or not profile.explicit_bindings:
        return ()
    textures = {info.leaf.name: info.leaf for info in program.shader.textures}
    groups: dict[int, dict[int, tuple[Bound, EntryRow]]] = {}
    for bound, slot in bindings.every:
        if _is_listed(bound, slot, profile, bindings):
            entry = _entry(bound, slot, program, profile, textures)
            groups.setdefault(slot.set, {}).setdefault(slot.binding, (bound, entry))
    shared = profile.scheme.shared_sets
    return tuple(
        _group_row(number, groups[number], program, profile, textures, is_shared=number in shared)
        for number in sorted(groups)
    )


def push_constants_row(program: Program, bindings: Bindings) -> PushConstantsRow | None:
    """The block that is push constants."""
    if not bindings.push_constants:
        return None
    (block,) = (b for b in program.blocks if b.name == bindings.push_constants)
    return PushConstantsRow(block=block.name, size=block.size, visibility=_drawn(program))


def _is_listed(bound: Bound, slot: BindingSlot, profile: Profile, bindings: Bindings) -> bool:
    """True for what has an entry in a layout.

    Shared sets have entries for their blocks whether these are there or not, and so has the set of
    draws; of the material's own set, only those that are there. Samplers that are shared with other
    textures have none.
    """
    if bound.kind == "block":
        if bound.name == bindings.push_constants:
            return False
        scheme = profile.scheme
        is_kept = slot.set in scheme.shared_sets or slot.set == scheme.set_of("draw")
        return bound.is_declared or is_kept
    if bound.kind == "sampler":
        return bindings.sampler_owners.get(bound.name, bound.name) == bound.name
    return True


def _group_row(
    number: int,
    bound: Mapping[int, tuple[Bound, EntryRow]],
    program: Program,
    profile: Profile,
    textures: Mapping[str, Texture],
    *,
    is_shared: bool,
) -> GroupLayoutRow:
    entries = tuple(entry for _, (_, entry) in sorted(bound.items()))
    visibility = tuple(row.name for row in profile.stages) if is_shared else _drawn(program)
    facts = [
        (entry.binding, entry.kind, entry.type, str(_type_of(entry, textures))) for entry in entries
    ]
    return GroupLayoutRow(
        group=number,
        layout_id=layout_digest(visibility, facts),
        shared=is_shared,
        visibility=visibility,
        entries=entries,
    )


def _type_of(entry: EntryRow, textures: Mapping[str, Texture]) -> object:
    """The type of a texture, by which views of it have to be made."""
    return textures[entry.name].type if entry.kind in ("texture", "combined") else ""


def _drawn(program: Program) -> tuple[str, ...]:
    """The stages of the shader, be it that one of them has nothing to do."""
    return tuple(row.name for row in program.shader.chain)


def _entry(
    bound: Bound,
    slot: BindingSlot,
    program: Program,
    profile: Profile,
    textures: Mapping[str, Texture],
) -> EntryRow:
    assert bound.kind != "written"
    is_combined = bound.kind == "texture" and profile.samplers.combined
    return EntryRow(
        binding=slot.binding,
        kind="combined" if is_combined else bound.kind,
        type=_word(bound, program, textures),
        name=bound.name,
        read=bound.is_read,
    )


def _word(bound: Bound, program: Program, textures: Mapping[str, Texture]) -> str:
    """WebGPU's word for the type of a binding."""
    match bound.kind:
        case "block":
            return "uniform"
        case "buffer":
            written = {buffer.name for buffer in program.written}
            return "storage" if bound.name in written else "read-only-storage"
        case "image":
            return "write-only"
        case "sampler":
            return sampler_type(textures[bound.name])
        case _:
            texture = textures[bound.name]
            return sample_type(texture, is_filtered=bound.of_rig or _may_filter(texture, program))


def _may_filter(texture: Texture, program: Program) -> bool:
    """True unless the stages only load texels; those of the rig's lights are alike for all."""
    return texture not in program.textures or texture in program.sampled


def binding_id(row: BackendRow, program: Program) -> str:
    """The digest of a row that has none yet."""
    files = [(file.stage, file.file, file.entry_point) for file in row.files]
    places = [
        (kind, name, place.identifier, place.group, place.binding)
        for kind, places in (
            ("block", row.blocks), ("buffer", row.buffers), ("image", row.images),
            ("texture", row.textures), ("sampler", row.samplers),
        )
        for name, place in places.items()
    ]  # fmt: skip
    layouts = [layout.layout_id for layout in row.layouts]
    pushed = row.push_constants and row.push_constants.block
    return layout_digest(files, places, layouts, pushed, row.front_face, *_of_material(program))


def _of_material(program: Program) -> Iterator[object]:
    """What all profiles have in common: textures, buffers, vertex inputs and targets."""
    shader = program.shader
    for info in shader.textures:
        leaf = info.leaf
        yield leaf.name, str(leaf.type), leaf.state, leaf.default, info.intent
    for each in (*shader.buffers, *shader.written):
        element = each.leaf.type.element
        yield each.leaf.name, str(element), _struct_members(element)
    for field in program.vertex_inputs:
        yield field.name, str(field.type), field.location
    for result in (*shader.results_of(IMAGE), *shader.results_of(TARGET)):
        yield result.name, result.state and result.state.format


def _struct_members(element: object) -> list[tuple[str, str]]:
    rows: Iterable[tuple[str, object]] = element.members if isinstance(element, Struct) else ()
    return [(name, str(type_)) for name, type_ in rows]
