"""Sets up a camera, an object and lights for a material, by the declarations of its parameters.

``stdlib/scene.toml`` says what the library's declarations mean in a scene. World space is
right-handed with y upwards; clip space has z from 0 to w.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...compiler.documents.drawing import TextureRow, VertexInputRow
from ...compiler.documents.plan import FramePlan
from ...compiler.documents.reflection import Reflection
from ...compiler.documents.representations import kind_of, lanes_of
from ...compiler.documents.values import LightRow, MemberRow, ParameterRow
from ...compiler.reflection.roles import scene_names
from ...support.frozen import changed
from .cameras import Camera, Matrix, looking
from .instances.declared import Declared
from .instances.host_values import HostValues
from .instances.shapes import WHOLE
from .instances.values import ParameterError
from .lamps import GOLDEN_ANGLE, MADE_UP, Lamp, left_over, make_up, shine
from .looks import PLAIN, Look
from .meshes import BONES, CHANNELS, Mesh, MeshError

Pose = tuple[tuple[tuple[float, ...], ...], ...]
"""The transforms of bones, each column by column."""

INSTANCES = 4
"""The number of instances that are drawn if the material distinguishes them."""


@dataclass(frozen=True, slots=True)
class Scene:
    """The positions of camera, object and lights, and the look of the object."""

    camera: Camera = field(default_factory=looking)
    object_to_world: tuple[tuple[float, ...], ...] = tuple(map(tuple, np.eye(4).tolist()))
    """The rows of the object's transform."""
    light_distance: float = 3.0
    """The distance from the origin of lights that are made up and have a position."""
    light_count: int = 3
    """The number of lights that are made up for an array of lights, if it has space for them."""
    lamps: tuple[Lamp, ...] = ()
    """The lights of a file; without any, lights are made up."""
    look: Look = PLAIN
    """The surface of the object as a file describes it."""
    bones: Matrix | None = None
    """The transform of each bone (bones, 4, 4); ``None`` for the bones of the meshes here."""

    def apply(self, instance: HostValues, aspect: float, but: frozenset[str] = frozenset()) -> None:
        """Set all parameters and textures that belong to a scene, except those named in ``but``.

        ``aspect`` is width divided by height.
        """
        roles = value_roles(instance.declared)
        given = self._values(aspect)
        for name, role in roles.items():
            if name in but:
                continue
            if role == _POSE:
                instance.set(name, self._pose(_bones_of(instance.declared, name), name))
            elif role in given:
                instance.set(name, given[role])
        for name, role in texture_roles(instance.declared).items():
            if role in self.look.textures and name not in but:
                instance.set(name, self.look.textures[role])
        self._place_lights(instance)

    def values(self, aspect: float, declared: Iterable[Declared] = ()) -> dict[str, Any]:
        """The values of the scene that are no light's, by the scene's words for them.

        Those ``declared`` which have bones say how many; without any, there is no pose.
        """
        found = self._values(aspect)
        for each in declared:
            for name, role in value_roles(each).items():
                if role == _POSE:
                    found[_POSE] = self._pose(_bones_of(each, name), name)
        return found

    def _values(self, aspect: float) -> dict[str, Any]:
        """The values of the scene without the pose, which may be large and is rarely read."""
        return {
            "world_to_clip": _columns(self.camera.world_to_clip(aspect)),
            "eye": self.camera.eye,
            "object_to_world": _columns(np.array(self.object_to_world)),
            **self.look.parameters,
        }

    def _pose(self, count: int, name: str) -> Pose:
        """The transforms of ``count`` bones, for the parameter ``name``."""
        if self.bones is None:
            return pose(count)
        if len(self.bones) > count:
            raise ParameterError(
                name,
                f"`{name}` has space for {count} bones, and the skin has {len(self.bones)}: the "
                f"material makes space by `param {name} : mat4[{len(self.bones)}] per draw`",
            )
        rest = np.tile(np.eye(4), (count - len(self.bones), 1, 1))
        return tuple(_columns(bone) for bone in np.concatenate([self.bones, rest]))

    def unused_lamps(self, instance: HostValues) -> list[Lamp]:
        """The lights of a file for which the rig has no entry."""
        return left_over(instance, self.lamps, _all_roles(instance))

    def _place_lights(self, instance: HostValues) -> None:
        if self.lamps:
            shine(instance, self.lamps, _all_roles(instance))
        else:
            make_up(instance, _all_roles(instance), self.light_distance, self.light_count)


def _all_roles(instance: HostValues) -> list[dict[str, str]]:
    """The roles of each light's parameters in a scene."""
    parameters = _by_name(instance.declared)
    return [dict(light_roles(parameters, row)) for row in instance.declared.lights]


