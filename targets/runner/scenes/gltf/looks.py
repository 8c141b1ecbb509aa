"""Makes looks from the materials of a glTF file: their numbers and their pictures.

The words are those by which ``stdlib/scene.toml`` finds parameters and textures of a material that
draws them.
"""

from __future__ import annotations

from typing import Any

from .....compiler.budget import Tally
from ...looks import PLAIN, Look
from ...textures.files import picture_in
from ...textures.kinds import PictureError
from ...textures.texture import Texture
from ..notes import Notes
from ..records import SceneError
from .accessors import Accessors
from .folder import Folder
from .layers import layers_of
from .materials_schema import Material, TextureInfo
from .schema import File, Image, Sampler

IN_PLACE = {"set": 0, "offset": (0.0, 0.0), "rotation": 0.0, "scale": (1.0, 1.0)}
"""A texture as it lies on a surface of which a file says nothing else."""
_COORDINATES = 2
"""The number of texture coordinates that a mesh has at most."""
_FORMATS = ("PNG", "JPEG")
"""The formats that pictures may have: other formats are no part of glTF."""


class Looks:
    """The looks of one file. Each, and each picture, is made when it is first asked for."""

    def __init__(
        self, file: File, folder: Folder, accessors: Accessors, notes: Notes, memory: Tally
    ) -> None:
        """``memory`` counts the pictures, and ``notes`` collects what is left out."""
        self._file = file
        self._folder = folder
        self._accessors = accessors
        self._looks: dict[int, Look] = {}
        self._textures: dict[tuple[int, bool], Texture] = {}
        self._notes = notes
        self._memory = memory

    def look(self, index: int | None, what: str) -> Look:
        """The look of a material. Raises ``SceneError``; ``what`` names the look's user in it."""
        if index is None:
            return PLAIN
        if index >= len(self._file.materials):
            raise SceneError(f"{what}: there is no material {index}")
        if index not in self._looks:
            self._looks[index] = self._made(self._file.materials[index], f"material {index}")
        return self._looks[index]

    def _made(self, material: Material, what: str) -> Look:
        base = material.pbr_metallic_roughness
        layers = layers_of(material.extensions, what, self._notes)
        infos = {
            "base_color": (base.base_color_texture, True),
            "metallic_roughness": (base.metallic_roughness_texture, False),
            "normal": (material.normal_texture, False),
            "occlusion": (material.occlusion_texture, False),
            "emissive": (material.emissive_texture, True),
            **layers.textures,
        }
        pictures = {name: info for name, (info, _) in infos.items() if info is not None}
        textures = {
            f"{name}_map": self._texture(info, infos[name][1], f"{what}, {name}_map")
            for name, info in pictures.items()
        }
        places = {name: self._place(info, f"{what}, {name}_map") for name, info in pictures.items()}
        moved = {
            f"how {name}_map lies on the surface": f"{name}_place"
            for name, place in places.items()
            if place != IN_PLACE
        }
        return Look(
            material.name,
            {
                **_numbers(material),
                **layers.parameters,
                **{f"{name}_place": place for name, place in places.items()},
            },
            textures,
            {**layers.needs, **moved},
        )

    def _place(self, info: TextureInfo, what: str) -> dict[str, Any]:
        """How a texture lies on a surface, as a `TexturePlace` of `std.gltf_layers`."""
        transform = info.extensions.transform
        coordinates = info.tex_coord if transform.tex_coord is None else transform.tex_coord
        if coordinates >= _COORDINATES:
            self._notes.add(what, ": it is read with the first texture coordinates")
            coordinates = 0
        return {
            "set": coordinates,
            "offset": transform.offset,
            "rotation": transform.rotation,
            "scale": transform.scale,
        }

    def _texture(self, info: TextureInfo, is_color: bool, what: str) -> Texture:
        if info.index >= len(self._file.textures):
            raise SceneError(f"{what}: there is no texture {info.index}")
        source = self._file.textures[info.index].source
        self._tell_sampler(self._file.textures[info.index].sampler, what)
        if source is None or source >= len(self._file.images):
            raise SceneError(f"{what}: texture {info.index} has no picture")
        key = source, is_color
        if key not in self._textures:
            image = self._file.images[source]
            self._textures[key] = self._read(image, is_color, f"image {source}")
        return self._textures[key]

    def _tell_sampler(self, index: int | None, what: str) -> None:
        """Note a sampler that differs from how materials here read textures."""
        if index is None:
            return
        if index >= len(self._file.samplers):
            raise SceneError(f"{what}: there is no sampler {index}")
        if self._file.samplers[index] != Sampler():
            self._notes.add(what, ": its sampler is left out, as materials say how they read")

    def _read(self, image: Image, is_color: bool, what: str) -> Texture:
        try:
            data = self._bytes(image, what)
            return Texture.of_array(
                picture_in(data, what, self._memory, formats=_FORMATS), srgb=is_color
            )
        except PictureError as error:
            raise SceneError(str(error)) from None

    def _bytes(self, image: Image, what: str) -> bytes:
        if (image.uri is None) == (image.buffer_view is None):
            raise SceneError(f"{what}: it has either a URI or a buffer view")
        if image.buffer_view is not None:
            return self._accessors.bytes_of_view(image.buffer_view, what)
        assert image.uri is not None
        return self._folder.read(image.uri, what)


def _numbers(material: Material) -> dict[str, Any]:
    """The numbers that a material has without extensions; it shines by one of these."""
    base = material.pbr_metallic_roughness
    normal, occlusion = material.normal_texture, material.occlusion_texture
    strength = material.extensions.emissive_strength
    shining = strength.emissive_strength if strength else 1.0
    red, green, blue = material.emissive_factor
    masked = material.alpha_mode == "MASK"
    return {
        "base_color": base.base_color_factor,
        "metallic": base.metallic_factor,
        "roughness": base.roughness_factor,
        "normal_scale": normal.scale if normal else 1.0,
        "occlusion_strength": occlusion.strength if occlusion else 1.0,
        "emissive": (red * shining, green * shining, blue * shining),
        "is_opaque": material.alpha_mode == "OPAQUE",
        "is_two_sided": material.double_sided,
        "alpha_cutoff": min(material.alpha_cutoff, 1.0) if masked else 0.0,
    }
