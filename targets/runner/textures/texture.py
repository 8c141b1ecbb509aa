"""Textures that a host gives to an instance: made of pictures, arrays and single colours.

Users call this class as ``burnish.Texture``. A texture's numbers are those in its file, unless the
caller says that they are sRGB: only the caller knows whether a picture shows colours or holds data,
such as normals or roughness.

An array of textures has layers, a 3D texture has slices, and a cube has the faces +x, -x, +y, -y,
+z, -z. Seen from inside a cube with y upwards, the first row of a side's face is at the top. In a
right-handed world, a face is reversed. Direct3D, Vulkan, OpenGL, WebGPU and files of cube maps all
do it this way.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

from ....compiler.ir.default_textures import OF_SAMPLES
from ....compiler.ir.types import Intent
from ....support.arguments import expect, expect_all
from ..drivers.texels import TEXELS, Dimension, Image, TextureFormat
from ..instances.literals import color_channels
from .kinds import FACES, SRGB_PREFIX, Kind, PictureError, without_prefix

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Texture:
    """Texels with all their mip levels; the first row is the top one."""

    format: TextureFormat
    width: int
    """The width of the first level. Each further level halves both sides, rounded down, but not
    below 1."""
    height: int
    levels: tuple[bytes, ...]
    """The bytes of each level, row by row, layer by layer."""
    dimension: Dimension = "2d"
    depth: int = 1
    """Layers, faces, or slices of the first level, which are halved like the sides."""

    @classmethod
    def load(
        cls,
        path: str | Path | Sequence[str | Path],
        *,
        srgb: bool = False,
        dimension: Dimension = "2d",
        sample: Kind = "float",
    ) -> Texture:
        """The first picture of a file, rotated as its camera noted; or one file for each layer.
        A cube may also be made of a panorama, which is twice as wide as high and holds floats. An
        array of cubes takes six files for each cube, or a panorama for each.

        Colours get 8 bits a lane: palettes are looked up, grey becomes three equal lanes, a missing
        alpha is opaque, and 16 bits are reduced to 8. A file of floats keeps its floats. With
        ``srgb``, the colours (not alpha) are decoded when a shader reads them. For integers
        (``sample`` is ``int`` or ``uint``), the texture has the numbers in the file, which are
        indices if it has a palette. Depths are the brightness.

        Raises ``PictureError`` if there is no picture, if it is damaged, if the pictures have a
        wrong size or number, or if one is larger than every WebGPU device supports: no side may
        have more than 8192 texels, or 2048 for 3D textures. Raises ``BudgetError`` if they take
        more memory than is allowed.
        """
        array = _read(path, dimension, sample)
        return cls.of_array(array, srgb=srgb, dimension=dimension, sample=sample)

    @classmethod
    def of_array(
        cls,
        array: Any,
        *,
        srgb: bool = False,
        dimension: Dimension = "2d",
        sample: Kind = "float",
        levels: Sequence[Any] = (),
    ) -> Texture:
        """The texture of an array (height, width), or (height, width, lanes) with 1, 3 or 4 lanes.

        If the dimension is not ``2d``, layers, slices or faces come first: (6, size, size, 4).
        An array of cubes has the faces of one cube after those of another.

        Colours: ``uint8`` and ``uint16`` mean 0..1, and are stored with 8 bits; floats are linear,
        and stored unchanged. Integers of up to 32 bits are stored unchanged. Depths have one lane
        and are in 0..1. Smaller levels of colours are computed, unless the caller passes
        ``levels``.

        Raises ``PictureError`` for arrays of other shapes and types.
        """
        from .arrays import check_level, texel_array
        from .mipmaps import smaller

        _check_kind(dimension, sample)
        expect("levels", levels, Sequence, "a sequence of arrays")
        texels, format_ = texel_array(array, srgb, dimension, sample)
        whole = [texels]
        for number, level in enumerate(levels, start=1):
            whole.append(check_level(whole[0], level, number, srgb, dimension, sample))
        if not levels and sample == "float":
            whole += smaller(texels, format_, dimension)
        depth, height, width, _ = texels.shape
        kind = TEXELS[format_].kind
        stored = tuple(level.astype(kind, copy=False).tobytes() for level in whole)
        return cls(format_, width, height, stored, dimension, depth)

    @classmethod
    def solid(cls, color: str | Sequence[float], *, dimension: Dimension = "2d") -> Texture:
        """One texel of a colour: ``"#b5651d"``, which is sRGB, or 3 or 4 linear lanes in 0..1.

        A cube has one such texel on each face, and an array one layer. Raises ``PictureError`` for
        any other value.
        """
        import numpy as np

        if isinstance(color, str):
            channels = color_channels(color)
            if channels is None:
                raise PictureError(f"{color!r} is no colour, which would be '#b5651d'")
            return _texel(np.array(channels, np.uint8), dimension, "float", srgb=True)
        try:
            lanes = np.array(color, np.float64)
        except (TypeError, ValueError):
            lanes = np.array(())
        if lanes.shape not in ((3,), (4,)) or not ((lanes >= 0) & (lanes <= 1)).all():
            raise PictureError(f"a colour has 3 or 4 lanes in 0..1, and {color!r} has not")
        return _texel(np.rint(lanes * 255).astype(np.uint8), dimension, "float")

    @classmethod
    def parse(
        cls,
        text: str,
        *,
        dimension: Dimension = "2d",
        sample: Kind = "float",
        intent: Intent = "data",
    ) -> Texture:
        """A texture from a command line: ``picture.png`` or ``#b5651d``.

        The numbers of a file are decoded from sRGB if the ``intent`` of the texture is ``color``,
        as its reflection says, unless they are floats. ``srgb:picture.png`` and
        ``linear:picture.png`` say themselves how a picture is meant.

        If the dimension is not ``2d``, the pictures of layers, slices or faces are separated by
        commas: ``srgb:px.png,nx.png,py.png,ny.png,pz.png,nz.png``. Raises ``PictureError``.
        """
        expect("text", text, str, "a text")
        _check_kind(dimension, sample)
        if text.startswith("#"):
            if sample != "float":
                raise PictureError(f"{text} is a colour, and the texture holds {_HELD[sample]}")
            return cls.solid(text, dimension=dimension)
        srgb = text.startswith(SRGB_PREFIX)
        if srgb and sample != "float":
            raise PictureError(f"{_HELD[sample]} are never sRGB: leave out `{SRGB_PREFIX}`")
        names = without_prefix(text)
        paths = [names] if dimension == "2d" else [name.strip() for name in names.split(",")]
        array = _read(paths, dimension, sample)
        if names == text:
            srgb = intent == "color" and array.dtype.kind != "f"
        return cls.of_array(array, srgb=srgb, dimension=dimension, sample=sample)

    @property
    def sample(self) -> Kind:
        """The kind of the texture's texels."""
        held: dict[str, Kind] = {"float": "float", "depth": "depth", "sint": "int", "uint": "uint"}
        return held[TEXELS[self.format].sample]

    def _size(self, level: int) -> tuple[int, int, int]:
        """The number of layers, faces or slices of a level, its height and its width."""
        height, width = max(self.height >> level, 1), max(self.width >> level, 1)
        return max(self.depth >> level, 1) if self.dimension == "3d" else self.depth, height, width

    def size(self, level: int) -> tuple[int, ...]:
        """The number of texels in each direction of a level, or of the nearest existing one."""
        depth, height, width = self._size(min(max(level, 0), len(self.levels) - 1))
        return (width, height, depth) if self.dimension == "3d" else (width, height)

    def as_array(self) -> Texture:
        """An array whose only layer is this cube."""
        return replace(self, dimension="cube_array")

    def image(self) -> Image:
        """The texture in the form that drivers take."""
        return Image(self.format, self.width, self.height, self.levels, self.dimension, self.depth)

    def linear(self) -> list[NDArray[np.float64] | NDArray[np.int64]]:
        """Each level as a shader reads it: (height, width, 4), or (height, width, 1) for depths.

        If the dimension is not ``2d``, the layers come first.
        """
        from .mipmaps import stored_levels

        found = stored_levels(self.format, self.levels, self._size)
        return [level[0] for level in found] if self.dimension == "2d" else found


