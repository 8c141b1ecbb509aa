"""Makes the steps of a frame: what each draws or runs, and what the frame gives its shaders."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ...compiler.documents.plan import (
    AttachmentRow,
    CopyStep,
    DrawnRow,
    DrawStep,
    PlanStep,
    ResultSource,
    RunStep,
    UseRow,
)
from ...compiler.documents.plan import Source as PlanSource
from ..fields import Field
from ..materials import Material
from ..statements import Place
from .model import (
    Attachment,
    Copy,
    Dispatch,
    Drawn,
    FrameBuffer,
    FrameTexture,
    Give,
    Lights,
    Pass,
    Read,
    Resource,
    Step,
    Use,
)
from .values import NUMBERS, PARAMETERS, FrameNumbers


class Steps:
    """Makes the steps of one frame."""

    def __init__(
        self,
        values: FrameNumbers,
        textures: Sequence[FrameTexture],
        buffers: Mapping[tuple[str, bool], FrameBuffer],
    ) -> None:
        """``buffers`` are those of results; with true, those of the last frame."""
        self._values, self._plan = values, values.plan
        self._textures, self._buffers = textures, buffers
        self._lights = {row.entry: row for row in self._plan.lights}

    def all(self) -> Iterator[Step]:
        """The steps, in the order in which a host executes them."""
        for step in self._plan.steps:
            yield self._step(step)

    def _step(self, step: PlanStep) -> Step:
        match step:
            case DrawStep():
                return self._pass(step)
            case RunStep():
                return self._dispatch(step)
            case CopyStep():
                source, target = (self._textures[end.texture] for end in (step.copied, step.into))
                return Copy(row=step, source=source, target=target)

    # -- passes and kernels ------------------------------------------------------------------------

    def _pass(self, step: DrawStep) -> Pass:
        targets = tuple(self._attachment(step, row) for row in step.targets)
        depth = None if step.depth is None else self._attachment(step, step.depth)
        draws = tuple(self._drawn(step, row) for row in step.draws)
        every = [use for drawn in draws for use in drawn.uses]
        first = step.attachments[0]
        is_each = first.layer is None and any(use.layer is not None for use in every)
        return Pass(
            row=step, layers=self._textures[first.texture].row.layers if is_each else 1,
            targets=targets, depth=depth, draws=draws,
            viewport=self._setting(step, "viewport", step.viewport),
            scissor=self._setting(step, "scissor", step.scissor),
            blend_constant=self._setting(step, "blend_constant", step.blend_constant),
        )  # fmt: skip

    def _setting(self, step: DrawStep, word: str, value: int | None) -> Field | None:
        return None if value is None else self._values.value(value, f"{step.name}.{word}")

    def _attachment(self, step: DrawStep, row: AttachmentRow) -> Attachment:
        texture = self._textures[row.texture]
        clear = None
        if row.clear is not None:
            is_depth = texture.row.format.startswith("depth")
            field = self._values.depth if is_depth else self._values.value
            clear = field(row.clear, f"{step.name}.{row.name}.clear")
        return Attachment(row=row, texture=texture, clear=clear)

    def _drawn(self, step: DrawStep, row: DrawnRow) -> Drawn:
        lights = None
        if row.light is not None and (light := self._lights[row.light]).capacity is not None:
            count = None if light.count is None else self._values.parameter(light.count)
            lights = Lights(entry=row.light, count=count, capacity=light.capacity)
        vertices = row.vertices
        return Drawn(
            models=row.models,
            vertices=(
                None if vertices is None else self._values.value(vertices, f"{step.name}.vertices")
            ),
            light=lights,
            uses=tuple(self._use(step.name, use, lights) for use in row.uses),
        )  # fmt: skip

    def _dispatch(self, step: RunStep) -> Dispatch:
        return Dispatch(
            row=step, use=self._use(step.name, step.use, None),
            groups=self._values.groups(step, f"{step.name}.groups"),
            images=tuple((each.name, self._textures[each.texture]) for each in step.images),
            buffers=tuple((each.name, self._buffers[each.result, False]) for each in step.buffers),
        )  # fmt: skip

    # -- uses --------------------------------------------------------------------------------------

    def _use(self, step: str, row: UseRow, lights: Lights | None) -> Use:
        shader = self._values.shaders[row.shader]
        fields = {
            field.name: (block, field)
            for block in shader.blocks
            if block.derivation is None
            for field in block.structure.fields
        }
        sources = {
            **self._own(step, shader),
            **self._lit(shader, lights),
            **self._inputs(step, shader, row),
        }
        gives = [
            Give(block=block, field=field, source=source, initially=initially)
            for name, (block, field) in fields.items()
            for source, initially in [sources.get(name, (None, None))]
            if source is not None
        ]
        layers = shader.reflection.draw.layers
        return Use(
            material=row.material, shader=shader,
            gives=tuple(sorted(gives, key=lambda give: bool(give.field.counts))),
            reads=tuple(self._reads(row)),
            layer=None if layers is None else fields.get(layers.parameter or ""),
        )  # fmt: skip

    def _own(self, step: str, shader: Material) -> dict[str, tuple[Place, Place | None]]:
        """What a kernel's size is computed of, and the frame does not give it."""
        found: dict[str, tuple[Place, Place | None]] = {}
        for row in shader.reflection.parameters:
            field = self._values.parameter(f"{step}.{row.name}")
            if field is not None and shader.reflection.extent is not None:
                found[row.name] = Place(block=PARAMETERS, way=(field.word,)), None
        return found

    def _lit(
        self, shader: Material, lights: Lights | None
    ) -> dict[str, tuple[Place, Place | None]]:
        """The lights of the frame, by the shader's parameters."""
        found: dict[str, tuple[Place, Place | None]] = {}
        for row in shader.reflection.lights:
            own = self._lights[row.entry]
            is_element = lights is not None and row.entry == lights.entry and row.capacity is None
            for name in row.parameters:
                if is_element:
                    array = self._values.parameter(own.name)
                    assert array is not None
                    way: tuple[str | int | None, ...] = (array.word, None, row.member(name))
                else:
                    source = (
                        own.name if row.capacity is not None else f"{own.name}.{row.member(name)}"
                    )
                    field = self._values.parameter(source)
                    if field is None:
                        continue
                    way = (field.word,)
                found[name] = Place(block=PARAMETERS, way=way), None
            if row.count is not None and own.count is not None:
                count = self._values.parameter(own.count)
                assert count is not None
                found[row.count] = Place(block=PARAMETERS, way=(count.word,)), None
        return found

    def _inputs(
        self, step: str, shader: Material, row: UseRow
    ) -> dict[str, tuple[Place, Place | None]]:
        """The numbers that the frame sets, with those of elements in buffers."""
        counts = {buffer.name: buffer.count for buffer in shader.reflection.buffers}
        found: dict[str, tuple[Place, Place | None]] = {}
        for given in row.inputs:
            if given.source.kind == "value":
                field = self._values.value(given.source.value, f"{step}.{given.name}")
                found[given.name] = Place(block=NUMBERS, way=(field.word,)), None
            elif given.name in counts:
                source = given.source
                first = source.initially if source.kind == "previous" else None
                found[counts[given.name]] = (
                    self._count(source),
                    None if first is None else self._count(first),
                )
        return found

    def _count(self, source: PlanSource) -> Place:
        """The number of elements of a buffer."""
        if source.kind == "host":
            rows = {row.name: row for row in self._plan.host_buffers}
            field = self._values.parameter(rows[source.host].count)
            assert field is not None
            return Place(block=PARAMETERS, way=(field.word,))
        buffer = self._buffers[_result(source), source.kind == "previous"]
        return Place(block=NUMBERS, way=(buffer.count.word,))

    def _reads(self, row: UseRow) -> Iterator[Read]:
        for given in row.inputs:
            source = given.source
            if source.kind == "value":
                continue
            first = source.initially if source.kind == "previous" else None
            yield Read(
                name=given.name, source=self._resource(source),
                initially=None if first is None else self._resource(first),
            )  # fmt: skip

    def _resource(self, source: PlanSource) -> Resource:
        if source.kind == "host":
            return Resource(kind="host", number=-1, name=source.host)
        assert source.kind != "value"
        name = _result(source)
        if source.texture is not None:
            return Resource(kind="texture", number=source.texture, name=name)
        number = self._buffers[name, source.kind == "previous"].number
        return Resource(kind="buffer", number=number, name=name)


def _result(source: PlanSource) -> str:
    """The result that is read."""
    if isinstance(source, ResultSource):
        return source.result
    assert source.kind == "previous"
    return source.previous
