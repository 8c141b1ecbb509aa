"""Shows a single material as a frame: a plan of one step that draws or runs it.

Hosts have one road only: they execute plans. ``burnish view`` takes this road for materials,
kernels and passes that capture; the author of an engine can do the same with any reflection.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ....compiler.documents.plan import FramePlan
from ....compiler.documents.reflection import Reflection
from ....compiler.ir.shader import Shader
from ....support.frozen import changed
from ..capturing import give_elements
from ..codes import ShaderFile
from ..meshes import MESHES, farthest_first
from ..scene import Scene, with_inputs
from ..scene_state import CLEAR, Color, set_up
from ..subject import Subject
from .checks.rows import PlanError
from .host import FrameHost
from .scenery import Model, Scenery
from .single_plan import single_plan


@dataclass(frozen=True, slots=True)
class SingleFrame:
    """A frame with one shader."""

    name: str
    plan: FramePlan
    shaders: Sequence[Subject]

    @property
    def plan_of_reference(self) -> FramePlan:
        """The plan itself, as the results of one step share nothing."""
        return self.plan


@dataclass(frozen=True, slots=True)
class _Renamed:
    """A material under the name that frames give their shaders."""

    subject: Subject
    name: str
    reflection: Reflection

    @property
    def files(self) -> Sequence[ShaderFile]:
        """The emitted texts."""
        return self.subject.files

    @property
    def lacking(self) -> Mapping[str, str]:
        """The reason for each profile that has no texts."""
        return self.subject.lacking

    @property
    def shader(self) -> Shader:
        """The shader of the material as it is meant."""
        return self.subject.shader

    def emitted(self, profile: str) -> Shader:
        """The shader that the texts for a profile compute."""
        return self.subject.emitted(profile)


def single_frame(subject: Subject, background: Color = CLEAR) -> SingleFrame:
    """The frame that shows a material on all models of the scene, or the results of a kernel.

    The frame has an output for each render target, image or buffer. ``background`` is the clear
    value of its first target, unless its pass has one. Raises ``PlanError`` for a pass that
    captures vertices by a stream output, as it leaves nothing for a host.
    """
    reflection = subject.reflection
    if not (reflection.targets or reflection.results):
        raise PlanError(f"{subject.name} draws no picture")
    parts = [subject.name, reflection.pass_, subject.name]
    name = ".".join(part for part in parts if part)
    shader = _Renamed(subject, name, changed(reflection, material=name))
    plan = single_plan(subject.name, shader.name, reflection, background)
    return SingleFrame(subject.name, plan, (shader,))


def captures(frame: SingleFrame) -> bool:
    """True if the frame captures the vertices of a mesh, which ``give_captured`` gives it."""
    return frame.shaders[0].reflection.capture is not None


def give_captured(host: FrameHost, mesh: str, instances: int) -> None:
    """Give a kernel that captures the vertices of a mesh, in the scene of a material."""
    (instance,) = host.instances
    whole = with_inputs(instance.reflection, MESHES[mesh](), instances)
    give_elements(set_up(instance, whole, Scene(), host.size))


def single_scenery(frame: SingleFrame, mesh: str, instances: int) -> Scenery:
    """A mesh with the material, and the camera and lights that ``burnish render`` has for it."""
    reflection = frame.shaders[0].reflection
    if not frame.plan.models:
        return Scenery(())
    scene = Scene()
    whole = with_inputs(reflection, MESHES[mesh](), instances)
    if any(row.blend is not None for row in reflection.targets):
        whole = farthest_first(whole, scene.camera.eye)
    return Scenery((Model(whole, frame.name, scene.object_to_world),), scene)
