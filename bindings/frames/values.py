"""The two blocks of a frame: its parameters, and the numbers that are computed of them.

``steps.py`` asks for each number where a step needs it, so that it gets a name which says for what.
A kernel's extent is computed of the kernel's parameters and textures; what the frame gives these is
put in their place, so that all is computed of the frame's parameters before the first step.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ...compiler.documents.plan import FramePlan, PreviousSource, ResultSource, RunStep, ValueSource
from ...compiler.documents.values import ParameterRow
from ...compiler.tracing import Expression, Tracing, wrapped
from ...support.frozen import changed
from ...support.unique import Names
from ..blocks import computing
from ..derivation import Stored, Value, Values
from ..fields import Field, Numbers, Structure
from ..helpers import Helpers
from ..loose import computed, end, loose
from ..materials import Block, Derivation, Material, Source
from ..statements import Place
from ..structures import Structures

PARAMETERS, NUMBERS = "Parameters", "Numbers"
"""The plain names of the two blocks."""
_MOST = 16384
"""The largest side of a texture."""


class FrameNumbers:
    """The numbers of one frame."""

    def __init__(
        self, plan: FramePlan, shaders: Sequence[Material], structures: Structures, helpers: Helpers
    ) -> None:
        self.plan, self.shaders = plan, shaders
        self.structures, self.helpers = structures, helpers
        self.hints: dict[int, str] = {}
        self.steps = {step.name: step for step in plan.steps if isinstance(step, RunStep)}
        fields = loose(structures, plan.parameters)
        self._parameters = {field.name: field for field in fields}
        self._words = Names(field.word for field in fields)
        self._own = _OfFrame(self)
        self._names = Names(())
        self._known: dict[object, Field] = {}
        self._stored: list[tuple[Place, Field, Value]] = []

    # -- the parameters ----------------------------------------------------------------------------

    def parameter(self, name: str) -> Field | None:
        """The field of a parameter, by its name in the plan."""
        return self._parameters.get(name)

    def own_parameter(self, owner: str, row: ParameterRow) -> Field:
        """The field of a kernel's parameter that the frame does not give, and needs itself."""
        name = f"{owner}.{row.name}"
        if name not in self._parameters:
            (field,) = loose(self.structures, [changed(row, name=name, count=None)])
            self._add(field)
        return self._parameters[name]

    def texture_size(self, texture: str, lanes: int) -> Field:
        """The field of the size of a texture that the host has."""
        name = f"{texture}.size"
        if name not in self._parameters:
            about = f"The size of the texture `{texture}`, in texels"
            type_ = Numbers(kind="int", lanes=lanes, stored_lanes=lanes)
            word = name.replace(".", "_")
            self._add(
                Field(
                    name=name, word=word, type=type_, offset=0, default=(1,) * lanes,
                    range=(1, _MOST), meaning=f"ivec{lanes}", doc=about,
                )
            )  # fmt: skip
        return self._parameters[name]

    def _add(self, field: Field) -> None:
        at = end(list(self._parameters.values()))
        word = self._words.new(field.word)
        self._parameters[field.name] = changed(field, word=word, offset=at)

    # -- the numbers -------------------------------------------------------------------------------

    def value(self, number: int, wish: str) -> Field:
        """The field of one of the plan's values."""
        row = self.plan.values[number]
        (*_, last) = row.steps
        name = last.parameter if last.op == "parameter" else wish
        return self._field(number, name, row.representation, lambda: self.lanes(number))

    def depth(self, number: int, wish: str) -> Field:
        """The field of a depth that is cleared to, which lies between 0 and 1."""

        def lanes() -> Value:
            (depth,) = self.lanes(number)
            return (Tracing.minimum(Tracing.maximum(depth, 0.0), 1.0),)

        return self._field(("depth", number), wish, "float", lanes)

    def size(self, texture: int, wish: str) -> Field:
        """The field of the width and height of a texture's first level."""
        row = self.plan.textures[texture].size
        if row.value is not None and not row.level:
            return self.value(row.value, wish)
        key = "size", row.value, row.extent_of, row.level
        return self._field(key, wish, "ivec2", lambda: self.size_lanes(texture))

    def groups(self, step: RunStep, wish: str) -> Field:
        """The field of the numbers of work groups of a kernel."""
        sides = self.shaders[step.use.shader].reflection.work_group
        assert sides is not None

        def lanes() -> Value:
            extent = (*self.extent(step.name), *map(wrapped, (1, 1)))[:3]
            return tuple(map(_groups, extent, sides))

        return self._field(("groups", step.name), wish, "ivec3", lanes)

    def count(self, result: str, wish: str) -> Field:
        """The field of the number of elements of a buffer that a kernel writes."""
        return self._field(("count", result), wish, "int", lambda: self.count_lanes(result))

    def _field(self, key: object, wish: str, representation: str, lanes: Any) -> Field:
        if key not in self._known:
            word = self._names.new(wish.replace(".", "_"))
            at = end([field for _, field, _ in self._stored])
            field = computed(word, representation, at)
            found = lanes()
            if field.capacity:
                elements = found.elements() if isinstance(found, Stored) else found
                for number, each in enumerate(elements):
                    self._store((word, number), field, each)
            else:
                self._store((word,), field, found)
            self._known[key] = field
        return self._known[key]

    def _store(self, way: tuple[str | int, ...], field: Field, lanes: Value) -> None:
        self._stored.append((Place(block=NUMBERS, way=way), field, lanes))

    # -- as expressions ----------------------------------------------------------------------------

    def lanes(self, number: int) -> Value:
        """One of the plan's values."""
        return self._own.of(self.plan.values[number].steps)

    def size_lanes(self, texture: int) -> Value:
        """The width and height of a texture's first level."""
        row = self.plan.textures[texture].size
        whole = self.extent(row.extent_of or "") if row.value is None else self.lanes(row.value)
        return tuple(halved(side, wrapped(row.level)) for side in whole)

    def extent(self, step: str) -> Value:
        """The numbers of texels or elements that a kernel computes."""
        run = self.steps[step]
        extent = self.shaders[run.use.shader].reflection.extent
        assert extent is not None
        return _OfKernel(self, run).of(extent)

    def count_lanes(self, result: str) -> Value:
        """The number of elements of a buffer that a kernel writes."""
        run, name = next(
            (step, each.name)
            for step in self.steps.values()
            for each in step.buffers
            if each.result == result
        )
        rows = self.shaders[run.use.shader].reflection.results
        steps = next(row.count for row in rows if row.name == name)
        return _OfKernel(self, run).of(steps)

    # -- the blocks --------------------------------------------------------------------------------

    def blocks(self, frame: str) -> tuple[Block, Block]:
        """The block of the parameters and that of the values."""
        given, made = f"{frame}.{PARAMETERS}", f"{frame}.{NUMBERS}"
        fields = tuple(self._parameters.values())
        parameters = Block(
            structure=Structure(name=given, size=end(fields), fields=fields),
            plain_name=PARAMETERS, group="frame", layout_id="",
            about=f"The parameters of the frame `{self.plan.frame}`.",
        )  # fmt: skip
        stored = tuple(dict.fromkeys(field for _, field, _ in self._stored))
        sources = (Source(plain_name=PARAMETERS, name=given),) if self._own.sources else ()
        values = Block(
            structure=Structure(name=made, size=end(stored), fields=stored),
            plain_name=NUMBERS, group="frame", layout_id="",
            derivation=Derivation(
                sources=sources, statements=computing(self._stored, (), self.hints)
            ),
            about=f"The numbers of the frame `{self.plan.frame}`, computed of its parameters.",
        )  # fmt: skip
        return parameters, values

    def read(self, field: Field) -> Value:
        """The value of a parameter."""
        self._own.sources.setdefault(PARAMETERS)
        return Stored(PARAMETERS, (field.word,), (), field).read()


