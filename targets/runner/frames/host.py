"""The host's side of a plan: values that are set by name, sizes, and the draws of every step.

The reference and the drivers execute the same ``StepDraw`` records, so that a plan is read in one
place.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol, TypeGuard

import numpy as np

from ....compiler.budget import BudgetError, Tally
from ....compiler.diagnostics.nearest import suggestion
from ....compiler.documents.plan import (
    AttachmentRow,
    DrawnRow,
    DrawStep,
    FramePlan,
    HostSource,
    HostTextureRow,
    PlanStep,
    PreviousSource,
    ResultSource,
    RunStep,
    UseRow,
    ValueSource,
)
from ....compiler.documents.reflection import Reflection
from ....compiler.documents.steps import StepRow
from ....compiler.documents.values import BufferRow, DerivedRow, LightRow, ParameterRow
from ....compiler.ir.primitives import CORNERS
from ..instances.host_values import HostValues, MissingValuesError
from ..instances.instance import Instance
from ..instances.values import UnknownParameterError
from ..meshes import Mesh
from ..scene import value_roles
from ..scene_state import Color, SceneState, drawn_state
from ..subject import Subject
from .checking import PlanError, check_plan
from .checks.reflections import LANE
from .numbers import is_of
from .scenery import Model, Scenery
from .settings import StepState, cleared, step_state
from .sizes import Size, checked_size, drawn_size

NUMBERS = 1 << 24
"""The number of frames that are told apart: after it, `number` is 0 again."""

MOST_VERTICES = 1 << 24
"""The largest number of vertices of a step without models: as many as float32 can tell apart."""


class PlannedFrame(Protocol):
    """The parts of a frame that are needed to execute its plan."""

    @property
    def name(self) -> str:
        """The frame's name."""

    @property
    def plan(self) -> FramePlan:
        """The plan that a host executes."""

    @property
    def shaders(self) -> Sequence[Subject]:
        """The shaders, in the order of the plan."""


class FrameSubject(PlannedFrame, Protocol):
    """A compiled frame, as ``burnish.compile`` returns it."""

    @property
    def plan_of_reference(self) -> FramePlan:
        """The plan that the reference executes: one of its own, in which results share nothing."""


def is_frame(subject: Subject | FrameSubject) -> TypeGuard[FrameSubject]:
    """True if something compiled is a frame."""
    return not is_shader(subject)


def is_shader(subject: Subject | PlannedFrame) -> TypeGuard[Subject]:
    """True if something compiled is a material or a kernel, and no frame."""
    return hasattr(subject, "files")


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


