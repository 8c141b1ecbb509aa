"""The textures of a plan while it is made: which results share one, and how each is used.

``plan.py`` asks for a texture for each thing that a step leaves, gives it back when nobody needs
this any more, and asks which barriers stand between two uses.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

from ...frozen import fresh, frozen, record
from ..ir.frame import Frame, Image, ImageDimension
from ..ir.node import Node
from .stencils import Stencils

State = Literal["undefined", "target", "depth", "image", "sampled", "copied_from", "copied_to"]
"""What a texture is used as: drawn to, written by a kernel, read, copied. At first it has no
contents: ``undefined``."""

_WRITES = frozenset(("target", "depth", "image", "copied_to"))
"""Uses behind which even the same use has to wait."""


@frozen
class Shape:
    """What results have in common that can share a texture."""

    format: str
    size: Node | str
    """The value that says it, or the name of the step whose kernel does."""
    halved: int
    """How often both sides are halved then."""
    dimension: ImageDimension = "2d"
    layers: int = 1
    levels: int = 1
    samples: int = 1

    @classmethod
    def of(cls, frame: Frame, stencils: Stencils, image: Image) -> Shape:
        """That of the texture in which others find a result."""
        return cls(
            stencils.format_of(image), _size(frame, image), image.size.level, image.dimension,
            image.layers, image.levels,
        )  # fmt: skip

    @classmethod
    def of_samples(cls, frame: Frame, stencils: Stencils, image: Image, level: int) -> Shape:
        """That of the texture with the samples of one layer of a result, in one of its levels."""
        size, halved = _size(frame, image), image.size.level + level
        return cls(stencils.format_of(image), size, halved, samples=image.samples)


def _size(frame: Frame, image: Image) -> Node | str:
    value = image.size.value
    return image.size.kernel if value is None else frame.values[value]


@record
class PlannedTexture:
    """A texture that the host makes, for one result after the other."""

    shape: Shape
    images: list[Image]
    uses: dict[State, None] = fresh(factory=dict)
    kept: bool = False
    """Whether its contents are needed in the next frame."""


@frozen(eq=False)
class Barrier:
    """A texture that is used in another way from here on."""

    texture: int
    before: State
    after: State
    only_first: bool
    """Whether the texture is used in the first frame only."""


class Textures:
    """All textures so far; each is named by its place among ``made``."""

    def __init__(self, *, shares: bool) -> None:
        self.made: list[PlannedTexture] = []
        self._shares = shares
        self._free: dict[Shape, list[int]] = {}
        self._states: dict[int, State] = {}
        self._lasting: set[int] = set()
        """Those that nothing else shares, as steps of the first frame only draw to them."""

    def new(self, shape: Shape, image: Image, *, lasts: bool = False) -> int:
        """A texture of its own; where it ``lasts``, it is never shared."""
        self.made.append(PlannedTexture(shape, [image]))
        number = len(self.made) - 1
        self._states[number] = "undefined"
        if lasts:
            self._lasting.add(number)
        return number

    def allot(self, shape: Shape, image: Image) -> int:
        """A texture that is free, or else a new one."""
        free = self._free.get(shape)
        if not free or not self._shares:
            return self.new(shape, image)
        number = free.pop()
        self.share(number, image)
        return number

    def share(self, number: int, image: Image) -> None:
        """Have a texture hold one more result, behind those that it holds."""
        self.made[number].images.append(image)

    def release(self, number: int, image: Image) -> None:
        """Let others have a texture, unless it holds another result by now."""
        texture = self.made[number]
        if texture.images[-1] is image and number not in self._lasting:
            self._free.setdefault(texture.shape, []).append(number)

    def keep(self, number: int) -> None:
        """Have the next frame find what a texture holds."""
        self.made[number].kept = True

    def is_ready(self, number: int) -> None:
        """Note that a texture can be read from the beginning: the last frame left something."""
        self._states[number] = "sampled"
        self.made[number].uses["sampled"] = None

    def barriers(self, used: Iterable[tuple[int, State]]) -> tuple[Barrier, ...]:
        """What has to be waited for before textures are used like this."""
        found = []
        for number, state in dict.fromkeys(used):
            before = self._states[number]
            self.made[number].uses[state] = None
            if before != state or before in _WRITES:
                found.append(Barrier(number, before, state, number in self._lasting))
            self._states[number] = state
        return tuple(found)
