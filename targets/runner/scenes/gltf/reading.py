"""Reads a scene from a glTF 2.0 file; ``burnish render --scene`` calls ``read_gltf``.

The modules of this folder are its steps: ``container.py`` takes the file apart into the records of
``schema.py``; ``folder.py`` reads what else it names; ``accessors.py`` decodes arrays, of which
``meshes.py`` makes meshes; ``nodes.py`` places them, ``variants.py`` chooses their materials, and
``looks.py`` reads these, with the extensions of ``layers.py``. Whatever is wrong with a file
becomes a ``SceneError``, and what is too large a ``BudgetError``, before much time or memory is
spent.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from .....compiler.budget import Tally, check
from ...cameras import Camera, Matrix, Vector
from ...lamps import Lamp
from ...looks import Look
from ...meshes import Mesh
from ..notes import Notes
from ..records import SceneError, SceneFile, SceneObject, short
from . import schema
from .accessors import Accessors
from .container import SUPPORTED, open_file
from .folder import Folder
from .looks import Looks
from .meshes import Size, is_drawn, mesh_of, size_of
from .nodes import Placed, placed_nodes
from .variants import ChosenVariant

_BYTES_OF_JOINT = 4 * 4 * 8
_RIGHT_ANGLE = np.pi / 2


def read_gltf(path: Path, variant: str | None = None) -> SceneFile:
    """Read the scene of a ``.gltf`` or ``.glb`` file, in the variant of this name.

    Raises ``SceneError``, and ``BudgetError`` if it takes more than is allowed.
    """
    memory = Tally("memory", f"reading {path} takes")
    file, binary = open_file(path, memory)
    folder = Folder(path, memory)
    accessors = Accessors(file, folder, binary, path, memory)
    notes = Notes()
    looks = Looks(file, folder, accessors, notes, memory)
    chosen = ChosenVariant(file, path, variant, notes)
    return _Reader(path, file, accessors, looks, chosen, notes, memory).scene()


class _Reader:
    """Reads the objects, cameras and lamps of one file."""

    def __init__(
        self,
        path: Path,
        file: schema.File,
        accessors: Accessors,
        looks: Looks,
        variant: ChosenVariant,
        notes: Notes,
        memory: Tally,
    ) -> None:
        self._path = path
        self._file = file
        self._accessors = accessors
        self._looks = looks
        self._variant = variant
        self._notes = notes
        self._memory = memory
        check("nodes", len(file.nodes), f"{path} has")
        self._nodes = placed_nodes(file, path, memory)
        self._places = {each.number: each.to_world for each in self._nodes}
        self._skins: dict[int, Matrix] = {}
        self._meshes: dict[tuple[int, int, int], Mesh] = {}
        self._sizes: dict[tuple[int, int], Size] = {}
        self._weights: dict[tuple[float, ...], int] = {(): 0}
        """A number for each tuple of weights of a node; such a tuple may be long."""
        self._vertices = Tally("vertices", f"{path} draws")

    def scene(self) -> SceneFile:
        self._check_count()
        self._note_left_out()
        objects = [found for placed in self._nodes for found in self._objects(placed)]
        cameras = [self._camera(placed) for placed in self._nodes if placed.node.camera is not None]
        lamps = [self._lamp(placed) for placed in self._nodes if placed.node.extensions.light]
        return SceneFile(tuple(objects), tuple(cameras), tuple(lamps), self._notes.told())

    def _check_count(self) -> None:
        """Refuse more objects than make sense, before anything is made."""
        meshes = self._file.meshes
        drawn = (each.node.mesh for each in self._nodes if each.node.mesh is not None)
        count = sum(len(meshes[number].primitives) for number in drawn if number < len(meshes))
        beside = sum(1 for each in self._nodes if each.node.camera is not None)
        beside += sum(1 for each in self._nodes if each.node.extensions.light)
        check("objects", count + beside, f"{self._path} has")

    def _note_left_out(self) -> None:
        """Note the contents of the file that the scene leaves out."""
        for name in self._file.extensions_used:
            if name not in SUPPORTED:
                self._notes.add(f"the extension {short(name)}", " is left out")
        if self._file.animations:
            self._notes.add("animations", " are left out")

    def _objects(self, placed: Placed) -> Iterator[SceneObject]:
        """An object for each primitive of a node's mesh."""
        number, node = placed.node.mesh, placed.node
        if number is None:
            return
        if number >= len(self._file.meshes):
            raise SceneError(f"node {placed.number}: there is no mesh {number}")
        mesh = self._file.meshes[number]
        bones = None if node.skin is None else self._bones(node.skin, placed)
        of_node = self._weights.setdefault(node.weights, len(self._weights))
        for index, primitive in enumerate(mesh.primitives):
            what = f"mesh {number}, primitive {index}"
            if not is_drawn(primitive):
                self._notes.add(what, ": it consists of lines, and is left out")
                continue
            self._vertices.add(self._size(primitive, (number, index), what).drawn)
            look = self._looks.look(self._variant.material_of(primitive, what), what)
            yield SceneObject(
                placed.name,
                self._mesh(primitive, (number, index, of_node), node.weights or mesh.weights, what),
                placed.to_world if bones is None else np.eye(4),
                _morphed(look) if primitive.targets else look,
                placed.tags,
                bones,
            )

    def _size(self, primitive: schema.Primitive, key: tuple[int, int], what: str) -> Size:
        if key not in self._sizes:
            self._sizes[key] = size_of(primitive, self._accessors, what)
        return self._sizes[key]

    def _mesh(
        self,
        primitive: schema.Primitive,
        key: tuple[int, int, int],
        weights: tuple[float, ...],
        what: str,
    ) -> Mesh:
        """The mesh of a primitive with these weights of its morph targets."""
        if key not in self._meshes:
            self._size(primitive, key[:2], what).count_memory(self._memory)
            weights = weights or (0.0,) * len(primitive.targets)
            self._meshes[key] = mesh_of(primitive, self._accessors, weights, what)
        return self._meshes[key]

    def _bones(self, number: int, placed: Placed) -> Matrix:
        """The transforms of a skin's joints, from the mesh at rest to world space."""
        if number >= len(self._file.skins):
            raise SceneError(f"node {placed.number}: there is no skin {number}")
        if number not in self._skins:
            self._skins[number] = self._moved(self._file.skins[number], f"skin {number}")
        return self._skins[number]

    def _moved(self, skin: schema.Skin, what: str) -> Matrix:
        for joint in skin.joints:
            if joint not in self._places:
                raise SceneError(f"{what}: joint {joint} is no node of the scene")
        self._memory.add(
            len(skin.joints) * _BYTES_OF_JOINT, passing=2 * len(skin.joints) * _BYTES_OF_JOINT
        )
        joints = np.stack([self._places[joint] for joint in skin.joints])
        if skin.inverse_bind_matrices is None:
            return joints
        resting = self._accessors.floats(skin.inverse_bind_matrices, "MAT4", what)
        if len(resting) < len(joints):
            raise SceneError(f"{what}: it has {len(joints)} joints, and {len(resting)} matrices")
        moved: Matrix = joints @ np.swapaxes(resting[: len(joints)], 1, 2)
        return moved

    def _camera(self, placed: Placed) -> Camera:
        number = placed.node.camera
        assert number is not None
        if number >= len(self._file.cameras):
            raise SceneError(f"node {placed.number}: there is no camera {number}")
        camera = self._file.cameras[number]
        to_world = _upright(placed)
        eye = _vector(to_world[:3, 3])
        view: Matrix = np.linalg.inv(to_world).astype(np.float64)
        if camera.type == "perspective" and (lens := camera.perspective):
            far = np.inf if lens.zfar is None else lens.zfar
            _check_depths(lens.znear, far, number)
            return Camera(eye, view, lens.znear, float(far), lens.yfov)
        if camera.type == "orthographic" and (flat := camera.orthographic):
            _check_depths(flat.znear, flat.zfar, number)
            return Camera(eye, view, flat.znear, flat.zfar, None, 2 * flat.ymag)
        raise SceneError(f"camera {number}: it does not say what it sees")

    def _lamp(self, placed: Placed) -> Lamp:
        named = placed.node.extensions.light
        assert named is not None
        lights = self._file.extensions.punctual.lights
        if named.light >= len(lights):
            raise SceneError(f"node {placed.number}: there is no light {named.light}")
        light = lights[named.light]
        # Lights count by what a white matt surface sends, which is the irradiance over pi.
        red, green, blue = (light.intensity * lane / math.pi for lane in light.color)
        if light.spot.inner_cone_angle >= light.spot.outer_cone_angle:
            self._notes.add(
                f"light {named.light}",
                ": its inner cone is not inside the outer one; its edge is hard",
            )
        outer = min(light.spot.outer_cone_angle, _RIGHT_ANGLE)
        return Lamp(
            light.name or placed.name,
            light.type,
            (red, green, blue),
            _vector(placed.to_world[:3, 3]),
            _vector(-_upright(placed)[:3, 2]),
            min(light.spot.inner_cone_angle, outer),
            outer,
            light.range if light.range is not None else np.inf,
        )


def _morphed(look: Look) -> Look:
    """The look of a mesh whose channels ``morph_…`` already lead to its shape."""
    return replace(look, parameters={**look.parameters, "morph": 1.0})


def _check_depths(near: float, far: float, number: int) -> None:
    if not near < far:
        raise SceneError(f"camera {number}: what is near is farther away than what is far")


def _upright(placed: Placed) -> Matrix:
    """The transform of a camera or a light, without the scale of the nodes above it."""
    to_world = placed.to_world.copy()
    lengths = np.linalg.norm(to_world[:3, :3], axis=0)
    if not lengths.all():
        raise SceneError(f"node {placed.number}: its axes have no direction")
    to_world[:3, :3] /= lengths
    if abs(np.linalg.det(to_world[:3, :3])) < 1e-6:
        raise SceneError(f"node {placed.number}: its axes lie in a plane")
    return to_world


def _vector(lanes: Matrix) -> Vector:
    x, y, z = lanes.tolist()
    return x, y, z
