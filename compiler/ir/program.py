"""The types of programs, which the passes hand to ``legalise`` and ``emit``, in no language yet.

A program is staged, laid out and scheduled. A backend prints it and decides nothing about order,
sharing, stages or offsets: a node that a statement binds is printed as that statement's name, every
other node in place. All names here are suggestions in the user's spelling; a backend's ``Namer``
turns them into legal ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ...stdlib.builtins import BUILTINS
from ...support.frozen import cached_property, frozen
from .leaves import Buffer, HostPlace, Parameter, Texture
from .node import Formal, Node
from .operations import NATIVE, builtin_of
from .scattering import Scattered, scattered
from .shader import ArgumentInfo, Shader, Store
from .stages import (
    VERTICES,
    Domain,
    InterpolationMode,
    StageRow,
)
from .statements import EmittedPart, Region
from .storage import stored_type, structs_in
from .types import Struct, Type
from .walks import visible

StageName = str
"""The name of a stage's row, ``vertex``."""


@frozen
class StoredMember:
    """One member of a block in its stored form: the same bytes on every backend."""

    name: str
    """The suggested identifier, ``torch_axis``; paddings are ``pad_0`` …"""
    type: Type
    """The stored type.

    Bools are uints, matrices have columns of four rows, and packed arrays are arrays of vec4.
    """
    offset: int
    """Bytes from the start of the block (or of the struct)."""
    size: int
    """Bytes occupied."""
    parameter: Parameter | None
    """The parameter that it holds; ``None`` for explicit padding."""
    doc: str = ""


@frozen
class Block:
    """A uniform block: one group's parameters, values derived from them, or a host's own."""

    name: str
    """Suggested identifier, ``Material`` or ``MaterialDerived``."""
    group: str
    derived: bool
    members: tuple[StoredMember, ...]
    size: int
    """Bytes, a multiple of 16."""
    structs: tuple[Struct, ...]
    """Stored struct types (padded) that members use, in order of definition."""
    host: HostPlace | None = None
    """The place where a host binds a block that it owned before the program did."""


@frozen
class Field:
    """A stage input or output: vertex attribute, varying slot, or render target."""

    name: str
    type: Type
    location: int
    mode: InterpolationMode = "perspective"
    doc: str = ""
    step: Domain = VERTICES
    """The domain over which a vertex input varies."""
    invariant: bool = False
    """True for a varying from which positions are computed that have to be invariant."""


@frozen
class Varying:
    """Values that cross from one stage to the next in one location."""

    field: Field
    values: tuple[Node, ...]
    """Values in the domain of the earlier stage, whose lanes, joined, fill the slot."""


@frozen
class Interface:
    """The varyings that one stage hands on to the next."""

    origin: Domain
    """The domain in which the values are computed."""
    destination: Domain
    """The domain in which they are read."""
    varyings: tuple[Varying, ...]
    through: Domain | None = None
    """The domain of a stage between the two that hands the values on as they are, if there is one.

    That stage gets them by an interface of its own, in the same locations.
    """

    @property
    def fields(self) -> tuple[Field, ...]:
        """The outputs of the one stage, and inputs of the other."""
        return tuple(varying.field for varying in self.varyings)


def leaving(interfaces: Iterable[Interface], row: StageRow) -> tuple[Varying, ...]:
    """The varyings that a stage computes for the next, without those that it only hands on."""
    return tuple(
        varying
        for face in interfaces
        if face.origin == row.domain and face.through is None
        for varying in face.varyings
    )


@frozen
class Image:
    """An image that a kernel writes."""

    name: str
    format: str
    """The format of its texels, such as ``rgba16f``."""
    group: str
    """The group with which a host binds it."""


@frozen
class Output:
    """One value that a stage delivers."""

    kind: str
    """A kind of ``stages.py``: ``VARYING``, or that of a shader's result."""
    value: Node
    field: Field | None = None
    """The location of a varying or of a render target."""
    store: Store | None = None
    """The place of a value that is written to a storage buffer."""
    image: Image | None = None
    """The image of a value that is written to a texel."""

    @property
    def shown(self) -> str:
        """The name of the output for people."""
        if self.image is not None:
            return self.image.name
        if self.store is not None:
            return ".".join([self.store.buffer.name, *map(str, self.store.path)])
        return self.field.name if self.field is not None else self.kind


