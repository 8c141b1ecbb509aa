"""The draws of a plan's steps: what each shader is given, by the host and by other steps.

The reference and the drivers execute the same ``StepDraw`` records, so that a plan is read in one
place.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ....compiler.documents.plan import (
    DrawnRow,
    DrawStep,
    HostSource,
    PreviousSource,
    ResultSource,
    RunStep,
    UseRow,
    ValueSource,
)
from ....compiler.documents.reflection import Reflection
from ....compiler.ir.primitives import CORNERS
from ..instances.instance import Instance
from ..meshes import Mesh
from ..scene_state import SceneState, drawn_state
from .checking import PlanError
from .checks.reflections import LANE
from .host import FrameHost
from .scenery import Model

MOST_VERTICES = 1 << 24
"""The largest number of vertices of a step without models: as many as float32 can tell apart."""


@dataclass(frozen=True, slots=True)
class Read:
    """The source of a shader's texture or buffer that a step has made."""

    result: str
    texture: int | None
    """The number of the texture; ``None`` for a buffer."""


@dataclass(frozen=True, eq=False, slots=True)
class StepDraw:
    """One draw of a step, or the run of a kernel."""

    shader: int
    state: SceneState
    """The state of the draw; its instance has the values that the host knows. Results of steps are
    not among its textures and buffers."""
    reads: Mapping[str, Read]
    """The sources, by the shader's name for a texture or a buffer."""


def bare_mesh(count: int, primitive: str = "triangle") -> Mesh:
    """Points or triangles whose vertices have nothing but their numbers."""
    corners = CORNERS[primitive]
    whole = np.arange(count - count % corners)
    places = np.zeros((count, 3))
    return Mesh(
        {"position": places}, whole.reshape(-1, 3) if corners == 3 else np.empty((0, 3), int)
    )


KERNEL = bare_mesh(3)
"""The mesh of a kernel that is drawn: it covers all pixels of a texture."""


@dataclass(frozen=True, slots=True)
class _Onto:
    """The targets of a step."""

    size: tuple[int, int]
    """The width and height of its targets."""
    seen: tuple[int, int]
    """The width and height of the viewport, which a camera fills."""


