"""The groups of parameters that exist in every shader, and the names of their blocks."""

from __future__ import annotations

from collections.abc import Set

STANDARD_GROUPS = ("frame", "view", "rig", "material", "draw")
"""The groups that exist in every shader, in the order of their bindings."""

SHARED_GROUPS = ("frame", "view", "rig")
"""The groups whose blocks serve many materials."""


def block_name(group: str, derived: bool, taken: Set[str] = frozenset()) -> str:
    """The suggested identifier of a group's block: ``Material``, ``MaterialDerived``.

    What is derived from a shared group differs between materials: ``DerivedFromRig`` belongs to one
    material, and not to the rig as ``Rig`` does. The groups ``wind`` and ``Wind`` would have the
    same one, so the second is ``WindGroup``.
    """
    name = group[:1].upper() + group[1:]
    if derived:
        name = f"DerivedFrom{name}" if group in SHARED_GROUPS else f"{name}Derived"
    while name in taken:
        name += "Group"
    return name