@frozen
class Function:
    """A body used more than once, such as the contribution of one light.

    A call is an ``apply`` node whose first operand is ``body`` and whose further operands are the
    arguments. Of its caller's values a body reads uniforms and its parameters only.
    """

    name: str
    doc: str
    parameters: tuple[tuple[Formal, Type], ...]
    body: Node
    """Identifies the function: the first operand of the calls."""
    region: Region
    value: Node
    stands_for: Node | None = None
    """Of a builtin's definition, a node that it computes; its own nodes are of another graph."""

    @cached_property
    def nodes(self) -> Sequence[Node]:
        """All nodes that it computes itself, operands before users, for whatever profile asks."""
        return visible((self.value,))


@frozen
class TextureRead:
    """A read of a texture by a stage, in one way."""

    builtin: str
    texture: Texture
    node: int
    """The id of one node that does."""

    @property
    def samples(self) -> bool:
        """True if it reads by the texture's sampler."""
        return BUILTINS[self.builtin].sampler is not None


def texture_reads(nodes: Iterable[Node]) -> tuple[TextureRead, ...]:
    """Each way in which ``nodes`` read a texture, once."""
    found: dict[tuple[str, Texture], TextureRead] = {}
    for node in nodes:
        builtin = builtin_of(node)
        if builtin and isinstance(texture := node.operands[0].data, Texture):
            read = TextureRead(builtin, texture, node.id)
            found.setdefault((read.builtin, texture), read)
    return tuple(found.values())


@frozen
class NativeUse:
    """A use of a builtin's own operation by a stage, on operands of certain types."""

    builtin: str
    types: tuple[Type, ...]
    node: Node
    """One node that does."""


def native_uses(nodes: Iterable[Node]) -> tuple[NativeUse, ...]:
    """Each native among ``nodes`` with the types of its operands, once."""
    found: dict[tuple[str, tuple[Type, ...]], NativeUse] = {}
    for node in nodes:
        if node.op == "native":
            key = NATIVE.data(node), tuple([operand.type for operand in node.operands])
            if key not in found:
                found[key] = NativeUse(*key, node)
    return tuple(found.values())


@frozen
class Stage:
    """One shader stage."""

    row: StageRow
    inputs: tuple[Field, ...]
    """Vertex inputs of the first stage, and varyings of every other."""
    blocks: tuple[Block, ...]
    """Blocks the stage reads, in binding order."""
    textures: tuple[Texture, ...]
    functions: tuple[Function, ...]
    region: Region
    results: tuple[Output, ...]
    """All outputs: the shader's own results first, and then the varyings."""
    buffers: tuple[Buffer, ...] = ()
    """The storage buffers that it reads or writes."""
    builtin_inputs: tuple[str, ...] = ()
    """The row's ``inputs`` that the stage reads, by name."""
    reads: tuple[TextureRead, ...] = ()
    """The ways in which the stage reads its textures: each way of each once."""
    natives: tuple[NativeUse, ...] = ()
    """The builtins whose own operations it uses, to be looked up among those a profile lacks."""
    handed_on: tuple[Field, ...] = ()
    """The inputs that the next stage reads as well, so that this stage hands them on."""
    emitted: tuple[EmittedPart, ...] = ()
    """The groups of vertices that it emits, if any.

    The stage's region then has the values that these share.
    """
    function: str = ""
    """The function that an engine calls, which this is instead of a whole stage; else empty."""
    arguments: tuple[ArgumentInfo, ...] = ()
    """The arguments of that function."""
    emitting: tuple[Node, ...] = ()
    """For each group of the expansion, a condition: a strip of it is emitted. All share a graph."""

    @property
    def name(self) -> StageName:
        """The stage's name in its row, or that of the function that it is instead."""
        return self.function or self.row.name

    @property
    def outputs(self) -> tuple[Field, ...]:
        """The fields of all results that have one."""
        return tuple(output.field for output in self.results if output.field is not None)

    @property
    def images(self) -> tuple[Image, ...]:
        """The images that it writes."""
        return tuple(output.image for output in self.results if output.image is not None)

    @property
    def regions(self) -> tuple[Region, ...]:
        """The bodies of its entry point and of its functions."""
        emitted = (region for part in self.emitted for region in part.regions)
        return (self.region, *emitted, *(function.region for function in self.functions))

    @property
    def roots(self) -> tuple[Node, ...]:
        """The values of all results."""
        return tuple(output.value for output in self.results)

    @cached_property
    def nodes(self) -> Sequence[Node]:
        """All nodes that it or its functions compute, operands before users.

        Each profile asks what values a program has.
        """
        return visible(self.roots, into_bodies=True)

    @property
    def written(self) -> frozenset[Buffer]:
        """The storage buffers that it writes."""
        return frozenset(output.store.buffer for output in self.results if output.store)

    @property
    def scattered(self) -> tuple[Scattered, ...]:
        """The values that it joins with elements of its own choice."""
        return scattered(self.results)

    def value_of(self, kind: str) -> Node | None:
        """The value of the result of a kind of which there is one at most."""
        return next((output.value for output in self.results if output.kind == kind), None)

    def results_of(self, kind: str) -> tuple[Output, ...]:
        """The results of one kind, in order."""
        return tuple(output for output in self.results if output.kind == kind)


