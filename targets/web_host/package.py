"""Makes the package of a frame: all that the host for web pages needs, as one JSON document.

``burnish view`` sends packages to its page, and routes of the browser draw with them.
``serving/packages.py`` declares it. It is complete, so the host needs no Python: the declarations
of the library have their values from the scene, and meshes are the buffers of draw calls.
"""

from __future__ import annotations

from base64 import b64encode
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ...compiler.budget import check
from ...compiler.documents.drawing import VertexInputRow
from ...compiler.documents.reflection import Reflection
from ...compiler.ir.stages import INSTANCES, VERTICES
from ...support.frozen import changed
from ..runner.frames.host import FrameHost
from ..runner.frames.scenery import WHOLE, Model
from ..runner.instances.declared import Declared
from ..runner.instances.host_values import HostValues
from ..runner.instances.instance import Instance
from ..runner.instances.shapes import stored_as
from ..runner.looks import PLAIN
from ..runner.mesh_buffers import mesh_rows
from ..runner.meshes import Mesh
from ..runner.scene import texture_roles, value_roles
from ..runner.scene_state import drawn_state
from ..runner.subject import Subject
from ..runner.textures.texture import Texture
from .serving.packages import (
    CameraRow,
    ElementsRow,
    GeometryRow,
    ModelRow,
    Package,
    PackagedShader,
    PictureRow,
    ShaderTextRow,
)
from .webgpu import WGSL, format_of, pipelines, webgpu_pipeline

VERSION: Literal[2] = 2
"""The version of the document; a host refuses others."""

_COPIES = 5
"""The bytes of memory that a byte of a picture or buffer takes until a package is sent: its base64
is a third longer, and is in the package, in the document, and in the document's bytes."""

_SQUARE = 1.0
"""The width of a picture divided by its height, for which a package has the camera."""

_CAMERA = {"world_to_clip": "view_projection", "eye": "eye"}
"""The host's names of the camera's values, by their roles in a scene."""


def frame_package(host: FrameHost, profiles: Iterable[str] = (WGSL,)) -> Package:
    """The package of a frame with the values and the scene that its host has now, and with the
    texts for some profiles.

    Raises ``BudgetError`` where its pictures, buffers and meshes take too much memory,
    ``MeshError`` where a mesh lacks what a shader reads, and ``MissingValuesError`` where the
    levels of patches depend on a value that nobody has set.
    """
    return _Package(host, frozenset(profiles)).document()


