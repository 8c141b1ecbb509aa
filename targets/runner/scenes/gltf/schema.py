"""The JSON of a glTF 2.0 file as typed records: the parts that a scene is made of.

msgspec checks all types and ranges while it reads a file (``container.py``), so that everything
else can rely on them. Members that are not listed here are left out. Names and meanings are those
of the specification, in snake case.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from msgspec import Meta, Raw, Struct, field

from .materials_schema import Material
from .record import (
    Distance,
    Index,
    Name,
    NotNegative,
    Numbers3,
    Numbers4,
    Positive,
    Record,
    Share,
    Size,
)


class Asset(Record, frozen=True):
    version: Name
    min_version: Name | None = None


class Buffer(Record, frozen=True):
    byte_length: Size
    uri: str | None = None


class BufferView(Record, frozen=True):
    buffer: Index
    byte_length: Size
    byte_offset: Index = 0
    byte_stride: Annotated[int, Meta(ge=4, le=252, multiple_of=4)] | None = None


IndexType = Literal[5121, 5123, 5125]
ComponentType = Literal[5120, 5121, 5122, 5123, 5125, 5126]
"""The numbers of OpenGL's types: bytes, shorts and integers without signs; and with float, all."""


class SparseIndices(Record, frozen=True):
    buffer_view: Index
    component_type: IndexType
    byte_offset: Index = 0


class SparseValues(Record, frozen=True):
    buffer_view: Index
    byte_offset: Index = 0


class Sparse(Record, frozen=True):
    count: Size
    indices: SparseIndices
    values: SparseValues


ElementType = Literal["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"]


class Accessor(Record, frozen=True):
    component_type: ComponentType
    count: Size
    type: ElementType
    buffer_view: Index | None = None
    byte_offset: Index = 0
    normalized: bool = False
    sparse: Sparse | None = None


class Image(Record, frozen=True):
    uri: str | None = None
    mime_type: Name | None = None
    buffer_view: Index | None = None


class Texture(Record, frozen=True):
    source: Index | None = None
    sampler: Index | None = None


class Sampler(Record, frozen=True):
    """A sampler in OpenGL's numbers. Textures here have the defaults: repeated, filtered."""

    mag_filter: Index = 9729
    wrap_s: Index = 10497
    wrap_t: Index = 10497


class VariantMapping(Record, frozen=True):
    """The material of a primitive in some variants of a file."""

    material: Index
    variants: tuple[Index, ...]


class Mappings(Record, frozen=True):
    mappings: tuple[VariantMapping, ...] = ()


class PrimitiveExtensions(Struct, frozen=True):
    variants: Mappings = field(default=Mappings(), name="KHR_materials_variants")


class Primitive(Record, frozen=True):
    attributes: dict[Name, Index]
    indices: Index | None = None
    material: Index | None = None
    mode: Annotated[int, Meta(ge=0, le=6)] = 4
    targets: tuple[dict[Name, Index], ...] = ()
    extensions: PrimitiveExtensions = PrimitiveExtensions()


class Mesh(Record, frozen=True):
    primitives: Annotated[tuple[Primitive, ...], Meta(min_length=1)]
    weights: tuple[float, ...] = ()


class Skin(Record, frozen=True):
    joints: Annotated[tuple[Index, ...], Meta(min_length=1)]
    inverse_bind_matrices: Index | None = None


class Perspective(Record, frozen=True):
    yfov: Annotated[float, Meta(ge=1e-6, lt=3.1415)]
    znear: Distance
    zfar: Distance | None = None


class Orthographic(Record, frozen=True):
    xmag: Distance
    ymag: Distance
    zfar: Distance
    znear: Annotated[float, Meta(ge=0, le=1e30)]


class Camera(Record, frozen=True):
    type: Literal["perspective", "orthographic"]
    name: Name = ""
    perspective: Perspective | None = None
    orthographic: Orthographic | None = None


class Cone(Record, frozen=True):
    inner_cone_angle: Annotated[float, Meta(ge=0, lt=1.5708)] = 0.0
    outer_cone_angle: Annotated[float, Meta(gt=0, le=1.5708)] = 0.7853981633974483


class Lamp(Record, frozen=True):
    type: Literal["directional", "point", "spot"]
    name: Name = ""
    color: tuple[Share, Share, Share] = (1.0, 1.0, 1.0)
    intensity: NotNegative = 1.0
    range: Positive | None = None
    spot: Cone = Cone()


class Lights(Record, frozen=True):
    lights: tuple[Lamp, ...]


class LightOfNode(Record, frozen=True):
    light: Index


class NodeExtensions(Struct, frozen=True):
    light: LightOfNode | None = field(default=None, name="KHR_lights_punctual")


class Extras(Record, frozen=True):
    tags: tuple[Name, ...] = ()
    """Words by which frames choose models; they are no part of glTF."""


class Node(Record, frozen=True):
    name: Name = ""
    children: tuple[Index, ...] = ()
    matrix: Annotated[tuple[float, ...], Meta(min_length=16, max_length=16)] | None = None
    translation: Numbers3 = (0.0, 0.0, 0.0)
    rotation: Numbers4 = (0.0, 0.0, 0.0, 1.0)
    scale: Numbers3 = (1.0, 1.0, 1.0)
    mesh: Index | None = None
    skin: Index | None = None
    camera: Index | None = None
    weights: tuple[float, ...] = ()
    extensions: NodeExtensions = NodeExtensions()
    extras: Extras | list[Any] | str | float | bool | None = None
    """Data of an application, in any form; only tags are read."""


class Scene(Record, frozen=True):
    nodes: tuple[Index, ...] = ()


class Variant(Record, frozen=True):
    name: Name


class Variants(Record, frozen=True):
    variants: tuple[Variant, ...] = ()


class FileExtensions(Struct, frozen=True):
    punctual: Lights = field(default=Lights(()), name="KHR_lights_punctual")
    variants: Variants = field(default=Variants(), name="KHR_materials_variants")


class File(Record, frozen=True):
    """A whole file."""

    asset: Asset
    scene: Index | None = None
    scenes: tuple[Scene, ...] = ()
    nodes: tuple[Node, ...] = ()
    meshes: tuple[Mesh, ...] = ()
    skins: tuple[Skin, ...] = ()
    cameras: tuple[Camera, ...] = ()
    materials: tuple[Material, ...] = ()
    textures: tuple[Texture, ...] = ()
    images: tuple[Image, ...] = ()
    samplers: tuple[Sampler, ...] = ()
    accessors: tuple[Accessor, ...] = ()
    buffer_views: tuple[BufferView, ...] = ()
    buffers: tuple[Buffer, ...] = ()
    animations: tuple[Raw, ...] = ()
    extensions: FileExtensions = FileExtensions()
    extensions_used: tuple[Name, ...] = ()
    extensions_required: tuple[Name, ...] = ()