class StepDraws:
    """Makes the draws of a frame's steps."""

    def __init__(self, host: FrameHost) -> None:
        """``host`` has the values of the frame, the models that it draws and their lights."""
        self._host = host
        self.given: SceneState | None = None
        """The state of the only step, if it is not made of the host's values and models."""
        self._costs = [_cost(shader.reflection) for shader in host.shaders]
        self._entries = {row.entry: row for row in host.plan.lights}

    def check_values(self) -> None:
        """Raise ``MissingValuesError`` if something is drawn for which a value is missing."""
        self._host.begin(0)
        for step in self._host.plan.steps:
            if isinstance(step, DrawStep):
                drawn = list(self.of(step, is_first=True))
            else:
                drawn = [self.kernel(step, is_first=True)] if isinstance(step, RunStep) else []
            for draw in drawn:
                draw.state.instance.values()

    def of(self, step: DrawStep, *, is_first: bool) -> Iterator[StepDraw]:
        """All draws of a step, in order."""
        if self.given is not None:
            yield StepDraw(0, self.given, {})
            return
        state = self._host.state_of(step)
        size = self._host.drawn_size(step)
        onto = _Onto(size, size if state.viewport is None else state.viewport[2:])
        for drawn in step.draws:
            for light in self._lights(drawn.light):
                yield from self._drawn(drawn, light, onto, is_first)

    def kernel(self, step: RunStep, *, is_first: bool) -> StepDraw:
        """The run of a kernel."""
        shader = step.use.shader
        state, reads = self.given, {}
        if state is None:
            self._host.steps.add(self._costs[shader])
            instance = self._host.instances[shader].copied()
            reads = self._give(instance, step.use, is_first)
            state = SceneState(1, 1, {}, KERNEL.triangles, instance, ())
        self._host.kernels[step.name] = state.instance
        return StepDraw(shader, state, reads)

    def _lights(self, entry: str | None) -> Sequence[tuple[str, int | None] | None]:
        """Each light of an entry of the rig, by its name and number."""
        if entry is None:
            return (None,)
        row = self._entries[entry]
        if row.capacity is None:
            return ((entry, None),)
        count = row.capacity
        if row.count is not None:
            count = min(max(self._host.values.get(row.count), 0), count)
        return tuple((entry, number) for number in range(count))

    def _drawn(
        self,
        drawn: DrawnRow,
        light: tuple[str, int | None] | None,
        onto: _Onto,
        is_first: bool,
    ) -> Iterator[StepDraw]:
        uses = {use.material: use for use in drawn.uses}
        self._host.steps.add(sum(self._costs[use.shader] for use in drawn.uses))
        if drawn.models is None:
            assert drawn.vertices is not None, "names are checked"
            count = self._vertex_count(drawn.vertices)
            primitive = self._host.instances[uses[None].shader].reflection.draw.primitive
            if count >= CORNERS[primitive]:
                mesh = bare_mesh(count, primitive)
                yield self._one(uses[None], None, mesh, light, onto, is_first)
            return
        for model in self._host.scenery.tagged(drawn.models):
            if model.material not in uses:
                known = ", ".join(filter(None, uses))
                raise PlanError(
                    f"a model of `{drawn.models}` has the material {model.material}, and the "
                    f"frame draws {known}"
                )
            yield self._one(uses[model.material], model, model.mesh, light, onto, is_first)

    def _vertex_count(self, value: int) -> int:
        """The number of vertices of a step that draws without models.

        Raises ``PlanError`` for numbers that make no sense.
        """
        count = int(self._host.number(value))
        if not 0 <= count <= MOST_VERTICES:
            raise PlanError(f"a step would draw {count} vertices; it can draw 0 to {MOST_VERTICES}")
        self._host.vertices.add(count)
        return count

    def _one(
        self,
        use: UseRow,
        model: Model | None,
        mesh: Mesh,
        light: tuple[str, int | None] | None,
        onto: _Onto,
        is_first: bool,
    ) -> StepDraw:
        instance = self._host.instances[use.shader].copied()
        scene = self._host.scenery.scene
        if model is not None:
            scene = replace(
                scene, object_to_world=model.placement, look=model.look, bones=model.bones
            )
        scene.apply(instance, onto.seen[0] / onto.seen[1], self._host.given)
        self._shine(instance, light)
        reads = self._give(instance, use, is_first)
        return StepDraw(use.shader, drawn_state(instance, mesh, onto.size), reads)

    def _shine(self, instance: Instance, light: tuple[str, int | None] | None) -> None:
        """Give a shader the lights of the frame; or the single light of an entry."""
        for row in instance.reflection.lights:
            own = self._entries[row.entry]
            source = own.name
            if light is not None and light[1] is not None and row.entry == light[0]:
                source = f"{source}[{light[1]}]"
            if row.capacity is None:
                for name in row.parameters:
                    value = self._host.values.get(f"{source}.{row.member(name)}")
                    if value is not None:
                        instance.set(name, value)
            else:
                instance.take(row.name, self._host.values, own.name)
                if row.count is not None and own.count is not None:
                    instance.take(row.count, self._host.values, own.count)

    def _give(self, instance: Instance, use: UseRow, is_first: bool) -> dict[str, Read]:
        """Give a shader the values that the frame sets; returns the sources made by steps."""
        reads = {}
        for row in use.inputs:
            name, source = row.name, row.source
            if is_first and isinstance(source, PreviousSource) and source.initially is not None:
                source = source.initially
            match source:
                case ValueSource():
                    instance.set(name, self._host.number(source.value))
                case HostSource():
                    self._bind(instance, name, source.host)
                case PreviousSource():
                    reads[name] = Read(f"previous({source.previous})", source.texture)
                case ResultSource():
                    reads[name] = Read(source.result, source.texture)
        for name, read in reads.items():
            if read.texture is not None:
                instance.bind_own(name, self._host.size_of(read.texture))
        return reads

    def _bind(self, instance: Instance, name: str, host: str) -> None:
        """Give a shader a texture or a buffer of the host."""
        textures = self._host.values.textures()
        if host in textures:
            instance.set(name, textures[host])
        else:
            instance.set_bytes(name, self._host.values.buffers()[host].data)


_GIVEN = ("parameters", "derived", "lights", "buffers", "textures", "vertex_inputs", "targets")
"""The values that a draw has to be given, as tables of a reflection."""


def _cost(reflection: Reflection) -> int:
    """The number of things that are set for a draw: rows, and the lanes of the parameters."""
    lanes = sum(row.size for row in reflection.parameters) // LANE
    return lanes + sum(len(getattr(reflection, table)) for table in _GIVEN)
