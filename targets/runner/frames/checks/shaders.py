"""Checks a plan against the reflections of its shaders: inputs and render targets."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeVar

from .....compiler.documents.drawing import LayersRow
from .....compiler.documents.plan import (
    AttachmentRow,
    DrawStep,
    FramePlan,
    HostSource,
    PreviousSource,
    ResultSource,
    RunStep,
    Source,
    UseRow,
    ValueSource,
    WrittenImage,
)
from .....compiler.documents.reflection import Reflection
from .....compiler.documents.values import BufferRow, ResultRow
from .reflections import check_reflection
from .rows import Named, fail

DEPTHS = "depth"
"""The beginning of the depth formats, and the name of the dimension of textures that hold
depths."""
_VALUE = ("representation", "layout", "members")
"""The fields that have to be equal where a shader takes over a value of the frame."""
_KINDS = ("parameters", "textures", "buffers")
_BUFFER = ("representation", "stride", "members", "structs")
"""The fields that have to be equal where one shader reads the elements that another one writes."""


def check_shaders(plan: FramePlan, reflections: Sequence[Reflection]) -> None:
    """Raise ``PlanError`` if a shader's inputs or targets differ from its reflection.

    ``reflections`` are those of the plan's shaders, in order.
    """
    if len(reflections) != len(plan.shaders):
        fail(plan, "shaders", f"there are {len(reflections)}, and not {len(plan.shaders)}")
    for row, reflection in zip(plan.shaders, reflections, strict=True):
        found = (reflection.material, reflection.pass_ or None, reflection.rig or None)
        wanted = (row.name, row.pass_, row.rig)
        if found != wanted:
            fail(plan, row.name, f"{row.reflection} is the reflection of another shader")
        check_reflection(row.name, reflection)
        _check_lights(plan, reflection)
    shaders = _Shaders(plan, reflections)
    for step in plan.steps:
        for use in step.uses:
            shaders.check_use(step.name, use)
        if isinstance(step, DrawStep):
            shaders.check_draw(step)
        elif isinstance(step, RunStep):
            shaders.check_run(step)


def _check_lights(plan: FramePlan, reflection: Reflection) -> None:
    """Check that the lights of a shader are those of the frame, and its arrays the same arrays."""
    lights = {row.entry: row for row in plan.lights}
    values, own_values = _by_name(plan.parameters), _by_name(reflection.parameters)
    for row in reflection.lights:
        own = lights.get(row.entry)
        if own is None:
            fail(plan, reflection.material, f"the frame has no light `{row.entry}`")
        if row.capacity is None:
            continue
        taken: list[tuple[str, str | None]] = [(row.name, own.name)]
        if row.count is not None:
            taken.append((row.count, own.count))
        for ours, theirs in taken:
            of_frame = None if theirs is None else values.get(theirs)
            if not _are_alike(own_values[ours], of_frame, _VALUE):
                fail(plan, reflection.material, f"the frame's light `{row.entry}` is another one")


class _Shaders:
    def __init__(self, plan: FramePlan, reflections: Sequence[Reflection]) -> None:
        self._plan = plan
        self._reflections = reflections
        self._inputs = [_inputs_of(each) for each in reflections]
        """The inputs of each shader, by name: the kind (one of ``_KINDS``), and the row."""
        self._results = [_by_name(each.results) for each in reflections]
        self._alike: set[tuple[str, int, str]] = set()
        """The buffers that have been compared, each with an input of a shader."""
        self._textures: dict[str, tuple[str, str]] = dict(self._all_textures())
        """For each result, and each texture of the host, its dimension and the kind of its
        texels."""
        self._buffers = dict(self._all_buffers())

    def _all_textures(self) -> Iterator[tuple[str, tuple[str, str]]]:
        for row in self._plan.host_textures:
            yield f"host {row.name}", (row.dimension, row.sample)
        for result in self._plan.results:
            if result.texture is not None:
                texture = self._plan.textures[result.texture]
                holds = DEPTHS if texture.format.startswith(DEPTHS) else "float"
                yield result.name, (texture.dimension, holds)

    def _all_buffers(self) -> Iterator[tuple[str, BufferRow | ResultRow]]:
        for row in self._plan.host_buffers:
            yield f"host {row.name}", row
        for step in self._plan.steps:
            for written in step.buffers:
                (kernel,) = step.uses
                if (result := self._results[kernel.shader].get(written.name)) is not None:
                    yield written.result, result

    # --- inputs of shaders -----------------------------------------------------------------------

    def check_use(self, where: str, use: UseRow) -> None:
        """Check that every input exists in the shader, and has its type."""
        shader: int = use.shader
        for row in use.inputs:
            name = row.name
            if name not in self._inputs[shader]:
                material = self._reflections[shader].material
                fail(self._plan, where, f"{material} has no input `{name}`")
            wanted, declared = self._inputs[shader][name]
            if (wanted == "parameters") != isinstance(row.source, ValueSource):
                fail(self._plan, where, f"`{name}` is one of the shader's {wanted}")
            if isinstance(row.source, ValueSource):
                self._check_value(where, name, row.source.value, declared)
                continue
            for named in _read(row.source):
                if wanted == "textures":
                    self._check_texture(where, named, declared)
                elif (named, shader, name) not in self._alike:
                    self._check_buffer(where, named, declared)
                    self._alike.add((named, shader, name))

    def _check_value(self, where: str, name: str, number: int, declared: Any) -> None:
        found = self._plan.values[number].representation
        if found != declared.representation:
            fail(self._plan, where,
                 f"`{name}` is {declared.representation}, and value {number} is "
                 f"{found}")  # fmt: skip

    def _check_texture(self, where: str, named: str, declared: Any) -> None:
        found = self._textures.get(named)
        if found != (declared.dimension, declared.sample):
            name = declared.name
            fail(self._plan, where, f"`{name}` is {declared.type}, and `{named}` is not")

    def _check_buffer(self, where: str, named: str, declared: Any) -> None:
        if not _are_alike(declared, self._buffers.get(named), _BUFFER):
            name = declared.name
            fail(self._plan, where, f"`{name}` is {declared.type}, and `{named}` is not")

    # --- targets and results ---------------------------------------------------------------------

    def check_draw(self, step: DrawStep) -> None:
        """Check that the targets of a pass are drawn to textures of their formats."""
        where = step.name
        layers = self._plan.textures[step.attachments[0].texture].layers
        for shader in dict.fromkeys(use.shader for use in step.uses):
            reflection = self._reflections[shader]
            self._check_kind(where, shader, is_kernel=False)
            self._check_targets(where, step.targets, reflection)
            self._check_depths(where, step.depth, reflection)
            own = reflection.draw.layers
            samples = reflection.render_state.samples
            for row in step.attachments:
                found = self._plan.textures[row.texture].samples
                if found != samples:
                    fail(self._plan, where, f"`{row.name}` has {found} samples, not {samples}")
                if (own is not None) != (row.layer is None):
                    fail(self._plan, where, f"`{row.name}` is drawn to layer {row.layer}")
            if own is not None:
                self._check_layers(where, own, layers)
            if own is not None and self._at_once(shader) != self._at_once(step.uses[0].shader):
                fail(self._plan, where, "its shaders reach different layers by one draw")

    def _at_once(self, shader: int) -> tuple[bool, int | None]:
        """The way in which a draw of a shader reaches the layers of its targets."""
        row = self._reflections[shader].draw.layers
        assert row is not None
        return row.parameter is None, row.view_mask

    def _check_layers(self, where: str, own: LayersRow, layers: int) -> None:
        """Check that a shader draws to as many layers as its targets have, and so its views."""
        if own.count != layers:
            fail(self._plan, where, f"it draws {own.count} layers to {layers}")
        if own.view_mask is not None and (own.parameter or own.view_mask != 2**own.count - 1):
            fail(self._plan, where, f"its view mask {own.view_mask} is not that of all layers")

    def _check_depths(
        self, where: str, given: AttachmentRow | None, reflection: Reflection
    ) -> None:
        """Check that a step has depths, and stencil values, if its pass uses them."""
        state = reflection.render_state
        depth, stencil = state.depth, state.stencil
        is_used = depth.is_used or stencil is not None
        if is_used != (given is not None):
            said = "no depths" if given is None else "depths"
            fail(self._plan, where, f"it has {said}, and {reflection.material} differs")
        if stencil is not None and (given is None or given.stencil is None):
            fail(self._plan, where, f"{reflection.material} tests stencil values it has not got")

    def check_run(self, step: RunStep) -> None:
        """Check that a kernel writes the results of its reflection."""
        reflection = self._reflections[step.use.shader]
        self._check_kind(step.name, step.use.shader, is_kernel=True)
        self._check_targets(step.name, step.images, reflection)
        found = [row.name for row in step.buffers]
        wanted = [row.name for row in reflection.results]
        if found != wanted:
            fail(self._plan, step.name, f"it writes {', '.join(wanted)}")

    def _check_kind(self, where: str, shader: int, *, is_kernel: bool) -> None:
        """Check that a pass has no work groups, and that a kernel draws nothing."""
        reflection = self._reflections[shader]
        if (reflection.work_group is not None) != is_kernel:
            kinds = "a pass", "a kernel"
            fail(self._plan, where, f"{reflection.material} is {kinds[not is_kernel]}, and not "
                 f"{kinds[is_kernel]}")  # fmt: skip

    def _check_targets(
        self, where: str, rows: Sequence[AttachmentRow | WrittenImage], reflection: Reflection
    ) -> None:
        found = [(row.name, self._plan.textures[row.texture].format) for row in rows]
        wanted = [(row.name, row.format) for row in reflection.targets]
        if found != wanted:
            given, meant = (", ".join(f"`{name}` as {format_}" for name, format_ in each) or "none"
                            for each in (found, wanted))  # fmt: skip
            fail(self._plan, where, f"its targets are {given}, and those of the shader {meant}")


def _read(source: Source) -> Iterator[str]:
    """The names of the things that an input reads, as this module knows them."""
    match source:
        case HostSource():
            yield f"host {source.host}"
        case ResultSource():
            yield source.result
        case PreviousSource():
            yield source.previous
            if source.initially is not None:
                yield from _read(source.initially)


def _are_alike(one: object, other: object, fields: Sequence[str]) -> bool:
    """True if two rows have equal values in some fields."""
    return other is not None and all(getattr(one, f) == getattr(other, f) for f in fields)


def _inputs_of(reflection: Reflection) -> Mapping[str, tuple[str, Any]]:
    """All inputs of a shader, by name. The first of several with the same name is used."""
    return {row.name: (kind, row) for kind in reversed(_KINDS) for row in getattr(reflection, kind)}


N = TypeVar("N", bound=Named)


def _by_name(rows: Sequence[N]) -> Mapping[str, N]:
    return {row.name: row for row in rows}