class FrameHost:
    """The values of one frame."""

    def __init__(self, subject: PlannedFrame, scenery: Scenery, size: tuple[int, int]) -> None:
        """Raises ``PlanError`` for a plan that cannot be executed."""
        plan = subject.plan
        check_plan(plan, [shader.reflection for shader in subject.shaders])
        self.frame = subject
        self.plan = plan
        self.shaders = subject.shaders
        self.scenery = scenery
        what = f"a frame of {plan.frame} takes"
        self._steps, self._vertices = Tally("steps", what), Tally("vertices", what)
        """The cost of one frame beside its models: values that the host computes and sets, and
        draws without models."""
        self.values = HostValues(FrameDeclarations(plan), self._steps)
        self.size = size
        """The width and height of the frame's targets, unless the frame states another size."""
        width, height = size
        scenery.scene.apply(self.values, width / height)
        self.given: frozenset[str] = frozenset()
        """The names that have been set; a scene leaves their values alone."""
        self.size = size
        """The width and height of the outputs."""
        self._tell("size", size)
        self.instances = [Instance(shader.reflection, self._steps) for shader in self.shaders]
        """For each shader, the values of its materials that are the same for all models."""
        self._costs = [_cost(shader.reflection) for shader in self.shaders]
        self._entries = {row.entry: row for row in plan.lights}
        self._kernels: dict[str, Instance] = {}
        """The instances of the kernels of this frame, by step."""

    def unused_lamps(self) -> list[str]:
        """The names of the lights in the scene for which the frame's rig has no entry."""
        return [lamp.name for lamp in self.scenery.scene.unused_lamps(self.values)]

    def set_text(self, name: str, text: str) -> None:
        """Set a value of the frame; or else of all shaders that have it.

        A material's parameter is an example. Raises ``ParameterError`` and ``PictureError``, as
        ``Instance.set_text`` does.
        """
        self._set(name, lambda instance: instance.set_text(name, text))

    def set(self, name: str, value: object) -> None:
        """Set a value in the form that ``Instance.set`` takes. Raises ``ParameterError``."""
        self._set(name, lambda instance: instance.set(name, value))

    def _set(self, name: str, act: Callable[[HostValues], None]) -> None:
        self.given |= {name}
        errors: list[UnknownParameterError] = []
        every: tuple[HostValues, ...] = (self.values, *self.instances)
        for instance in every:
            try:
                act(instance)
            except UnknownParameterError as error:
                errors.append(error)
                continue
            if instance is self.values:
                return
        if len(errors) == len(every):
            unset = (error for error in errors if error.names_no_value)
            raise next(unset, UnknownParameterError(name, self._unknown(name)))

    def _unknown(self, name: str) -> str:
        """The message about a name that neither the frame nor a shader has."""
        declared = [each.declared for each in (*self.instances, self.values)]
        # The size of a single material's picture is called by its step: it is not the material's.
        steps = tuple(f"{step.name}." for step in self.plan.steps)
        names = [
            row.name
            for each in declared
            for row in (*each.parameters, *each.textures, *each.buffers)
            if not row.name.startswith(steps)
        ]
        roots = list(dict.fromkeys(known.partition(".")[0] for known in names))
        root = name.partition(".")[0].partition("[")[0]
        hint = suggestion(name, names) or suggestion(root, roots) or f"there are {', '.join(roots)}"
        return f"there is no parameter `{name}`: {hint}"

    def begin(self, drawn: int) -> None:
        """Set the number of frames before this one. To be called before the frame's first step."""
        self._steps.begin()
        self._vertices.begin()
        self._tell("number", drawn % NUMBERS)

    def _tell(self, name: str, value: object) -> None:
        """Set a value that hosts give every frame, unless it was set or is declared otherwise."""
        for own, role in value_roles(self.plan).items():
            if role == name and own not in self.given:
                self.values.set(own, value)

    # --- numbers ---------------------------------------------------------------------------------

    def number(self, value: int) -> Any:
        """One of the plan's values, in the form in which an instance takes it.

        Raises ``MissingValuesError``, and ``PlanError`` for steps that compute nothing of its type.
        """
        row, where = self.plan.values[value], f"{self.plan.frame}, value {value}"
        try:
            found = self.values.evaluated(row.steps)
        except (BudgetError, MissingValuesError):
            raise
        except (ArithmeticError, AssertionError, AttributeError, LookupError, TypeError, ValueError,
                StopIteration) as error:  # fmt: skip
            raise PlanError(f"{where}: its steps cannot be computed") from error
        if not is_of(found, row.representation):
            raise PlanError(f"{where}: its steps compute no {row.representation}")
        return found

    def size_of(self, texture: int) -> tuple[int, int]:
        """The width and the height of a texture's first level."""
        row = self.plan.textures[texture]
        if row.size.value is None:
            width, height = self._extent(row.size.extent_of or "")
        else:
            width, height = (int(lane) for lane in self.number(row.size.value))
        return checked_size(row, width, height)

    def _extent(self, step: str) -> tuple[int, int]:
        """The size of a kernel's results. Raises ``PlanError`` before the kernel is run."""
        if step not in self._kernels:
            raise PlanError(
                f"the size of what `{step}` writes is needed before it is run: give its parameters "
                "and textures in the frame"
            )
        return self._kernels[step].image_size()

    def drawn_size(self, step: PlanStep) -> Size:
        """The size of a step's attachments. Raises ``PlanError`` if they differ."""
        sizes = {row.texture: self.size_of(row.texture) for row in step.attachments}
        return drawn_size(self.plan, step, sizes)

    def state_of(self, step: DrawStep) -> StepState:
        """The state that a step sets for all its draws.

        Raises ``PlanError`` for a viewport that is not within the step's targets.
        """
        return step_state(self.plan, step, self.drawn_size(step), self.number)

    def clear_of(self, target: AttachmentRow) -> Color:
        """The clear value of a target; for depths, the first number."""
        return cleared(self.plan, target, self.number)

    # --- draws -----------------------------------------------------------------------------------

    def check_values(self) -> None:
        """Raise ``MissingValuesError`` if something is drawn for which a value is missing."""
        self.begin(0)
        for step in self.plan.steps:
            if isinstance(step, DrawStep):
                drawn = list(self.draws(step, is_first=True))
            else:
                drawn = [self.kernel(step, is_first=True)] if isinstance(step, RunStep) else []
            for draw in drawn:
                draw.state.instance.values()

    def draws(self, step: DrawStep, *, is_first: bool) -> Iterator[StepDraw]:
        """All draws of a step, in order."""
        state = self.state_of(step)
        size = self.drawn_size(step)
        onto = _Onto(size, size if state.viewport is None else state.viewport[2:])
        for drawn in step.draws:
            for light in self._lights(drawn.light):
                yield from self._drawn(drawn, light, onto, is_first)

    def kernel(self, step: RunStep, *, is_first: bool) -> StepDraw:
        """The run of a kernel."""
        shader = step.use.shader
        self._steps.add(self._costs[shader])
        instance = self.instances[shader].copied()
        reads = self._give(instance, step.use, is_first)
        self._kernels[step.name] = instance
        return StepDraw(shader, SceneState(1, 1, {}, KERNEL.triangles, instance, ()), reads)

    def _lights(self, entry: str | None) -> Sequence[tuple[str, int | None] | None]:
        """Each light of an entry of the rig, by its name and number."""
        if entry is None:
            return (None,)
        row = self._entries[entry]
        if row.capacity is None:
            return ((entry, None),)
        count = row.capacity
        if row.count is not None:
            count = min(max(self.values.get(row.count), 0), count)
        return tuple((entry, number) for number in range(count))

    def _drawn(
        self,
        drawn: DrawnRow,
        light: tuple[str, int | None] | None,
        onto: _Onto,
        is_first: bool,
    ) -> Iterator[StepDraw]:
        uses = {use.material: use for use in drawn.uses}
        self._steps.add(sum(self._costs[use.shader] for use in drawn.uses))
        if drawn.models is None:
            assert drawn.vertices is not None, "names are checked"
            count = self._vertex_count(drawn.vertices)
            primitive = self.instances[uses[None].shader].reflection.draw.primitive
            if count >= CORNERS[primitive]:
                mesh = bare_mesh(count, primitive)
                yield self._one(uses[None], None, mesh, light, onto, is_first)
            return
        for model in self.scenery.tagged(drawn.models):
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
        count = int(self.number(value))
        if not 0 <= count <= MOST_VERTICES:
            raise PlanError(f"a step would draw {count} vertices; it can draw 0 to {MOST_VERTICES}")
        self._vertices.add(count)
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
        instance = self.instances[use.shader].copied()
        scene = self.scenery.scene
        if model is not None:
            scene = replace(
                scene, object_to_world=model.placement, look=model.look, bones=model.bones
            )
        scene.apply(instance, onto.seen[0] / onto.seen[1], self.given)
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
                    value = self.values.get(f"{source}.{row.member(name)}")
                    if value is not None:
                        instance.set(name, value)
            else:
                instance.take(row.name, self.values, own.name)
                if row.count is not None and own.count is not None:
                    instance.take(row.count, self.values, own.count)

    def _give(self, instance: Instance, use: UseRow, is_first: bool) -> dict[str, Read]:
        """Give a shader the values that the frame sets; returns the sources made by steps."""
        reads = {}
        for row in use.inputs:
            name, source = row.name, row.source
            if is_first and isinstance(source, PreviousSource) and source.initially is not None:
                source = source.initially
            match source:
                case ValueSource():
                    instance.set(name, self.number(source.value))
                case HostSource():
                    self._bind(instance, name, source.host)
                case PreviousSource():
                    reads[name] = Read(f"previous({source.previous})", source.texture)
                case ResultSource():
                    reads[name] = Read(source.result, source.texture)
        for name, read in reads.items():
            if read.texture is not None:
                instance.bind_own(name, self.size_of(read.texture))
        return reads

    def _bind(self, instance: Instance, name: str, host: str) -> None:
        """Give a shader a texture or a buffer of the host."""
        textures = self.values.textures()
        if host in textures:
            instance.set(name, textures[host])
        else:
            instance.set_bytes(name, self.values.buffers()[host].data)


