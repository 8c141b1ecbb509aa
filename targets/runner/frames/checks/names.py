"""Checks that every name and number of a plan refers to something, and to one thing only."""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence
from typing import Any, NoReturn

from .....compiler.documents.plan import (
    AttachmentRow,
    CopyStep,
    DrawnRow,
    DrawStep,
    FramePlan,
    FrameTextureRow,
    HostSource,
    KeptRow,
    PlanStep,
    PreviousSource,
    ResolveRow,
    ResultSource,
    RunStep,
    Source,
    ValueRow,
    ValueSource,
    WaitingRow,
)
from .....compiler.documents.steps import ParameterStep, TextureStep
from .....compiler.ir.formats import DEPTH_WORDS
from .....support.frozen import changed
from .reflections import Values
from .rows import Named, drawn_to, fail, inputs, places_of_waiting
from .steps import check_steps

STENCILS = "stencil8"
"""The ending of the depth formats that have stencil values."""
SETTINGS = {"viewport": "ivec4", "scissor": "ivec4", "blend_constant": "vec4"}
"""The types of the values that a step sets for all its draws."""
LAYERS = {"2d": range(1, 2), "cube": range(6, 7)}
"""The numbers of layers of textures of a dimension; ``MOST_LAYERS`` for all others."""
MOST_LAYERS = range(1, 2049)
"""The numbers of layers that all devices support."""
LEVELS = range(1, 1 << 5)
"""The numbers of levels that a texture may have, whatever its size."""


def check_names(plan: FramePlan) -> None:
    """Raise ``PlanError`` for a row that names something unknown, or that makes no sense."""
    _Names(plan).check()


