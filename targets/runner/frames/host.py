"""The host's side of a plan: values that are set by name, and numbers and sizes computed from them.

``step_draws.py`` makes the draws of a frame by it, for the reference and for drivers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ....compiler.budget import BudgetError, Tally
from ....compiler.documents.plan import (
    AttachmentRow,
    DrawStep,
    FramePlan,
    HostTextureRow,
    PlanStep,
)
from ....compiler.documents.steps import StepRow
from ....compiler.documents.values import BufferRow, DerivedRow, LightRow, ParameterRow
from ..instances.host_values import HostValues, MissingValuesError
from ..instances.instance import Instance
from ..instances.names import no_parameter
from ..instances.values import UnknownParameterError
from ..scene import value_roles
from ..scene_state import Color
from .checking import PlanError, check_plan
from .numbers import is_of
from .owners import check_one_type, owned_shaders, unowned
from .scenery import Scenery
from .settings import StepState, cleared, step_state
from .sizes import Size, checked_size, drawn_size
from .subjects import PlannedFrame

NUMBERS = 1 << 24
"""The number of frames that are told apart: after it, `number` is 0 again."""


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
        self.steps, self.vertices = Tally("steps", what), Tally("vertices", what)
        """The cost of one frame beside its models: values that the host computes and sets, and
        draws without models."""
        self.values = HostValues(FrameDeclarations(plan), self.steps)
        width, height = size
        scenery.scene.apply(self.values, width / height)
        self.given: frozenset[str] = frozenset()
        """The names that have been set; a scene leaves their values alone."""
        self.size = size
        """The width and height of the outputs."""
        self._tell("size", size)
        self.instances = [Instance(shader.reflection, self.steps) for shader in self.shaders]
        """For each shader, the values of its materials that are the same for all models."""
        self.kernels: dict[str, Instance] = {}
        """The instances of the kernels that this frame has run, by step: they say sizes."""

    def unused_lamps(self) -> list[str]:
        """The names of the lights in the scene for which the frame's rig has no entry."""
        return [lamp.name for lamp in self.scenery.scene.unused_lamps(self.values)]

    def set_text(self, name: str, text: str) -> None:
        """Set a value of the frame; or else of all shaders that have it.

        A material's parameter is an example; ``Clay.base`` is that of one material. Raises
        ``ParameterError`` and ``PictureError``, as ``Instance.set_text`` does, also for a name that
        has several types.
        """
        self._set(name, lambda instance, own: instance.set_text(own, text))

    def set(self, name: str, value: object) -> None:
        """Set a value in the form that ``Instance.set`` takes. Raises ``ParameterError``."""
        self._set(name, lambda instance, own: instance.set(own, value))

    @property
    def owners(self) -> Mapping[str, Sequence[HostValues]]:
        """The values of each material, and of each pass or kernel without one, by its name."""
        return {
            owner: [self.instances[number] for number in numbers]
            for owner, numbers in owned_shaders(self.plan).items()
        }

    def owner_of(self, name: str) -> str:
        """The owner that ``Clay.base`` names; empty if the name is one of its own."""
        owner, dot, own = name.partition(".")
        every = (self.values, *self.instances)
        is_whole = any(each.type_of(name) or each.is_light(name) for each in every)
        return owner if dot and own and not is_whole and owner in self.owners else ""

    def _set(self, name: str, act: Callable[[HostValues, str], None]) -> None:
        self.given |= {name}
        owner = self.owner_of(name)
        own = name.removeprefix(f"{owner}.") if owner else name
        every: Sequence[HostValues] = (self.values, *self.instances)
        if owner:
            every = self.owners[owner]
        elif not self.values.type_of(name):
            pairs = ((known, each) for known, all_of in self.owners.items() for each in all_of)
            check_one_type(name, pairs)
        errors: list[UnknownParameterError] = []
        for instance in every:
            try:
                act(instance, own)
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
        if said := unowned(name, self.owners):
            return said
        # The size of a single material's picture is called by its step: it is not the material's.
        steps = tuple(f"{step.name}." for step in self.plan.steps)
        set_by_frame: list[set[str]] = [set() for _ in self.instances]
        for step in self.plan.steps:
            for use in step.uses:
                set_by_frame[use.shader] |= {row.name for row in use.inputs}
        names = [
            row.name
            for each, taken in zip(
                (*self.instances, self.values), (*set_by_frame, set()), strict=True
            )
            for row in (*each.declared.parameters, *each.declared.textures, *each.declared.buffers)
            if row.name not in taken and not row.name.startswith(steps)
        ]
        return no_parameter(name, names)

    def begin(self, drawn: int) -> None:
        """Set the number of frames before this one. To be called before the frame's first step."""
        self.steps.begin()
        self.vertices.begin()
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
        if step not in self.kernels:
            raise PlanError(
                f"the size of what `{step}` writes is needed before it is run: give its parameters "
                "and textures in the frame"
            )
        return self.kernels[step].image_size()

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
