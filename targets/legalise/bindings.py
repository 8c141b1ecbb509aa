"""Assigns a set and a binding to every block, buffer, texture and sampler of a program.

The assignment looks at the whole program, so that its stages agree and the reflection can say what
the text says. In most profiles a number is used once only within a set: DXC maps HLSL's ``b0``,
``t0`` and ``s0`` all to Vulkan's binding 0. Where there are no sets, blocks, textures and samplers
are numbered each on their own (``Profile.numbering``), and storage buffers after the blocks or on
their own, too.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from itertools import count
from typing import Protocol

from ...compiler.ir.leaves import Buffer, Texture
from ...compiler.ir.program import Block, Program
from ...support.frozen import frozen
from ..description.profile import Profile
from ..description.shading_language import BindingKind
from .samplers import sampler_owners


@frozen
class BindingSlot:
    """A place in the binding model."""

    set: int
    binding: int


@frozen
class Bindings:
    """The slots of a program; keys are the program's own names."""

    blocks: Mapping[str, BindingSlot]
    textures: Mapping[str, BindingSlot]
    samplers: Mapping[str, BindingSlot]
    """The slots of samplers, for textures that are read by one. Where the profile combines them, it
    is the texture's own slot; textures that share a sampler have one slot."""
    buffers: Mapping[str, BindingSlot]
    images: Mapping[str, BindingSlot]
    sampler_owners: Mapping[str, str]
    """The texture whose sampler reads a texture."""


def assign_bindings(program: Program, profile: Profile) -> Bindings:
    """Number the blocks of each group, then its buffers, textures and samplers, group by group."""
    blocks: dict[str, BindingSlot] = {}
    buffers: dict[str, BindingSlot] = {}
    images: dict[str, BindingSlot] = {}
    textures: dict[str, BindingSlot] = {}
    samplers: dict[str, BindingSlot] = {}
    owners = sampler_owners(program, profile)
    hosts = {block.name: block.host for block in program.blocks if block.host is not None}
    if profile.numbering == "kind":
        slots: _Slots = _SlotsByKind()
        blocks = {name: slots.free("block", place.group) for name, place in hosts.items()}
    else:
        blocks = {name: BindingSlot(place.group, place.binding) for name, place in hosts.items()}
        slots = _SlotsBySet(frozenset(blocks.values()))
    # Images come first, as devices have fewer bindings for them than for textures.
    for image in program.images:
        set_ = profile.sets.get(image.group, profile.default_set)
        images[image.name] = slots.free("image", set_)
    for group, owned in _by_group(program).items():
        set_ = profile.sets.get(group, profile.default_set)
        for block in sorted(owned.blocks, key=lambda block: block.derived):
            blocks[block.name] = slots.free("block", set_)
        for buffer in owned.buffers:
            kind: BindingKind = "buffer" if profile.numbers_storage_apart else "block"
            buffers[buffer.name] = slots.free(kind, set_)
        for resource in owned.resources:
            texture = textures[resource.name] = slots.free("texture", set_)
            if owners.get(resource.name) == resource.name:
                combined = profile.samplers.combined
                samplers[resource.name] = texture if combined else slots.free("sampler", set_)
    shared = {name: samplers[owner] for name, owner in owners.items()}
    return Bindings(blocks, textures, shared, buffers, images, owners)


class _Slots(Protocol):
    """Hands out binding slots that are still free."""

    def free(self, kind: BindingKind, set_: int) -> BindingSlot:
        """The next free slot for a resource of ``kind`` in a set."""


class _SlotsBySet:
    """Uses a number once in a set, and skips those of blocks that the host has bound itself."""

    def __init__(self, taken: frozenset[BindingSlot]) -> None:
        self._taken = taken
        self._numbers: defaultdict[int, Iterator[int]] = defaultdict(count)

    def free(self, _kind: BindingKind, set_: int) -> BindingSlot:
        slots = (BindingSlot(set_, number) for number in self._numbers[set_])
        return next(slot for slot in slots if slot not in self._taken)


class _SlotsByKind:
    """Uses a number once for each kind; images count as textures.

    The host's own blocks are numbered like others, and before them, since their places may differ
    in the set only.
    """

    def __init__(self) -> None:
        self._numbers: defaultdict[BindingKind, Iterator[int]] = defaultdict(count)

    def free(self, kind: BindingKind, _set: int) -> BindingSlot:
        counted: BindingKind = "texture" if kind == "image" else kind
        return BindingSlot(0, next(self._numbers[counted]))


@frozen(eq=False)
class _Owned:
    """The blocks, buffers and textures of one group, without the blocks that the host has bound."""

    blocks: list[Block]
    buffers: list[Buffer]
    resources: list[Texture]


def _by_group(program: Program) -> dict[str, _Owned]:
    """The blocks, buffers and textures of each group; groups are in the order of the program."""
    found: defaultdict[str, _Owned] = defaultdict(lambda: _Owned([], [], []))
    for block in program.blocks:
        owned = found[block.group].blocks
        if block.host is None:
            owned.append(block)
    for buffer in program.buffers:
        found[buffer.group].buffers.append(buffer)
    for resource in program.textures:
        found[resource.group].resources.append(resource)
    return found
