"""Loads the images of a document as MaterialX's renderer binds them: numbers as they are in files.

Both sides read files by the same loader and have the same smaller levels. MaterialX's text decodes
colour spaces itself, after filtering, unless it was asked to leave sRGB to the host.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

import numpy as np

from ...compiler.ir.types import Wrap
from ...compiler.reference.transfer import decode_srgb
from ...targets.runner.drivers.slots import Place, TextureSlot
from ...targets.runner.drivers.texels import Image
from ...targets.runner.textures.kinds import PictureError
from ...targets.runner.textures.texture import Texture
from .records import AddressMode, FidelityError, ImageUse

Color = tuple[float, float, float, float]

WRAPS: Mapping[AddressMode, Wrap] = {
    "constant": "border", "clamp": "clamp", "periodic": "repeat", "mirror": "mirror",
}  # fmt: skip

_TOKENS = {"<UDIM>": "1001", "<UVTILE>": "u1_v1"}
"""What is drawn of a set of files: the first tile. MaterialX's renderer binds one file, too."""


class Images:
    """The images of a document, which lie inside of a folder."""

    def __init__(self, document: Path, root: Path | None = None) -> None:
        """Names of files are relative to the ``document``, or else to ``root``, outside of which no
        file is read. It is the document's own folder unless somebody names another."""
        self._folder = document.resolve().parent
        self._root = (root or self._folder).resolve()
        self.missing: list[str] = []
        """The files that are not there; their samplers have the default colour, as MaterialX's
        renderer does it."""

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
        path = self.path(use.file)
        if path is not None:
            return _loaded(path, path.stat().st_mtime_ns, use.is_srgb)
        if use.file:
            self.missing.append(use.file)
        texel = np.array(default, np.float32).reshape(1, 1, 4)
        return Texture.of_array(texel).image()

    def path(self, file: str) -> Path | None:
        """The path of a file that the document names; ``None`` if there is none. Raises
        ``FidelityError`` for one outside of the folder."""
        if not file:
            return None
        for token, tile in _TOKENS.items():
            file = file.replace(token, tile)
        for folder in (self._folder, self._root):
            path = (folder / file).resolve()
            if path.is_file():
                if not path.is_relative_to(self._root):
                    raise FidelityError(f"{file} lies outside of {self._root}, and is not read")
                return path
        return None


def _decoded(color: Color) -> Color:
    """A colour in sRGB as linear light."""
    red, green, blue = decode_srgb(np.array(color[:3])).tolist()
    return red, green, blue, color[3]


@lru_cache(maxsize=8)
def _loaded(path: Path, _changed: int, is_srgb: bool) -> Image:
    try:
        return Texture.load(path, srgb=is_srgb).image()
    except PictureError as error:
        raise FidelityError(str(error)) from None
