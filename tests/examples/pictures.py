"""Paints the pictures that examples are drawn with: ``python -m tests.examples.pictures``.

Each is a formula, so that everybody knows where it comes from, and may use it. They are small, as
they only have to show what a material does with them. ``test_pictures.py`` compares them with the
files in ``examples/pictures``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from burnish.targets.runner.textures.high_range import encoded_floats, format_of

EXAMPLES = Path(__file__).parents[2] / "examples"
FOLDER = EXAMPLES / "pictures"
OF_TUTORIAL = ("brick_normals", "bricks")
"""Pictures that the tutorial has as well: a comment may name files of its own folder only."""
SIDE = 96

Floats = NDArray[np.float64]


def places(width: int = SIDE, height: int = SIDE) -> tuple[Floats, Floats]:
    """The middles of all pixels, from 0 to 1: to the right, and down."""
    down, right = np.mgrid[0:height, 0:width]
    return (right + 0.5) / width, (down + 0.5) / height


def rgb(text: str) -> Floats:
    """A colour such as ``#b5651d``, from 0 to 1."""
    return np.array([int(text[at : at + 2], 16) for at in (1, 3, 5)]) / 255


def mixed(dark: str, light: str, share: Floats) -> Floats:
    """A mixture of two colours: ``dark`` where the share is 0, ``light`` where it is 1."""
    return rgb(dark) + (rgb(light) - rgb(dark)) * np.clip(share, 0, 1)[..., None]


def with_alpha(colors: Floats, alpha: Floats) -> Floats:
    return np.concatenate([colors, np.clip(alpha, 0, 1)[..., None]], axis=-1)


def noise(seed: int, cells: int, side: int = SIDE) -> Floats:
    """Smooth noise from 0 to 1 that goes on at the edges, in five octaves."""
    chance = np.random.default_rng(seed)
    right, down = places(side, side)
    total = np.zeros((side, side))
    for octave in range(5):
        count = cells * 2**octave
        grid = chance.random((count, count))
        x, y = right * count, down * count
        left, top = np.floor(x).astype(int), np.floor(y).astype(int)
        across, along = (s * s * (3 - 2 * s) for s in (x - left, y - top))
        corners = [[grid[(top + j) % count, (left + i) % count] for i in (0, 1)] for j in (0, 1)]
        above, below = (a + (b - a) * across for a, b in corners)
        total += (above + (below - above) * along) / 2**octave
    spread: Floats = (total - total.min()) / (total.max() - total.min())
    return spread


# --- surfaces ---


def brick_depths() -> Floats:
    """The depth below the surface of bricks: joints are 1."""
    right, down = places()
    rows = down * 6
    along = right * 3 + 0.5 * (np.floor(rows) % 2)
    edge = np.minimum(np.minimum(along % 1, 1 - along % 1) * 2, np.minimum(rows % 1, 1 - rows % 1))
    depths: Floats = 1 - np.clip((edge - 0.04) / 0.1, 0, 1) * (0.9 + 0.1 * noise(3, 8))
    return depths


def bricks() -> Floats:
    right, down = places()
    rows = np.floor(down * 6)
    stone = np.floor(right * 3 + 0.5 * (rows % 2)) % 3
    tone = (np.sin(12.9898 * stone + 78.233 * rows) * 43758.5453) % 1
    clay = mixed("#8c3f2b", "#c2704c", 0.6 * tone + 0.5 * noise(1, 8))
    joint = np.clip((brick_depths() - 0.4) * 3, 0, 1)[..., None]
    return clay * (1 - joint) + mixed("#9a948a", "#c9c3b8", noise(2, 16)) * joint


def normals_of(heights: Floats, strength: float) -> Floats:
    """A normal map: green goes up."""
    slope_x = np.roll(heights, -1, 1) - np.roll(heights, 1, 1)
    slope_y = np.roll(heights, -1, 0) - np.roll(heights, 1, 0)
    found = np.stack([-strength * slope_x, strength * slope_y, np.ones_like(heights)], axis=-1)
    normals: Floats = 0.5 + 0.5 * found / np.linalg.norm(found, axis=-1, keepdims=True)
    return normals


def grounds(dark: str, light: str, seed: int, cells: int) -> Floats:
    """Ground of one kind, whose alpha is its height."""
    height = noise(seed, cells)
    return with_alpha(mixed(dark, light, height), height)


def weights() -> Floats:
    """The shares of four kinds of ground."""
    first, second = noise(21, 3), noise(22, 3)
    shares = np.stack([first, 1 - first, second, 1.2 * (1 - second) - 0.3], axis=-1)
    return np.clip(2.2 * shares - 0.7, 0, 1)


