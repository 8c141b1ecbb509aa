"""The properties of one profile's texts that a host has to know."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from ...support.frozen import frozen
from ..constraints import Count


@frozen(kw_only=True)
class BindingRow:
    """The binding of a texture or sampler."""

    identifier: str
    """Name in the text."""
    group: Count | None
    """Bind group, descriptor set or register space; null where the host binds by name."""
    binding: Count | None
    """Number within the group; null where the host binds by name."""
    register: str | None
    """Name of the binding in the language itself, ``b0`` in HLSL; null where it has none."""


@frozen(kw_only=True)
class BlockBindingRow:
    """The binding of a block."""

    identifier: str
    """Name in the text."""
    group: Count | None
    """Bind group, descriptor set or register space; null where the host binds by name."""
    binding: Count | None
    """Number within the group; null where the host binds by name."""
    register: str | None
    """Name of the binding in the language itself, ``b0`` in HLSL; null where it has none."""
    members: Mapping[str, str]
    """Identifiers in the text by member name in the block."""


@frozen(kw_only=True)
class EntryRow:
    """One entry of the layout of a bind group, whether a stage reads what is bound there or not."""

    binding: Count
    """Number within the group."""
    kind: Literal["block", "buffer", "texture", "sampler", "combined", "image"]
    """What is bound; ``combined`` is a texture with its sampler, in one object."""
    type: str
    """WebGPU's word for the type of the binding.

    Of blocks it is ``uniform``, of buffers ``storage`` or ``read-only-storage``, of textures the
    sample type, such as ``unfilterable-float``, of samplers ``filtering``, ``non-filtering`` or
    ``comparison``, and of images ``write-only``.
    """
    name: str
    """The block, buffer, texture or image, or the texture that the sampler is for."""
    read: bool
    """True if a stage reads or writes it."""


@frozen(kw_only=True)
class GroupLayoutRow:
    """The layout of a bind group, or of a descriptor set: it follows from declarations."""

    group: Count
    """Bind group, descriptor set or register space."""
    layout_id: str
    """A digest of the layout: groups with one id fit one layout object."""
    shared: bool
    """True if materials share it: nothing in it differs from material to material of a rig."""
    visibility: tuple[str, ...]
    """The stages that see all of its entries."""
    entries: tuple[EntryRow, ...]
    """The entries, by number."""


@frozen(kw_only=True)
class PushConstantsRow:
    """The block that is push constants."""

    block: str
    """The name of the block."""
    size: Count
    """Its bytes, from the first one on."""
    visibility: tuple[str, ...]
    """The stages of the range."""


@frozen(kw_only=True)
class VertexInputNameRow:
    """The name of a vertex input."""

    identifier: str
    """Name in the text."""
    semantic: str | None
    """HLSL semantic; null elsewhere."""


@frozen(kw_only=True)
class FileRow:
    """One stage's text."""

    stage: str
    """The stage, such as ``vertex``."""
    file: str
    """File name, relative to this document."""
    entry_point: str
    """Entry point in the file."""


@frozen(kw_only=True)
class ModuleRow:
    """One stage's text, compiled for drivers that take no texts."""

    stage: str
    """The stage, such as ``vertex``."""
    file: str
    """File name, relative to this document."""
    format: Literal["spirv", "dxil"]
    """What the file holds: SPIR-V, as Vulkan takes it, or DXIL, as Direct3D 12 does."""
    entry_point: str
    """Entry point in the file."""


@frozen(kw_only=True)
class SourceMapRow:
    """The text in Burnish that each statement of an emitted file computes, or is there for."""

    sources: tuple[str, ...]
    """Burnish files by name, as given to the compiler; those of the library begin with ``std/``."""
    lines: tuple[tuple[Count, Count, Count, Count, Count], ...]
    """Rows of five numbers, in the order of the text.

    They are a line of the text, then the number of a source counted from 0, the line and the column
    in it, and the number of characters.
    """


@frozen(kw_only=True)
class BackendRow:
    """One profile's texts."""

    source_maps: Mapping[str, SourceMapRow]
    """The origin of the statements of each file, by file name."""
    language: str
    """Language of the text: ``hlsl``, ``glsl``, ``wgsl`` …"""
    clip_depth: Literal["0..1", "-1..1"]
    """Depth range of clip space that the text writes."""
    clip_control: tuple[str, ...]
    """The arguments that a host gives to OpenGL's ``glClipControl``: its origin and its depth mode.

    Empty where a host does not call it.
    """
    flip_y: bool
    """True if the text negates clip y."""
    front_face: Literal["ccw", "cw"]
    """Winding that a host has to set as front, in the API's own terms."""
    first_row: Literal["top", "bottom"]
    """The row of the picture that comes first in the framebuffer's memory."""
    files: tuple[FileRow, ...]
    """Emitted files."""
    blocks: Mapping[str, BlockBindingRow]
    """Blocks by name."""
    images: Mapping[str, BindingRow]
    """Images that a kernel writes, by name.

    There are none where the kernel is a full-screen pass, whose render targets they are.
    """
    buffers: Mapping[str, BindingRow]
    """Storage buffers by name."""
    textures: Mapping[str, BindingRow]
    """Textures by name; together with their samplers where the profile combines the two."""
    samplers: Mapping[str, BindingRow]
    """Samplers by the name of the texture; empty where the profile combines the two."""
    layouts: tuple[GroupLayoutRow, ...]
    """The layouts of all bind groups, by number; empty where the API has no groups."""
    binding_id: str
    """A digest of all that a host binds and feeds for these texts, and of their files' names.

    A binding in the language of a host has the one that it was made for, and is stale with others.
    """
    vertex_inputs: Mapping[str, VertexInputNameRow]
    """Vertex inputs by name."""
    stream_output: Literal["text", "names", "semantics", None]
    """The way in which a host captures vertices.

    ``text``: as the text says. ``names``: by the names of outputs that it gives before linking.
    ``semantics``: by their semantics. Null where the profile has no stream output.
    """
    captures: Mapping[str, VertexInputNameRow]
    """The outputs that hold captured values, by name of the value.

    OpenGL is told them before it links, or Direct3D's stream output names their semantics. Empty
    where the profile has no stream output, or a kernel captures.
    """
    host_uniforms: tuple[str, ...]
    """Loose float uniforms that the host sets besides the blocks."""
    required_limits: Mapping[str, Count]
    """What a device has to allow, by the API's names of limits, if not every device does.

    A host asks for it (``requiredLimits`` of WebGPU), or looks it up, and does without the material
    where a device has less.
    """
    push_constants: PushConstantsRow | None = None
    """The block that has no binding, since it is push constants, if there is one."""
    modules: tuple[ModuleRow, ...] | None = None
    """The texts compiled for drivers; left out where none was asked for."""
