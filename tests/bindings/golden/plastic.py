"""Plastic: what a host sets, computes and binds.

Made by `burnish bind`; do not edit. A block is a class: its attributes write to its bytes, and
`bytes(block)` is what a host uploads. `derive_…` compute the blocks of derived values.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar, Generic, NamedTuple, TypeVar, overload

T = TypeVar("T")
Lanes = Sequence[float]
"""A vector: a tuple, a list, or any sequence of numbers, such as those of NumPy and mathutils."""
Columns = Sequence[Sequence[float]]
"""A matrix by its columns: for NumPy's and mathutils' `m[row][column]`, give the transposed one."""


class Kind(Generic[T]):
    """How a value lies in memory."""

    size: int

    def read(self, memory: memoryview, at: int) -> T:
        """The value at an offset."""
        raise NotImplementedError

    def write(self, memory: memoryview, at: int, value: T, name: str) -> T:
        """Store a value, and return what is stored. Raises `ValueError`."""
        raise NotImplementedError

    def reset(self, memory: memoryview, at: int) -> None:
        """Store what is there before a host sets a value."""
        memory[at : at + self.size] = bytes(self.size)


class Numbers(Kind[T]):
    """Numbers of 32 bits: one, the lanes of a vector, or those of a matrix column by column."""

    def __init__(self, code: str, lanes: int, columns: int = 0, stored: int = 0) -> None:
        """`code` is that of `struct`, or `?` for truths; `stored` lanes are those of a column."""
        self._code, self._lanes, self._columns = code, lanes, columns
        self._struct = struct.Struct(f"<{lanes}{'I' if code == '?' else code}")
        self._stride = 4 * (stored or lanes)
        self.size = self._stride * (columns or 1)

    def read(self, memory: memoryview, at: int) -> T:
        if self._columns:
            found: Any = tuple(self._column(memory, each) for each in self._offsets(at))
        else:
            found = self._column(memory, at)
        value: T = found if self._columns or self._lanes > 1 else found[0]
        return value

    def write(self, memory: memoryview, at: int, value: T, name: str) -> T:
        given: Any = value if self._columns or self._lanes > 1 else (value,)
        try:
            columns = [tuple(each) for each in given] if self._columns else [tuple(given)]
            packed = [self._packed(each) for each in columns]
        except (struct.error, TypeError) as error:
            raise ValueError(f"`{name}` takes {self}: {value!r} is not") from error
        if len(packed) != (self._columns or 1):
            raise ValueError(f"`{name}` takes {self}: {value!r} is not")
        for offset, column in zip(self._offsets(at), packed):
            memory[offset : offset + len(column)] = column
        return self.read(memory, at)

    def __str__(self) -> str:
        numbers = {"f": "numbers", "?": "truths"}.get(self._code, "whole numbers")
        if self._columns:
            return f"{self._columns} columns of {self._lanes} {numbers}"
        return f"{self._lanes} {numbers}" if self._lanes > 1 else f"a {numbers[:-1]}"

    def _offsets(self, at: int) -> range:
        return range(at, at + self.size, self._stride)

    def _column(self, memory: memoryview, at: int) -> tuple[Any, ...]:
        found = self._struct.unpack_from(memory, at)
        return tuple(map(bool, found)) if self._code == "?" else found

    def _packed(self, lanes: tuple[Any, ...]) -> bytes:
        try:
            return self._struct.pack(*lanes)
        except OverflowError:  # No float32 is that large.
            return self._struct.pack(*(_clipped(lane) for lane in lanes))


def _clipped(lane: float) -> float:
    """The number, or infinity where no float32 is that large."""
    return math.copysign(math.inf, lane) if abs(lane) > 3.4028235677973366e38 else lane


def _single(number: float) -> float:
    """The nearest float32, which is what a block holds."""
    found: float = struct.unpack("<f", struct.pack("<f", number))[0]
    return found


f32: Kind[float] = Numbers("f", 1)
i32: Kind[int] = Numbers("i", 1)
vec3: Kind[Lanes] = Numbers("f", 3)
mat3: Kind[Columns] = Numbers("f", 3, 3, 4)
mat4: Kind[Columns] = Numbers("f", 4, 4, 4)


class Block:
    """The bytes of a block, or of a structure in one."""

    SIZE: ClassVar[int]
    LAYOUT_ID: ClassVar[str] = ""
    """A digest of the layout: a text whose reflection has another one needs another binding."""

    memory: memoryview

    def __init__(self, **values: Any) -> None:
        """Fields that are not named have their defaults, or zeros if they have none."""
        self.memory = memoryview(bytearray(self.SIZE))
        self.reset()
        for name, value in values.items():
            if not isinstance(getattr(type(self), name, None), (Field, Array)):
                raise AttributeError(f"{type(self).__name__} has no field `{name}`")
            setattr(self, name, value)

    def reset(self) -> None:
        """Set all fields to their defaults."""
        for field in vars(type(self)).values():
            if isinstance(field, (Field, Array)):
                field.reset(self)

    def __bytes__(self) -> bytes:
        return bytes(self.memory)


class Field(Generic[T]):
    """A field of a block."""

    def __init__(
        self,
        offset: int,
        kind: Kind[T],
        default: T | None = None,
        low: float = -math.inf,
        high: float = math.inf,
        *,
        unit: bool = False,
        computed: bool = False,
    ) -> None:
        """`low` and `high` are what a lane may be, and a `unit` vector has length 1."""
        self._offset, self._kind, self._default = offset, kind, default
        self._low, self._high = _single(low), _single(high)
        self._unit, self._computed = unit, computed

    def __set_name__(self, owner: type[Block], name: str) -> None:
        self._name = name

    @overload
    def __get__(self, block: None, owner: type[Block]) -> Field[T]: ...
    @overload
    def __get__(self, block: Block, owner: type[Block]) -> T: ...
    def __get__(self, block: Block | None, owner: type[Block]) -> Field[T] | T:
        return self if block is None else self._kind.read(block.memory, self._offset)

    def __set__(self, block: Block, value: T) -> None:
        new = memoryview(bytearray(self._kind.size))
        stored: Any = self._kind.write(new, 0, value, self._name)
        if not self._computed and isinstance(stored, (float, int, tuple)):
            self._check(stored if isinstance(stored, tuple) else (stored,), value)
        block.memory[self._offset : self._offset + self._kind.size] = new

    def reset(self, block: Block) -> None:
        """Set the field to its default."""
        self._kind.reset(block.memory, self._offset)
        if self._default is not None:
            self._kind.write(block.memory, self._offset, self._default, self._name)

    def _check(self, lanes: tuple[Any, ...], value: T) -> None:
        """Raise `ValueError` if a lane is out of its range."""
        for lane in lanes:
            if isinstance(lane, tuple):
                self._check(lane, value)
            elif not math.isfinite(lane):
                raise ValueError(f"`{self._name}` takes finite numbers: {value!r} is not")
            elif not self._low <= lane <= self._high:
                declared = f"{self._low:g}..{self._high:g}"
                raise ValueError(f"`{self._name}` is declared in {declared}: {value!r} is not")
        if self._unit and abs(math.hypot(*lanes) - 1.0) > 1e-3:
            length = f"{math.hypot(*lanes):.6g}"
            raise ValueError(f"`{self._name}` has to be of length 1, not {length}")


BlockType = TypeVar("BlockType", bound=Block)


class Part(Kind[BlockType]):
    """A structure in a block."""

    def __init__(self, kind: type[BlockType]) -> None:
        self._kind, self.size = kind, kind.SIZE

    def read(self, memory: memoryview, at: int) -> BlockType:
        """The structure at an offset, whose attributes write to this memory."""
        found = self._kind.__new__(self._kind)
        found.memory = memory[at : at + self.size]
        return found

    def write(self, memory: memoryview, at: int, value: BlockType, name: str) -> BlockType:
        if not isinstance(value, self._kind):
            raise ValueError(f"`{name}` takes a {self._kind.__name__}: {value!r} is not")
        memory[at : at + self.size] = value.memory
        return value

    def reset(self, memory: memoryview, at: int) -> None:
        self.read(memory, at).reset()


class Elements(Sequence[T]):
    """The elements of an array, in the block's own memory."""

    def __init__(
        self, block: Block, offset: int, element: Field[T], count: int, stride: int
    ) -> None:
        self._block, self._offset, self._element = block, offset, element
        self._count, self._stride = count, stride

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, number: int) -> T: ...
    @overload
    def __getitem__(self, number: slice) -> Sequence[T]: ...
    def __getitem__(self, number: int | slice) -> T | Sequence[T]:
        if isinstance(number, slice):
            return [self[each] for each in range(*number.indices(self._count))]
        return self._element.__get__(self._part(number), Block)

    def __setitem__(self, number: int, value: T) -> None:
        self._element.__set__(self._part(number), value)

    def reset(self) -> None:
        """Set all elements to their defaults."""
        for number in range(self._count):
            self._element.reset(self._part(number))

    def _part(self, number: int) -> Block:
        at = self._offset + self._stride * range(self._count)[number]
        part = Block.__new__(Block)
        part.memory = self._block.memory[at : at + self._stride]
        return part


