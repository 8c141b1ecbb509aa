"""Loads the images of a document as MaterialX's renderer binds them: numbers as they are in files.

Both sides read files by the same loader and have the same smaller levels. MaterialX's text decodes
colour spaces itself, after filtering, unless it was asked to leave sRGB to the host.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from ...compiler.ir.types import Wrap
from ...compiler.reference.transfer import decode_srgb
from ...targets.runner.drivers.slots import Place, TextureSlot
from ...targets.runner.drivers.texels import Dimension, Image
from ...targets.runner.textures.files import picture_given
from ...targets.runner.textures.kinds import PictureError
from ...targets.runner.textures.texture import Texture
from ..pictures import Picture, Pictures
from .records import AddressMode, FidelityError, ImageUse

Color = tuple[float, float, float, float]

WRAPS: Mapping[AddressMode, Wrap] = {
    "constant": "border", "clamp": "clamp", "periodic": "repeat", "mirror": "mirror",
}  # fmt: skip


class Images:
    """The images of a document, which lie in its folder or in others that a user names."""

    def __init__(self, document: Path, folders: Sequence[Path] = ()) -> None:
        """Files are looked for as the importer does it: in the folder of the ``document``, and then
        in further ``folders``; nothing outside of these is read."""
        self._pictures = Pictures((document.resolve().parent, *folders))
        self.missing: dict[str, Color] = {}
        """The files that are not there, with the default colours that their samplers have, as
        MaterialX's renderer does it."""

    def bound(self, use: ImageUse) -> tuple[TextureSlot, Image]:
        """The slot of a sampler, and its image. Raises ``FidelityError``."""
        default = _decoded(use.default) if use.is_srgb else use.default
        slot = TextureSlot(
            Place(use.name, None, None),
            None,
            filter="nearest" if use.nearest else "linear",
            mip="nearest" if use.nearest else "linear",
            wrap_u=WRAPS[use.wrap_u],
            wrap_v=WRAPS[use.wrap_v],
            border_color=default if "constant" in (use.wrap_u, use.wrap_v) else None,
        )
        return slot, self._image(use, default)

    def _image(self, use: ImageUse, default: Color) -> Image:
        picture = self.found(use.file)
        if picture is not None:
            return _loaded(picture.content, picture.path, use.is_srgb)
        if use.file:
            self.missing[use.file] = default
        return _plain(default).image()

    def found(self, file: str) -> Picture | None:
        """The picture that the document names; ``None`` if there is none."""
        return self._pictures.found(file) if file else None


@dataclass(frozen=True, eq=False, slots=True)
class NamedImage:
    """An image of a document, or a set of them, as the value of a texture of Burnish."""

    images: Images
    files: tuple[str, ...]
    """One file, or one for each layer."""
    default: Color | None = None
    """The colour if the file is not there: which one is up to hosts."""

    def with_default(self, defaults: Mapping[str, Color]) -> NamedImage:
        """The same image with the colour that another host has in place of its file."""
        return replace(self, default=defaults.get(self.files[0]))

    def texture(self, *, is_srgb: bool, dimension: Dimension = "2d") -> Texture | None:
        """The texture; ``None`` if the file is not there and has no default. Raises
        ``FidelityError``."""
        pictures = [picture for file in self.files if (picture := self.images.found(file))]
        if pictures and dimension == "2d":
            return _texture(pictures[0].content, pictures[0].path, is_srgb)
        if pictures:
            return _layers(pictures, is_srgb)
        return None if self.default is None else _plain(self.default)


def _plain(color: Color) -> Texture:
    """A texture of one texel, which is light already."""
    return Texture.of_array(np.array(color, np.float32).reshape(1, 1, 4))


def _decoded(color: Color) -> Color:
    """A colour in sRGB as linear light."""
    red, green, blue = decode_srgb(np.array(color[:3])).tolist()
    return red, green, blue, color[3]


def _loaded(content: bytes, name: str, is_srgb: bool) -> Image:
    return _texture(content, name, is_srgb).image()


def _layers(pictures: Sequence[Picture], is_srgb: bool) -> Texture:
    try:
        found = [picture_given(each.content, each.path, "2d", "float") for each in pictures]
        if len({array.shape for array in found}) > 1:
            raise FidelityError(f"the pictures beside {pictures[0].path} have other sizes")
        array = np.stack(found)
        is_encoded = is_srgb and array.dtype.kind != "f"
        return Texture.of_array(array, srgb=is_encoded, dimension="2d_array")
    except PictureError as error:
        raise FidelityError(str(error)) from None


@lru_cache(maxsize=8)
def _texture(content: bytes, name: str, is_srgb: bool) -> Texture:
    try:
        array = picture_given(content, name, "2d", "float")
        return Texture.of_array(array, srgb=is_srgb and array.dtype.kind != "f")
    except PictureError as error:
        raise FidelityError(str(error)) from None