class _Names:
    """Everything that has a name in a plan. It is collected once, since each step names some."""

    def __init__(self, plan: FramePlan) -> None:
        self._plan = plan
        self._results = _named(plan.results)
        self._buffers = {row.name for row in plan.results if row.kind == "buffer"}
        self._parameters = {row.name: row.representation for row in plan.parameters}
        self._host_textures = _named(plan.host_textures)
        self._of_host = {*self._host_textures, *_named(plan.host_buffers)}
        self._models = {row.name: row.materials for row in plan.models}
        self._lights = {row.entry for row in plan.lights}
        self._kept = {row.result: row.previous for row in plan.kept}
        self._kernels = {step.name for step in plan.steps if step.images}

    def check(self) -> None:
        plan = self._plan
        self._check_unique()
        self._check_host_values()
        for row in plan.shaders:
            if row.rig not in (None, plan.rig):
                self._fail(row.name, f"it is drawn under `{row.rig}`, and not `{plan.rig}`")
        used = {use.shader for step in plan.steps for use in step.uses}
        for number, shader in enumerate(plan.shaders):
            if number not in used:
                self._fail(shader.name, "no step uses it")
        for number, value in enumerate(plan.values):
            self._check_value(f"value {number}", value)
        for number, texture in enumerate(plan.textures):
            self._check_texture(f"texture {number}", texture)
        for where, place in places_of_waiting(plan):
            self._check_barriers(where, place)
        for step in plan.steps:
            self._check_step(step)
        for kept in plan.kept:
            self._check_kept(kept)
        for output in plan.outputs:
            where = f"output {output.name}"
            self._one_of(where, "result", output.result, self._results)
            self._texture(where, output.texture)

    def _check_unique(self) -> None:
        plan = self._plan
        for table in (
            "shaders", "models", "parameters", "lights", "host_textures", "host_buffers",
            "results", "outputs",
        ):  # fmt: skip
            self._no_two(table, [row.name for row in getattr(plan, table)])
        self._no_two("kept", [row.result for row in plan.kept])
        self._no_two("steps", [step.name for step in plan.steps if step.kind != "copy"])
        set_by_host = [*self._parameters, *self._of_host]
        for name in set_by_host:
            self._one_of("sources", "declaration", name, plan.sources)
        known = set(set_by_host)
        for name in plan.sources:
            self._one_of("sources", "value of the host", name, known)
        for row in plan.results:
            if row.kind == "buffer" and row.texture is not None:
                self._fail(row.name, "a buffer is in no texture")
            number = self._texture(row.name, row.texture)
            if number >= 0 and plan.textures[number].samples > 1:
                self._fail(row.name, f"nobody can read the samples of texture {number}")

    def _check_host_values(self) -> None:
        """Check the values that the host sets of the frame, which has no blocks."""
        plan = self._plan
        values = Values(plan.frame, plan.parameters, plan.lights)
        values.check()
        values.check_buffers(plan.host_buffers)
        values.check_textures(plan.host_textures)

    def _no_two(self, table: str, names: Iterable[Any]) -> None:
        seen: set[Any] = set()
        for name in names:
            if name in seen:
                said = name if isinstance(name, str) else f"texture {name}"
                self._fail(table, f"there are two of the name `{said}`")
            seen.add(name)

    # --- values and textures ---------------------------------------------------------------------

    def _check_value(self, where: str, value: ValueRow) -> None:
        """Check the steps of a number: known operations on numbers before them."""
        check_steps(f"{self._plan.frame}, {where}", value.steps)
        for step in value.steps:
            if isinstance(step, ParameterStep):
                name = step.parameter
                self._one_of(where, "parameter", name, self._parameters)
                if step.type != self._parameters[name]:
                    self._fail(where, f"`{name}` is no {step.type}")
            if isinstance(step, TextureStep):
                self._one_of(where, "texture of the host", step.texture, self._host_textures)
        found = value.steps[-1].type
        if found != value.representation:
            self._fail(where, f"it is {found}, and not {value.representation}")

    def _check_texture(self, where: str, texture: FrameTextureRow) -> None:
        is_single = (texture.dimension, texture.levels, texture.kept) == ("2d", 1, False)
        if texture.samples > 1 and not is_single:
            self._fail(where, "it has several samples, and also levels, layers or a later frame")
        if texture.layers not in LAYERS.get(texture.dimension, MOST_LAYERS):
            self._fail(where, f"{texture.dimension} does not have {texture.layers} layers")
        if texture.levels not in LEVELS:
            self._fail(where, f"no texture has {texture.levels} levels")
        size = texture.size
        if (size.value is None) == (size.extent_of is None):
            self._fail(where, "its size is either a value or the extent of a step")
        if size.value is not None:
            self._value(where, size.value, "ivec2")
        else:
            self._one_of(where, "step that writes images", size.extent_of, self._kernels)

    # --- steps -----------------------------------------------------------------------------------

    def _check_barriers(self, where: str, place: PlanStep | WaitingRow) -> None:
        """Check the barriers in one place."""
        self._no_two(where, [row.texture for row in place.barriers])
        for barrier in place.barriers:
            self._texture(where, barrier.texture)
        self._no_two(where, [row.result for row in place.buffer_barriers])
        for waited in place.buffer_barriers:
            self._one_of(where, "buffer", waited.result, self._buffers)

    def _check_step(self, step: PlanStep) -> None:
        where = step.name
        for use in step.uses:
            self._number(where, "shader", use.shader, self._plan.shaders)
            self._no_two(where, [row.name for row in use.inputs])
        for row in inputs(step):
            self._check_source(f"{where}, input {row.name}", row.source)
        written = [*drawn_to(step), *(row.texture for row in step.images)]
        self._no_two(where, written)
        for image in step.images:
            self._texture(where, image.texture)
        if isinstance(step, DrawStep):
            self._check_settings(where, step)
            for drawn in step.draws:
                self._check_drawn(where, step, drawn)
        if isinstance(step, RunStep) and step.use.material is not None:
            self._fail(where, f"it is a kernel, and has the material `{step.use.material}`")
        if isinstance(step, CopyStep):
            for end in (step.copied, step.into):
                self._one_of(where, "result", end.result, self._results)
                self._texture(where, end.texture)
        self._check_result_names(where, step)

    def _check_settings(self, where: str, step: DrawStep) -> None:
        """Check the numbers that hold for all draws of a step, and its targets."""
        for name, type_ in SETTINGS.items():
            number: int | None = getattr(step, name)
            if number is not None:
                self._value(f"{where}, {name}", number, type_)
        if not step.attachments:
            self._fail(where, "it draws to nothing")
        for row in step.attachments:
            self._check_attachment(f"{where}, {row.name}", row, is_depth=row is step.depth)

    def _check_result_names(self, where: str, step: PlanStep) -> None:
        """Check that a result has the name of the step and target that leave it."""
        for row in step.attachments:
            if row.result.rpartition(".")[2] != row.name:
                self._fail(where, f"`{row.name}` is drawn to `{row.result}`")
        for written in step.written:
            if written.result != f"{step.name}.{written.name}":
                self._fail(where, f"`{written.name}` is written to `{written.result}`")

    def _check_source(self, where: str, source: Source) -> None:
        match source:
            case ValueSource():
                self._number(where, "value", source.value, self._plan.values)
            case HostSource():
                known = self._of_host
                self._one_of(where, "texture or buffer of the host", source.host, known)
            case ResultSource():
                self._one_of(where, "result", source.result, self._results)
                self._texture(where, source.texture)
            case PreviousSource():
                self._texture(where, source.texture)
                if source.initially is not None:
                    self._check_source(where, source.initially)
                self._one_of(where, "result that is kept", source.previous, self._kept)
                if self._kept[source.previous] != source.texture:
                    self._fail(where, f"texture {source.texture} does not keep `{source.previous}`")

    def _check_attachment(self, where: str, row: AttachmentRow, *, is_depth: bool) -> None:
        texture = self._plan.textures[self._texture(where, row.texture)]
        if (texture.format in DEPTH_WORDS) != is_depth:
            self._fail(where, f"texture {row.texture} is {texture.format}")
        if texture.format.endswith(STENCILS) != (row.stencil is not None):
            said = "nothing" if row.stencil is None else "what becomes"
            self._fail(where, f"it says {said} of stencil values, and it is {texture.format}")
        layer, level = row.layer, row.level
        if not 0 <= level < texture.levels or not (layer is None or 0 <= layer < texture.layers):
            self._fail(where, f"texture {row.texture} has no layer {layer}, level {level}")
        if row.clear is not None:
            self._value(where, row.clear, "float" if is_depth else "vec4")
            if row.load != "clear":
                self._fail(where, "what is loaded is not cleared")
        if row.over is not None:
            self._one_of(where, "result", row.over, self._results)
        if row.resolve is not None:
            self._check_resolve(where, texture, row.resolve)

    def _check_resolve(self, where: str, drawn: FrameTextureRow, row: ResolveRow) -> None:
        """Check that the mean of samples is written to a place of the same size and format."""
        texture = self._plan.textures[self._texture(where, row.texture)]
        level, said = row.level, f"texture {row.texture}"
        size, whole = drawn.size, texture.size
        if drawn.samples == 1 or drawn.format in DEPTH_WORDS or texture.samples > 1:
            self._fail(where, f"there are no samples to resolve to {said}")
        if not 0 <= level < texture.levels or not 0 <= row.layer < texture.layers:
            self._fail(where, f"{said} has no layer {row.layer}, level {level}")
        if (texture.format, changed(whole, level=whole.level + level)) != (drawn.format, size):
            self._fail(where, f"{said} has another format or size than its samples")

    def _check_drawn(self, where: str, step: DrawStep, drawn: DrawnRow) -> None:
        """Check the draws of a step: models, each by the shader for its material, or vertices."""
        models = drawn.models
        materials: tuple[str | None, ...] = (None,)
        if (models is None) == (drawn.vertices is None):
            self._fail(where, "it draws either models or vertices without models")
        if drawn.vertices is not None:
            self._value(where, drawn.vertices, "int")
        if models is not None:
            self._one_of(where, "name of models", models, self._models)
            materials = self._models[models]
        if tuple(use.material for use in drawn.uses) != materials:
            self._fail(where, f"it does not have one shader for each material of `{models}`")
        if drawn.light is not None:
            self._one_of(where, "light", drawn.light, self._lights)
        for use in drawn.uses:
            shader = self._plan.shaders[use.shader]
            parts = (self._plan.frame, step.pass_, use.material, drawn.light)
            meant = ".".join(part for part in parts if part)
            # The shader of a frame of a single material is called like the material.
            if shader.name not in (meant, use.material) or shader.pass_ != step.pass_:
                self._fail(where, f"it is drawn by `{shader.name}`, and not by `{meant}`")

    def _check_kept(self, row: KeptRow) -> None:
        where = f"kept {row.result}"
        self._one_of(where, "result", row.result, self._results)
        if row.texture is None and row.previous is None:
            return
        numbers = [self._texture(where, end) for end in (row.texture, row.previous)]
        if numbers[0] == numbers[1]:
            self._fail(where, "what was drawn and what is drawn are one texture")
        if min(numbers) < 0:
            self._fail(where, "only one of its two textures is said")
        one, other = (self._plan.textures[number] for number in numbers)
        for key in ("format", "dimension", "size", "layers", "levels"):
            if getattr(one, key) != getattr(other, key):
                self._fail(where, f"its two textures differ in their {key}")

    # --- parts -----------------------------------------------------------------------------------

    def _fail(self, where: str, text: str) -> NoReturn:
        fail(self._plan, where, text)

    def _one_of(self, where: str, what: str, name: Any, known: Container[Any]) -> None:
        if name not in known:
            self._fail(where, f"there is no {what} `{name}`")

    def _number(self, where: str, what: str, number: int, rows: Sequence[object]) -> None:
        if not 0 <= number < len(rows):
            self._fail(where, f"there is no {what} {number}: there are {len(rows)}")

    def _value(self, where: str, number: int, type_: str) -> None:
        self._number(where, "value", number, self._plan.values)
        found = self._plan.values[number].representation
        if found != type_:
            self._fail(where, f"value {number} is {found}, and not {type_}")

    def _texture(self, where: str, number: int | None) -> int:
        if number is None:
            return -1
        self._number(where, "texture", number, self._plan.textures)
        return number


def _named(rows: Iterable[Named]) -> set[str]:
    return {row.name for row in rows}
