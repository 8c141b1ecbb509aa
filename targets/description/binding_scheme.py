"""The record that says where things are bound: sets, first numbers, samplers, push constants.

Every ``Profile`` has one. ``binding_schemes.py`` makes others, of what users ask for, and
``legalise/bindings.py`` numbers everything by it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from ...compiler.ir.groups import SHARED_GROUPS
from ...support.frozen import EMPTY, frozen

BindingKind = Literal["block", "buffer", "written", "image", "texture", "sampler"]
"""The kinds of things that a host binds; a texture and a sampler in one are a texture."""

GROUP_SETS: Mapping[str, int] = {"frame": 0, "view": 0, "rig": 1, "material": 2, "draw": 3}
"""The set of each group, which is the bind group of WebGPU: it guarantees four."""

OF_MATERIALS = "material"
"""The group in whose set everything lies that depends on the material, whatever its own group."""


@frozen(kw_only=True)
class BindingScheme:
    """The sets and numbers of everything that is bound."""

    sets: Mapping[str, int] = GROUP_SETS
    """The set of each group; a group that is not listed lies in the set of materials."""
    resources: Mapping[str, int] = EMPTY
    """The set of a group's textures, samplers and buffers, if it is another one than usual."""
    first: Mapping[str, int] = EMPTY
    """The number of a group's block. Those that follow it in the set go on from there."""
    kinds: Mapping[BindingKind, int] = EMPTY
    """The first number of each kind, in profiles that number each kind on its own."""
    combined_samplers: bool = False
    """True if a texture and its sampler are one object, also in profiles that have them apart and
    can have them together (``Profile.can_combine_samplers``)."""
    push_constants: str = ""
    """The group whose block is push constants, in profiles that have these; empty for none."""

    @property
    def shared_sets(self) -> frozenset[int]:
        """The sets that many materials share: those of shared groups, unless others lie there."""
        others = {number for group, number in self.sets.items() if group not in SHARED_GROUPS}
        kept = {number for group, number in self.sets.items() if group in SHARED_GROUPS}
        return frozenset(kept - others - set(self.resources.values()))

    def set_of(self, group: str) -> int:
        """The set of a group's block."""
        return self.sets.get(group, self.sets[OF_MATERIALS])

    def set_of_derived(self, group: str) -> int:
        """The set of the values that are derived from a group.

        Those of a shared group differ from material to material, so they lie with the material.
        """
        return self.set_of(OF_MATERIALS if group in SHARED_GROUPS else group)

    def set_of_resource(self, group: str, *, of_rig: bool) -> int:
        """The set of a texture or buffer; ``of_rig`` if a light of the rig declares it."""
        if group in self.resources:
            return self.resources[group]
        if group not in SHARED_GROUPS:
            return self.set_of(group)
        return self.set_of("rig" if of_rig else OF_MATERIALS)
