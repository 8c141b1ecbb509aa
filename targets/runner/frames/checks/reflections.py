"""Checks a reflection by itself: its parts fit each other, and do not take too much memory.

Reflections come from files, too. A host makes room for all values of a shader before it sets any,
so what would be too large is refused here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NoReturn

from .....compiler.budget import check
from .....compiler.documents.drawing import CaptureRow, DrawRow
from .....compiler.documents.reflection import Reflection
from .....compiler.documents.representations import lanes_of
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
from .....compiler.ir.kernel import MOST_INVOCATIONS, invocations
from ...instances.declared import TextureDeclaration
from ...instances.shapes import MOST_LANES
from .blocks import UNIT, check_blocks
from .rows import PlanError
from .steps import check_steps

LANE = 4
"""The bytes of a lane."""
KEPT = 16
"""The factor by which a host needs more memory for a value than a GPU."""
MOST_CORNERS = 32
"""The most corners of a patch that all devices support."""
MOST_INPUTS = 32
"""The most vertex inputs of any API: those of Direct3D, and of most devices with Vulkan."""


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
        """Raise ``PlanError`` unless the bytes to the next element are those of one."""
        self._check_size(row.name, "its elements have", self._bytes_of(row.name, row), row.stride)

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
        """Raise ``PlanError`` unless a value has its own bytes, and padding behind it."""
        self._check_size(name, "its value has", self._bytes_of(name, row), row.size)

    def _check_size(self, name: str, has: str, needed: int, said: int) -> None:
        """Check a size that a row says by the bytes that are needed."""
        if needed > said:
            self.fail(name, f"{has} more than {said} bytes")
        if said - needed >= UNIT:
            self.fail(name, f"{has} {needed} bytes, and not {said}")

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
            if reflection.capture is None or result.name != reflection.capture.buffer:
                self._values.check_element(result)
        check_blocks(self._where, reflection)
        for derived in reflection.derived:
            self._values.check_row(derived.name, derived)
        for name, steps in _computed(reflection):
            self._check_steps(name, steps)
        for row in reflection.samplers:
            if row.texture not in self._textures:
                self._fail("samplers", f"there is no texture `{row.texture}`")
        self._check_draw(reflection.draw)
        self._check_locations()
        group = reflection.work_group
        if group is not None and invocations(group) > MOST_INVOCATIONS:
            sides = " x ".join(map(str, group))
            self._fail("work_group", f"no device runs {sides} invocations together")
        if reflection.capture is not None:
            self._check_capture(reflection.capture)

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

        if row.vertices is not None:
            check("vertices", row.vertices, f"{self._where}: what one primitive turns into has")

    def _check_locations(self) -> None:
        """Check that targets are numbered in their order, and that vertex inputs have places."""
        for number, target in enumerate(self._reflection.targets):
            if target.location != number:
                self._fail(target.name, f"it is target {number}, and not {target.location}")
        taken: set[int] = set()
        for row in self._reflection.vertex_inputs:
            if row.location is None:
                continue
            if row.location >= MOST_INPUTS:
                last = MOST_INPUTS - 1
                self._fail(row.name, f"it has the location {row.location}, and the last is {last}")
            if row.location in taken:
                self._fail(row.name, f"another vertex input has the location {row.location}")
            taken.add(row.location)

    def _check_capture(self, row: CaptureRow) -> None:
        """Check that the captured values of a vertex lie one behind the other."""
        end = 0
        for each in row.members:
            if each.offset != end:
                self._fail(each.name, f"it is at byte {each.offset}, and not at {end}")
            end += LANE * lanes_of(each.representation)
        if row.stride != end or row.there not in (None, end):
            self._fail("capture", f"its values have {end} bytes, and not {row.stride}")
        if row.buffer is not None:
            self._check_vertices(row.buffer, end if row.there is None else end + LANE)
        check("vertices", row.vertices, f"{self._where}: what is captured of one primitive has")

    def _check_vertices(self, name: str, size: int) -> None:
        """Check that each element of a buffer is a captured vertex of so many bytes."""
        found = next((row for row in self._reflection.results if row.name == name), None)
        if found is None:
            self._fail("capture", f"no kernel writes `{name}`")
        if found.stride != size:
            self._fail(name, f"its vertices have {size} bytes, and not {found.stride}")

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
