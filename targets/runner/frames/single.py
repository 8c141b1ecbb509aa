"""Shows a single material as a frame: a plan of one step that draws or runs it.

Hosts have one road only: they execute plans. ``burnish render`` and ``burnish view`` take this road
for materials and kernels, and the latter for passes that capture, too; the author of an engine can
do the same with any reflection.
"""

from __future__ import annotations

from dataclasses import replace

from ..binding import shows_less
from ..cameras import USUAL, Viewpoint, looking
from ..capturing import give_elements
from ..exact import Exact
from ..kernels import has_images, pictures_of
from ..meshes import MESHES, farthest_first, lies
from ..scene import Scene, with_inputs
from ..scene_state import CLEAR, Color, set_up
from ..smooth import Smooth, can_be_smooth
from ..subject import Subject
from .checks.rows import PlanError
from .host import FrameHost
from .scenery import Model, Scenery
from .single_plan import single_plan
from .subjects import PlannedFrame, SingleFrame

_ABOVE = (0.7, 2.6, 2.6)
"""The eye before a mesh that lies."""


def single_frame(
    subject: Subject, background: Color = CLEAR, *, exact: bool = False, samples: int = 1
) -> SingleFrame:
    """The frame that shows a material on all models of the scene, or the results of a kernel.

    The frame has an output for each render target, image or buffer, or one for the depths of a pass
    without targets. ``background`` is the clear value of targets for which the pass has none. With
    several ``samples``, what shows light has them, and targets of floats, unless the pass says by
    itself how many. Or else with ``exact``, targets keep what the material writes, instead of
    rounding it to their formats, if the pass shows no less than that. Raises ``PlanError`` for a
    pass that captures vertices by a stream output, as it leaves nothing for a host.
    """
    reflection = subject.reflection
    if not (pictures_of(reflection) or reflection.results):
        raise PlanError(f"{subject.name} draws no picture")
    if not (reflection.targets or reflection.results):
        subject = Exact.of(subject)
    elif samples > 1 and can_be_smooth(reflection):
        subject = Smooth.of(subject, samples)
    elif exact and not (has_images(reflection) or shows_less(reflection)):
        subject = Exact.of(subject)
    return SingleFrame(subject.name, single_plan(subject.reflection, background), (subject,))


def captures(frame: PlannedFrame) -> bool:
    """True if a frame of a single kernel captures the vertices of a mesh, which ``give_captured``
    gives it."""
    return isinstance(frame, SingleFrame) and frame.shaders[0].reflection.capture is not None


def give_captured(host: FrameHost, mesh: str, instances: int) -> None:
    """Give a kernel that captures the vertices of a mesh, in the scene of a material."""
    (instance,) = host.instances
    whole = with_inputs(instance.reflection, MESHES[mesh](), instances)
    give_elements(set_up(instance, whole, Scene(), host.size))


def single_scenery(
    frame: SingleFrame, mesh: str, instances: int, viewpoint: Viewpoint = USUAL
) -> Scenery:
    """A mesh with the material, and the camera and lights that ``burnish render`` has for it.

    What lies is seen from above. Raises ``CameraError``.
    """
    reflection = frame.shaders[0].reflection
    if not frame.plan.models:
        return Scenery(())
    shape = MESHES[mesh]()
    scene = Scene(looking(_ABOVE)) if lies(shape) else Scene()
    whole = with_inputs(reflection, shape, instances)
    found = Scenery((Model(whole, frame.name, scene.object_to_world),), scene)
    found = found.seen_from(viewpoint)
    if any(row.blend is not None for row in reflection.targets):
        sorted_ = farthest_first(whole, found.scene.camera.eye)
        found = replace(found, models=(replace(found.models[0], mesh=sorted_),))
    return found
