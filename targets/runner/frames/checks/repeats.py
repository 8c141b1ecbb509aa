"""Checks which steps of a plan are done in the first frame only.

These are the steps that later frames do not need, since they find what the last one left, and steps
that would leave the same in every frame.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence, Set
from itertools import zip_longest

from .....compiler.documents.plan import FramePlan, PlanStep, ResultSource, UseRow, ValueSource
from .....compiler.documents.reflection import Reflection
from .....compiler.documents.steps import ParameterStep, TextureStep
from .rows import (
    drawn_over,
    fail,
    inputs,
    read_before,
    read_now,
    written,
)


def check_repeats(plan: FramePlan, reflections: Sequence[Reflection] | None) -> None:
    """Raise ``PlanError`` for a step that would be missing in later frames."""
    repeats = _Repeats(plan, reflections)
    unneeded = repeats.only_first()
    for step, following in zip_longest(plan.steps, plan.steps[1:]):
        where = step.name
        if step.kind == "copy":
            if following is None or step.only_first != following.only_first:
                fail(plan, where, "it is for the step behind it, and not done as often")
            continue
        if step.only_first != (where in unneeded) and not (
            step.only_first and repeats.leaves_the_same(step)
        ):
            fail(plan, where, "whether it is needed in later frames is said wrongly")


class _Repeats:
    def __init__(self, plan: FramePlan, reflections: Sequence[Reflection] | None) -> None:
        self._plan = plan
        self._reflections = reflections
        self._outputs = {row.result for row in plan.outputs}
        self._drawn_anew = {over for step in plan.steps for over in drawn_over(step)}
        self._drawn_anew |= {row.result for row in plan.kept} | self._outputs
        self._often = {result for step in plan.steps if not step.only_first
                       for result, _ in written(step)}  # fmt: skip
        """Results that every frame draws."""
        self._constant = [
            not any(isinstance(part, ParameterStep | TextureStep) for part in value.steps)
            for value in plan.values
        ]
        """For each value, True if it is the same in every frame."""
        self._read_by: dict[int, Set[str]] = {}
        """The names that a shader reads, by the shader's number."""

    def only_first(self) -> set[str]:
        """The names of the steps that only a first frame needs, since it has no last one."""
        steps = {step.name: step for step in self._plan.steps if step.kind != "copy"}
        leaves: dict[str, list[str]] = defaultdict(list)
        for name, step in steps.items():
            for result, _ in written(step):
                leaves[result].append(name)
        needed: set[str] = set()
        pending = list(self._outputs)
        reached = set(pending)
        while pending:
            for name in leaves[pending.pop()]:
                if name in needed:
                    continue
                needed.add(name)
                further = _wanted(steps[name]) - reached
                reached |= further
                pending += further
        return steps.keys() - needed

    def leaves_the_same(self, step: PlanStep) -> bool:
        """True if nothing that a step is given, or draws to, changes from frame to frame."""
        results = {result for result, _ in written(step)}
        changes = results & self._drawn_anew or results & self._often
        if changes or any(drawn_over(step)):
            return False
        if any(drawn.models is not None or drawn.light for drawn in step.draws):
            return False
        for row in inputs(step):
            source = row.source
            is_same = isinstance(source, ResultSource) and source.result not in self._often
            if not is_same and not isinstance(source, ValueSource):
                return False
        return all(self._is_constant(number) for number in self._numbers(step)) and all(
            self._is_given_all(use) for use in step.uses
        )

    def _numbers(self, step: PlanStep) -> Iterator[int | None]:
        """The values that define a step's draws and sizes; ``None`` for an unknown one."""
        textures = [row.texture for row in step.attachments]
        textures += [image.texture for image in step.images]
        yield from (self._plan.textures[texture].size.value for texture in textures)
        if step.buffers:
            yield None
        for drawn in step.draws:
            yield drawn.vertices
        for row in inputs(step):
            if isinstance(row.source, ValueSource):
                yield row.source.value

    def _is_constant(self, number: int | None) -> bool:
        return number is not None and self._constant[number]

    def _is_given_all(self, use: UseRow) -> bool:
        """True if the frame sets everything that a shader reads, as far as that is known."""
        if self._reflections is None:
            return True
        shader = use.shader
        if shader not in self._read_by:
            self._read_by[shader] = set(_read_by(self._reflections[shader]))
        return self._read_by[shader] <= {row.name for row in use.inputs}


def _wanted(step: PlanStep) -> set[str]:
    """The results that later frames have to draw if they do this step."""
    now = read_now(step, is_first=False)
    read = (result for result, _ in (*written(step), *read_before(step), *now))
    return {*read, *drawn_over(step)}


def _read_by(reflection: Reflection) -> Iterator[str]:
    """The names that a shader reads, itself or by values that are derived from them."""
    for row in reflection.parameters:
        if row.block is not None:
            yield row.name
    for value in reflection.derived:
        yield from (part.parameter for part in value.steps if isinstance(part, ParameterStep))
    yield from (texture.name for texture in reflection.textures if texture.stages)
    yield from (buffer.name for buffer in reflection.buffers if buffer.stages)
