"""Checks a plan's rows about results against the steps.

Which texture has a result, which step reads it last, how a texture is used, and what has to be
stored: all of this follows from the steps, and hosts rely on it when they make, share and free
memory.
"""

from __future__ import annotations

from bisect import bisect_right
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set

from .....compiler.documents.plan import (
    AttachmentRow,
    CopyStep,
    DrawStep,
    FramePlan,
    KeptRow,
    OutputRow,
    PlanStep,
)
from .....support.frozen import cached_property
from .rows import (
    Reading,
    drawn_over,
    fail,
    has_samples,
    places_of_waiting,
    read_before,
    read_now,
    written,
)

_Place = tuple[str, int, int | None, int]
"""The place to which a step draws: the result, its texture, and the texture's layer and level."""


def check_needs(plan: FramePlan) -> None:
    """Raise ``PlanError`` for a row that contradicts the steps."""
    needs = _Needs(plan)
    needs.check_results()
    needs.check_textures()
    needs.check_steps()


class _Needs:
    def __init__(self, plan: FramePlan) -> None:
        self._plan = plan
        self._steps = plan.steps
        self._results = {row.name: row for row in plan.results}
        self._outputs = {row.result for row in plan.outputs}
        self._previous = {row.previous: row.result for row in plan.kept
                          if row.previous is not None}  # fmt: skip
        """For textures that the last frame has left, the result."""

    @cached_property
    def _read_last(self) -> dict[str, None]:
        """The results that the next frame reads, in order."""
        return {result: None for step in self._steps for result, _ in read_before(step)}

    # --- results and textures --------------------------------------------------------------------

    def check_results(self) -> None:
        """Check that every result is in the texture that its users name, as long as stated."""
        first: dict[str, int] = {}
        last: dict[str, int] = {}
        for number, step in enumerate(self._steps):
            for result, texture in self._mentioned(step):
                self._check_place(step.name, result, texture)
            if step.kind == "copy":
                continue
            for result, _ in written(step):
                first.setdefault(result, number)
            used = (*written(step), *read_now(step, is_first=True))
            for result in (*(result for result, _ in used), *drawn_over(step)):
                last[result] = number
        last |= dict.fromkeys(self._outputs, len(self._steps) - 1)
        left: tuple[OutputRow | KeptRow, ...] = (*self._plan.outputs, *self._plan.kept)
        for each in left:
            self._check_place(f"result {each.result}", each.result, each.texture)
        for name in first.keys() - self._results.keys():
            fail(self._plan, name, "no row says where it is")
        for name, row in self._results.items():
            if name not in first:
                fail(self._plan, name, "no step leaves it")
            if (row.first, row.last) != (first[name], last[name]):
                fail(self._plan, name,
                     f"it is needed from step {first[name]} to {last[name]}, and not from "
                     f"{row.first} to {row.last}")  # fmt: skip
        kept = [row.result for row in self._plan.kept]
        if sorted(kept) != sorted(self._read_last):
            fail(self._plan, "kept", f"the next frame reads {_listed(self._read_last)}, and "
                 f"{_listed(kept)} is kept")  # fmt: skip

    def _mentioned(self, step: PlanStep) -> Iterator[Reading]:
        """The results of this frame that a step names, each with a texture."""
        for row in step.attachments:
            if not has_samples(self._plan, row):
                yield row.result, row.texture
            elif row.resolve is not None:
                yield row.result, row.resolve.texture
        for image in step.images:
            yield image.result, image.texture
        for buffer in step.buffers:
            yield buffer.result, None
        yield from read_now(step, is_first=True)
        yield from read_now(step, is_first=False)
        if isinstance(step, CopyStep):
            for end in (step.copied, step.into):
                yield end.result, end.texture

    def _check_place(self, where: str, result: str, texture: int | None) -> None:
        row = self._results.get(result)
        if row is None or row.texture != texture:
            fail(self._plan, where, f"`{result}` is not in texture {texture}")

    def check_textures(self) -> None:
        """Check that every texture has the results and uses that its row states."""
        pairs = dict(_exchanged(self._plan))
        kept = pairs.keys()
        for number, row in enumerate(self._plan.textures):
            where = f"texture {number}"
            names = (
                [self._previous[number]] if number in self._previous else self._held.get(number, [])
            )
            if list(row.results) != names:
                fail(self._plan, where, f"it holds {_listed(names)}")
            if row.kept != (number in kept):
                fail(self._plan, where, f"kept is {not row.kept}")
            other = pairs.get(number)
            uses = self._used_as[number] | self._used_as[number if other is None else other]
            if set(row.uses) != uses or len(row.uses) != len(uses):
                fail(self._plan, where, f"it is used as {_listed(sorted(uses))}")

    @cached_property
    def _held(self) -> Mapping[int, list[str]]:
        """The results that each texture holds, in order.

        They are all results that other steps find there, and all that are drawn there with several
        samples.
        """
        found: dict[int, dict[str, int]] = defaultdict(dict)
        for name, row in self._results.items():
            if row.texture is not None:
                found[row.texture][name] = row.first
        for number, step in enumerate(self._steps):
            for drawn in step.attachments:
                if has_samples(self._plan, drawn):
                    found[drawn.texture].setdefault(drawn.result, number)
        return {texture: sorted(first, key=first.__getitem__) for texture, first in found.items()}

    @cached_property
    def _used_as(self) -> Mapping[int, set[str]]:
        """The uses of each texture, for as long as it has its number."""
        found: dict[int, set[str]] = defaultdict(set)
        for texture in self._previous:
            found[texture].add("sampled")
        for _, place in places_of_waiting(self._plan):
            for row in place.barriers:
                found[row.texture].add(row.after)
        return found

    # --- steps -----------------------------------------------------------------------------------

    def check_steps(self) -> None:
        """Check that a step stores what is needed, and that later frames wait for what they use."""
        self._check_later_frames()
        read_in_pass: set[int | None] = set()
        for number, step in enumerate(self._steps):
            where = step.name
            if isinstance(step, DrawStep):
                self._check_continued(number, step, read_in_pass)
            if not (isinstance(step, DrawStep) and step.continues):
                read_in_pass = set()
            read_in_pass.update(texture for _, texture in read_now(step, is_first=True))
            for row in step.attachments:
                self._check_stored(number, where, row)
                if row.stencil is not None and row.stencil.store != self._is_found(number, row):
                    said = "stored" if row.stencil.store else "dropped"
                    fail(self._plan, where, f"stencil values of `{row.result}` are {said}")
            places = {(row.layer, row.level) for row in step.attachments}
            resolved = {(row.resolve.layer, row.resolve.level)
                        for row in step.attachments if row.resolve is not None}  # fmt: skip
            if len(places) > 1 or len(resolved) > 1:
                fail(self._plan, where, "its targets are different layers or levels")

    def _check_stored(self, number: int, where: str, row: AttachmentRow) -> None:
        """Check that results that are needed later are stored, and of samples their mean."""
        result, needed = row.result, self._is_needed(number, row.result)
        if has_samples(self._plan, row):
            step = self._steps[number]
            is_depth = isinstance(step, DrawStep) and row is step.depth
            resolves = needed and not is_depth and self._resolves(number, row)
            if (row.resolve is not None) != resolves:
                said = "read later" if resolves else "read by nobody"
                fail(self._plan, where, f"the mean of the samples of `{result}` is {said}")
            needed = self._is_found(number, row)
        if row.store != needed:
            fail(self._plan, where, f"`{result}` is {'stored' if row.store else 'dropped'}")

    def _resolves(self, number: int, drawn: AttachmentRow) -> bool:
        """True if a step's result is read before another step draws to the same place."""
        read = _next(self._reads.get(drawn.result, ()), number)
        again = _next(self._draws.get(_place(drawn), ()), number)
        return again is None or (read is not None and read <= again)

    @cached_property
    def _reads(self) -> Mapping[str, list[int]]:
        """The steps that read each result, in order."""
        found: dict[str, list[int]] = defaultdict(list)
        for number, step in enumerate(self._steps):
            for result, _ in read_now(step, is_first=True):
                found[result].append(number)
        return dict(found)

    @cached_property
    def _draws(self) -> Mapping[_Place, list[int]]:
        """The steps that draw on at each place, in order. One that clears the samples there draws
        another layer of the result."""
        found: dict[_Place, list[int]] = defaultdict(list)
        for number, step in enumerate(self._steps):
            for row in step.attachments:
                if row.load == "load":
                    found[_place(row)].append(number)
        return dict(found)

    def _check_later_frames(self) -> None:
        """Check that later frames wait for all that each of them writes, and for nothing else."""
        always = [each for step in self._steps if not step.only_first for each in written(step)]
        results = {result for result, _ in always}
        textures = {texture for _, texture in always}
        textures |= {texture for texture, _ in _exchanged(self._plan)}
        for where, place in places_of_waiting(self._plan):
            waited = [
                (f"texture {row.texture}", row.texture in textures, row.only_first)
                for row in place.barriers
            ]
            waited += [
                (f"the buffer of `{row.result}`", row.result in results, row.only_first)
                for row in place.buffer_barriers
            ]
            for what, is_always, only_first in waited:
                if only_first == is_always:
                    fail(self._plan, where, f"whether later frames wait for {what} is said wrongly")

    def _check_continued(self, number: int, step: DrawStep, read: Set[int | None]) -> None:
        """Check that the plan says rightly if a step goes on in the render pass before it.

        ``read`` are the textures that are read in that pass.
        """
        before = self._steps[number - 1] if number else None
        here = _places(step)
        resolved = {row.resolve.texture for row in step.attachments
                    if row.resolve is not None}  # fmt: skip
        continues = (
            isinstance(before, DrawStep)
            and here == _places(before)
            and (step.depth is None) == (before.depth is None)
            and step.only_first == before.only_first
            and all(row.load == "load" and row.layer is not None for row in step.attachments)
            and all(row.resolve is None for row in before.attachments)
            and not step.buffer_barriers
            and {row.texture for row in step.barriers}
            <= {texture for texture, *_ in here} | resolved
            and resolved.isdisjoint(read)
        )
        if step.continues != continues:
            fail(self._plan, step.name, "whether it draws on is said wrongly")

    def _is_needed(self, number: int, result: str) -> bool:
        """True if a result that a step draws is needed after the step."""
        is_left = result in self._outputs or result in self._read_last
        return is_left or self._last_read.get(result, number) > number

    def _is_found(self, number: int, left: AttachmentRow) -> bool:
        """True if a later step draws over the stencil values or samples that a step leaves.

        Samples are found only with the same number of samples, as other steps find one value for
        each texel.
        """
        over = left.result, left.texture if has_samples(self._plan, left) else None
        last = max(self._last_over.get(over, -1), self._last_draw.get(_place(left), -1))
        return last > number

    @cached_property
    def _last_draw(self) -> Mapping[_Place, int]:
        """The last step that draws on at each place."""
        return {place: numbers[-1] for place, numbers in self._draws.items()}

    @cached_property
    def _last_over(self) -> Mapping[tuple[str, int | None], int]:
        """The last step that draws over each result, in a texture or in any."""
        found: dict[tuple[str, int | None], int] = {}
        for number, step in enumerate(self._steps):
            for row in step.attachments:
                if row.over is not None:
                    found[row.over, row.texture] = found[row.over, None] = number
        return found

    @cached_property
    def _last_read(self) -> dict[str, int]:
        """The last step that reads each result, or draws over it with one sample."""
        found = {}
        for number, step in enumerate(self._steps):
            for result, _ in read_now(step, is_first=True):
                found[result] = number
            for row in step.attachments:
                if row.over is not None and not has_samples(self._plan, row):
                    found[row.over] = number
        return found


def _exchanged(plan: FramePlan) -> Iterator[tuple[int | None, int | None]]:
    """Each texture that is kept, and the one that it is exchanged with; also the other way
    around."""
    for row in plan.kept:
        yield row.texture, row.previous
        yield row.previous, row.texture


def _next(numbers: Sequence[int], number: int) -> int | None:
    """The first of some numbers in order that is larger than another one."""
    at = bisect_right(numbers, number)
    return numbers[at] if at < len(numbers) else None


def _place(row: AttachmentRow) -> _Place:
    return row.result, row.texture, row.layer, row.level


def _places(step: PlanStep) -> list[tuple[int, int | None, int]]:
    return [(row.texture, row.layer, row.level) for row in step.attachments]


def _listed(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names) or "nothing"
