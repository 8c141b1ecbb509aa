"""Simulates a plan: every step finds its inputs in the right place, and has waited for them.

The simulation has a first and a second frame: the result that each texture holds in each layer and
level, and its use.
"""

from __future__ import annotations

from collections.abc import Iterator

from .....compiler.budget import Tally
from .....compiler.documents.plan import (
    AttachmentRow,
    BarrierRow,
    BufferBarrierRow,
    CopyEnd,
    CopyStep,
    DrawStep,
    FramePlan,
    PlanStep,
    PreviousSource,
    ResolveRow,
    StencilLoad,
    WaitingRow,
)
from .rows import (
    END,
    WRITES,
    fail,
    inputs,
    places,
    read_before,
    read_now,
    written,
)


def check_order(plan: FramePlan) -> None:
    """Raise ``PlanError`` for the first step that uses something before it is ready."""
    _Execution(plan).execute()


class _Execution:
    def __init__(self, plan: FramePlan) -> None:
        self._plan = plan
        self._uses: dict[int, str] = {}
        self._touched: set[int] = set()
        """Textures that this frame has used."""
        self._holds: dict[int, dict[tuple[int, int], str]] = {}
        """For each texture, the result that each layer and level holds."""
        self._stencils: dict[int, set[tuple[int, int]]] = {}
        """For each texture, the layers and levels with stencil values that have been kept."""
        self._buffers: dict[str, str] = {}
        """The present uses of the buffers of results that this frame has used."""
        self._kept_buffers: set[str] = set()
        self._step = ""
        self._meter = Tally("steps", f"the frame {plan.frame} uses layers and levels in")
        self._waited: set[int | str] = set()
        """Textures, and results in buffers, with a barrier before this step."""
        self._used_here: set[int | str] = set()
        rare = [step for step in plan.steps if step.only_first]
        self._lasting = {
            texture for step in rare for _, texture in written(step) if texture is not None
        }
        """Textures that only the first frame draws to, and that keep their contents."""

    def execute(self) -> None:
        """Simulate two frames."""
        for row in self._plan.kept:
            if row.previous is not None:
                self._uses[row.previous] = "sampled"
        for is_first in (True, False):
            self._begin(is_first)
            for step in self._plan.steps:
                self._step = step.name
                self._wait_at(step, is_first)
                if is_first or not step.only_first:
                    self._do(step, is_first)
            self._step = END
            self._wait_at(self._plan.end, is_first)
            self._end()
            self._check_waited(set())

    def _begin(self, is_first: bool) -> None:
        """Forget everything that the last frame has left, except what is kept."""
        kept = {row.previous for row in self._plan.kept if row.previous is not None}
        if not is_first:
            kept |= self._lasting
        self._holds = {texture: held for texture, held in self._holds.items()
                       if texture in kept}  # fmt: skip
        self._touched, self._buffers = kept, {}
        self._stencils = {texture: held for texture, held in self._stencils.items()
                          if texture in kept}  # fmt: skip

    def _end(self) -> None:
        """Read the host's outputs, and leave what the next frame reads."""
        for output in self._plan.outputs:
            self._step = f"output {output.name}"
            self._reads(output.texture, output.result)
        for row in self._plan.kept:
            self._step = f"kept {row.result}"
            self._reads(row.texture, row.result)
        self._step = END
        self._kept_buffers = set()
        for row in self._plan.kept:
            one, other = row.texture, row.previous
            if one is None or other is None:
                self._kept_buffers.add(row.result)
                continue
            self._holds[one], self._holds[other] = self._holds.get(other, {}), self._holds[one]
            self._uses[one], self._uses[other] = self._uses.get(other, "sampled"), self._uses[one]

    # --- steps -----------------------------------------------------------------------------------

    def _wait_at(self, place: PlanStep | WaitingRow, is_first: bool) -> None:
        """Wait at the barriers of a step, also if it is left out; or at those of the end."""
        self._waited, self._used_here = set(), set()
        for barrier in place.barriers:
            if is_first or not barrier.only_first:
                self._wait(barrier)
        for waited in place.buffer_barriers:
            if is_first or not waited.only_first:
                self._wait_for_buffer(waited)

    def _do(self, step: PlanStep, is_first: bool) -> None:
        self._read_all(step, is_first)
        if isinstance(step, CopyStep):
            self._copy(step.copied, step.into)
        for image in step.images:
            self._written(image.texture, "image")
            self._holds[image.texture] = {(0, 0): image.result}
        if isinstance(step, DrawStep):
            for target in step.attachments:
                self._draw(target, "depth" if target is step.depth else "target")
        for row in step.buffers:
            self._used_buffer(row.result, "written")
        # Later frames also wait for results that the first one reads in place of a last one's.
        read_first: set[int | str] = {
            result if texture is None else texture
            for result, texture in read_now(step, is_first=True)
        }
        self._check_waited(set() if is_first else read_first)

    def _check_waited(self, also: set[int | str]) -> None:
        """Check that everything that a step waited for is used, except some of it."""
        for used in sorted(map(_said, self._waited - self._used_here - also)):
            self._fail(f"it waits for {used}, which it does not use")

    def _wait(self, barrier: BarrierRow) -> None:
        texture, before = barrier.texture, barrier.before
        known = self._uses.get(texture, "undefined") if texture in self._touched else "undefined"
        if before != known:
            self._fail(f"texture {texture} is used as {known} before, and not as {before}")
        if before == barrier.after and before not in WRITES:
            self._fail(f"it waits for texture {texture}, which was only read as {before}")
        if before == "undefined":
            self._holds[texture] = {}
            self._stencils.pop(texture, None)
        self._uses[texture] = barrier.after
        self._touched.add(texture)
        self._waited.add(texture)

    def _wait_for_buffer(self, barrier: BufferBarrierRow) -> None:
        result, before = barrier.result, barrier.before
        known = self._buffers.get(result, "undefined")
        if before != known:
            self._fail(f"the buffer of `{result}` is {known} before, and not {before}")
        if before == barrier.after:
            self._fail(f"it waits for the buffer of `{result}`, which was {before} already")
        self._buffers[result] = barrier.after
        self._waited.add(result)

    def _used_buffer(self, result: str, use: str) -> None:
        known = self._buffers.get(result, "undefined")
        if known != use:
            self._fail(f"the buffer of `{result}` is {use}, and no barrier says so: it is {known}")
        self._used_here.add(result)

    def _used(self, texture: int, use: str) -> None:
        known = self._uses.get(texture, "undefined")
        if known != use or texture not in self._touched:
            self._fail(f"texture {texture} is used as {use}, and no barrier says so: it is {known}")
        self._used_here.add(texture)

    def _written(self, texture: int, use: str) -> None:
        self._used(texture, use)
        if texture not in self._waited:
            self._fail(f"nothing waits for what was done to texture {texture} before")

    # --- contents --------------------------------------------------------------------------------

    def _read_all(self, step: PlanStep, is_first: bool) -> None:
        for result, texture in read_now(step, is_first=is_first):
            self._reads(texture, result)
        black = {
            (row.source.previous, row.source.texture)
            for row in inputs(step)
            if isinstance(row.source, PreviousSource) and row.source.initially is None
        }
        for result, texture in read_before(step):
            if texture is None:
                if not is_first and result not in self._kept_buffers:
                    self._fail(f"the last frame has left no `{result}`")
                continue
            if is_first and (result, texture) not in black:
                continue
            self._used(texture, "sampled")
            if not is_first:
                self._finds(texture, result)

    def _reads(self, texture: int | None, result: str) -> None:
        """Check that a result can be read."""
        if texture is None:
            self._used_buffer(result, "read")
        else:
            self._used(texture, "sampled")
            self._finds(texture, result)

    def _finds(self, texture: int, result: str) -> None:
        """Check that a texture holds the whole of a result."""
        held = self._holds.get(texture, {})
        for place in self._all_of(texture):
            if held.get(place) != result:
                found = held.get(place)
                what = f"`{found}`" if found else "nothing"
                self._fail(f"texture {texture} should hold `{result}`, and holds {what}")

    def _all_of(self, texture: int) -> Iterator[tuple[int, int]]:
        """Every layer and level of a texture. Raises ``BudgetError`` for too many in all."""
        row = self._plan.textures[texture]
        self._meter.add(row.layers * row.levels)
        return places(row)

    def _copy(self, source: CopyEnd, target: CopyEnd) -> None:
        self._used(source.texture, "copied_from")
        self._finds(source.texture, source.result)
        self._written(target.texture, "copied_to")
        whole = self._all_of(target.texture)
        self._holds[target.texture] = dict.fromkeys(whole, source.result)
        self._stencils[target.texture] = set(self._stencils.get(source.texture, ()))

    def _draw(self, target: AttachmentRow, use: str) -> None:
        texture, result, over = target.texture, target.result, target.over
        self._written(texture, use)
        held = self._holds.setdefault(texture, {})
        layers = self._plan.textures[texture].layers if target.layer is None else 1
        self._meter.add(layers)
        for layer in range(layers) if target.layer is None else (target.layer,):
            place = layer, target.level
            found = held.get(place)
            if target.load == "load" and found != (over or result):
                self._fail(f"`{result}` is drawn over something else: {found or 'nothing'}")
            if target.load == "clear" and (found == result or over is not None):
                self._fail(f"`{result}` is cleared, and should be drawn over")
            held[place] = result if target.store else ""
            if target.stencil is not None:
                self._draw_stencil(texture, place, target.stencil, target.load)
        if target.resolve is not None:
            self._resolve(target.resolve, result)

    def _resolve(self, target: ResolveRow, result: str) -> None:
        """Write the mean of a result's samples to the place where other steps find the result."""
        self._written(target.texture, "target")
        held = self._holds.setdefault(target.texture, {})
        held[target.layer, target.level] = result

    def _draw_stencil(
        self, texture: int, place: tuple[int, int], stencil: StencilLoad, load: str
    ) -> None:
        """Load stencil values as the depths beside them, and keep them if they are stored."""
        kept = self._stencils.setdefault(texture, set())
        if stencil.load != load:
            self._fail(f"its depths are to {load}, and its stencil values otherwise")
        if stencil.load == "load" and place not in kept:
            self._fail(
                f"it finds stencil values in texture {texture}, which nothing has kept there"
            )
        if stencil.store:
            kept.add(place)
        else:
            kept.discard(place)

    def _fail(self, text: str) -> None:
        fail(self._plan, self._step, text)


def _said(used: int | str) -> str:
    return f"texture {used}" if isinstance(used, int) else f"the buffer of `{used}`"
