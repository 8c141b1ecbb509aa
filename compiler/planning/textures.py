"""The textures of a plan while it is made: which results share one.

``plan.py`` asks for a texture for each thing that a step leaves, and gives it back when nobody
needs this any more.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...support.frozen import frozen, record
from ..documents.plan import TextureUse
from ..ir.frame import Frame, ImageDimension, StepTexture
from ..ir.node import Node
from ..ir.render_state import Samples
from .barriers import Waits
from .stencils import Stencils


@frozen
class Shape:
    """The properties of results that can share a texture."""

    format: str
    size: Node | str
    """The value that says it, or the name of the step whose kernel does."""
    halved: int
    """The number of times that both sides are halved then."""
    dimension: ImageDimension = "2d"
    layers: int = 1
    levels: int = 1
    samples: Samples = 1

    @classmethod
    def of(cls, frame: Frame, stencils: Stencils, image: StepTexture) -> Shape:
        """The shape of the texture in which other steps find a result."""
        return cls(
            stencils.format_of(image), _size(frame, image), image.size.level, image.dimension,
            image.layers, image.levels,
        )  # fmt: skip

    @classmethod
    def of_samples(cls, frame: Frame, stencils: Stencils, image: StepTexture, level: int) -> Shape:
        """The shape of the texture with the samples of one layer of a result, in one level."""
        size, halved = _size(frame, image), image.size.level + level
        return cls(stencils.format_of(image), size, halved, samples=image.samples)


def _size(frame: Frame, image: StepTexture) -> Node | str:
    value = image.size.value
    return image.size.kernel if value is None else frame.values[value]


@record
class PlannedTexture:
    """A texture that the host makes, for one result after the other."""

    shape: Shape
    images: list[StepTexture]
    """Each once, also where several layers or levels of one are drawn here, each with samples."""
    uses: tuple[TextureUse, ...] = ()
    """All uses, also those of the texture of the last frame with which it is exchanged."""
    kept: bool = False
    """True if its contents are needed in the next frame."""


class Textures:
    """All textures so far; each is named by its place among ``made``."""

    def __init__(self, waits: Waits, *, shares: bool) -> None:
        """``waits`` is told of each texture."""
        self.made: list[PlannedTexture] = []
        self._waits = waits
        self._shares = shares
        self._free: dict[Shape, list[int]] = {}
        self._lasting: set[int] = set()
        self._held: dict[int, StepTexture] = {}
        """The image that each texture holds by now."""

    def new(self, shape: Shape, image: StepTexture, *, lasts: bool = False) -> int:
        """A texture of its own; one that ``lasts`` is never shared."""
        self.made.append(PlannedTexture(shape, [image]))
        number = len(self.made) - 1
        self._waits.add(number)
        self._held[number] = image
        if lasts:
            self._lasting.add(number)
        return number

    def lasts(self, number: int) -> bool:
        """True if a texture is never shared, as steps of the first frame only draw to it."""
        return number in self._lasting

    def allot(self, shape: Shape, image: StepTexture) -> int:
        """A texture that is free, or else a new one."""
        free = self._free.get(shape)
        if not free or not self._shares:
            return self.new(shape, image)
        number = free.pop()
        self.share(number, image)
        return number

    def share(self, number: int, image: StepTexture) -> None:
        """Have a texture hold a result, behind those that it held before."""
        self._held[number] = image
        if image not in self.made[number].images:
            self.made[number].images.append(image)

    def release(self, number: int, image: StepTexture) -> None:
        """Let others have a texture, unless it holds another result by now."""
        if self._held[number] is image and number not in self._lasting:
            self._free.setdefault(self.made[number].shape, []).append(number)

    def exchange(self, one: int, other: int) -> None:
        """Has two textures take turns: the next frame reads the one that this frame writes."""
        for number in (one, other):
            self.made[number].kept = True

    def join_uses(self, exchanged: Iterable[tuple[int, int]]) -> None:
        """Notes all uses of each texture; two that are exchanged share theirs."""
        uses = self._waits.uses
        for number, texture in enumerate(self.made):
            texture.uses = tuple(uses[number])
        for one, other in exchanged:
            joined = tuple({**uses[one], **uses[other]})
            for number in (one, other):
                self.made[number].uses = joined
