"""Random materials that read textures of every kind, in every way, at all sorts of coordinates.

Reads are placed after choices and in sums, at coordinates that are stretched, rotated and displaced
by other reads. There the levels and the pixels of a quad have the most reasons to disagree.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from burnish.compiler.ir.types import TEXTURES, Dimension, TextureType

TARGETS = 2
"""The number of colours that a material writes, each an expression of its own."""
DEPTH = 2
"""The depth to which expressions are nested."""
MAPS = 5

_STRETCHES = (0.25, 0.5, 1.0, 1.5, 3.0, 8.0)
_NUMBERS = (0.1, 0.25, 0.4, 0.5, 0.7, 0.85)
_PLACES = {
    2: ("uv", "0.97 * vec2(position.xy) + 0.013", "0.93 * vec2(normal.xz) + 0.017"),
    3: ("vec3(uv, 0.41)", "0.97 * vec3(position) + 0.013", "0.93 * vec3(normal) + 0.017"),
}
"""Coordinates by their number of lanes. One that is the same on a whole wall must not be between
two texels."""


@dataclass
class Reads:
    """Writes one material, which depends only on the seed."""

    seed: int
    turn: str | None = field(default=None, init=False)
    """The variable of the surrounding sum, whose iterations are the same in all pixels."""

    def __post_init__(self) -> None:
        self._chance = random.Random(f"reads {self.seed}")
        kinds = [self._chance.choice(TEXTURES) for _ in range(MAPS)]
        self._maps = {f"t{i}": kind for i, kind in enumerate(kinds)}
        self._states = {name: _state(self._chance, kind) for name, kind in self._maps.items()}

    def text(self) -> str:
        """The text of the whole program."""
        lines = ["burnish 1", "", "material Reads {", *self._declarations(), "}", ""]
        lines += ["pass Read {"]
        lines += [f"    target c{i} : rgba32f = {self.color(DEPTH)}" for i in range(TARGETS)]
        return "\n".join([*lines, "}", ""])

    def _declarations(self) -> Iterator[str]:
        for name, kind in self._maps.items():
            state = f" with {{ {self._states[name]} }}" if self._states[name] else ""
            yield f"    map {name} : {kind}{state}"

    # --- what is read -----------------------------------------------------------------------------

    def color(self, depth: int) -> str:
        """A random expression of type ``vec4``."""
        if depth <= 0:
            return self.read(0)
        ways = [self.read, self.read, self._chosen, self._chosen, self._sum, self._mixed]
        return self._chance.choice(ways)(depth - 1)

    def read(self, depth: int) -> str:
        """A read of one of the textures, as a ``vec4``."""
        name, kind = self._chance.choice(list(self._maps.items()))
        if kind.sample in ("int", "uint"):
            return f"vec4({self._load(name, kind, depth)} mod {_modulus(kind)}) / 16"
        if kind.sample == "depth":
            return self._compared(name, kind, depth)
        ways: list[Callable[[str, TextureType, int], str]] = [
            self._implicit, self._implicit, self._level
        ]  # fmt: skip
        # Of gradients of cubes, little can be proven (``subjects.py``).
        ways += [] if kind.is_cube else [self._grad]
        ways += [self._gather] if kind.dimension != "3d" else []
        ways += [] if kind.is_cube else [self._load]
        return self._chance.choice(ways)(name, kind, depth)

    def _implicit(self, name: str, kind: TextureType, depth: int) -> str:
        return f"{name}({self._where(kind, depth)})"

    def _level(self, name: str, kind: TextureType, depth: int) -> str:
        return f"{name}.level({self._where(kind, depth)}, 3 * {self.scalar(depth)})"

    def _grad(self, name: str, kind: TextureType, depth: int) -> str:
        changes = ", ".join(
            f"{self._number(0.02, 0.3)} * {self.place(_extents(kind.dimension), 0)}"
            for _ in range(2)
        )
        return f"{name}.grad({self._where(kind, depth)}, {changes})"

    def _gather(self, name: str, kind: TextureType, depth: int) -> str:
        return f"{name}.gather({self._where(kind, depth)}, {self._chance.randrange(4)})"

    def _load(self, name: str, kind: TextureType, depth: int) -> str:
        extents = 3 if kind.dimension == "3d" else 2
        layer = f", {self._layer()}" if kind.layered else ""
        return f"{name}.load(ivec{extents}(20 * {self.place(extents, depth)}){layer}, 0)"

    def _compared(self, name: str, kind: TextureType, depth: int) -> str:
        where, reference = self._where(kind, depth), self.scalar(depth)
        if not kind.is_cube and self._chance.random() < 0.3:
            return f"{name}.gather({where}, {reference})"
        return f"vec4({name}({where}, {reference}))"

    def _where(self, kind: TextureType, depth: int) -> str:
        place = self.place(_extents(kind.dimension), depth)
        return f"{place}, {self._layer()}" if kind.layered else place

    def _layer(self) -> str:
        return self.turn or self._chance.choice(["0", "1", "2", "int(3 * uv.x)"])

    # --- where, and whether -----------------------------------------------------------------------

    def place(self, extents: int, depth: int) -> str:
        """A coordinate, in parentheses."""
        base = f"({self._chance.choice(_PLACES[extents])})"
        lanes = ", ".join(str(self._chance.choice(_STRETCHES)) for _ in range(extents))
        ways = [
            base,
            f"({base} * vec{extents}({lanes}))",
            f"({base} * vec{extents}({lanes}) + {self._number(-1, 1)})",
        ]
        if extents == 2:
            cosine, sine = self._number(-1, 1), self._number(-1, 1)
            turn = f"mat2(vec2({cosine}, {sine}), vec2({-sine}, {cosine}))"
            ways.append(f"({turn} * ({base} * vec2({lanes})))")
        if self.turn:
            ways.append(f"({base} + 0.1 * float({self.turn}))")
        if depth > 0:
            lanes = "xyz"[:extents]
            ways.append(f"({base} + {self._number(0, 0.3)} * ({self.color(depth - 1)}).{lanes})")
        return self._chance.choice(ways)

    def scalar(self, depth: int) -> str:
        """A number that usually is in 0..1, in parentheses."""
        ways = [
            "uv.x", "uv.y", "(0.5 + 0.5 * position.x)", "distance(uv, vec2(0.4, 0.6))",
            f"fract({self._chance.choice(_STRETCHES)} * uv.y)", str(self._chance.choice(_NUMBERS)),
        ]  # fmt: skip
        if depth > 0:
            ways.append(f"({self.color(depth - 1)}).{self._chance.choice('xyzw')}")
        return self._chance.choice(ways)

    def condition(self, depth: int) -> str:
        """A condition that changes from pixel to pixel, in parentheses."""
        compared = f"({self.scalar(depth)} < {self._chance.choice(_NUMBERS)})"
        if depth <= 0 or self._chance.random() < 0.5:
            return compared
        word = self._chance.choice(["and", "or"])
        return f"({compared} {word} {self.condition(depth - 1)})"

    # --- around reads -----------------------------------------------------------------------------

    def _chosen(self, depth: int) -> str:
        then, otherwise = self.color(depth), self.color(depth)
        return f"(if {self.condition(depth)} then {then} else {otherwise})"

    def _sum(self, depth: int) -> str:
        if self.turn:
            return self._mixed(depth)
        self.turn = "i"
        body = self.color(depth)
        self.turn = None
        return f"(0.5 * (sum i in 0..{self._chance.randint(1, 3)} : {body}))"

    def _mixed(self, depth: int) -> str:
        return f"mix({self.color(depth)}, {self.color(depth)}, {self.scalar(depth)})"

    def _number(self, low: float, high: float) -> float:
        return round(self._chance.uniform(low, high), 3)


def _extents(dimension: Dimension) -> int:
    return 2 if dimension.startswith("2d") else 3


def _modulus(kind: TextureType) -> str:
    return "16u" if kind.sample == "uint" else "16"


def _state(chance: random.Random, kind: TextureType) -> str:
    """The settings of a texture's sampler."""
    if kind.sample in ("int", "uint"):
        return ""
    settings = {"filter": chance.choice(["linear", "linear", "nearest"])}
    if kind.sample == "float":
        settings["mip"] = chance.choice(["linear", "linear", "nearest", "none"])
    if not kind.is_cube:
        axes = ("wrap", "wrap_u", "wrap_v", "wrap_w")[: 1 + _extents(kind.dimension)]
        for axis in (axes[0], *(axis for axis in axes[1:] if chance.random() < 0.3)):
            settings[axis] = chance.choice(["repeat", "clamp", "mirror"])
    if kind.sample == "depth":
        settings["compare"] = chance.choice(["less", "less_equal", "greater", "greater_equal"])
    return ", ".join(f"{name} = {value}" for name, value in settings.items())