def light_roles(
    parameters: Mapping[str, ParameterRow], light: LightRow
) -> Iterator[tuple[str, str]]:
    """The parameters of a light that a scene sets, each with its role.

    The names come without the light's own name. ``parameters`` are those of the reflection, by
    name.
    """
    rows = [parameters[name] for name in light.parameters]
    members: list[tuple[str, ParameterRow | MemberRow]] = (
        [(light.member(row.name), row) for row in rows]
        if light.capacity is None
        else [(member.name, member) for row in rows for member in row.members]
    )
    for name, member in members:
        role = _light_role(member)
        if role is not None:
            yield name, role


def _by_name(declared: Declared) -> Mapping[str, ParameterRow]:
    return {row.name: row for row in declared.parameters}


def _light_role(row: ParameterRow | MemberRow) -> str | None:
    """The scene's word for a light's parameter, if it has a value for it.

    A declaration of the library decides this, or else the type of a parameter without a default.
    Names decide nothing: a parameter of one's own may have any name.
    """
    names = scene_names()
    known = names["parameters"].get(row.library or "")
    by_type = names["light_types"].get(row.type) if row.default is None else None
    return known or by_type


def set_by_scene(declared: Declared) -> set[str]:
    """The names of the parameters that every scene sets, including those of single lights."""
    parameters = _by_name(declared)
    found = {name for name, row in parameters.items() if row.role in _OF_VIEWS}
    for light in declared.lights:
        if light.capacity is None:
            roles = light_roles(parameters, light)
            found.update(f"{light.name}.{name}" for name, role in roles if role in MADE_UP)
    return found


_POSE = "pose"
_OF_VIEWS = ("world_to_clip", "eye", "object_to_world", _POSE)
"""The scene's words for the values that are not a light's."""


def value_roles(declared: Declared | FramePlan) -> dict[str, str]:
    """The parameters for which a scene may have a value, each with the scene's word for it."""
    rows = declared.parameters
    return {row.name: row.role for row in rows if row.role is not None}


def declared_as(role: str) -> str:
    """The library's declaration of a role, which is the scene's word for a value."""
    return next(name for name, own in scene_names()["parameters"].items() if own == role)


def takes_mean_radiance(row: ParameterRow) -> bool:
    """True for light from everywhere, by the library's declaration of it."""
    return scene_names()["surroundings"].get(row.library or "") == "mean_radiance"


def texture_roles(declared: Declared) -> dict[str, str]:
    """The textures for which a look may have a picture, each with the scene's word for it."""
    names = scene_names()["textures"]
    rows = (row for row in declared.textures if isinstance(row, TextureRow))
    found = ((row.name, names.get(row.library or "")) for row in rows)
    return {name: role for name, role in found if role is not None}


def vertex_data(reflection: Reflection, mesh: Mesh) -> dict[str, NDArray[Any]]:
    """The mesh's values for each vertex input that the shader reads, of shape (vertices, lanes).

    For inputs per instance the shape is (instances, lanes). ``stdlib/scene.toml`` says which
    channel an input's name means; otherwise it is the channel of this name. Raises ``MeshError`` if
    the mesh lacks one.
    """
    roles = scene_names()["attributes"]
    found = {}
    for row in inputs_of_mesh(reflection):
        held = mesh.instances if row.step == "instance" else mesh.channels
        channel = roles.get(row.name, row.name)
        values = held.get(_own(row.name), held.get(row.name, held.get(channel)))
        if values is None:
            raise MeshError(
                f"{reflection.material} reads the vertex input `{row.name}` "
                f"({row.type}), which the mesh does not have for each {row.step}: "
                f"it has {', '.join(held) or 'nothing'}"
            )
        found[row.name] = _with_lanes(row, values)
    return found


def inputs_of_mesh(reflection: Reflection) -> list[VertexInputRow]:
    """The vertex inputs as a mesh has them, however its primitives are drawn."""
    rows = {row.name: row for row in map(_of_mesh, reflection.vertex_inputs) if row is not None}
    return list(rows.values())


def _of_mesh(row: VertexInputRow) -> VertexInputRow | None:
    """A vertex input as a mesh has it; ``None`` if the host counts or makes it."""
    mesh = row.mesh
    if mesh is None:
        return row
    if mesh.is_number or mesh.is_of_pattern:
        return None
    return changed(row, name=mesh.name, step="instance" if mesh.corner is None else "vertex")


def with_inputs(reflection: Reflection, mesh: Mesh, instances: int = INSTANCES) -> Mesh:
    """``mesh`` with a smooth pattern for each vertex input of the shader that it lacks.

    If the shader distinguishes instances and the mesh has none, there are ``instances`` of them.
    """
    roles = scene_names()["attributes"]
    position = mesh.channels["position"]
    channels, count = dict(mesh.channels), mesh.instance_count
    of_instances = dict(mesh.instances)
    if is_instanced(reflection) and not of_instances:
        count = instances
    for row in inputs_of_mesh(reflection):
        name = row.name
        if row.step == "instance":
            of_instances.setdefault(name, _of_instances(row, count))
            continue
        channel = channels.get(name, channels.get(roles.get(name, name)))
        fits = channel is not None and (channel.dtype.kind == "f") == (
            kind_of(row.representation) == "float"
        )
        if not fits:
            channels[_own(name)] = _pattern(row, position)
    return replace(mesh, channels=channels, instances=of_instances, instance_count=count)