_GIVEN = ("parameters", "derived", "lights", "buffers", "textures", "vertex_inputs", "targets")
"""The values that a draw has to be given, as tables of a reflection."""


def _cost(reflection: Reflection) -> int:
    """The number of things that are set for a draw: rows, and the lanes of the parameters."""
    lanes = sum(row.size for row in reflection.parameters) // LANE
    return lanes + sum(len(getattr(reflection, table)) for table in _GIVEN)


@dataclass(frozen=True, slots=True)
class FrameDeclarations:
    """The declarations of a frame, in the form of a shader's, so that a host can set its values."""

    plan: FramePlan

    @property
    def material(self) -> str:
        """The name of the frame."""
        return self.plan.frame

    @property
    def rig(self) -> str:
        """The rig of the frame."""
        return self.plan.rig

    @property
    def parameters(self) -> Sequence[ParameterRow]:
        """The parameters of the frame and of its lights."""
        return self.plan.parameters

    @property
    def derived(self) -> Sequence[DerivedRow]:
        """Nothing: a frame has no blocks."""
        return ()

    @property
    def lights(self) -> Sequence[LightRow]:
        """The lights of the rig."""
        return self.plan.lights

    @property
    def buffers(self) -> Sequence[BufferRow]:
        """The storage buffers that the host binds."""
        return self.plan.host_buffers

    @property
    def textures(self) -> Sequence[HostTextureRow]:
        """The textures that the host binds."""
        return self.plan.host_textures

    @property
    def computed(self) -> Iterator[Sequence[StepRow]]:
        """The steps of the frame's values."""
        return (value.steps for value in self.plan.values)
