"""The pictures that people give a page of ``burnish view``: files that its browser sends.

The server keeps the files in memory for as long as there is room, and knows each by a digest of its
contents. ``documents.py`` makes textures of them.
"""

from __future__ import annotations

from hashlib import blake2b
from pathlib import PurePath
from typing import TYPE_CHECKING, NamedTuple, get_args

from .keeping import Keeping, Shelf

if TYPE_CHECKING:
    from ...targets.runner.drivers.texels import Dimension
    from ...targets.runner.textures.kinds import Kind
    from ...targets.runner.textures.texture import Texture

MOST_TEXELS = 96 * 2**20
"""The most bytes of a texture with all its levels. A page gets it as text, which is a third
longer."""
_BYTES_OF_TEXEL = 4
"""Bytes of a texel: colours with 8 bits a lane, or one number. Smaller levels of colours take a
third of that besides."""
_SRGB = "srgb:"


class KeptFile(NamedTuple):
    """A file that was given."""

    name: str
    data: bytes
    is_float: bool


class Wanted(NamedTuple):
    """The kind of texture that a shader needs."""

    dimension: Dimension
    sample: Kind


def wanted_of(dimension: str, sample: str) -> Wanted | None:
    """The kind of texture that a page names; ``None`` if there is no such kind."""
    from ...targets.runner.drivers.texels import Dimension
    from ...targets.runner.textures.kinds import Kind

    dimensions: dict[str, Dimension] = {each: each for each in get_args(Dimension)}
    samples: dict[str, Kind] = {each: each for each in get_args(Kind)}
    if dimension not in dimensions or sample not in samples:
        return None
    return Wanted(dimensions[dimension], samples[sample])


class Pictures:
    """The files that were given. Threads may share it."""

    def __init__(self, keeping: Keeping) -> None:
        self._textures = Shelf[tuple[str, Wanted], "Texture"](keeping, _size_of)
        """The textures of the files, since each change of the source asks for them."""
        self._files = Shelf[str, KeptFile](keeping, lambda kept: len(kept.data))

    def keep(self, name: str, data: bytes, wanted: Wanted) -> str:
        """Keep a file for some texture; returns the word by which pages ask for it.

        Raises ``PictureError`` for a file that makes no such texture, and ``BudgetError``.
        """
        from ...targets.runner.textures.kinds import PictureError

        kept = KeptFile(name, data, _is_float(name))
        _check_size(name, _announced(kept, wanted))
        _check_size(name, _size_of(_texture(kept, wanted, srgb=False)))
        word = blake2b(name.encode() + b"\0" + data, digest_size=16).hexdigest()
        if not self._files.put(word, kept):
            raise PictureError(f"there is no room to keep {name}: a higher `--budget memory` helps")
        return word

    def get(self, asked: str) -> KeptFile | None:
        """The file that a page asks for, if it is still kept."""
        return self._files.get(asked.removeprefix(_SRGB))

    def is_srgb(self, asked: str, wanted: Wanted) -> bool:
        """True if the colours that a page asks for are sRGB. Floats never are."""
        kept = self.get(asked)
        is_color = wanted.sample == "float" and kept is not None and not kept.is_float
        return is_color and asked.startswith(_SRGB)

    def texture(self, asked: str, wanted: Wanted) -> Texture | None:
        """The texture that a page asks for: by the word for a file, behind ``srgb:`` if its colours
        are. ``None`` if the file is not here any more. Raises ``PictureError``."""
        kept = self.get(asked)
        if kept is None:
            return None
        key = asked, wanted
        found = self._textures.get(key)
        if found is None:
            found = _texture(kept, wanted, srgb=self.is_srgb(asked, wanted))
            self._textures.put(key, found)
        return found


def _announced(kept: KeptFile, wanted: Wanted) -> int:
    """The least bytes of the texture that a file makes, as far as its header tells.

    A file that is too large need not be decoded. Files of floats are counted when they are read.
    """
    from ...targets.runner.textures.files import announced_size

    if kept.is_float:
        return 0
    width, height = announced_size(kept.data, kept.name)
    levels = 4 / 3 if wanted.sample == "float" else 1
    return int(width * height * _BYTES_OF_TEXEL * levels)


def _check_size(name: str, size: int) -> None:
    """Raise ``PictureError`` for a texture that a page does not accept."""
    from ...targets.runner.textures.kinds import PictureError

    if size > MOST_TEXELS:
        raise PictureError(
            f"{name} makes a texture of {size >> 20} MB, and the page takes {MOST_TEXELS >> 20}"
        )


def _size_of(texture: Texture) -> int:
    return sum(map(len, texture.levels))


def _is_float(name: str) -> bool:
    from ...targets.runner.textures.high_range import format_of

    return format_of(PurePath(name)) is not None


def _texture(kept: KeptFile, wanted: Wanted, *, srgb: bool) -> Texture:
    from ...targets.runner.textures.files import picture_given
    from ...targets.runner.textures.texture import Texture

    array = picture_given(kept.data, kept.name, *wanted)
    return Texture.of_array(array, srgb=srgb, dimension=wanted.dimension, sample=wanted.sample)