class Array(Generic[T]):
    """A field with several elements; one that is counted takes fewer, and sets their number."""

    def __init__(
        self,
        offset: int,
        element: Field[T],
        capacity: int,
        stride: int,
        default: Sequence[T] | None = None,
        counter: str = "",
    ) -> None:
        self._offset, self._element, self._stride = offset, element, stride
        self.capacity, self._default, self._counter = capacity, default, counter

    def __set_name__(self, owner: type[Block], name: str) -> None:
        self._name = name
        self._element.__set_name__(owner, f"{name}[…]")

    @overload
    def __get__(self, block: None, owner: type[Block]) -> Array[T]: ...
    @overload
    def __get__(self, block: Block, owner: type[Block]) -> Elements[T]: ...
    def __get__(self, block: Block | None, owner: type[Block]) -> Array[T] | Elements[T]:
        return self if block is None else self._elements(block)

    def __set__(self, block: Block, values: Sequence[T]) -> None:
        elements = self._elements(block)
        count, most = len(values), self.capacity
        if self._counter and count > most:
            raise ValueError(f"`{self._name}` takes at most {most} elements, not {count}")
        if not self._counter and count != most:
            raise ValueError(f"`{self._name}` takes {most} elements, not {count}")
        for number, value in enumerate(values):
            elements[number] = value
        if self._counter:
            setattr(block, self._counter, len(values))

    def reset(self, block: Block) -> None:
        """Set all elements to their defaults."""
        elements = self._elements(block)
        elements.reset()
        for number, value in enumerate(self._default or ()):
            elements[number] = value

    def _elements(self, block: Block) -> Elements[T]:
        return Elements(block, self._offset, self._element, self.capacity, self._stride)