def _own(name: str) -> str:
    """The channel of a mesh for a vertex input that one material has got.

    A material may call an input ``position``, and still the mesh has its own positions.
    """
    return f"own {name}" if name in CHANNELS else name


def is_instanced(reflection: Reflection) -> bool:
    """True if a shader distinguishes instances of the mesh."""
    rows = reflection.vertex_inputs
    draw = reflection.draw
    if "instances" in (draw.expanded_by, draw.tessellation and draw.tessellation.divided_by):
        of_mesh = [row.mesh for row in rows if row.mesh is not None]
        return any(row.corner is None and not row.is_of_pattern for row in of_mesh)
    return any("instance_index" in read for read in reflection.pipeline_inputs.values()) or any(
        row.step == "instance" for row in rows
    )


def _of_instances(row: VertexInputRow, count: int) -> NDArray[Any]:
    """The values of ``count`` instances for an input: their transforms, or a pattern."""
    column = row.column
    if column is not None and scene_names()["instances"].get(column.of) == "placement":
        return placements(count)[:, :, column.index]
    return _pattern(row, _places(count))


def placements(count: int) -> NDArray[np.float64]:
    """Transforms that place ``count`` small copies next to each other: (count, row, column)."""
    transforms = np.zeros((count, 4, 4))
    transforms[:, (0, 1, 2), (0, 1, 2)] = 0.5
    transforms[:, :3, 3] = _places(count)
    transforms[:, 3, 3] = 1
    return transforms.astype(np.float32).astype(float)


def _places(count: int) -> NDArray[np.float64]:
    """Positions around the origin that do not hide each other, each with its own depth."""
    turns = GOLDEN_ANGLE * np.arange(count)
    ring = 0.75 * np.sqrt((np.arange(count) + 0.5) / count)
    depth = np.linspace(-0.4, 0.4, count) if count > 1 else np.zeros(1)
    return np.stack([ring * np.cos(turns), ring * np.sin(turns), depth], 1)


def _pattern(row: VertexInputRow, position: NDArray[np.float64]) -> NDArray[Any]:
    representation = row.representation
    lanes = lanes_of(representation)
    number = int(re.sub(r"\D", "", representation) or 1)
    waves = [
        0.5 + 0.4 * np.sin(position @ [1.3 + lane, 0.7 * number, 2.1 - lane] + len(row.name))
        for lane in range(lanes)
    ]
    values = np.stack(waves, 1)
    if kind_of(representation) in WHOLE:
        return np.floor(8 * values).astype(np.int64)
    return values.astype(np.float32).astype(float)


def _with_lanes(row: VertexInputRow, values: NDArray[Any]) -> NDArray[Any]:
    """``values`` with the input's number of lanes: others are removed, a missing fourth is 1."""
    representation = row.representation
    if kind_of(representation) in WHOLE and values.dtype.kind == "f":
        raise MeshError(
            f"the vertex input `{row.name}` ({row.type}) takes whole numbers, which the mesh "
            "does not have there"
        )
    lanes = lanes_of(representation)
    given = values.shape[1]
    if given < lanes:
        filler = np.zeros((len(values), lanes - given))
        if lanes == 4:
            filler[:, -1] = 1
        values = np.concatenate([values, filler], 1)
    return values[:, :lanes]


@cache
def pose(count: int) -> Pose:
    """A transform for each of ``count`` bones: the meshes here bend, each bone more than the last.

    Every bone rotates around the origin of its own slice of the mesh; see ``meshes.BONES``.
    """
    return tuple(_columns(_bent(min(number, BONES - 1))) for number in range(count))


def _bones_of(declared: Declared, name: str) -> int:
    """The number of bones that a parameter has space for."""
    return _by_name(declared)[name].layout.count or 1


def _bent(number: int) -> Matrix:
    """The rotation of a bone around z, in the rotated frame of the bones below it."""
    bent: Matrix = np.eye(4)
    for below in range(number):
        angle, height = math.radians(14), 2 * below / (BONES - 1) - 1
        turn = np.eye(4)
        turn[:2, :2] = [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]
        turn[:2, 3] = [math.sin(angle) * height, (1 - math.cos(angle)) * height]
        bent = bent @ turn
    return bent


def _columns(matrix: Matrix) -> tuple[tuple[float, ...], ...]:
    """A matrix in the form that hosts set: column after column."""
    return tuple(tuple(column) for column in matrix.T.tolist())
