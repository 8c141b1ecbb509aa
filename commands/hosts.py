"""Sets frames up to be drawn: a scene, values by name, and pictures and elements to work on.

``render`` and ``view`` call it for everything that they draw: a material is a frame of one step.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from .console import remark
from .failures import drawing_errors
from .options import point_of
from .standing import ROOM, STANDING

if TYPE_CHECKING:
    from ..compiler.documents.plan import FramePlan
    from ..targets.runner.cameras import Viewpoint
    from ..targets.runner.frames.host import FrameHost
    from ..targets.runner.frames.scenery import Scenery
    from ..targets.runner.frames.subjects import PlannedFrame, SingleFrame
    from ..targets.runner.instances.declared import Declared
    from ..targets.runner.instances.instance import Instance


Point = tuple[float, float, float]


def is_single(frame: PlannedFrame) -> bool:
    """True for a single material or kernel, of which no file declares a frame."""
    from ..targets.runner.frames.subjects import SingleFrame

    return isinstance(frame, SingleFrame)


class SceneRequest(Protocol):
    """What a command line says about the scene; the names are those of its options."""

    @property
    def mesh(self) -> str:
        """The mesh to draw, if there is no scene."""

    @property
    def instances(self) -> int:
        """The number of instances to draw if the material distinguishes them."""

    @property
    def scene(self) -> Path | None:
        """A file whose objects are drawn."""

    @property
    def variant(self) -> str | None:
        """The name of the variant in which the file is drawn."""

    @property
    def eye(self) -> Point | None:
        """The place of the camera."""

    @property
    def look_at(self) -> Point | None:
        """The point that the camera looks at."""

    @property
    def turn(self) -> tuple[float, float]:
        """The angles by which the camera turns, in radians."""

    @property
    def wished(self) -> Sequence[tuple[str, str]]:
        """The values that the comment of the file asks for, by name, as texts."""

    @property
    def values(self) -> Sequence[tuple[str, str]]:
        """The values of the command line, which win."""


def scenery_of(frame: PlannedFrame, request: SceneRequest, mesh: str | None = None) -> Scenery:
    """The scene to draw: a mesh for a material, a model of each of a frame's materials, or the
    objects of a file; with the camera where it was asked for.

    ``mesh`` is used instead of that of the request. Raises ``CameraError``, ``SceneError``,
    ``FileError`` and ``BudgetError``.
    """
    from ..targets.runner.cameras import Viewpoint
    from ..targets.runner.frames.subjects import SingleFrame

    mesh = mesh or request.mesh
    eye = request.eye or _eye_set(frame, (*request.wished, *request.values))
    viewpoint = Viewpoint(eye, request.look_at, request.turn)
    if request.scene is None and isinstance(frame, SingleFrame):
        return _single_scenery(frame, mesh, request.instances, viewpoint)
    return _scenery_of_frame(frame, mesh, request).seen_from(viewpoint)


def _eye_set(frame: PlannedFrame, values: Iterable[tuple[str, str]]) -> Point | None:
    """The place that a value gives the parameter for the viewer's eye: the camera goes there, too.

    A text that is no point is left to ``set_values``, which refuses it.
    """
    from ..targets.runner.scene import value_roles

    of_shaders = [shader.reflection for shader in frame.shaders]
    declared: list[Declared | FramePlan] = [frame.plan, *of_shaders]
    eyes = {name for each in declared for name, role in value_roles(each).items() if role == "eye"}
    places = [point_of(text) for name, text in values if name in eyes]
    return places[-1] if places else None


def _scenery_of_frame(frame: PlannedFrame, mesh: str, request: SceneRequest) -> Scenery:
    """A model of each of a frame's materials, or the objects of a file."""
    from ..targets.runner.frames.scenery import in_a_row

    tags = {row.name: row.materials for row in frame.plan.models}
    materials = list(dict.fromkeys(each for listed in tags.values() for each in listed))
    if request.scene is None:
        return in_a_row(materials, tags, mesh, ROOM if STANDING in tags else 1)
    from ..targets.runner.frames.staging import left_out, staged
    from ..targets.runner.scenes.gltf.reading import read_gltf

    file = read_gltf(request.scene, request.variant)
    found = staged(file, materials, list(tags))
    for note in (*file.notes, *left_out(found, _words(frame))):
        remark("note", f"{request.scene}: {note}")
    return found