class Point(Block):
    """An element of an array, or a part of a block."""

    SIZE = 48
    diffuse_color = Field(0, vec3, (1.0, 1.0, 1.0))
    """Linear."""
    specular_color = Field(16, vec3, (1.0, 1.0, 1.0))
    """Linear."""
    place = Field(32, vec3)
    """On no surface that is drawn; no default: has to be set."""


class View(Block):
    """Group 0, binding 0; per view."""

    SIZE = 80
    LAYOUT_ID = "978849b2805233be"
    view_projection = Field(
        0,
        mat4,
        ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0)),
    )
    """World to clip space."""
    eye = Field(64, vec3, (0.0, 0.0, 5.0))
    """Where the viewer stands."""


class Rig(Block):
    """Group 1, binding 0; per rig."""

    SIZE = 544
    LAYOUT_ID = "3d0f658f93ac902c"
    ambient_light = Field(0, vec3, (0.1, 0.1, 0.1))
    """Light from everywhere; linear."""
    sun_diffuse_color = Field(16, vec3, (1.0, 1.0, 1.0))
    """Linear."""
    sun_specular_color = Field(32, vec3, (1.0, 1.0, 1.0))
    """Linear."""
    sun_direction = Field(48, vec3, (0.0, -1.0, 0.0), unit=True)
    """Where the light travels; length 1."""
    lamps = Array(64, Field(0, Part(Point)), 8, 48, counter="lamps_count")
    lamps_count = Field(448, i32, 0, low=0, high=8)
    """The number of `lamps` that shine; 0 to 8."""
    torch_diffuse_color = Field(464, vec3, (1.0, 1.0, 1.0))
    """Linear."""
    torch_specular_color = Field(480, vec3, (1.0, 1.0, 1.0))
    """Linear."""
    torch_place = Field(496, vec3)
    """On no surface that is drawn; no default: has to be set."""
    torch_axis = Field(512, vec3, (0.0, -1.0, 0.0), unit=True)
    """Where the light travels; length 1."""
    torch_inner = Field(524, f32, 0.34906584, low=0.0, high=1.5707964)
    """0 to 1.5708; radians."""
    torch_outer = Field(528, f32, 0.5235988, low=0.0, high=1.5707964)
    """0 to 1.5708; radians."""


