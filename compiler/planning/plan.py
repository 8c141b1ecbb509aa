"""Makes a plan of a frame: textures that results share, copies, loads and stores, barriers.

``compiled.py`` calls ``plan`` when somebody asks for a frame's plan, and ``reflection/plan.py``
writes what comes of it as JSON.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping

from ...frozen import changed, frozen, record
from ..ir.frame import Attachment, Elements, Frame, Image, KernelStep, RenderStep, Step
from .barriers import BufferState, State, Waiting, Waits
from .lifetimes import (
    ALWAYS,
    Left,
    Lifetimes,
    attachments_of,
    only_first,
    read_by,
    written_by,
)
from .stencils import Stencils
from .unchanging import unchanging


@record
class PlannedTexture:
    """A texture that the host makes, for one result after the other."""

    images: list[Image]
    uses: tuple[State, ...] = ()
    """All that it is used as, also where it is exchanged with the one that the last frame left."""
    kept: bool = False
    """Whether its contents are needed in the next frame."""


@frozen(eq=False)
class Target:
    """An attachment of a step with what happens to its texture."""

    attachment: Attachment
    texture: int
    loads: bool
    """Whether what is there is kept; else it is cleared."""
    stores: bool
    """Whether anybody needs what is drawn."""
    has_stencil: bool = False
    """Whether there are stencil values, too."""
    stores_stencil: bool = False
    """Whether a later step finds these."""


@frozen(eq=False)
class Copy:
    """What is there before a step draws over it, where others still need what was there, or where
    what is drawn is kept."""

    image: Image
    into: Image


@frozen(eq=False)
class PlannedStep:
    """A step of the plan."""

    step: Step | Copy
    waiting: Waiting
    """What is waited for before it."""
    targets: tuple[Target, ...] = ()
    depth: Target | None = None
    only_first: bool = False
    """Whether the first frame is enough: it leaves the same in every frame, or only the first frame
    needs it."""
    continues: bool = False
    """Whether it draws on where the step before has drawn, and nothing happens in between."""

    @property
    def places(self) -> list[tuple[int, int | None, int]]:
        """The textures, layers and levels that it draws to, its depths last."""
        every = self.targets if self.depth is None else (*self.targets, self.depth)
        return [(each.texture, each.attachment.layer, each.attachment.level) for each in every]


@frozen(eq=False)
class Kept:
    """Something that the next frame reads: of two textures, or buffers, one is drawn while the
    other one still has what the last frame left; after the frame they are exchanged."""

    left: Left
    texture: int | None
    previous: int | None
    """The textures; ``None`` for buffers, of which each result has its own."""


@frozen(eq=False)
class Plan:
    """What a host does for a frame."""

    frame: Frame
    textures: tuple[PlannedTexture, ...]
    texture_of: Mapping[Image, int]
    lifetimes: Lifetimes
    stencils: Stencils
    steps: tuple[PlannedStep, ...]
    kept: tuple[Kept, ...]
    end: Waiting
    """What is waited for behind the last step, so that the host and the next frame can read."""


def plan(frame: Frame, *, shares: bool = True) -> Plan:
    """The plan of a frame. Unless it ``shares``, every result has a texture of its own: this needs
    more memory, and says what the frame means even if sharing is wrong."""
    return _Planning(frame, shares=shares).plan()


class _Planning:
    def __init__(self, frame: Frame, *, shares: bool) -> None:
        self._frame = frame
        self._shares = shares
        self._lifetimes = Lifetimes.of(frame)
        self._stencils = Stencils.of(frame)
        self._textures: list[PlannedTexture] = []
        self._texture_of: dict[Image, int] = {}
        self._free: dict[Hashable, list[int]] = {}
        self._waits = Waits(self._is_rare)
        self._drawn: set[tuple[Image, int | None, int]] = set()
        """Layers and levels that have been drawn to."""
        self._rare = only_first(frame) | unchanging(frame)
        """The names of the steps of the first frame only."""
        self._rare_textures: set[int] = set()
        """Theirs, which nothing else shares: these steps may be left out."""
        self._rare_buffers = {
            left
            for step in frame.steps
            for left in written_by(step)
            if step.name in self._rare and isinstance(left, Elements)
        }

    def plan(self) -> Plan:
        kept = tuple(self._kept(left) for left in self._lifetimes.kept)
        steps: list[PlannedStep] = []
        for number, step in enumerate(self._frame.steps):
            copies = list(self._placed(number, step))
            is_rare = step.name in self._rare
            steps += [self._copied(copy, is_rare=is_rare) for copy in copies]
            planned = self._planned(number, step)
            if steps and _draws_on(steps[-1], planned):
                planned = changed(planned, continues=True)
            steps.append(planned)
            self._release(number, step)
        end = self._waits.before(self._images_left(), self._buffers_left())
        self._join_uses(kept)
        return Plan(
            self._frame,
            tuple(self._textures),
            self._texture_of,
            self._lifetimes,
            self._stencils,
            tuple(steps),
            kept,
            end,
        )

    def _is_rare(self, used: int | Elements) -> bool:
        """Whether a texture, or a buffer, is used in the first frame only."""
        return used in (self._rare_buffers if isinstance(used, Elements) else self._rare_textures)

    # --- textures ---

    def _kept(self, left: Left) -> Kept:
        if not isinstance(left, Image):
            return Kept(left, None, None)
        texture, previous = self._new(left), self._new(left)
        for number in (texture, previous):
            self._textures[number].kept = True
        self._texture_of[left] = texture
        self._waits.add(previous, "sampled")
        return Kept(left, texture, previous)

    def _new(self, image: Image) -> int:
        self._textures.append(PlannedTexture([image]))
        self._waits.add(len(self._textures) - 1)
        return len(self._textures) - 1

    def _join_uses(self, kept: Iterable[Kept]) -> None:
        """Say what each texture is used as; of two that are exchanged, what either is."""
        uses = self._waits.uses
        for number, texture in enumerate(self._textures):
            texture.uses = tuple(uses[number])
        for each in kept:
            if each.texture is not None and each.previous is not None:
                joined = tuple({**uses[each.texture], **uses[each.previous]})
                for number in (each.texture, each.previous):
                    self._textures[number].uses = joined

    def _key(self, image: Image) -> Hashable:
        """What two images have in common that can share a texture."""
        value = image.size.value
        size = image.size.kernel if value is None else self._frame.values[value].id
        format_ = self._stencils.format_of(image)
        return (format_, size, image.size.level, image.dimension, image.layers, image.levels)

    def _placed(self, number: int, step: Step) -> Iterator[Copy]:
        """Find a texture for everything that a step draws; what has to be copied before it."""
        read = set(read_by(step))
        for attachment in attachments_of(step):
            image, over = attachment.image, attachment.over
            if over is None or self._lifetimes.first[image] < number:
                continue
            if image in self._texture_of:
                yield Copy(over, image)  # What is kept has a texture of its own.
            elif self._shares and over not in read and self._is_drawn_over(over, image, number):
                self._share(image, self._texture_of[over])
            else:
                self._find_texture(step, image)
                yield Copy(over, image)
        for left in written_by(step):
            if isinstance(left, Image) and left not in self._texture_of:
                self._find_texture(step, left)

    def _find_texture(self, step: Step, image: Image) -> None:
        """Find a texture for what a step leaves."""
        if step.name in self._rare:
            self._texture_of[image] = self._new(image)
            self._rare_textures.add(self._texture_of[image])
        else:
            self._allot(image)

    def _is_drawn_over(self, over: Image, image: Image, number: int) -> bool:
        """Whether nobody needs what is there from a step on but those that draw an image over it:
        there may be a step for each of its layers."""
        if over in self._lifetimes.kept or self._lifetimes.last[over] == ALWAYS:
            return False
        return all(
            over not in read_by(step)
            and all(each.image is image for each in attachments_of(step) if each.over is over)
            for step in self._frame.steps[number:]
        )

    def _allot(self, image: Image) -> None:
        free = self._free.get(self._key(image))
        if free and self._shares:
            self._share(image, free.pop())
        else:
            self._texture_of[image] = self._new(image)

    def _share(self, image: Image, texture: int) -> None:
        self._texture_of[image] = texture
        self._textures[texture].images.append(image)

    def _release(self, number: int, step: Step) -> None:
        """Free the textures that nothing needs behind a step."""
        over = [each.over for each in attachments_of(step) if each.over is not None]
        touched = dict.fromkeys([*written_by(step), *read_by(step), *over])
        for left in touched:
            if not isinstance(left, Image) or not self._lifetimes.is_over(left, number):
                continue
            texture = self._texture_of[left]
            if self._textures[texture].images[-1] is left and texture not in self._rare_textures:
                self._free.setdefault(self._key(left), []).append(texture)

    # --- steps ---

    def _copied(self, copy: Copy, *, is_rare: bool) -> PlannedStep:
        states: tuple[tuple[State, Image], ...] = (
            ("copied_from", copy.image), ("copied_to", copy.into),
        )  # fmt: skip
        self._drawn |= {(copy.into, layer, level) for image, layer, level in self._drawn
                        if image is copy.image}  # fmt: skip
        used = ((self._texture_of[i], state) for state, i in states)
        return PlannedStep(copy, self._waits.before(used, ()), only_first=is_rare)

    def _planned(self, number: int, step: Step) -> PlannedStep:
        waiting = self._waits.before(self._used(step), _buffers_used(step))
        targets = [self._target(number, each) for each in attachments_of(step)]
        for target in targets:
            attachment = target.attachment
            self._drawn.add((attachment.image, attachment.layer, attachment.level))
        has_depth = not isinstance(step, KernelStep) and step.depth is not None
        depth = targets.pop() if has_depth else None
        return PlannedStep(step, waiting, tuple(targets), depth, step.name in self._rare)

    def _target(self, number: int, attachment: Attachment) -> Target:
        image = attachment.image
        again = (image, attachment.layer, attachment.level) in self._drawn
        return Target(
            attachment, self._texture_of[image], again or attachment.over is not None,
            self._is_needed(number, image), image in self._stencils.images,
            self._stencils.are_needed(number, attachment),
        )  # fmt: skip

    def _is_needed(self, number: int, image: Image) -> bool:
        """Whether somebody reads an image behind a step that draws it."""
        if image in self._lifetimes.kept or self._lifetimes.last[image] == number:
            return image in self._lifetimes.kept
        later = self._frame.steps[number + 1 :]
        reads = any(image in set(read_by(step)) for step in later)
        drawn_over = any(each.over is image for step in later for each in attachments_of(step))
        return reads or drawn_over or any(o.source is image for o in self._frame.outputs)

    def _used(self, step: Step) -> Iterator[tuple[int, State]]:
        for left in read_by(step):
            if isinstance(left, Image):
                yield self._texture_of[left], "sampled"
        if isinstance(step, KernelStep):
            for image in step.images.values():
                yield self._texture_of[image], "image"
            return
        for attachment in step.attachments:
            yield self._texture_of[attachment.image], "target"
        if step.depth is not None:
            yield self._texture_of[step.depth.image], "depth"

    # --- what is left ---

    def _images_left(self) -> Iterator[tuple[int, State]]:
        """The textures that the host or the next frame reads."""
        for left in self._left():
            if isinstance(left, Image):
                yield self._texture_of[left], "sampled"

    def _buffers_left(self) -> Iterator[tuple[Elements, BufferState]]:
        """Likewise."""
        for left in self._left():
            if isinstance(left, Elements):
                yield left, "read"

    def _left(self) -> Iterator[Left]:
        yield from (output.source for output in self._frame.outputs)
        yield from self._lifetimes.kept


def _buffers_used(step: Step) -> Iterator[tuple[Elements, BufferState]]:
    for left in read_by(step):
        if isinstance(left, Elements):
            yield left, "read"
    if isinstance(step, KernelStep):
        for elements in step.buffers.values():
            yield elements, "written"


def _draws_on(before: PlannedStep, planned: PlannedStep) -> bool:
    """Whether both steps can be one render pass: they draw to the same places, one of them over
    what the other leaves, and the second one waits for nothing else."""
    if not isinstance(before.step, RenderStep) or not isinstance(planned.step, RenderStep):
        return False
    places = planned.places
    every = (*planned.targets, *(() if planned.depth is None else (planned.depth,)))
    return (
        before.places == places
        and (before.depth is None) == (planned.depth is None)
        and before.only_first == planned.only_first
        and all(layer is not None for _, layer, _ in places)
        and all(each.loads for each in every)
        and not planned.waiting.buffers
        and {each.texture for each in planned.waiting.textures} <= {place[0] for place in places}
    )