def belt() -> Floats:
    """Arrows that point to where the belt goes."""
    right, down = places()
    arrow = (right * 6 + np.abs(down * 4 % 1 - 0.5) * 1.4) % 1 < 0.45
    return mixed("#22262b", "#e8b23a", arrow.astype(float))


def leaf() -> Floats:
    """Leaves on nothing."""
    right, down = places()
    x, y = right * 4 % 1 - 0.5, down * 3 % 1
    width = 0.42 * np.sin(np.pi * np.clip((y - 0.06) / 0.9, 0, 1)) ** 0.8
    vein = np.abs(x) < 0.02
    vein |= np.abs((y * 7 + np.abs(x) * 5) % 1 - 0.5) < 0.07
    color = mixed("#2f6b2a", "#86b84a", 0.4 * y + 0.4 * vein + 0.2 * noise(5, 6))
    return with_alpha(color, (np.abs(x) < width).astype(float))


def star() -> Floats:
    """A star on nothing."""
    right, down = places()
    x, y = 2 * right - 1, 2 * down - 1
    turn = np.abs((np.arctan2(x, -y) * 5 / (2 * np.pi) + 0.5) % 1 - 0.5) * 2
    inside = np.hypot(x, y) < 0.9 - 0.52 * turn
    return with_alpha(np.broadcast_to(rgb("#f2c230"), (*x.shape, 3)), inside.astype(float))


# --- what is around ---


def directions() -> Floats:
    """The direction of each pixel of a panorama, which is twice as wide as high."""
    right, down = places(2 * SIDE, SIDE)
    around, above = 2 * np.pi * (right - 0.5), np.pi * (0.5 - down)
    level = np.cos(above)
    return np.stack([level * np.sin(around), np.sin(above), -level * np.cos(around)], axis=-1)


def garden() -> Floats:
    """A sky with a sun above hills and a lawn in squares."""
    towards = directions()
    x, y, z = np.moveaxis(towards, -1, 0)
    sky = mixed("#dbe8f0", "#2f6fb5", np.sqrt(np.clip(y, 0, 1)) * 1.1)
    sky += np.clip((towards @ (np.array([0.5, 0.62, -0.6]) / 1.0)) - 0.97, 0, 1)[..., None] * 30
    around = np.arctan2(x, -z)
    hill = 0.12 + 0.05 * np.sin(3 * around) + 0.03 * np.sin(7 * around + 1)
    below = np.minimum(y, -1e-3)
    squares = (np.floor(-x / below) + np.floor(-z / below)) % 2
    near = np.exp(-np.hypot(x, z) / -below / 12)
    lawn = mixed("#5d8f45", "#3c6b33", squares * near + 0.3 * (1 - near))
    found = np.where((y < hill)[..., None], mixed("#38573a", "#6d8f6a", (hill - y) * 4), sky)
    return np.where((y < 0)[..., None], lawn, found)


def room() -> Floats:
    """Walls of different colours, a floor of boards and a bright window, seen from the middle."""
    towards = directions()
    reach = np.array([2.0, 1.25, 2.0]) / np.maximum(np.abs(towards), 1e-6)
    side = reach.argmin(axis=-1)
    place = towards * reach.min(axis=-1)[..., None]
    x, y, z = np.moveaxis(place, -1, 0)
    wall = np.where((side == 0)[..., None], rgb("#b5763f"), rgb("#d9d2c4"))
    wall = np.where(((side == 0) & (x < 0))[..., None], rgb("#4f7f86"), wall)
    boards = mixed("#6b4a2f", "#8d6743", (np.floor(x * 3) * 0.37) % 1)
    found = np.where(((side == 1) & (y < 0))[..., None], boards, wall)
    found = np.where(((side == 1) & (y > 0))[..., None], rgb("#f2efe8"), found)
    window = (side == 2) & (z < 0) & (np.abs(x) < 1) & (np.abs(y - 0.2) < 0.7)
    bars = (np.abs(x) < 0.05) | (np.abs(y - 0.2) < 0.05)
    shade = 0.55 + 0.45 * np.clip(1 - np.hypot(x, z + 2) / 5, 0, 1)
    return np.where((window & ~bars)[..., None], rgb("#ffffff"), found * shade[..., None])


def ball() -> Floats:
    """A ball of polished jade under two lamps, as the viewer sees it."""
    right, down = places()
    x, y = 2 * right - 1, 1 - 2 * down
    z = np.sqrt(np.clip(1 - x * x - y * y, 0, 1))
    key = np.clip(0.5 * x + 0.65 * y + 0.57 * z, 0, 1)
    rim = np.clip(-0.75 * x + 0.1 * y - 0.1 * z, 0, 1) ** 2
    color = mixed("#12352b", "#5fb58d", key) + rim[..., None] * rgb("#3f5f9f")
    above: Floats = (np.clip(y, 0, 1) * (1 - z) ** 2)[..., None] * 0.25
    return color + (key**40)[..., None] * 0.9 + above


