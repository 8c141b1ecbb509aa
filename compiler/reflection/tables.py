"""What a backend tells the reflection about its own text: identifiers, bindings, files.

The compiler knows no backend; each hands in one ``BackendTable`` of plain data.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from ...frozen import EMPTY, frozen
from ..diagnostics.source import Span
from ..ir.program import StageName


@frozen
class BindingPoint:
    """Where a host binds one block, texture or sampler."""

    identifier: str
    """Its name in the text."""
    group: int | None = None
    """Bind group, descriptor set or register space; ``None`` where the profile binds by name."""
    binding: int | None = None
    """Number within the group."""
    register: str = ""
    """HLSL's register, ``b0``; empty elsewhere."""
    members: Mapping[str, str] = EMPTY
    """For a block: final identifiers by the layout's member names."""


@frozen
class FieldName:
    """How a vertex input, or a captured output, is called in the text."""

    identifier: str
    semantic: str = ""
    """HLSL's semantic, ``TEXCOORD0``; empty elsewhere."""


@frozen
class EmittedFile:
    """One file of text and the entry point in it."""

    stage: StageName
    file: str
    entry_point: str


@frozen
class BackendTable:
    """One profile's side of the reflection."""

    language: str
    """``hlsl``, ``glsl`` or ``wgsl``."""
    files: tuple[EmittedFile, ...]
    blocks: Mapping[str, BindingPoint] = EMPTY
    """By block name."""
    buffers: Mapping[str, BindingPoint] = EMPTY
    images: Mapping[str, BindingPoint] = EMPTY
    """Those that a kernel writes; empty where it is a full-screen pass."""
    textures: Mapping[str, BindingPoint] = EMPTY
    """By texture name; where the profile combines texture and sampler, this is the pair."""
    samplers: Mapping[str, BindingPoint] = EMPTY
    """By the name of the texture that they read; empty where the profile combines the two."""
    vertex_inputs: Mapping[str, FieldName] = EMPTY
    """By vertex input name."""
    captures: Mapping[str, FieldName] = EMPTY
    """By captured member; empty where the profile has no stream output."""
    stream_output: str = ""
    """How a host captures vertices: as the ``text`` says, by ``names``, by ``semantics``, or not at
    all."""
    host_uniforms: tuple[str, ...] = ()
    """Loose float uniforms that the host sets besides the blocks."""
    clip_depth: Literal["0..1", "-1..1"] = "0..1"
    """Depth range of clip space that the text writes."""
    clip_control: tuple[str, ...] = ()
    """What a host gives to OpenGL's ``glClipControl``; empty where it does not call it."""
    flip_y: bool = False
    """Whether the text negates clip y."""
    front_face: Literal["ccw", "cw"] = "ccw"
    """What a host has to set as front if it goes counter-clockwise: clockwise where the text turns
    the picture over."""
    source_maps: Mapping[str, Mapping[int, Span]] = EMPTY
    """By file name, what in Burnish text each line of the file is for."""
    first_row: Literal["top", "bottom"] = "top"
    """Which row of the picture comes first in the framebuffer's memory."""
