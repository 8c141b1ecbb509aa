"""Which set and binding every block, texture and sampler of a program has.

The assignment looks at the whole program, so that its stages agree and the reflection can say what
the text says. Within a set a number is used once only: DXC maps HLSL's ``b0``, ``t0`` and ``s0``
all to Vulkan's binding 0.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import count

from ...compiler.ir.leaves import Resource
from ...compiler.ir.program import Block, Program
from ...frozen import frozen
from ..emit.description import Profile


@frozen
class Slot:
    """A place in the binding model."""

    set: int
    binding: int


@frozen
class Bindings:
    """The slots of a program; keys are the program's own names."""

    blocks: Mapping[str, Slot]
    textures: Mapping[str, Slot]
    samplers: Mapping[str, Slot]
    """Of textures that are read by one; the texture's own slot where the profile combines them."""


def assign_bindings(program: Program, profile: Profile) -> Bindings:
    """Number the blocks of each group, then its textures and samplers, group by group."""
    blocks: dict[str, Slot] = {}
    textures: dict[str, Slot] = {}
    samplers: dict[str, Slot] = {}
    hosts = {block.name: block.host for block in program.blocks if block.host is not None}
    for name, place in hosts.items():
        blocks[name] = Slot(place.group, place.binding)
    taken = frozenset(blocks.values())
    numbers = {set_: _free(set_, taken) for set_ in {*profile.sets.values(), profile.default_set}}
    for group in _groups(program):
        set_ = profile.sets.get(group, profile.default_set)
        for block in _blocks_of(program, group):
            blocks[block.name] = Slot(set_, next(numbers[set_]))
        for resource in program.resources:
            if resource.group == group:
                texture = Slot(set_, next(numbers[set_]))
                textures[resource.name] = texture
                if resource in program.sampled:
                    combined = profile.samplers.combined
                    sampler = texture if combined else Slot(set_, next(numbers[set_]))
                    samplers[resource.name] = sampler
    return Bindings(blocks, textures, samplers)


def _free(set_: int, taken: frozenset[Slot]) -> Iterator[int]:
    """The numbers within a set that the host's own blocks leave."""
    return (number for number in count() if Slot(set_, number) not in taken)


def _groups(program: Program) -> list[str]:
    owners: list[Block | Resource] = [*program.blocks, *program.resources]
    return list(dict.fromkeys(owner.group for owner in owners))


def _blocks_of(program: Program, group: str) -> list[Block]:
    """The group's plain block, then the derived one; not the host's own."""
    found = [block for block in program.blocks if block.group == group and block.host is None]
    return sorted(found, key=lambda block: block.derived)
