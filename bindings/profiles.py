"""Lists what a host binds for each profile, and the texts.

A group that materials share is listed as it is declared, so that all of them have one layout.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ..compiler.documents.backends import (
    BackendRow,
    BindingRow,
    BlockBindingRow,
    EntryRow,
    GroupLayoutRow,
)
from ..compiler.documents.reflection import Reflection
from ..compiler.ir.stages import STAGES
from ..support.frozen import changed
from .materials import Block, Bound, Profile, Text

COMPUTE = ("compute",)
_KINDS = {"block": "uniform", "buffer": "storage"}
"""The kinds of entries that have another name here."""


def profiles_of(
    reflection: Reflection, blocks: Sequence[Block], texts: Mapping[str, str], stem: str
) -> tuple[Profile, ...]:
    """The profiles of a material, in the order of their names."""
    return tuple(
        Profile(
            name=name, row=row, binding_id=row.binding_id,
            bound=tuple(_bound(reflection, row, blocks)), texts=tuple(_texts(row, texts, stem)),
        )
        for name, row in sorted(reflection.backends.items())
    )  # fmt: skip


def _texts(row: BackendRow, texts: Mapping[str, str], stem: str) -> Iterator[Text]:
    for file in row.files:
        yield Text(
            stage=file.stage, file=file.file, entry_point=file.entry_point,
            text=texts.get(file.file), module=f"{stem}.{STAGES[file.stage].suffix}",
        )  # fmt: skip


def _bound(reflection: Reflection, backend: BackendRow, blocks: Sequence[Block]) -> Iterator[Bound]:
    """What is bound, by its group and binding; in the order of the reflection without them."""
    declared: Declared = {
        (layout.group, entry.binding): (layout, entry)
        for layout in backend.layouts
        for entry in layout.entries
    }
    read = [
        *_blocks(reflection, backend, blocks),
        *_buffers(reflection, backend),
        *_textures(reflection, backend),
    ]
    found = [_declared(each, declared) for each in read if _is_owner(each, declared)]
    places = {(each.group, each.binding) for each in found}
    found += [
        _unread(*rows) for place, rows in declared.items() if rows[0].shared and place not in places
    ]
    yield from sorted(found, key=lambda each: (each.group or 0, each.binding or 0))


Declared = Mapping[tuple[int | None, int | None], tuple[GroupLayoutRow, EntryRow]]
"""The entries of layouts by group and number."""


def _is_owner(bound: Bound, declared: Declared) -> bool:
    """False for the sampler of a texture that is read by the sampler of another one."""
    _, entry = declared.get((bound.group, bound.binding), (None, None))
    return bound.kind != "sampler" or entry is None or entry.name == bound.name


def _declared(bound: Bound, declared: Declared) -> Bound:
    """What is read, with what its layout says of it."""
    layout, entry = declared.get((bound.group, bound.binding), (None, None))
    if layout is None or entry is None:
        return bound
    kind = entry.kind if entry.kind == "combined" else bound.kind
    if not layout.shared:
        return changed(bound, kind=kind, type=entry.type)
    return changed(bound, kind=kind, type=entry.type, stages=layout.visibility, is_shared=True)


def _unread(layout: GroupLayoutRow, entry: EntryRow) -> Bound:
    """What is declared in a shared group, and read by no stage of this material."""
    return Bound(
        name=entry.name, kind=_KINDS.get(entry.kind, entry.kind), group=layout.group,
        binding=entry.binding, register=None, identifier="", stages=layout.visibility,
        type=entry.type, is_shared=True, is_read=False,
    )  # fmt: skip


def _blocks(
    reflection: Reflection, backend: BackendRow, blocks: Sequence[Block]
) -> Iterator[Bound]:
    names = {each.plain_name: each.name for each in blocks}
    pushed = backend.push_constants
    for row in reflection.blocks:
        if (place := backend.blocks.get(row.name)) is None:
            continue
        if pushed is not None and pushed.block == row.name:
            yield _at(place, names[row.name], "push-constants", pushed.visibility, pushed.size)
        else:
            yield _at(place, names[row.name], "uniform", row.stages, row.size)


def _buffers(reflection: Reflection, backend: BackendRow) -> Iterator[Bound]:
    for row in reflection.buffers:
        if (place := backend.buffers.get(row.name)) is not None:
            yield _at(place, row.name, "storage", row.stages)
    for result in reflection.results:
        if (place := backend.buffers.get(result.name)) is not None:
            yield _at(place, result.name, "result", COMPUTE)
    for name, place in backend.images.items():
        yield _at(place, name, "image", COMPUTE)


def _textures(reflection: Reflection, backend: BackendRow) -> Iterator[Bound]:
    for row in reflection.textures:
        if (place := backend.textures.get(row.name)) is not None:
            yield _at(place, row.name, "texture", row.stages)
        if (place := backend.samplers.get(row.name)) is not None:
            yield _at(place, row.name, "sampler", row.stages)


def _at(
    place: BindingRow | BlockBindingRow,
    name: str,
    kind: str,
    stages: tuple[str, ...],
    size: int = 0,
) -> Bound:
    return Bound(
        name=name, kind=kind, group=place.group, binding=place.binding, register=place.register,
        identifier=place.identifier, stages=stages, size=size,
    )  # fmt: skip