class PlasticMaterial(Block):
    """Group 2, binding 0; per material."""

    SIZE = 32
    LAYOUT_ID = "bf52c16bcfd2db34"
    base = Field(0, vec3, (0.462077, 0.13013647, 0.012286488))
    """Base colour; linear."""
    shine = Field(16, vec3, (1.0, 1.0, 1.0))
    """Highlight colour; linear."""
    power = Field(28, f32, 48.0, low=1.0, high=512.0)
    """Specular exponent; 1 to 512."""


class Draw(Block):
    """Group 3, binding 0; per draw."""

    SIZE = 64
    LAYOUT_ID = "537a3c06595dcb26"
    object_to_world = Field(
        0,
        mat4,
        ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0)),
    )


class RigDerived(Block):
    """Group 1, binding 1; per rig; computed from `Rig`."""

    SIZE = 16
    LAYOUT_ID = "97c5e91246cd9c65"
    torch_falloff_cos = Field(0, f32, computed=True)
    torch_falloff_inverse_width = Field(4, f32, computed=True)


class DrawDerived(Block):
    """Group 3, binding 1; per draw; computed from `Draw`."""

    SIZE = 48
    LAYOUT_ID = "e41d484946444194"
    normal_matrix = Field(0, mat3, computed=True)


def _total(function: Callable[[float], float], x: float) -> float:
    """A function of `math`: infinity where it is too large, and no number of infinity."""
    try:
        return function(x)
    except OverflowError:
        return math.inf
    except ValueError:
        return math.nan


def quotient(x: float, y: float) -> float:
    return 0.0 if abs(y) < 2.0**-126 else x / y


def derive_rig(rig: Rig) -> RigDerived:
    """The values that a host computes of `Rig`, in double precision."""
    derived = RigDerived()
    torch_outer = rig.torch_outer
    torch_falloff_cos = _total(math.cos, torch_outer)
    derived.torch_falloff_cos = torch_falloff_cos
    difference = _total(math.cos, min(rig.torch_inner, torch_outer)) - torch_falloff_cos
    derived.torch_falloff_inverse_width = (
        quotient(1.0, difference)
        if abs(difference) >= 2.0**-64
        else 2.0**64
    )
    return derived


def derive_draw(draw: Draw) -> DrawDerived:
    """The values that a host computes of `Draw`, in double precision."""
    derived = DrawDerived()
    object_to_world_0_x = draw.object_to_world[0][0]
    object_to_world_0_y = draw.object_to_world[0][1]
    object_to_world_0_z = draw.object_to_world[0][2]
    object_to_world_1_x = draw.object_to_world[1][0]
    object_to_world_1_y = draw.object_to_world[1][1]
    object_to_world_1_z = draw.object_to_world[1][2]
    object_to_world_2_x = draw.object_to_world[2][0]
    object_to_world_2_y = draw.object_to_world[2][1]
    object_to_world_2_z = draw.object_to_world[2][2]
    product = object_to_world_1_y * object_to_world_2_z
    product_2 = object_to_world_1_x * object_to_world_2_z
    product_3 = object_to_world_1_x * object_to_world_2_y
    determinant = (
        object_to_world_0_x * (product + object_to_world_1_z * -object_to_world_2_y)
        + object_to_world_0_y * -(product_2 + object_to_world_1_z * -object_to_world_2_x)
        + object_to_world_0_z * (product_3 + object_to_world_1_y * -object_to_world_2_x)
    )
    choice = quotient(1.0, determinant) if abs(determinant) >= 2.0**-126 else 0.0
    derived.normal_matrix = (
        (
            (product - object_to_world_1_z * object_to_world_2_y) * choice,
            (object_to_world_1_z * object_to_world_2_x - product_2) * choice,
            (product_3 - object_to_world_1_y * object_to_world_2_x) * choice,
        ),
        (
            (
                object_to_world_2_y * object_to_world_0_z - object_to_world_2_z * object_to_world_0_y
            ) * choice,
            (
                object_to_world_2_z * object_to_world_0_x - object_to_world_2_x * object_to_world_0_z
            ) * choice,
            (
                object_to_world_2_x * object_to_world_0_y - object_to_world_2_y * object_to_world_0_x
            ) * choice,
        ),
        (
            (
                object_to_world_0_y * object_to_world_1_z - object_to_world_0_z * object_to_world_1_y
            ) * choice,
            (
                object_to_world_0_z * object_to_world_1_x - object_to_world_0_x * object_to_world_1_z
            ) * choice,
            (
                object_to_world_0_x * object_to_world_1_y - object_to_world_0_y * object_to_world_1_x
            ) * choice,
        ),
    )
    return derived


