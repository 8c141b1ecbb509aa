"""What surrounds an object: a small studio or a sky that formulas compute, or a panorama of a file.

``burnish render`` and ``burnish view`` give it to every cube map of colours that has no picture.
Numbers are radiance in linear light, and may be larger than 1. World space has y upwards; cameras
look along -z by themselves, so that light from +z comes from behind the viewer.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ....compiler.budget import Tally
from ....compiler.reference.transfer import decode_srgb
from ..cameras import Vector
from .files import read_picture
from .kinds import PictureError
from .panorama import cube_of, face_directions
from .texture import Texture

Floats = NDArray[np.float64]

SIDE = 64
"""The texels on a side of a face that a formula fills: as small as a mirror's picture allows, since
a page of ``burnish view`` carries it."""
NOTHING = "none"
"""The word for no environment at all: cube maps keep the colours of their declarations."""


class Environment(NamedTuple):
    """The radiance from all directions."""

    name: str
    """The word or the file that asked for it."""
    texture: Texture
    """A cube of floats."""
    mean: Vector
    """The mean radiance over all directions."""


def environment(asked: str) -> Environment | None:
    """The environment of a word of ``FORMULAS`` or of a panorama's file; ``None`` for ``none``.

    A panorama is twice as wide as high: of floats (``.hdr``, ``.exr``), or of colours in sRGB, as
    ``.png`` and other pictures have them. Raises ``PictureError`` for a file that is no panorama,
    is damaged, or has numbers that are not finite, and ``BudgetError`` for one that is too large.
    """
    if asked == NOTHING:
        return None
    if asked in FORMULAS:
        return _computed(asked)
    cube = _panorama(Path(asked))
    if not np.isfinite(cube).all():
        raise PictureError(f"{asked} has numbers that are not finite, which no light is")
    return _made(asked, cube)


@cache
def _computed(name: str) -> Environment:
    radiance = FORMULAS[name]
    return _made(name, np.stack([radiance(towards) for towards in face_directions(SIDE)]))


def _made(name: str, cube: Floats) -> Environment:
    return Environment(
        name, Texture.of_array(cube.astype(np.float32), dimension="cube"), mean(cube)
    )


def mean(cube: Floats) -> Vector:
    """The mean radiance of a cube (6, side, side, lanes) over all directions.

    A texel counts by the solid angle in which it is seen.
    """
    lanes = cube[..., :3] if cube.shape[-1] >= 3 else np.repeat(cube[..., :1], 3, axis=-1)
    distances = [np.linalg.norm(towards, axis=2) for towards in face_directions(cube.shape[1])]
    weights = np.stack(distances) ** -3.0
    red, green, blue = (np.sum(lanes[..., i] * weights) / np.sum(weights) for i in range(3))
    return float(red), float(green), float(blue)


def _panorama(path: Path) -> Floats:
    """The six faces of the panorama in a file, in linear light."""
    texels = read_picture(path, "float", Tally("memory", "the environment takes"))
    if texels.dtype != np.float32:
        shades = texels.astype(np.float32) / np.iinfo(texels.dtype).max
        texels = decode_srgb(shades[..., :3] if shades.ndim == 3 else shades).astype(np.float32)
    return cube_of(texels, str(path)).astype(np.float64)


# --- formulas ------------------------------------------------------------------------------------


class _SoftBox(NamedTuple):
    """A lamp behind a square of cloth, which is at a distance of one."""

    towards: Vector
    """The direction of its middle, of any length."""
    width: float
    """Half of the width, as a tangent of the angle at which it is seen."""
    height: float
    color: Vector


_BOXES = (
    _SoftBox((-0.6, 0.55, 0.58), 0.5, 0.4, (3.0, 2.85, 2.65)),
    _SoftBox((0.95, 0.2, 0.25), 0.22, 0.65, (1.0, 1.15, 1.3)),
    _SoftBox((0.25, 0.35, -0.9), 0.8, 0.15, (1.5, 1.45, 1.4)),
)
"""The studio's lamps: the key light at the upper left, where the first lamp of a rig stands, too; a
narrow one that fills from the right; and a strip behind the object."""
_EDGE = 0.12
"""The width of a soft box's fading edge."""
_FLOOR, _HORIZON, _CEILING = (0.08, 0.076, 0.072), (0.26, 0.26, 0.265), (0.04, 0.043, 0.05)
"""The studio's walls without the lamps: below, all around and above."""