class _Package:
    def __init__(self, host: FrameHost, profiles: frozenset[str]) -> None:
        self._host = host
        self._profiles = profiles
        self._pictures: list[PictureRow] = []
        self._picture_of: dict[Texture, int] = {}
        self._geometries: list[GeometryRow] = []
        self._geometry_of: dict[tuple[int, int], int] = {}
        self._made: dict[GeometryRow, int] = {}
        """The numbers of geometries, by what they consist of."""
        self._draws = _draws_of_models(host)
        self._instances: list[Instance] = []
        self._bytes = 0
        """The size of all pictures, buffers and meshes so far."""

    def document(self) -> Package:
        host = self._host
        scene, values = host.scenery.scene, host.values
        camera = scene.values(_SQUARE)
        shaders = tuple(self._shader(*each) for each in enumerate(host.shaders))
        return Package(
            package=VERSION,
            plan=host.plan,
            shaders=shaders,
            pipelines=tuple(pipelines(host.plan, shaders)),
            formats=tuple(map(format_of, host.plan.textures)),
            size=host.size,
            camera=CameraRow(**{own: camera[name] for name, own in _CAMERA.items()}),
            models=tuple(map(self._model, host.scenery.models)),
            geometries=tuple(self._geometries),
            values=_values(values),
            roles=_roles(values.declared),
            given=tuple(sorted(host.given)),
            textures=self._textures(values),
            buffers=self._buffers(values),
            pictures=tuple(self._pictures),
        )

    # --- shaders ---------------------------------------------------------------------------------

    def _shader(self, number: int, shader: Subject) -> PackagedShader:
        instance = self._host.instances[number].copied()
        plain = replace(self._host.scenery.scene, look=PLAIN, bones=None)
        plain.apply(instance, _SQUARE, self._host.given)
        self._instances.append(instance)
        reflection, texts = instance.reflection, self._texts(shader)
        stages = texts.get(WGSL)
        return PackagedShader(
            reflection=without_source_maps(reflection),
            texts=texts,
            values=_values(instance),
            roles=_roles(reflection),
            lights=dict(self._lights(number, reflection)),
            textures=self._textures(instance),
            texture_roles=texture_roles(reflection),
            buffers=self._buffers(instance),
            levels=_levels(instance),
            webgpu=webgpu_pipeline(reflection, stages) if stages else None,
        )

    def _texts(self, shader: Subject) -> dict[str, dict[str, ShaderTextRow]]:
        found: dict[str, dict[str, ShaderTextRow]] = {}
        for file in shader.files:
            profile = f"{file.target}:{file.profile}"
            if profile in self._profiles:
                for stage, entry in file.entry_points.items():
                    text = ShaderTextRow(text=file.text, entry=entry)
                    found.setdefault(profile, {})[stage] = text
        return found

    def _lights(self, number: int, reflection: Reflection) -> Iterator[tuple[str, str]]:
        """The parameters of a shader's lights, each with the plan's that it is set to."""
        plan = self._host.plan
        lit = {
            use.shader: drawn.light
            for step in plan.steps
            for drawn in step.draws
            for use in drawn.uses
        }
        own = {row.entry: row for row in plan.lights}
        for row in reflection.lights:
            if (of_plan := own.get(row.entry)) is None:
                continue
            if row.capacity is not None:
                yield row.name, of_plan.name
                if row.count is not None and of_plan.count is not None:
                    yield row.count, of_plan.count
                continue
            is_one = of_plan.capacity is not None and lit.get(number) == row.entry
            source = f"{of_plan.name}[]" if is_one else of_plan.name
            for name in row.parameters:
                yield name, source + name.removeprefix(row.name)

    # --- the scene -------------------------------------------------------------------------------

    def _model(self, model: Model) -> ModelRow:
        scene = replace(
            self._host.scenery.scene,
            object_to_world=model.placement,
            look=model.look,
            bones=model.bones,
        )
        shaders = sorted(self._shaders_of(model))
        declared = [self._reflection(each) for each in shaders]
        roles = {role for each in declared for role in value_roles(each).values()}
        words = {
            word for each in shaders for word in texture_roles(self._reflection(each)).values()
        }
        return ModelRow(
            material=model.material,
            tags=("scene", *sorted(model.tags)),
            geometries={str(each): self._geometry(model.mesh, each) for each in shaders},
            values={
                role: value
                for role, value in scene.values(_SQUARE, declared).items()
                if role in roles and role not in _CAMERA
            },
            textures={
                word: self._picture(texture)
                for word, texture in model.look.textures.items()
                if word in words
            },
        )

    def _reflection(self, shader: int) -> Reflection:
        return self._host.instances[shader].reflection

    def _shaders_of(self, model: Model) -> set[int]:
        """The numbers of the shaders that draw a model."""
        return {
            shader
            for tag in (WHOLE, *model.tags)
            for shader in self._draws.get((tag, model.material), ())
        }

    def _geometry(self, mesh: Mesh, shader: int) -> int:
        """The number of a mesh's geometry for a shader; shaders with the same inputs share it."""
        key = id(mesh), shader
        if key not in self._geometry_of:
            made = _geometry(self._instances[shader].copied(), mesh)
            self._count(sum(map(len, (made.vertices, made.instances, made.indices or ""))))
            if made not in self._made:
                self._made[made] = len(self._geometries)
                self._geometries.append(made)
            self._geometry_of[key] = self._made[made]
        return self._geometry_of[key]

    # --- pictures --------------------------------------------------------------------------------

    def _textures(self, instance: HostValues) -> dict[str, int]:
        return {name: self._picture(each) for name, each in instance.textures().items()}

    def _picture(self, texture: Texture) -> int:
        if texture not in self._picture_of:
            self._count(sum(map(len, texture.levels)))
            self._picture_of[texture] = len(self._pictures)
            self._pictures.append(
                PictureRow(
                    format=texture.format,
                    dimension=texture.dimension,
                    width=texture.width,
                    height=texture.height,
                    depth=texture.depth,
                    levels=tuple(map(_base64, texture.levels)),
                )
            )
        return self._picture_of[texture]

    # --- buffers ---------------------------------------------------------------------------------

    def _buffers(self, instance: HostValues) -> dict[str, str]:
        buffers = instance.buffers()
        self._count(sum(len(contents.data) for contents in buffers.values()))
        return {name: _base64(contents.data) for name, contents in buffers.items()}

    def _count(self, size: int) -> None:
        """Count so many bytes more; raises ``BudgetError`` if these are too many."""
        self._bytes += size
        check("memory", _COPIES * self._bytes, f"a page that draws {self._host.plan.frame} needs")


