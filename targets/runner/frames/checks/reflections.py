"""Checks a reflection by itself: its parts fit each other, and do not take too much memory.

Reflections come from files, too. A host makes room for all values of a shader before it sets any,
so what would be too large is refused here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NoReturn

from .....compiler.budget import check
from .....compiler.documents.drawing import DrawRow
from .....compiler.documents.reflection import Reflection
from .....compiler.documents.steps import ParameterStep, StepRow, TextureStep
from .....compiler.documents.values import (
    BufferRow,
    DerivedRow,
    LayoutRow,
    LightRow,
    MemberRow,
    ParameterRow,
    ResultRow,
)
from .....compiler.ir.default_textures import OF_SAMPLES
from ...instances.declared import TextureDeclaration
from ...instances.shapes import MOST_LANES
from .rows import PlanError
from .steps import check_steps

LANE = 4
"""The bytes of a lane."""
KEPT = 16
"""The factor by which a host needs more memory for a value than a GPU."""
MOST_CORNERS = 32
"""The most corners of a patch that all devices support."""


def check_reflection(where: str, reflection: Reflection) -> None:
    """Raise ``PlanError`` for a reflection whose parts do not fit each other. Raises
    ``BudgetError`` if its values take too much memory."""
    _Reflection(where, reflection).check()


class Values:
    """The parameters, lights and buffers of a reflection, or of a plan, which a host sets."""

    def __init__(
        self, where: str, parameters: Sequence[ParameterRow], lights: Sequence[LightRow]
    ) -> None:
        self._where = where
        self._lights = lights
        self._parameters = {row.name: row for row in parameters}

    def check(self) -> None:
        """Raise ``PlanError`` for parameters and lights that do not fit each other."""
        rows = self._parameters.values()
        for row in rows:
            self.check_row(row.name, row)
        taken = KEPT * sum(row.size for row in rows)
        check("memory", taken, f"{self._where}: the values of its parameters take")
        for light in self._lights:
            self._check_light(light)

    def check_buffers(self, rows: Iterable[BufferRow]) -> None:
        """Raise ``PlanError`` unless counts belong to buffers, each to one of them."""
        counters: set[str] = set()
        for row in rows:
            name, count = row.name, row.count
            if count not in self._parameters or count in counters:
                self.fail(name, f"`{count}` does not count its elements")
            counters.add(count)
            self.check_element(row)

    def check_element(self, row: BufferRow | ResultRow) -> None:
        """Raise ``PlanError`` unless an element lies within the bytes to the next one."""
        if self._bytes_of(row.name, row) > row.stride:
            self.fail(row.name, f"its elements have more than {row.stride} bytes")

    def _check_light(self, row: LightRow) -> None:
        name, capacity = row.name, row.capacity
        named = row.parameters if row.count is None else (*row.parameters, row.count)
        for each in named:
            if each not in self._parameters:
                self.fail(name, f"there is no parameter `{each}`")
        if capacity is not None:
            found = self._parameters.get(name)
            if row.parameters != (name,) or found is None or found.layout.count != capacity:
                self.fail(name, f"no parameter has {capacity} of them")

    def check_textures(self, rows: Iterable[TextureDeclaration]) -> None:
        """Raise ``PlanError`` for a texture without a valid default until a host binds one."""
        for row in rows:
            known = OF_SAMPLES[row.sample]
            if row.default not in known:
                self.fail(row.name, f"nothing {row.sample} is called `{row.default}`")
            if row.default_texel != known[row.default]:
                self.fail(row.name, f"`{row.default}` has another texel")

    def check_row(self, name: str, row: ParameterRow | MemberRow | DerivedRow) -> None:
        """Raise ``PlanError`` unless a value lies within its own bytes."""
        if self._bytes_of(name, row) > row.size:
            self.fail(name, f"its value has more than {row.size} bytes")

    def _bytes_of(
        self, name: str, row: ParameterRow | MemberRow | DerivedRow | BufferRow | ResultRow
    ) -> int:
        """The number of bytes that a value spans, from its first to its last."""
        layout = row.layout
        members = () if isinstance(row, DerivedRow) else row.members
        one = self._of_members(name, members) if members else self._of_numbers(name, layout)
        count, stride = layout.count, layout.stride
        if count is None:
            return one
        if count < 1 or stride is None or stride < one:
            self.fail(name, f"{count} elements do not lie every {stride} bytes")
        return (count - 1) * stride + one

    def _of_members(self, name: str, members: Sequence[MemberRow]) -> int:
        for row in members:
            self.check_row(f"{name}.{row.name}", row)
        return max(row.offset + row.size for row in members)

    def _of_numbers(self, name: str, layout: LayoutRow) -> int:
        lanes, columns, stride = layout.lanes or 0, layout.columns or 0, layout.column_stride or 0
        if not 1 <= lanes <= MOST_LANES:
            self.fail(name, f"it has {lanes} lanes")
        if columns > 1 and stride < LANE * lanes:
            self.fail(name, f"its columns do not lie every {stride} bytes")
        return LANE * lanes + max(columns - 1, 0) * stride

    def fail(self, name: str, text: str) -> NoReturn:
        raise PlanError(f"{self._where}, {name}: {text}")


class _Reflection:
    def __init__(self, where: str, reflection: Reflection) -> None:
        self._where = where
        self._reflection = reflection
        self._values = Values(where, reflection.parameters, reflection.lights)
        self._parameters = {row.name for row in reflection.parameters}
        self._textures = {row.name for row in reflection.textures}

    def check(self) -> None:
        reflection = self._reflection
        for table in _UNIQUE:
            self._no_two(table, [row.name for row in getattr(reflection, table)])
        self._values.check()
        self._values.check_buffers(reflection.buffers)
        self._values.check_textures(reflection.textures)
        for result in reflection.results:
            self._values.check_element(result)
        self._check_blocks()
        for name, steps in _computed(reflection):
            self._check_steps(name, steps)
        for row in reflection.samplers:
            if row.texture not in self._textures:
                self._fail("samplers", f"there is no texture `{row.texture}`")
        self._check_draw(reflection.draw)

    def _check_blocks(self) -> None:
        """Check that all members of blocks lie within their blocks."""
        sizes = {row.name: row.size for row in self._reflection.blocks}
        check("memory", sum(sizes.values()), f"{self._where}: its blocks take")
        rows: tuple[ParameterRow | DerivedRow, ...] = (
            *self._reflection.parameters, *self._reflection.derived
        )  # fmt: skip
        for row in rows:
            name, block = row.name, row.block
            if block is None:
                continue
            if block not in sizes or row.offset is None:
                self._fail(name, f"there is no place in the block `{block}`")
            if row.offset + row.size > sizes[block]:
                self._fail(name, f"it is not within the {sizes[block]} bytes of `{block}`")
        for derived in self._reflection.derived:
            self._values.check_row(derived.name, derived)

    def _check_steps(self, name: str, steps: Sequence[StepRow]) -> None:
        if not steps:
            self._fail(name, "no steps compute it")
        check_steps(f"{self._where}, {name}", steps)
        for step in steps:
            if isinstance(step, ParameterStep) and step.parameter not in self._parameters:
                self._fail(name, f"there is no parameter `{step.parameter}`")
            if isinstance(step, TextureStep) and step.texture not in self._textures:
                self._fail(name, f"there is no texture `{step.texture}`")

    def _check_draw(self, row: DrawRow) -> None:
        if row.corners > MOST_CORNERS:
            self._fail("draw", f"no primitive has {row.corners} corners")
        division = row.tessellation
        if division is not None and not all(end < row.corners for end in division.ends):
            self._fail("draw", "the ends of patches are not among their corners")

    def _no_two(self, table: str, names: Sequence[str]) -> None:
        if len(set(names)) < len(names):
            self._fail(table, "two of them have one name")

    def _fail(self, name: str, text: str) -> NoReturn:
        raise PlanError(f"{self._where}, {name}: {text}")


_UNIQUE = ("blocks", "parameters", "lights", "buffers", "results", "textures", "targets",
           "vertex_inputs")  # fmt: skip
"""The tables of a reflection whose rows are named."""


def _computed(reflection: Reflection) -> Iterator[tuple[str, Sequence[StepRow]]]:
    """The steps of every value that a host computes, each with its name in messages."""
    for row in reflection.derived:
        yield row.name, row.steps
    if reflection.extent is not None:
        yield "extent", reflection.extent
    for result in reflection.results:
        yield result.name, result.count
    if reflection.levels is not None:
        for steps in (*reflection.levels.edges, *reflection.levels.inside):
            yield "levels", steps