_HELD: dict[Kind, str] = {
    "float": "colours", "depth": "depths", "int": "integers", "uint": "unsigned integers",
}  # fmt: skip


def _read(
    path: str | Path | Sequence[str | Path], dimension: Dimension, sample: Kind
) -> NDArray[Any]:
    """The array of a texture from its files. Raises as ``Texture.load`` does."""
    from .files import read_pictures

    _check_kind(dimension, sample)
    given = [path] if isinstance(path, str | PathLike) else path
    paths = expect_all("path", given, (str, PathLike), "the path of a picture, or several")
    return read_pictures([Path(each) for each in paths], dimension, sample)


def _check_kind(dimension: Dimension, sample: Kind) -> None:
    """Raise ``ValueError`` for a combination that no type has."""
    for argument, value, known in (
        ("dimension", dimension, get_args(Dimension)), ("sample", sample, get_args(Kind))
    ):  # fmt: skip
        if value not in known:
            raise ValueError(f"`{argument}` is one of {', '.join(known)}, and not {value!r}")


def described(dimension: Dimension, sample: Kind) -> str:
    """A type of texture in words: ``an array of textures of integers``."""
    shapes: dict[Dimension, str] = {
        "2d": "a flat texture", "2d_array": "an array of textures",
        "3d": "a volume", "cube": "a cube", "cube_array": "an array of cubes",
    }  # fmt: skip
    return f"{shapes[dimension]} of {_HELD[sample]}"


def default_texture(name: str, dimension: Dimension = "2d", sample: Kind = "float") -> Texture:
    """A default texture of a ``map``, by its name in the language; not sRGB."""
    import numpy as np

    texel = np.array(OF_SAMPLES[sample][name])
    if sample == "float":
        return _texel(np.round(texel * 255).astype(np.uint8), dimension, sample)
    if sample == "depth":
        return _texel(texel, dimension, sample)
    return _texel(texel.astype(np.uint8 if sample == "uint" else np.int32), dimension, sample)


def _texel(
    lanes: NDArray[Any], dimension: Dimension, sample: Kind, *, srgb: bool = False
) -> Texture:
    """A texture of one texel, or of one on each face."""
    import numpy as np

    depth = len(FACES) if dimension in ("cube", "cube_array") else 1
    shape = (1, 1, len(lanes)) if dimension == "2d" else (depth, 1, 1, len(lanes))
    whole = np.broadcast_to(lanes, shape)
    return Texture.of_array(whole, srgb=srgb, dimension=dimension, sample=sample)
