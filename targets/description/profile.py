"""The record that describes one dialect of a language: ``Profile``, with its limits and lacks.

``targets/<name>/language.py`` makes one for each dialect. ``legalise`` reads most of the rows;
``emit`` and the reflection read the others.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Literal

from ...compiler.ir.stages import COMPUTE, FRAGMENT, GEOMETRY, RASTERISED, Chain, StageRow
from ...compiler.ir.types import TEXTURES, TextureType, Type
from ...stdlib.builtins.row import Domain
from ...support.frozen import EMPTY, frozen
from .binding_scheme import BindingKind, BindingScheme
from .forms import Forms
from .spellings import Literals, PipelineInput, Spellings, TypeNames

Numbering = Literal["set", "kind"]
"""The way of counting binding numbers: together in a set, or without sets, each kind on its own."""

OfTypes = Callable[[tuple[Type, ...]], bool]
"""A question about an operation on operands of these types."""


@frozen(kw_only=True)
class Samplers:
    """The relation of textures and samplers: separate, or combined in one object."""

    combined: bool = False
    """True if a texture and its sampler are one object with one binding."""
    joined: str = ""
    """Replaces ``Forms.texture``."""
    precision: str = ""
    """The line that opens a file for each ``{type}`` of combined samplers in it."""


@frozen(kw_only=True)
class Framebuffer:
    """The directions of clip space and of the rows of a picture, and how they are flipped."""

    clip_depth: Literal["0..1", "-1..1"] = "0..1"
    """Depth range of clip space; Burnish's own is 0..1."""
    clip_y_down: bool = False
    """True if the API's own clip y points down. A host then flips the viewport for programs that
    were not emitted flipped, and only for these, so that both come out the right way round."""
    clip_control: tuple[str, ...] = ()
    """The constants that a host passes to OpenGL's ``glClipControl``, so that nothing has to be
    flipped. Empty: the host does not call it, as in all other APIs."""
    rows_up: bool = False
    """True if the first row of a picture is the bottom one, unless the program was emitted
    flipped."""
    inputs: Mapping[str, PipelineInput] = EMPTY
    """The spelling of the pipeline's values while rows count upwards."""
    natives: Spellings = EMPTY
    """The spelling of natives while rows count upwards."""


@frozen
class StreamOutput:
    """The way in which a host captures vertices."""

    told: Literal["text", "names", "semantics"]
    """The place where the captured outputs are listed: the text itself, the names that a host gives
    before it links (OpenGL's transform feedback), or semantics (Direct3D's stream output)."""
    indexed: bool = True
    """True if the vertices of a mesh may be drawn by their indices. Otherwise a host repeats the
    vertices, which then have other numbers."""


@frozen
class Limits:
    """Limits that every device and every compiler of a profile supports at least.

    ``LIMITED`` has the words for each of them in messages and in the manual.
    """

    varyings: int = 16
    """Vectors of varyings between two stages."""
    attributes: int = 16
    """Locations of vertex inputs."""
    vertex_buffers: int = 8
    """Storage buffers of a stage that computes vertices; 0 if it can read none."""
    fragment_buffers: int = 8
    """Storage buffers of the fragment stage; 0 if it can read none."""
    kernel_buffers: int = 8
    """Storage buffers of a kernel, read or written; 0 if it can have none."""
    textures: int = 16
    """Textures that one stage reads."""
    asked_textures: int | None = None
    """Textures that one stage reads, if a host asks the device for more than all devices have and
    refuses one that has fewer; ``None`` where the API has no way to ask, or nothing more."""
    vertex_textures: int | None = None
    """Textures of a stage that computes vertices, if these are fewer than in other stages."""
    samplers: int = 16
    """Samplers of a stage, where they are apart from textures. Those of equal state are one sampler
    in a program that has to share them."""
    block_bytes: int = 16384
    """Bytes of one uniform block."""
    vertex_uniforms: int | None = None
    """Vectors of loose uniforms of a stage that computes vertices, if blocks are loose uniforms
    (``Profile.loose_uniforms``)."""
    fragment_uniforms: int | None = None
    """Vectors of loose uniforms of the fragment stage, if blocks are loose uniforms."""
    render_targets: int = 8
    """Render targets that a pass writes."""
    nested_blocks: int = 240
    """Loops and branches inside of each other. DXC and clang take 256 brackets."""
    emitted_vertices: int = 256
    """Vertices that a geometry stage emits for one primitive."""
    emitted_components: int = 1024
    """Components of all vertices that are emitted for one primitive, those of the positions
    included."""
    inlined_operations: int = 10_000
    """Operations of a stage if every call is replaced by the function's body. No language has a
    limit of its own; but DXC and glslang's HLSL inline every call, and so do the drivers behind all
    languages. Their time grows with the square of the calls: 12 000 operations in 2000 calls took
    DXC and glslang four seconds each, and twice as many half a minute."""
    work_group: int = 128
    """Invocations in a work group."""
    shared_bytes: int = 16384
    """Bytes that the invocations of a work group share."""
    groups: int | None = None
    """Bind groups, if they are limited; this concerns the host's own blocks, which have fixed
    groups, and schemes."""
    bindings: int | None = None
    """Binding numbers in a group, if they are limited; for the same."""

    push_constant_bytes: int | None = None
    """Bytes of push constants; ``None`` where there are none, and a scheme that asks for them is
    ignored."""
    numbers: Mapping[BindingKind, int] = EMPTY
    """Binding numbers of each kind, where each kind is numbered on its own."""

    def most(self, name: str) -> int | None:
        """The value of a field that a program must not exceed, be it that devices are asked."""
        if name == "textures" and self.asked_textures is not None:
            return self.asked_textures
        found: int | None = getattr(self, name)
        return found

    def buffers_of(self, row: StageRow) -> int:
        """The number of storage buffers that a stage may have; 0 if it can have none."""
        return int(getattr(self, buffer_limit(row)))