def _draws_of_models(host: FrameHost) -> Mapping[tuple[str, str], set[int]]:
    """The shaders that draw models of a name and a material, by both."""
    found: dict[tuple[str, str], set[int]] = defaultdict(set)
    for step in host.plan.steps:
        for drawn in step.draws:
            for use in drawn.uses:
                if drawn.models is not None and use.material is not None:
                    found[drawn.models, use.material].add(use.shader)
    return found


def _geometry(instance: Instance, mesh: Mesh) -> GeometryRow:
    """The geometry of a draw call. The instance gets the buffer that has vertex inputs."""
    state = drawn_state(instance, mesh, (1, 1))
    rows = [row for row in instance.reflection.vertex_inputs if row.buffer is None]
    steps = {
        step: [(row, state.attributes[row.name]) for row in rows if row.step == step]
        for step in (VERTICES, INSTANCES)
    }
    corners = state.triangles.reshape(-1)
    is_in_order = np.array_equal(corners, np.arange(len(corners)))
    buffers = instance.buffers()
    return GeometryRow(
        vertices=_interleaved(steps[VERTICES]),
        instances=_interleaved(steps[INSTANCES]),
        indices=None if is_in_order else _base64(corners.astype("<u4").tobytes()),
        count=len(corners),
        instance_count=state.instance_count,
        elements=tuple(
            ElementsRow(name=name, data=_base64(buffers[name].data))
            for name in dict.fromkeys(place.name for _, place in mesh_rows(instance.reflection))
        ),
    )


def _interleaved(inputs: list[tuple[VertexInputRow, NDArray[Any]]]) -> str:
    """All inputs of one vertex or instance after the other. WebGPU guarantees 16 of them, but only
    8 buffers."""
    words = [
        np.ascontiguousarray(values).astype(stored_as(row.representation)).view("<u4")
        for row, values in inputs
    ]
    return _base64(np.hstack(words).tobytes()) if words else ""


def _levels(instance: Instance) -> tuple[float, ...] | None:
    """The levels into which the host divides patches, if it does, with the instance's values."""
    if instance.reflection.levels is None:
        return None
    edges, inside = instance.patch_levels()
    return *edges, *inside


def _roles(declared: Declared) -> dict[str, str]:
    """The value of the scene that each parameter has, by the parameter's name."""
    found = value_roles(declared).items()
    return {name: _CAMERA.get(role, role) for name, role in found}


def _values(instance: HostValues) -> dict[str, Any]:
    """All values that somebody has set; of lists and structures also parts without a value."""
    counters = {row.count for row in instance.declared.buffers}
    names = (row.name for row in instance.declared.parameters)
    found = {name: instance.get(name) for name in names if name not in counters}
    return {name: value for name, value in found.items() if value is not None}


def without_source_maps(reflection: Reflection) -> Reflection:
    """A reflection without its source maps: they are long, and no host draws with them."""
    backends = {
        profile: changed(row, source_maps={}) for profile, row in reflection.backends.items()
    }
    return changed(reflection, backends=backends)


def _base64(data: bytes) -> str:
    return b64encode(data).decode("ascii")