class VertexInput(NamedTuple):
    """A vertex input; `step` is `vertex` or `instance`."""

    name: str
    location: int | None
    format: str | None
    step: str
    stride: int


class Texture(NamedTuple):
    """A texture, and the state of its sampler in WebGPU's words; `None` if none reads it."""

    name: str
    dimension: str
    sample_type: str
    intent: str
    """`color`: pictures encoded as sRGB are bound in a format that decodes them."""
    default: tuple[float, ...]
    """The texel to bind before there is a picture."""
    sampler_type: str | None
    sampler: Mapping[str, Any] | None


class Bound(NamedTuple):
    """Something that is bound: where, under which name in the text, and what stages read it."""

    name: str
    kind: str
    group: int | None
    binding: int | None
    identifier: str
    stages: tuple[str, ...]
    block: type[Block] | None = None


class Text(NamedTuple):
    """The text of a stage: a file, or the text itself if it is embedded."""

    stage: str
    file: str
    entry_point: str
    text: str | None = None


class Profile(NamedTuple):
    """What one profile's texts ask of a host."""

    bound: tuple[Bound, ...]
    texts: tuple[Text, ...]
    front_face: str
    clip_depth: str


class Material(NamedTuple):
    """What a host needs besides the blocks."""

    name: str
    layout_ids: Mapping[str, str]
    vertex_inputs: tuple[VertexInput, ...]
    textures: tuple[Texture, ...]
    targets: tuple[Mapping[str, Any], ...]
    topology: str
    render_state: Mapping[str, Any]
    profiles: Mapping[str, Profile]

    def check(self, reflection: Mapping[str, Any]) -> None:
        """Raise `ValueError` if the binding is stale: a reflection says where values lie now."""
        stale = f"the binding of {self.name} is stale"
        now = {row["name"]: row["layout_id"] for row in reflection["blocks"]}
        for name, layout_id in self.layout_ids.items():
            if now.pop(name, None) != layout_id:
                raise ValueError(f"{stale}: `{name}` has another layout; run `burnish bind` again")
        if now:
            raise ValueError(f"{stale}: it lacks `{next(iter(now))}`; run `burnish bind` again")