class _OfFrame(Values):
    """Evaluates steps over the parameters of the frame."""

    def __init__(self, frame: FrameNumbers) -> None:
        super().__init__({}, frame.helpers, frame.hints)
        self._frame = frame

    def parameter(self, name: str) -> Value:
        """The value of a parameter."""
        field = self._frame.parameter(name)
        assert field is not None, name
        return self._frame.read(field)

    def texture_size(self, texture: str, level: Expression, lanes: int) -> Value:
        """The size of a texture of the host."""
        whole = self._frame.read(self._frame.texture_size(texture, lanes))
        return tuple(halved(side, level) for side in whole)


class _OfKernel(_OfFrame):
    """Evaluates steps over the parameters and textures of a kernel."""

    def __init__(self, frame: FrameNumbers, step: RunStep) -> None:
        super().__init__(frame)
        self._step = step
        self._reflection = frame.shaders[step.use.shader].reflection
        self._inputs = {row.name: row.source for row in step.use.inputs}

    def parameter(self, name: str) -> Value:
        """What the frame gives a parameter of the kernel, or what the host gives it itself."""
        source = self._inputs.get(name)
        if isinstance(source, ValueSource):
            return self._frame.lanes(source.value)
        buffers = (row.name for row in self._reflection.buffers if row.count == name)
        source = self._inputs.get(next(buffers, ""))
        if source is not None and source.kind == "host":
            rows = {row.name: row for row in self._frame.plan.host_buffers}
            return super().parameter(rows[source.host].count)
        if source is not None and source.kind == "result":
            return self._frame.count_lanes(source.result)
        if source is not None and source.kind == "previous":
            return self._frame.count_lanes(source.previous)
        row = next(each for each in self._reflection.parameters if each.name == name)
        return self._frame.read(self._frame.own_parameter(self._step.name, row))

    def texture_size(self, texture: str, level: Expression, lanes: int) -> Value:
        """The size of what the frame gives a texture of the kernel, or of the kernel's own."""
        source = self._inputs.get(texture)
        if isinstance(source, ResultSource | PreviousSource) and source.texture is not None:
            whole = self._frame.size_lanes(source.texture)
            return tuple(halved(side, level) for side in whole)
        own = source.host if source is not None and source.kind == "host" else ""
        return super().texture_size(own or f"{self._step.name}.{texture}", level, lanes)


def halved(side: Expression, level: Expression) -> Expression:
    """A side of a texture at a level: rounded down, but not below 1."""
    if level.op == "constant" and level.value == 0:
        return side
    return Tracing.maximum(side >> level, 1)


def _groups(side: Expression, group: int) -> Expression:
    """The work groups of this size that cover a side."""
    whole = Tracing.maximum(side, 0)
    return whole if group == 1 else (whole + (group - 1)) // group
