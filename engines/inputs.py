"""What engines light a surface by, and the slots of materials in which it is found: one table.

Materials may call their slots as they like. These are the names of the library's models and of its
terms; whoever uses other names says so.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ..compiler.ir.functions import Offer
from ..support.frozen import frozen


@frozen
class Input:
    """A value by which an engine lights a surface."""

    name: str
    """What all engines' tables call it."""
    slots: tuple[str, ...]
    """The slots in which it may be; the first that a material has is taken."""
    factors: tuple[str, ...] = ()
    """Slots that it is multiplied by, as far as the material has them."""
    at_vertices: bool = False
    """True if it is computed for vertices."""
    owner: str = ""
    """The material of the library that has to declare the slots, whose names say too little."""
    changed: bool = False
    """True if it counts only where the material says something else than the library.

    An engine has the mesh's place and normal itself.
    """

    @property
    def offers(self) -> Iterator[Offer]:
        """What the core is asked for."""
        stage = "vertex" if self.at_vertices else "fragment"
        for slot in self.slots:
            yield Offer(slot, stage, self.changed, self.owner)
        for slot in self.factors:
            yield Offer(slot, stage)


COLOR = "color"
"""The light that a surface sends out: of a surface that no lights are needed for."""

INPUTS: tuple[Input, ...] = (
    Input("base_color", ("base_color", "albedo", "tint", "kd", "base"), factors=("base_weight",)),
    Input("metallic", ("metallic", "metalness", "base_metalness")),
    Input("roughness", ("roughness", "specular_roughness")),
    Input("width", ("width",), owner="std.gltf.MetallicRoughness"),
    Input("clearcoat", ("clearcoat", "coat_weight")),
    Input("clearcoat_roughness", ("clearcoat_roughness", "coat_roughness")),
    Input("anisotropy", ("anisotropic", "anisotropy_strength")),
    Input("emission", ("emissive",), factors=("emissive_strength",)),
    Input("occlusion", ("occlusion",)),
    Input("normal", ("normal",), changed=True),
    Input("alpha", ("alpha",), changed=True),
    Input("hidden", ("is_hidden",), changed=True),
    Input(COLOR, (COLOR,), changed=True),
    Input("position", ("position",), at_vertices=True, changed=True),
    Input("object_position", ("object_position",), at_vertices=True, changed=True),
    Input("object_normal", ("object_normal",), at_vertices=True, changed=True),
)


LIT = frozenset({
    "base_color", "metallic", "roughness", "clearcoat", "emission", "occlusion", "normal",
})  # fmt: skip
"""A surface that gives one of these is lit by an engine; what it leaves out is the engine's own."""


def offers(renamed: Mapping[str, str]) -> tuple[Offer, ...]:
    """All slots that engines can use; ``renamed`` are slots that a user has named for an input."""
    return tuple(offer for row in with_names(renamed) for offer in row.offers)


def with_names(renamed: Mapping[str, str]) -> Iterator[Input]:
    """The table, with slots that a user has named for an input."""
    for row in INPUTS:
        slot = renamed.get(row.name)
        yield row if slot is None else Input(row.name, (slot,), at_vertices=row.at_vertices)
