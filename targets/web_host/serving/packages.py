"""The package of a frame: all that a page draws of it, as one document."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from ....compiler.constraints import Count, Nested, Positive, TypeScript
from ....compiler.documents.plan import FramePlan
from ....compiler.documents.reflection import Reflection
from ....compiler.ir.types import DIMENSION_WORDS, Dimension
from ....support.frozen import frozen

Value = Annotated[
    Any,
    Nested(
        "Value",
        "A value that a host sets: a number, a list of lanes, columns or elements, or members by "
        "name; null if nobody has set it.",
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
    """The texts by profile, such as ``wgsl:webgpu``, and stage."""
    values: Mapping[str, Value]
    """The values of the shader's parameters, by name."""
    roles: Mapping[str, str]
    """The roles of the parameters that the scene sets, by the parameter's name."""
    lights: Mapping[str, str]
    """The plan's parameters from which the shader's parameters of lights get their values, by the
    shader's name. ``[]`` stands behind an array of which one light is meant."""
    textures: Mapping[str, Count]
    """The numbers of the pictures of the shader's textures, by name."""
    texture_roles: Mapping[str, str]
    """The roles of the textures that models set, by the texture's name."""
    buffers: Mapping[str, str]
    """The elements of the shader's storage buffers in base64, by name."""
    levels: tuple[float, ...] | None
    """Where the host divides patches: the levels of the edges and the inside for which the
    geometries were made."""
    webgpu: WebGPUPipeline | None
    """The pipeline in the words of WebGPU; null without texts for it."""


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
    """The bindings of each group; a group that is not used is empty."""
    buffers: tuple[Annotated[Native, TypeScript("GPUVertexBufferLayout")], ...]
    """The vertex buffers."""
    targets: tuple[Annotated[Native, TypeScript("GPUColorTargetState")], ...]
    """The format, blending and write mask of each target."""
    primitive: Annotated[Native, TypeScript("GPUPrimitiveState")]
    """The drawing of primitives."""
    depth_stencil: Annotated[Native, TypeScript('Omit<GPUDepthStencilState, "format">')]
    """The tests of depths and stencil values, but for the format."""


@frozen(kw_only=True)
class SlotRow:
    """A binding of a group: a resource that a shader reads or writes."""

    kind: Literal["block", "buffer", "storage_texture", "texture", "sampler"]
    """The kind of the resource."""
    name: str
    """The name in the reflection; for a sampler, the name of its texture."""
    number: Count
    """The number among the shader's resources of this kind."""
    layout: Annotated[Native, TypeScript("GPUBindGroupLayoutEntry")]
    """The entry of the bind group layout, with the number of the binding."""
    sampler: Annotated[Native, TypeScript("GPUSamplerDescriptor")] | None = None
    """The state of a sampler."""


@frozen(kw_only=True)
class ShaderTextRow:
    """The text of a stage."""

    text: str
    """The text."""
    entry: str
    """The name of the entry point."""


@frozen(kw_only=True)
class CameraRow:
    """The camera of the scene, whose fields are named by their roles."""

    view_projection: tuple[tuple[float, ...], ...]
    """World space to the clip space of a square picture: four columns. For a picture that is ``a``
    times as wide as high, the host divides the first row by ``a``."""
    eye: tuple[float, ...]
    """The position of the camera in world space."""


@frozen(kw_only=True)
class ModelRow:
    """A model of the scene."""

    material: str
    """The name of the material."""
    tags: tuple[str, ...]
    """The names by which steps draw it."""
    geometries: Mapping[str, Count]
    """The numbers of the geometries that shaders draw of the model, by the shader's number."""
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
    """The elements in base64."""


@frozen(kw_only=True)
class GeometryRow:
    """The vertices, instances and indices of a draw call. Numbers have 32 bits, and are
    little-endian and in base64. A vertex, or an instance, has the vertex inputs of the reflection
    that step with it, one behind the other, but for those that are in a buffer."""

    vertices: str
    """The inputs of all vertices; empty if there are none."""
    instances: str
    """The inputs of all instances; empty if there are none."""
    indices: str | None
    """The numbers of the vertices that are drawn; null where they are drawn one after the other."""
    count: Count
    """The number of vertices of each instance."""
    instance_count: Count
    """The number of instances."""
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
    """The geometries of the draw calls, by number."""
    values: Mapping[str, Value]
    """The values of the plan's parameters, by name."""
    roles: Mapping[str, str]
    """The roles of the plan's parameters that the scene sets, by the parameter's name."""
    given: tuple[str, ...]
    """The names that somebody has set, which the scene leaves alone."""
    textures: Mapping[str, Count]
    """The pictures that the plan's host textures are, by name."""
    buffers: Mapping[str, str]
    """The elements of the plan's host buffers in base64, by name."""
    pictures: tuple[PictureRow, ...]
    """The pictures, by number."""
