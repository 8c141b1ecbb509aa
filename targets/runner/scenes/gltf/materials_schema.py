"""The materials of a glTF 2.0 file as typed records, with their extensions ``KHR_materials_…``.

``schema.py`` has the other parts of a file. Names, defaults and ranges are those of the
specification, in snake case.
"""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta, Struct, field

from .record import Index, Name, NotNegative, Positive, Record, Share

Shares3 = tuple[Share, Share, Share]
Numbers2 = tuple[float, float]
Ior = Annotated[float, Meta(ge=0)]


class TextureTransform(Record, frozen=True):
    offset: Numbers2 = (0.0, 0.0)
    rotation: float = 0.0
    scale: Numbers2 = (1.0, 1.0)
    tex_coord: Index | None = None


class TextureExtensions(Struct, frozen=True):
    transform: TextureTransform = field(default=TextureTransform(), name="KHR_texture_transform")


class TextureInfo(Record, frozen=True):
    index: Index
    tex_coord: Index = 0
    scale: float = 1.0
    """The scale of a normal map."""
    strength: Share = 1.0
    """The strength of an occlusion map."""
    extensions: TextureExtensions = TextureExtensions()


class Reflectance(Record, frozen=True):
    base_color_factor: tuple[Share, Share, Share, Share] = (1.0, 1.0, 1.0, 1.0)
    metallic_factor: Share = 1.0
    roughness_factor: Share = 1.0
    base_color_texture: TextureInfo | None = None
    metallic_roughness_texture: TextureInfo | None = None


class Anisotropy(Record, frozen=True):
    anisotropy_strength: Share = 0.0
    anisotropy_rotation: float = 0.0
    anisotropy_texture: TextureInfo | None = None


class Clearcoat(Record, frozen=True):
    clearcoat_factor: Share = 0.0
    clearcoat_roughness_factor: Share = 0.0
    clearcoat_texture: TextureInfo | None = None
    clearcoat_roughness_texture: TextureInfo | None = None
    clearcoat_normal_texture: TextureInfo | None = None


class Dispersion(Record, frozen=True):
    dispersion: NotNegative = 0.0


class EmissiveStrength(Record, frozen=True):
    emissive_strength: NotNegative = 1.0


class Refraction(Record, frozen=True):
    ior: Ior = 1.5


class Iridescence(Record, frozen=True):
    iridescence_factor: Share = 0.0
    iridescence_ior: Annotated[float, Meta(ge=1)] = 1.3
    iridescence_thickness_minimum: NotNegative = 100.0
    iridescence_thickness_maximum: NotNegative = 400.0
    iridescence_texture: TextureInfo | None = None
    iridescence_thickness_texture: TextureInfo | None = None


class Sheen(Record, frozen=True):
    sheen_color_factor: Shares3 = (0.0, 0.0, 0.0)
    sheen_roughness_factor: Share = 0.0
    sheen_color_texture: TextureInfo | None = None
    sheen_roughness_texture: TextureInfo | None = None


class Specular(Record, frozen=True):
    specular_factor: Share = 1.0
    specular_color_factor: tuple[NotNegative, NotNegative, NotNegative] = (1.0, 1.0, 1.0)
    specular_texture: TextureInfo | None = None
    specular_color_texture: TextureInfo | None = None


class Transmission(Record, frozen=True):
    transmission_factor: Share = 0.0
    transmission_texture: TextureInfo | None = None


class Unlit(Record, frozen=True):
    """A material with this record is not lit."""


class Volume(Record, frozen=True):
    thickness_factor: NotNegative = 0.0
    attenuation_color: Shares3 = (1.0, 1.0, 1.0)
    attenuation_distance: Positive | None = None
    """``None`` for an endless distance."""
    thickness_texture: TextureInfo | None = None


class MaterialExtensions(Struct, frozen=True):
    """The extensions of a material that the specification calls ratified."""

    anisotropy: Anisotropy | None = field(default=None, name="KHR_materials_anisotropy")
    clearcoat: Clearcoat | None = field(default=None, name="KHR_materials_clearcoat")
    dispersion: Dispersion | None = field(default=None, name="KHR_materials_dispersion")
    emissive_strength: EmissiveStrength | None = field(
        default=None, name="KHR_materials_emissive_strength"
    )
    ior: Refraction | None = field(default=None, name="KHR_materials_ior")
    iridescence: Iridescence | None = field(default=None, name="KHR_materials_iridescence")
    sheen: Sheen | None = field(default=None, name="KHR_materials_sheen")
    specular: Specular | None = field(default=None, name="KHR_materials_specular")
    transmission: Transmission | None = field(default=None, name="KHR_materials_transmission")
    unlit: Unlit | None = field(default=None, name="KHR_materials_unlit")
    volume: Volume | None = field(default=None, name="KHR_materials_volume")


class Material(Record, frozen=True):
    name: Name = ""
    pbr_metallic_roughness: Reflectance = Reflectance()
    normal_texture: TextureInfo | None = None
    occlusion_texture: TextureInfo | None = None
    emissive_texture: TextureInfo | None = None
    emissive_factor: Shares3 = (0.0, 0.0, 0.0)
    alpha_mode: Literal["OPAQUE", "MASK", "BLEND"] = "OPAQUE"
    alpha_cutoff: NotNegative = 0.5
    double_sided: bool = False
    extensions: MaterialExtensions = MaterialExtensions()
