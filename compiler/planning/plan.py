"""Makes a plan of a frame: textures that results share, copies, loads and stores, barriers.

``compiled.py`` calls ``plan`` when somebody asks for a frame's plan, and ``reflection/plan.py``
makes a document of the result.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from ...support.frozen import changed, frozen
from ..documents.plan import BufferUse, TextureUse, WaitingRow
from ..ir.frame import Attachment, Elements, Frame, KernelStep, RenderStep, Step, StepTexture
from .barriers import Waits
from .lifetimes import (
    Left,
    Lifetimes,
    attachments_of,
    only_first,
    read_by,
    written_by,
)
from .needs import DrawnPart, Needs, part_of
from .stencils import Stencils
from .textures import PlannedTexture, Shape, Textures
from .unchanging import unchanging


@frozen(eq=False)
class Target:
    """An attachment of a step, with the loads and stores of its texture."""

    attachment: Attachment
    texture: int
    loads: bool
    """True if the contents are kept at the start; otherwise they are cleared."""
    stores: bool
    """True if anybody needs the result."""
    has_stencil: bool = False
    """True if there are stencil values, too."""
    stores_stencil: bool = False
    """True if a later step reads the stencil values."""
    resolved: int | None = None
    """The texture to which the means of the samples are written behind the step.

    They go to the attachment's layer and level.
    """

    @property
    def place(self) -> tuple[int, int | None, int]:
        """The texture, its layer and its level that are drawn to."""
        at = self.attachment
        return (self.texture, at.layer, at.level) if at.image.samples == 1 else (self.texture, 0, 0)


@frozen(eq=False)
class Copy:
    """A copy of an image before a step draws over it.

    It is made where others still need the image as it was, or where the new one is kept.
    """

    image: StepTexture
    into: StepTexture


@frozen(eq=False)
class PlannedStep:
    """A step of the plan."""

    step: Step | Copy
    waiting: WaitingRow
    """The barriers before it."""
    targets: tuple[Target, ...] = ()
    depth: Target | None = None
    only_first: bool = False
    """True if the first frame is enough.

    The step leaves the same in every frame, or only the first frame needs its results.
    """
    continues: bool = False
    """True if it draws on where the step before has drawn, and nothing happens in between."""

    @property
    def places(self) -> list[tuple[int, int | None, int]]:
        """The textures, layers and levels that it draws to, its depths last."""
        return [target.place for target in self.drawn_to]

    @property
    def drawn_to(self) -> tuple[Target, ...]:
        """All targets that it draws to, its depths last."""
        return self.targets if self.depth is None else (*self.targets, self.depth)


@frozen(eq=False)
class Kept:
    """A texture or buffer that the next frame reads.

    Of two textures, or buffers, one is drawn while the other one still has the result of the last
    frame; after the frame they are exchanged.
    """

    left: Left
    texture: int | None
    previous: int | None
    """The textures; ``None`` for buffers, of which each result has its own."""


@frozen(eq=False)
class Plan:
    """The plan of a host for a frame."""

    frame: Frame
    textures: tuple[PlannedTexture, ...]
    texture_of: Mapping[StepTexture, int]
    lifetimes: Lifetimes
    stencils: Stencils
    steps: tuple[PlannedStep, ...]
    kept: tuple[Kept, ...]
    end: WaitingRow
    """The barriers behind the last step, so that the host and the next frame can read."""


def plan(frame: Frame, *, shares: bool = True) -> Plan:
    """The plan of a frame.

    Unless it ``shares``, every result has a texture of its own: this needs more memory, and says
    what the frame means even if sharing is wrong.
    """
    return _Planning(frame, shares=shares).plan()


class _Planning:
    def __init__(self, frame: Frame, *, shares: bool) -> None:
        self._frame = frame
        self._shares = shares
        self._lifetimes = Lifetimes.of(frame)
        self._needs = Needs.of(frame, self._lifetimes)
        self._stencils = Stencils.of(frame)
        self._waits = Waits(self._is_rare)
        self._textures = Textures(self._waits, shares=shares)
        self._texture_of: dict[StepTexture, int] = {}
        self._samples_of: dict[DrawnPart, int] = {}
        """The textures that steps with several samples draw to."""
        self._drawn: set[DrawnPart] = set()
        """The parts of images that have been drawn to."""
        self._rare = only_first(frame) | unchanging(frame)
        """The names of the steps of the first frame only.

        They share no textures, as they may be left out.
        """
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
            if steps and self._draws_on(steps, planned):
                planned = changed(planned, continues=True)
            steps.append(planned)
            self._release(number, step)
        end = self._waits.before(self._images_left(), self._buffers_left())
        self._textures.join_uses(
            (each.texture, each.previous)
            for each in kept
            if each.texture is not None and each.previous is not None
        )
        return Plan(
            self._frame,
            tuple(self._textures.made),
            self._texture_of,
            self._lifetimes,
            self._stencils,
            tuple(steps),
            kept,
            end,
        )

    def _is_rare(self, used: int | Elements) -> bool:
        """True if a texture, or a buffer, is used in the first frame only."""
        if isinstance(used, Elements):
            return used in self._rare_buffers
        return self._textures.lasts(used)

    # --- textures ---

    def _kept(self, left: Left) -> Kept:
        if not isinstance(left, StepTexture):
            return Kept(left, None, None)
        shape = self._shape(left)
        texture, previous = (self._textures.new(shape, left) for _ in range(2))
        self._textures.exchange(texture, previous)
        self._texture_of[left] = texture
        self._waits.add(previous, "sampled")
        return Kept(left, texture, previous)

    def _shape(self, image: StepTexture) -> Shape:
        return Shape.of(self._frame, self._stencils, image)

    def _placed(self, number: int, step: Step) -> Iterator[Copy]:
        """Finds a texture for everything that a step draws; yields the copies before it."""
        read = set(read_by(step))
        for attachment in attachments_of(step):
            image, over = attachment.image, attachment.over
            if image.samples > 1:
                self._place_samples(step, attachment)
                continue
            if over is None or self._lifetimes.first[image] < number:
                continue
            if image in self._texture_of:
                yield Copy(over, image)  # A kept result has a texture of its own.
            elif (
                self._shares and over not in read and self._needs.is_drawn_over(over, image, number)
            ):
                self._texture_of[image] = self._texture_of[over]
                self._textures.share(self._texture_of[over], image)
            else:
                self._texture_of[image] = self._found(step, image, self._shape(image))
                yield Copy(over, image)
        for left in written_by(step):
            if not isinstance(left, StepTexture) or left in self._texture_of:
                continue
            if left.samples == 1 or self._needs.is_resolved(number, left):
                self._texture_of[left] = self._found(step, left, self._shape(left))

    def _place_samples(self, step: Step, attachment: Attachment) -> None:
        """Find a texture for the samples to which a step draws: the one over which it draws."""
        image, over = attachment.image, attachment.over
        if part_of(attachment) in self._samples_of:
            return
        if over is None:
            shape = Shape.of_samples(self._frame, self._stencils, image, attachment.level)
            texture = self._found(step, image, shape)
        else:
            texture = self._samples_of[over, attachment.layer, attachment.level]
            self._textures.share(texture, image)
        self._samples_of[part_of(attachment)] = texture

    def _found(self, step: Step, image: StepTexture, shape: Shape) -> int:
        """A texture for a result of a step."""
        if step.name in self._rare:
            return self._textures.new(shape, image, lasts=True)
        return self._textures.allot(shape, image)

    def _release(self, number: int, step: Step) -> None:
        """Free the textures that nothing needs behind a step."""
        over = [each.over for each in attachments_of(step) if each.over is not None]
        touched = dict.fromkeys([*written_by(step), *read_by(step), *over])
        for left in touched:
            if isinstance(left, StepTexture) and self._lifetimes.is_over(left, number):
                texture = self._texture_of.get(left)
                if texture is not None:
                    self._textures.release(texture, left)
        for attachment in attachments_of(step):
            if attachment.image.samples > 1 and not self._needs.finds_samples(number, attachment):
                self._textures.release(self._samples_of[part_of(attachment)], attachment.image)

    # --- steps ---

    def _copied(self, copy: Copy, *, is_rare: bool) -> PlannedStep:
        states: tuple[tuple[TextureUse, StepTexture], ...] = (
            ("copied_from", copy.image), ("copied_to", copy.into),
        )  # fmt: skip
        self._drawn |= {(copy.into, layer, level) for image, layer, level in self._drawn
                        if image is copy.image}  # fmt: skip
        used = ((self._texture_of[i], state) for state, i in states)
        return PlannedStep(copy, self._waits.before(used, ()), only_first=is_rare)

    def _planned(self, number: int, step: Step) -> PlannedStep:
        targets = [self._target(number, each) for each in attachments_of(step)]
        self._drawn.update(part_of(target.attachment) for target in targets)
        waiting = self._waits.before(self._used(step, targets), _buffers_used(step))
        has_depth = not isinstance(step, KernelStep) and step.depth is not None
        depth = targets.pop() if has_depth else None
        return PlannedStep(step, waiting, tuple(targets), depth, step.name in self._rare)

    def _target(self, number: int, attachment: Attachment) -> Target:
        image, part = attachment.image, part_of(attachment)
        loads = part in self._drawn or attachment.over is not None
        stencil = image in self._stencils.images, self._stencils.are_needed(number, attachment)
        if image.samples == 1:
            needed = self._needs.is_needed(number, image)
            return Target(attachment, self._texture_of[image], loads, needed, *stencil)
        resolved = self._texture_of[image] if self._needs.resolves(number, attachment) else None
        finds = self._needs.finds_samples(number, attachment)
        return Target(attachment, self._samples_of[part], loads, finds, *stencil, resolved)

    def _used(self, step: Step, targets: Iterable[Target]) -> Iterator[tuple[int, TextureUse]]:
        for left in read_by(step):
            if isinstance(left, StepTexture):
                yield self._texture_of[left], "sampled"
        if isinstance(step, KernelStep):
            for image in step.images.values():
                yield self._texture_of[image], "image"
        for target in targets:
            yield target.texture, "depth" if target.attachment.image.is_depth else "target"
            if target.resolved is not None:
                yield target.resolved, "target"

    def _draws_on(self, steps: Sequence[PlannedStep], planned: PlannedStep) -> bool:
        """True if a step and those before it can be one render pass.

        They draw to the same places, each over what the last one leaves, and it waits for nothing
        else.
        """
        before, places = steps[-1], planned.places
        if not isinstance(before.step, RenderStep) or not isinstance(planned.step, RenderStep):
            return False
        resolved = {t.resolved for t in planned.drawn_to if t.resolved is not None}
        return (
            before.places == places
            and (before.depth is None) == (planned.depth is None)
            and before.only_first == planned.only_first
            and all(layer is not None for _, layer, _ in places)
            and all(target.loads for target in planned.drawn_to)
            and all(target.resolved is None for target in before.drawn_to)
            and not planned.waiting.buffer_barriers
            and {each.texture for each in planned.waiting.barriers}
            <= {place[0] for place in places} | resolved
            and resolved.isdisjoint(self._read_in_pass(steps))
        )

    def _read_in_pass(self, steps: Sequence[PlannedStep]) -> Iterator[int]:
        """The textures that are read in the render pass of the last one of the steps."""
        for planned in reversed(steps):
            if isinstance(planned.step, Copy):
                return
            for left in read_by(planned.step):
                if isinstance(left, StepTexture):
                    yield self._texture_of[left]
            if not planned.continues:
                return

    # --- results ---

    def _images_left(self) -> Iterator[tuple[int, TextureUse]]:
        """The textures that the host or the next frame reads."""
        for left in self._left():
            if isinstance(left, StepTexture):
                yield self._texture_of[left], "sampled"

    def _buffers_left(self) -> Iterator[tuple[Elements, BufferUse]]:
        """The buffers that are left for the host and the next frame, with their uses."""
        for left in self._left():
            if isinstance(left, Elements):
                yield left, "read"

    def _left(self) -> Iterator[Left]:
        yield from (output.source for output in self._frame.outputs)
        yield from self._lifetimes.kept


def _buffers_used(step: Step) -> Iterator[tuple[Elements, BufferUse]]:
    for left in read_by(step):
        if isinstance(left, Elements):
            yield left, "read"
    if isinstance(step, KernelStep):
        for elements in step.buffers.values():
            yield elements, "written"
