"""The numbers and textures of a material's extensions in glTF, by the specification's names.

``looks.py`` calls ``layers_of``, and adds these to what the material has without extensions.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ..notes import Notes
from . import materials_schema as schema
from .record import Record

ENDLESS_IOR = 1e6
"""What stands for an endless index of refraction, which a file calls 0: it mirrors all light."""
LONGEST = 1e9
"""What stands for any longer distance after which a medium has absorbed some light."""

_ABSENT: Mapping[str, Record] = {
    "anisotropy": schema.Anisotropy(),
    "clearcoat": schema.Clearcoat(),
    "dispersion": schema.Dispersion(),
    "ior": schema.Refraction(),
    "iridescence": schema.Iridescence(),
    "sheen": schema.Sheen(),
    "specular": schema.Specular(),
    "transmission": schema.Transmission(),
    "volume": schema.Volume(),
}
"""What a material without an extension has of it."""

_COLORS = frozenset({"sheen_color_texture", "specular_color_texture"})
"""The textures of colours; all others are of numbers."""


@dataclass(slots=True)
class Layers:
    """The contents of all extensions of a material."""

    parameters: dict[str, Any] = field(default_factory=dict)
    textures: dict[str, tuple[schema.TextureInfo, bool]] = field(default_factory=dict)
    """Each texture, by its name without ``_texture``, and whether it has colours."""
    needs: dict[str, str] = field(default_factory=dict)
    """The extensions that the material has, each with the word of a number of it."""


def layers_of(extensions: schema.MaterialExtensions, what: str, notes: Notes) -> Layers:
    """The numbers and textures of the extensions; ``what`` names the material in notes."""
    found = Layers()
    for name, absent in _ABSENT.items():
        record = getattr(extensions, name)
        _add(found, record or absent)
        if record is not None:
            found.needs[f"KHR_materials_{name}"] = record.__struct_fields__[0]
    unlit, ior = extensions.unlit is not None, found.parameters["ior"]
    if unlit:
        found.needs["KHR_materials_unlit"] = "is_unlit"
    if 0 < ior < 1:
        notes.add(what, ": its index of refraction is below 1; it counts as 1")
    found.parameters |= {
        "ior": min(max(ior, 1.0), ENDLESS_IOR) if ior else ENDLESS_IOR,
        "attenuation_distance": min(found.parameters["attenuation_distance"] or 0.0, LONGEST),
        "is_unlit": unlit,
        "has_anisotropy_map": "anisotropy" in found.textures,
    }
    return found


def _add(found: Layers, record: Record) -> None:
    for name in record.__struct_fields__:
        value = getattr(record, name)
        if not name.endswith("_texture"):
            found.parameters[name] = value
        elif value is not None:
            found.textures[name.removesuffix("_texture")] = value, name in _COLORS
    coat = getattr(record, "clearcoat_normal_texture", None)
    if isinstance(record, schema.Clearcoat):
        found.parameters["clearcoat_normal_scale"] = coat.scale if coat else 1.0