def _words(frame: PlannedFrame) -> dict[str, set[str]]:
    """The scene's words for the values that each of the frame's materials takes."""
    from ..targets.runner.frames.owners import owned_shaders
    from ..targets.runner.scene import texture_roles, value_roles

    found: dict[str, set[str]] = {}
    for owner, numbers in owned_shaders(frame.plan).items():
        declared = [frame.shaders[number].reflection for number in numbers]
        roles = [words for each in declared for words in (value_roles(each), texture_roles(each))]
        found[owner] = set[str]().union(*(words.values() for words in roles))
    return found


def _single_scenery(frame: SingleFrame, mesh: str, instances: int, viewpoint: Viewpoint) -> Scenery:
    """A mesh with all inputs that the material reads."""
    from ..targets.runner.frames.single import single_scenery
    from ..targets.runner.meshes import MESHES

    found = single_scenery(frame, mesh, instances, viewpoint)
    own = MESHES[mesh]().channels
    made_up = [f"`{name}`" for model in found.models for name in model.mesh.channels
               if name not in own]  # fmt: skip
    if made_up:
        remark("note", (
            f"no mesh here has {', '.join(made_up)}: {frame.name} is drawn with smooth waves in "
            "place of them"
        ))  # fmt: skip
    return found


def set_values(owners: Sequence[FrameHost | Instance], values: Iterable[tuple[str, str]]) -> None:
    """Set each value in every frame and kernel that has a parameter or texture of this name.

    What is set of one material, ``Clay.base``, comes after what is set of all. Raises
    ``UnknownParameterError`` if none has one, and ``ParameterError`` if they are of several types.
    """
    from ..targets.runner.frames.host import FrameHost
    from ..targets.runner.frames.owners import check_one_type
    from ..targets.runner.instances.values import UnknownParameterError

    hosts = [each for each in owners if isinstance(each, FrameHost)]

    def is_owned(pair: tuple[str, str]) -> bool:
        return any(host.owner_of(pair[0]) for host in hosts)

    for name, text in sorted(values, key=is_owned):
        known = (
            (owner, v) for host in hosts for owner, all_of in host.owners.items() for v in all_of
        )
        check_one_type(name, known)
        unknown = []
        for owner in owners:
            try:
                owner.set_text(name, text)
            except UnknownParameterError as error:
                unknown.append(error)
        if len(unknown) == len(owners):
            # The shortest message suggests a similar name; the others list all names.
            raise min(unknown, key=lambda error: len(str(error)))


def set_wished(owners: Sequence[FrameHost | Instance], values: Iterable[tuple[str, str]]) -> None:
    """Set the values that a file's comment asks for, where they exist and can be set.

    The comment may be about another of the file's materials, and its pictures may be elsewhere.
    """
    from ..targets.runner.instances.values import UnknownParameterError

    for name, text in values:
        for owner in owners:
            try:
                owner.set_text(name, text)
            except UnknownParameterError:
                continue
            except drawing_errors() as error:
                remark("note", f"the comment of the file sets `{name}`, and that failed: {error}")
                break


def set_pictures(instances: Iterable[Instance], size: tuple[int, int]) -> None:
    """Give kernels over images a picture to work on for each texture that has none."""
    from ..targets.runner.kernels import has_images
    from ..targets.runner.textures.chart import chart

    for instance in instances:
        reflection = instance.reflection
        for row in reflection.textures if has_images(reflection) else ():
            is_picture = (row.dimension, row.sample) == ("2d", "float")
            if is_picture and instance.get(row.name) is None:
                instance.set(row.name, chart(size))
                remark("note", (
                    f"`{row.name}` of {reflection.material} is a test chart: "
                    f"--set {row.name}=PICTURE sets another"
                ))  # fmt: skip


def tell_unmade(instances: Iterable[Instance]) -> None:
    """Note textures that lights bring to frames, and that nobody has set here."""
    unmade = {
        row.name: row.default
        for instance in instances
        for row in instance.reflection.textures
        if row.brought and row.stages and instance.get(row.name) is None
    }
    for name, default in unmade.items():
        remark("note", (
            f"`{name}` is made by steps of its light, which only a frame draws; here it is "
            f"`{default}`: --set {name}=PICTURE sets another"
        ))  # fmt: skip


def tell_unused_lamps(host: FrameHost) -> None:
    """Note the lights of a file for which the rig has no place."""
    from ..targets.runner.scenes.notes import Notes

    notes = Notes()
    for name in host.unused_lamps():
        notes.add(f"the light {name!r} of the scene", " is left out: the rig has no place for it")
    for note in notes.told():
        remark("note", note)