# --- drawn by hand ---

SPRITE = (
    "................", "......3333......", "....33222233....", "...3222222223...",
    "..322222222223..", "..322442244223..", ".32224512451223.", ".32224412441223.",
    ".32222222222223.", ".32221222212223.", ".32222111122223.", "..322222222223..",
    "...3222222223...", "....33222233....", "......3333......", "................",
)  # fmt: skip
PALETTE = ("#27435e", "#b0413e", "#f2c14e", "#c98a2b", "#ffffff", "#1b2530")


def sprite() -> Floats:
    """A face whose texels are numbers of colours."""
    numbers = [[int(mark) if mark.isdigit() else 0 for mark in line] for line in SPRITE]
    return np.array(numbers) / 255


def palette() -> Floats:
    return np.array([[rgb(color) for color in PALETTE]])


def letter() -> Floats:
    """The distance to the outline of an R, the same in all channels: 1 is deep inside."""
    size = 48
    right, down = places(size, size)
    x, y = (right - 0.5) * 1.3 + 0.5, (down - 0.5) * 1.3 + 0.5

    def box(left: float, top: float, width: float, height: float) -> Floats:
        across, along = np.abs(x - left - width / 2), np.abs(y - top - height / 2)
        outside = np.hypot(np.maximum(across - width / 2, 0), np.maximum(along - height / 2, 0))
        return outside + np.minimum(np.maximum(across - width / 2, along - height / 2), 0)

    bow = np.abs(np.hypot(np.maximum(x - 0.5, 0), y - 0.33) - 0.16) - 0.06
    bow = np.where(x < 0.5, np.abs(np.abs(y - 0.33) - 0.16) - 0.06, bow)
    bow = np.maximum(bow, 0.28 - x)
    slope = (x - 0.5) * 0.8 - (y - 0.55) * 0.6
    leg = np.maximum(np.maximum(np.abs(slope) - 0.06, 0.5 - y), y - 0.89)
    distance = np.minimum(np.minimum(box(0.26, 0.11, 0.12, 0.78), bow), leg)
    return np.repeat(np.clip(0.5 - distance * size / 1.3 / 4, 0, 1)[..., None], 3, axis=-1)


def ramp() -> Floats:
    """A ramp of four colours from shade to light."""
    steps = ("#5b2a3c", "#a8473f", "#e8843c", "#ffd98a")
    return np.array([[rgb(color) for color in steps for _ in range(8)]])


PICTURES: Mapping[str, Callable[[], Floats]] = {
    "ball": ball,
    "belt": belt,
    "brick_depths": lambda: np.repeat(brick_depths()[..., None], 3, axis=-1),
    "brick_normals": lambda: normals_of(1 - brick_depths(), 2.5),
    "bricks": bricks,
    "garden": garden,
    "grass": lambda: grounds("#33521f", "#8aa653", 11, 6),
    "leaf": leaf,
    "letter": letter,
    "palette": palette,
    "ramp": ramp,
    "rock": lambda: grounds("#4a4640", "#a39c90", 12, 4),
    "sand": lambda: grounds("#b0894e", "#e6cf9c", 13, 8),
    "snow": lambda: grounds("#c3d2e0", "#ffffff", 14, 3),
    "sprite": sprite,
    "star": star,
    "weights": weights,
}
"""The pictures that are painted in 8 bits, by the names of the files."""

PANORAMAS: Mapping[str, Callable[[], Floats]] = {"garden": garden, "room": room}
"""The pictures in floats, of all directions: skies that are brighter than white."""


def painted(name: str) -> Image.Image:
    """A picture in 8 bits."""
    return Image.fromarray(np.rint(255 * np.clip(PICTURES[name](), 0, 1)).astype(np.uint8))


def files() -> Iterator[tuple[str, Path]]:
    """The files of pictures in 8 bits, each with the name of what is painted there."""
    for name in PICTURES:
        yield name, FOLDER / f"{name}.png"
    for name in OF_TUTORIAL:
        yield name, EXAMPLES / "tutorial" / "pictures" / f"{name}.png"


def panorama(name: str) -> Floats:
    """A picture in linear light."""
    colors = np.maximum(PANORAMAS[name](), 0)
    return np.where(colors <= 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)


def main() -> None:
    """Write all files anew."""
    for name, path in files():
        path.parent.mkdir(exist_ok=True)
        painted(name).save(path, optimize=True)
    for name in PANORAMAS:
        path = FOLDER / f"{name}.hdr"
        form = format_of(path)
        assert form is not None
        path.write_bytes(encoded_floats(panorama(name), 3, path, form))


if __name__ == "__main__":
    main()