def studio(towards: Floats) -> Floats:
    """The radiance of a photographer's studio, in directions (…, 3) of any length."""
    d = towards / np.linalg.norm(towards, axis=-1, keepdims=True)
    found = _between(_HORIZON, _FLOOR, _eased(-d[..., 1] / 0.5))
    found = np.where(d[..., 1:2] > 0, _between(_HORIZON, _CEILING, _eased(d[..., 1] / 0.9)), found)
    for box in _BOXES:
        shown = _share_of_box(d, box)[..., None]
        found = found * (1 - shown) + np.array(box.color) * shown
    return found


def _share_of_box(d: Floats, box: _SoftBox) -> Floats:
    """1 where a direction meets a soft box, 0 elsewhere, and in between at its edge."""
    ahead = np.array(box.towards) / np.linalg.norm(box.towards)
    right = np.cross([0.0, 1.0, 0.0], ahead)
    right /= np.linalg.norm(right)
    up = np.cross(ahead, right)
    depth = d @ ahead
    x, y = (np.abs(d @ axis) / np.maximum(depth, 1e-6) for axis in (right, up))
    inside = np.minimum(box.width - x, box.height - y) / _EDGE
    shown: Floats = np.where(depth > 0, _eased(inside), 0.0)
    return shown


_SUN = (-0.45, 0.62, 0.64)
_SUN_COLOR = (60.0, 54.0, 44.0)
_SUN_COSINE = np.cos(np.radians(4.0)), np.cos(np.radians(3.0))
"""The sun's disc is larger than in nature, so that texels of this size have it: by its rim, where
it is dark, and where it is as bright as in its middle."""
_BLUE, _WHITE, _GROUND = (0.10, 0.24, 0.62), (0.62, 0.74, 0.92), (0.16, 0.14, 0.11)


def sky(towards: Floats) -> Floats:
    """The radiance of a clear sky above brown ground, in directions (…, 3) of any length.

    Its brightness is that of the CIE's clear sky (ISO 15469:2004, type 12), divided by that of the
    zenith; where it is bright, it is white rather than blue.
    """
    d = towards / np.linalg.norm(towards, axis=-1, keepdims=True)
    sun = np.array(_SUN) / np.linalg.norm(_SUN)
    height = np.maximum(d[..., 1], 1e-3)
    to_sun = np.clip(d @ sun, -1, 1)
    brightness = _gradation(height) * _scattered(to_sun) / (_gradation(1.0) * _scattered(sun[1]))
    color = 0.25 * brightness[..., None] * _between(_BLUE, _WHITE, _eased(brightness / 4))
    from_rim, in_full = _SUN_COSINE
    color = (
        color + np.array(_SUN_COLOR) * _eased((to_sun - from_rim) / (in_full - from_rim))[..., None]
    )
    return _between(color, _GROUND, _eased(-d[..., 1] / 0.04))


def _gradation(height: Floats | float) -> Floats:
    """ISO 15469, equation 2, by the cosine of the angle to the zenith."""
    return 1 - 1.0 * np.exp(-0.32 / np.asarray(height))


def _scattered(to_sun: Floats | float) -> Floats:
    """ISO 15469, equation 3, by the cosine of the angle to the sun."""
    cosine = np.asarray(to_sun)
    angle = np.arccos(np.clip(cosine, -1, 1))
    scattered: Floats = 1 + 10 * (np.exp(-3 * angle) - np.exp(-3 * np.pi / 2)) + 0.45 * cosine**2
    return scattered


FORMULAS: Mapping[str, Callable[[Floats], Floats]] = {"studio": studio, "sky": sky}
"""The environments that are computed, by the words for them: radiance by direction."""


def _between(first: Vector | Floats, second: Vector | Floats, share: Floats) -> Floats:
    a, b, weight = np.asarray(first), np.asarray(second), share[..., None]
    return a * (1 - weight) + b * weight


def _eased(share: Floats) -> Floats:
    """A share within 0 and 1, with a soft beginning and end."""
    x = np.clip(share, 0, 1)
    eased: Floats = x * x * (3 - 2 * x)
    return eased
