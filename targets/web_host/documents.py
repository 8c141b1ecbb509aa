"""The package of a frame: all that a page draws of it, as one document."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from ...compiler.constraints import Count, Nested, Positive, TypeScript
from ...compiler.documents.plan import FramePlan
from ...compiler.documents.reflection import Reflection
from ...compiler.ir.types import DIMENSION_WORDS, Dimension
from ...frozen import frozen

Value = Annotated[
    Any,
    Nested(
        "Value",
        "What a host sets: a number, a list of lanes, columns or elements, or members by name; "
        "null for what nobody has set.",
        objects=True,
    ),
]
"""A value that a host sets."""
TextureFormat = Annotated[str, TypeScript("GPUTextureFormat")]
"""A format, as WebGPU calls it."""
Native = Mapping[str, Any]
"""An object in the browser's own words."""


@frozen(kw_only=True)
class PackagedShader:
    """A shader with its texts, and what its materials set."""

    reflection: Reflection
    texts: Mapping[str, Mapping[str, ShaderTextRow]]
    """By profile, such as ``wgsl:webgpu``, and stage."""
    values: Mapping[str, Value]
    """The values of its parameters, by name."""
    roles: Mapping[str, str]
    """What each parameter is of the scene, by name, if it is something of it."""
    lights: Mapping[str, str]
    """What its parameters of lights are of the plan's, by name. Behind an array of which one light
    is meant stands ``[]``."""
    textures: Mapping[str, Count]
    """The pictures that its textures are, by name."""
    texture_roles: Mapping[str, str]
    """What each texture is of the look of a model, by name, if it is something of it."""
    buffers: Mapping[str, str]
    """The elements of its storage buffers in base64, by name."""
    levels: tuple[float, ...] | None
    """Where the host divides patches: the levels of the edges and the inside for which the
    geometries were made."""
    webgpu: WebGPUPipeline | None
    """Its pipeline in the words of WebGPU; null without texts for it."""


@frozen(kw_only=True)
class PipelineRow:
    """A pipeline of a shader: the formats of what it draws to."""

    shader: Count
    """The number of the shader."""
    targets: tuple[TextureFormat, ...]
    """The formats of the targets; none of a kernel that is computed."""
    depth: TextureFormat | None
    """The format of the depths; null where there are none."""


@frozen(kw_only=True)
class WebGPUPipeline:
    """A pipeline in the words of WebGPU, but for its texts."""

    KEYS: ClassVar = {"depth_stencil": "depthStencil"}

    groups: tuple[tuple[SlotRow, ...], ...]
    """What is bound, group by group; a group that is not used is empty."""
    buffers: tuple[Annotated[Native, TypeScript("GPUVertexBufferLayout")], ...]
    """The vertex buffers."""
    targets: tuple[Annotated[Native, TypeScript("GPUColorTargetState")], ...]
    """What each target is drawn with."""
    primitive: Annotated[Native, TypeScript("GPUPrimitiveState")]
    """How primitives are drawn."""
    depth_stencil: Annotated[Native, TypeScript('Omit<GPUDepthStencilState, "format">')]
    """The tests of depths and stencil values, but for the format."""


@frozen(kw_only=True)
class SlotRow:
    """What a shader reads or writes at one place of a group."""

    kind: Literal["block", "buffer", "storage_texture", "texture", "sampler"]
    """What it is."""
    name: str
    """The reflection's name for it; of a sampler, that of its texture."""
    number: Count
    """Its number among those of its kind."""
    layout: Annotated[Native, TypeScript("GPUBindGroupLayoutEntry")]
    """Its place."""
    sampler: Annotated[Native, TypeScript("GPUSamplerDescriptor")] | None = None
    """The state of a sampler."""


@frozen(kw_only=True)
class ShaderTextRow:
    """The text of a stage."""

    text: str
    """The text."""
    entry: str
    """Its entry point."""


@frozen(kw_only=True)
class CameraRow:
    """What looks at the scene. Both are values of the scene, by their roles."""

    view_projection: tuple[tuple[float, ...], ...]
    """World space to the clip space of a square picture: four columns. For a picture that is ``a``
    times as wide as high, the host divides the first row by ``a``."""
    eye: tuple[float, ...]
    """Where it stands."""


@frozen(kw_only=True)
class ModelRow:
    """A model of the scene."""

    material: str
    """Its material."""
    tags: tuple[str, ...]
    """The names by which steps draw it."""
    geometries: Mapping[str, Count]
    """What each shader that draws it gets of its mesh, by the shader's number."""
    values: Mapping[str, Value]
    """Values by role: ``object_to_world``, bones, colours."""
    textures: Mapping[str, Count]
    """Pictures by role."""


@frozen(kw_only=True)
class ElementsRow:
    """The elements of a storage buffer."""

    name: str
    """The buffer."""
    data: str
    """Its elements, in base64."""


@frozen(kw_only=True)
class GeometryRow:
    """What a draw call gets of a mesh. Numbers have 32 bits, and are little-endian and in base64. A
    vertex, or an instance, has the vertex inputs of the reflection that step with it, one behind
    the other, but for those that are in a buffer."""

    vertices: str
    """The inputs of all vertices; empty if there are none."""
    instances: str
    """The inputs of all instances; empty if there are none."""
    indices: str | None
    """The numbers of the vertices that are drawn; null where they are drawn one after the other."""
    count: Count
    """How many vertices are drawn of each instance."""
    instance_count: Count
    """How many instances there are."""
    elements: tuple[ElementsRow, ...]
    """The elements of storage buffers that stand for vertex inputs."""


@frozen(kw_only=True)
class PictureRow:
    """Texels with all mip levels."""

    WORDS: ClassVar = {"dimension": DIMENSION_WORDS}

    format: TextureFormat
    """The format, as WebGPU calls it."""
    dimension: Dimension
    """The dimension."""
    width: Positive
    """The width."""
    height: Positive
    """The height."""
    depth: Positive
    """Layers, faces, or slices of the first level."""
    levels: tuple[str, ...]
    """Each level in base64, layer by layer and row by row from the top."""


@frozen(kw_only=True)
class Package:
    """A frame with everything that a page draws of it."""

    VERSION: ClassVar = "package"

    package: Literal[2]
    """Version of this document's format. A host refuses versions that it does not know."""
    plan: FramePlan
    shaders: tuple[PackagedShader, ...]
    """The shaders, by the numbers of the plan."""
    pipelines: tuple[PipelineRow, ...]
    """The pipelines of WebGPU that steps use; empty without texts for it."""
    formats: tuple[TextureFormat, ...]
    """The formats of the plan's textures, as WebGPU calls them. All APIs can draw to these; lanes
    of ten bits have eight, which are clamped and blended in the same way."""
    size: tuple[int, int]
    """Width and height, until somebody resizes the frame."""
    camera: CameraRow
    models: tuple[ModelRow, ...]
    """The models of the scene."""
    geometries: tuple[GeometryRow, ...]
    """What draw calls get of meshes, by number."""
    values: Mapping[str, Value]
    """The values of the plan's parameters, by name."""
    roles: Mapping[str, str]
    """What each of the plan's parameters is of the scene, by name, if it is something of it."""
    given: tuple[str, ...]
    """The names that somebody has set, which the scene leaves alone."""
    textures: Mapping[str, Count]
    """The pictures that the plan's host textures are, by name."""
    buffers: Mapping[str, str]
    """The elements of the plan's host buffers in base64, by name."""
    pictures: tuple[PictureRow, ...]
    """The pictures, by number."""
