"""Lists what a host binds for each profile, and the texts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ..compiler.documents.backends import BackendRow, BindingRow, BlockBindingRow
from ..compiler.documents.reflection import Reflection
from ..compiler.ir.stages import STAGES
from .materials import Block, Bound, Profile, Text

COMPUTE = ("compute",)


def profiles_of(
    reflection: Reflection, blocks: Sequence[Block], texts: Mapping[str, str], stem: str
) -> tuple[Profile, ...]:
    """The profiles of a material, in the order of their names."""
    return tuple(
        Profile(
            name=name, row=row, bound=tuple(_bound(reflection, row, blocks)),
            texts=tuple(_texts(row, texts, stem)),
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
    found = [
        *_blocks(reflection, backend, blocks),
        *_buffers(reflection, backend),
        *_textures(reflection, backend),
    ]
    yield from sorted(found, key=lambda each: (each.group or 0, each.binding or 0))


def _blocks(
    reflection: Reflection, backend: BackendRow, blocks: Sequence[Block]
) -> Iterator[Bound]:
    names = {each.plain_name: each.name for each in blocks}
    for row in reflection.blocks:
        if (place := backend.blocks.get(row.name)) is not None:
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