PLASTIC = Material(
    name="Plastic",
    layout_ids={
        "View": "978849b2805233be",
        "Rig": "3d0f658f93ac902c",
        "RigDerived": "97c5e91246cd9c65",
        "Material": "bf52c16bcfd2db34",
        "Draw": "537a3c06595dcb26",
        "DrawDerived": "e41d484946444194",
    },
    vertex_inputs=(
        VertexInput("vertex_position", 0, "float32x3", "vertex", 12),
        VertexInput("vertex_normal", 1, "float32x3", "vertex", 12),
        VertexInput("vertex_uv", 2, "float32x2", "vertex", 8),
    ),
    textures=(
        Texture(
            "albedo",
            "2d",
            "float",
            "color",
            (1.0, 1.0, 1.0, 1.0),
            "filtering",
            {
                "mag_filter": "linear",
                "min_filter": "linear",
                "mipmap_filter": "linear",
                "address_mode_u": "repeat",
                "address_mode_v": "repeat",
                "address_mode_w": "repeat",
            },
        ),
    ),
    targets=(
        {
            "name": "color",
            "representation": "vec4",
            "location": 0,
            "format": "rgba8unorm-srgb",
            "encoding": "srgb",
            "blend": None,
            "mask": "rgba",
            "clear": None,
            "doc": "",
        },
    ),
    topology="triangle-list",
    render_state={
        "cull": "none",
        "front": "ccw",
        "fill": "faces",
        "samples": 1,
        "alpha_to_coverage": False,
        "depth": {
            "compare": "less",
            "write": True,
            "clear": 1.0,
            "bias": 0,
            "slope_bias": 0.0,
            "bias_clamp": 0.0,
        },
        "stencil": None,
    },
    profiles={
        "glsl:vulkan": Profile(
            bound=(
                Bound("View", "uniform", 0, 0, "View", ("vertex", "fragment",), View),
                Bound("Rig", "uniform", 1, 0, "Rig", ("fragment",), Rig),
                Bound("RigDerived", "uniform", 1, 1, "RigDerived", ("fragment",), RigDerived),
                Bound(
                    "Plastic.Material",
                    "uniform",
                    2,
                    0,
                    "Material",
                    ("fragment",),
                    PlasticMaterial,
                ),
                Bound("albedo", "texture", 2, 1, "albedo", ("fragment",)),
                Bound("albedo", "sampler", 2, 2, "albedo_sampler", ("fragment",)),
                Bound("Draw", "uniform", 3, 0, "Draw", ("vertex",), Draw),
                Bound("DrawDerived", "uniform", 3, 1, "DrawDerived", ("vertex",), DrawDerived),
            ),
            texts=(
                Text("vertex", "Plastic.vert.glsl", "main"),
                Text("fragment", "Plastic.frag.glsl", "main"),
            ),
            front_face="ccw",
            clip_depth="0..1",
        ),
        "wgsl:webgpu": Profile(
            bound=(
                Bound("View", "uniform", 0, 0, "View", ("vertex", "fragment",), View),
                Bound("Rig", "uniform", 1, 0, "Rig", ("fragment",), Rig),
                Bound("RigDerived", "uniform", 1, 1, "RigDerived", ("fragment",), RigDerived),
                Bound(
                    "Plastic.Material",
                    "uniform",
                    2,
                    0,
                    "Material",
                    ("fragment",),
                    PlasticMaterial,
                ),
                Bound("albedo", "texture", 2, 1, "albedo", ("fragment",)),
                Bound("albedo", "sampler", 2, 2, "albedo_sampler", ("fragment",)),
                Bound("Draw", "uniform", 3, 0, "Draw", ("vertex",), Draw),
                Bound("DrawDerived", "uniform", 3, 1, "DrawDerived", ("vertex",), DrawDerived),
            ),
            texts=(
                Text("vertex", "Plastic.vert.wgsl", "main"),
                Text("fragment", "Plastic.frag.wgsl", "main"),
            ),
            front_face="ccw",
            clip_depth="0..1",
        ),
    },
)


MATERIALS = (PLASTIC,)
"""All materials of this binding."""


def bind_group_layouts(
    material: Material, profile: str = "wgsl:webgpu"
) -> list[list[dict[str, Any]]]:
    """The entries of a WebGPU bind group layout for each group, as wgpu takes them."""
    flags = {"vertex": 1, "fragment": 2, "compute": 4}
    bound = material.profiles[profile].bound
    textures = {each.name: each for each in material.textures}
    last = max((each.group or 0 for each in bound), default=-1)
    groups: list[list[dict[str, Any]]] = [[] for _ in range(last + 1)]
    for each in bound:
        entry: dict[str, Any] = {
            "binding": each.binding,
            "visibility": sum(flags[stage] for stage in each.stages),
        }
        texture = textures.get(each.name)
        if each.block is not None:
            entry["buffer"] = {"type": "uniform", "min_binding_size": each.block.SIZE}
        elif texture is not None and each.kind == "texture":
            sample, dimension = texture.sample_type, texture.dimension
            entry["texture"] = {"sample_type": sample, "view_dimension": dimension}
        elif texture is not None:
            entry["sampler"] = {"type": texture.sampler_type}
        else:
            entry["buffer"] = {"type": "storage" if each.kind == "result" else "read-only-storage"}
        groups[each.group or 0].append(entry)
    return groups


def vertex_buffers(material: Material) -> list[dict[str, Any]]:
    """The layouts of vertex buffers for WebGPU, with a buffer for each input."""
    return [
        {
            "array_stride": each.stride,
            "step_mode": each.step,
            "attributes": [{"format": each.format, "offset": 0, "shader_location": each.location}],
        }
        for each in material.vertex_inputs
    ]