def buffer_limit(row: StageRow) -> str:
    """The field of ``Limits`` for the number of storage buffers of a stage."""
    others = {FRAGMENT.name: "fragment_buffers", COMPUTE.name: "kernel_buffers"}
    return others.get(row.name, "vertex_buffers")


@frozen
class Limited:
    """The words for one limit in messages and in the manual."""

    what: str
    """The noun that follows the number: the limited thing, in the plural."""
    stage: StageRow | None = None
    """The stage that the limit is about, if the limit has no meaning without the stage."""
    instead: str = ""
    """Advice to a user who exceeds the limit, besides compiling for another profile."""


IN_ONE_TEXTURE = (
    "have pictures of the same size in the layers of one `texture2d_array`, or put several beside "
    "each other in one `texture2d`"
)
IN_ONE_BUFFER = "put arrays into one buffer, whose elements are a structure with a member of each"
IN_ONE_STATE = "give textures the same `filter`, `mip` and `wrap`, so that they share a sampler"

LIMITED: Mapping[str, Limited] = {
    "varyings": Limited("varyings"),
    "attributes": Limited("vertex inputs"),
    "vertex_buffers": Limited(
        "storage buffers of a stage that computes vertices", instead=IN_ONE_BUFFER
    ),
    "fragment_buffers": Limited("storage buffers of the fragment stage", instead=IN_ONE_BUFFER),
    "kernel_buffers": Limited("storage buffers of a kernel", COMPUTE, instead=IN_ONE_BUFFER),
    "textures": Limited("textures", instead=IN_ONE_TEXTURE),
    "asked_textures": Limited("textures, if the host asks for a device that has them"),
    "samplers": Limited("samplers, each of another state", instead=IN_ONE_STATE),
    "vertex_textures": Limited("textures of a stage that computes vertices"),
    "block_bytes": Limited("bytes in a uniform block"),
    "vertex_uniforms": Limited("vectors of uniforms of a stage that computes vertices"),
    "fragment_uniforms": Limited("vectors of uniforms of the fragment stage"),
    "render_targets": Limited("render targets"),
    "nested_blocks": Limited("nested blocks"),
    "inlined_operations": Limited("operations in place of calls"),
    "work_group": Limited("invocations in a work group", COMPUTE),
    "shared_bytes": Limited("bytes that a work group shares", COMPUTE),
    "emitted_vertices": Limited("vertices of one primitive", GEOMETRY),
    "emitted_components": Limited("numbers at the vertices of one primitive", GEOMETRY),
    "push_constant_bytes": Limited("bytes of push constants"),
    "groups": Limited("bind groups"),
    "bindings": Limited("bindings in a group"),
}
"""The fields of ``Limits``."""


TargetBlending = Literal["alike", "switched", "apart"]
"""The ways in which targets of one pass may differ in blending: in none, and they have the same
lanes written ("alike"); in being blended or not, and in the written lanes ("switched"); or in
everything ("apart")."""

STORABLE = frozenset({"r32f", "rgba8", "rgba16f", "rgba32f"})
"""The formats of images that kernels of all APIs can write."""