@frozen
class Program:
    """One material under one pass and one rig, split into stages."""

    shader: Shader
    """The shader that was split. All passes have changed its results, but it is in one piece."""
    stages: tuple[Stage, ...]
    """The stages in pipeline order: the first one reads the vertex inputs."""
    blocks: tuple[Block, ...]
    """All blocks of all stages, in group order."""
    textures: tuple[Texture, ...]
    interfaces: tuple[Interface, ...]
    """The varyings between each stage and the next, in pipeline order."""
    buffers: tuple[Buffer, ...] = ()

    def stage(self, name: StageName) -> Stage:
        """The stage called so; ``KeyError`` if the program has none."""
        for stage in self.stages:
            if stage.name == name:
                return stage
        raise KeyError(f"{self.shader.name} has no {name} stage")

    @property
    def vertex_inputs(self) -> tuple[Field, ...]:
        """The values that the host's vertex buffers have to supply."""
        return self.stages[0].inputs

    @property
    def has_functions(self) -> bool:
        """True if its stages are functions that an engine calls."""
        return self.shader.has_functions

    @property
    def input_locations(self) -> int:
        """The number of locations of these; unread locations before a read one count, too."""
        return max((field.location + 1 for field in self.vertex_inputs), default=0)

    @property
    def varyings(self) -> tuple[Varying, ...]:
        """The varyings of all interfaces."""
        return tuple(varying for face in self.interfaces for varying in face.varyings)

    def interfaces_into(self, stage: Stage) -> tuple[Interface, ...]:
        """The interfaces into a stage, one for each earlier stage that hands something on to it."""
        return tuple(face for face in self.interfaces if face.destination == stage.row.domain)

    def entering(self, stage: Stage) -> tuple[Varying, ...]:
        """The varyings that a stage reads."""
        return tuple(v for face in self.interfaces_into(stage) for v in face.varyings)

    def leaving(self, stage: Stage) -> tuple[Varying, ...]:
        """The varyings that a stage computes for the next, without those that it only hands on."""
        return leaving(self.interfaces, stage.row)

    def results_of(self, kind: str) -> tuple[Output, ...]:
        """The results of one kind, of all stages."""
        return tuple(output for stage in self.stages for output in stage.results_of(kind))

    @property
    def written(self) -> frozenset[Buffer]:
        """The storage buffers that some stage writes."""
        return frozenset[Buffer]().union(*(stage.written for stage in self.stages))

    @property
    def scattered(self) -> frozenset[Buffer]:
        """The buffers with whose elements values are joined."""
        scattered = (each for stage in self.stages for each in stage.scattered)
        return frozenset(each.store.buffer for each in scattered)

    @property
    def images(self) -> tuple[Image, ...]:
        """The images that a kernel writes."""
        return tuple(image for stage in self.stages for image in stage.images)

    @property
    def structs(self) -> tuple[Struct, ...]:
        """The stored structs that blocks and buffers use, in order of definition."""
        of_buffers = structs_in(stored_type(buffer.type) for buffer in self.buffers)
        of_blocks = (struct for block in self.blocks for struct in block.structs)
        arguments = (info.leaf.type for stage in self.stages for info in stage.arguments)
        return tuple(dict.fromkeys((*of_blocks, *of_buffers, *structs_in(arguments))))

    @property
    def reads(self) -> tuple[TextureRead, ...]:
        """The reads of textures in all stages."""
        return tuple(read for stage in self.stages for read in stage.reads)

    @property
    def sampled(self) -> frozenset[Texture]:
        """The textures that are read by their samplers."""
        return frozenset(read.texture for read in self.reads if read.samples)