@frozen(eq=False, kw_only=True)
class Profile:
    """One dialect of a language: that of an API, or of a version of the language."""

    name: str
    doc: str
    on_request: bool = False
    """True if the profile has to be named, and is neither among ``all`` nor proposed: it cannot
    express many programs."""
    preamble: tuple[str, ...] = ()
    """Lines that open each file: version, extensions, default precisions."""
    requires: Mapping[str, str] = EMPTY
    """The line that opens a file in which a native is used."""
    defaults: tuple[str, ...] = ()
    """Lines behind these two: default precisions, where extensions have to come first."""
    types: TypeNames | None = None
    """The profile's own spelling of types, if it differs from its language's."""
    literals: Literals | None = None
    """The profile's own spelling of constants, if it differs from its language's."""
    forms: Forms | None = None
    """The profile's own statements and expressions, if they differ from its language's."""
    skeleton: Path | None = None
    """The profile's own skeleton, if it differs from its language's."""
    stages: Chain = RASTERISED
    """The stages that the profile has, in any order."""
    stream_output: StreamOutput | None = None
    """The way in which a host captures the vertices that the last stage before the fragments makes;
    ``None`` if it cannot."""
    image_formats: frozenset[str] = frozenset()
    """The formats of images that kernels can write. A kernel over images of other formats is drawn
    as a full-screen pass."""
    most_images: int = 4
    """The number of images that a kernel can write; a kernel with more is drawn as a full-screen
    pass."""
    draws_edges: bool = True
    """True if a host can draw the edges of triangles instead of filling them."""
    blending: TargetBlending = "apart"
    """The ways in which the targets of one pass may differ in blending."""
    blends_floats: bool = True
    """True if render targets of 32-bit floats can be blended."""
    links_without_fragments: bool = True
    """True if a pipeline can do without a fragment shader, where a pass writes depths only.
    Elsewhere it gets one that does nothing."""
    fragment_depths: bool = True
    """True if fragments can have depths of their own."""
    borders: bool = True
    """True if samplers can have a border of one colour beyond the edges of a texture."""
    single_file: bool = False
    """True if all stages can stand in one text."""
    samplers: Samplers = Samplers()
    framebuffer: Framebuffer = Framebuffer()
    limits: Limits = Limits()
    limit_names: Mapping[str, str] = EMPTY
    """The API's names of limits, by field of ``Limits``, for messages and for hosts that ask."""
    patch_winding: Literal["ccw", "cw"] = "ccw"
    """The API's winding of a patch's triangles that turn counter-clockwise where u points to the
    right and v upwards. It is the opposite one where the API has v point downwards."""
    invariant_inputs: bool = False
    """True if an input has to be declared invariant where the stage before delivers it as
    invariant."""
    varyings_by_name: bool = False
    """True if stages are matched by the names of varyings instead of their locations."""
    explicit_bindings: bool = True
    """True if the text states set and binding; otherwise the host assigns them by name."""
    numbering: Numbering = "set"
    """The scope in which a binding number is unique: a set, or a kind (blocks, textures,
    samplers)."""
    numbers_storage_apart: bool = False
    """With one count for each kind: True if storage buffers are a kind of their own, and False if
    their numbers follow those of the blocks."""
    scheme: BindingScheme = BindingScheme()
    """The sets, and the numbers in them."""
    can_combine_samplers: bool = False
    """True if it has textures and samplers apart, and a scheme may ask for both in one."""
    natives: Spellings = EMPTY
    """Spellings that only this profile has."""
    inputs: Mapping[str, PipelineInput] = EMPTY
    """Inputs that this profile spells differently from its language."""
    without_inputs: frozenset[str] = frozenset()
    """Values of the pipeline that its stages have not got."""
    textures: frozenset[TextureType] = frozenset(TEXTURES)
    """The types of textures that it has."""
    wide_integers: bool = True
    """True if integers have 32 bits, signed and unsigned, and there are operations on their
    bits."""
    integer_attributes: bool = True
    """True if vertex attributes can be integers."""
    attributes_of_floats: bool = False
    """True if a host hands integers on to vertices as floats, from which the text makes integers
    again: those of 24 bits stay the same."""
    flat_varyings: bool = True
    """True if a varying can be flat: the value of one vertex of the triangle. Integers have to be
    flat."""
    rectangular_matrices: bool = True
    """True if a matrix can have another number of columns than of rows."""
    computed_indices: bool = True
    """True if any integer can be the index of an element or a lane. Otherwise an index consists of
    constants and of the counters of loops around it; only arrays of uniforms are read at any index,
    and only where vertices are computed."""
    loose_uniforms: bool = False
    """True if each member of a block is a uniform of its own, which a host sets by name."""
    lacks: frozenset[str] = frozenset()
    """Builtins that the dialect has no word for: each becomes a function of the text, made from
    the builtin's ``definition``."""
    agrees: Mapping[str, Domain] = EMPTY
    """The operands for which the dialect's own operation has a builtin's meaning, where these are
    others than the builtin's ``domain``. They are more if the language defines what others leave
    open; then it needs fewer guards. They are fewer if it has the operation for some types only, or
    a compiler of it gets it wrong; elsewhere the ``definition`` is used."""
    mistakes: Mapping[str, OfTypes] = EMPTY
    """The types of operands for which a driver gets the dialect's own operation wrong, where the
    builtin's ``definition`` is used instead."""
    cannot: frozenset[str] = frozenset()
    """Builtins that the profile has neither by itself nor by an exact replacement. The message
    about a program that uses one is in ``capabilities.py``."""
    checkers: tuple[str, ...] = ()
    """Checkers of ``targets.toolchain`` that have to accept the text."""
