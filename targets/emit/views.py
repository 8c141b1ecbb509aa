"""What a skeleton sees: finished pieces of text in the order of the file, and nothing to decide."""

from __future__ import annotations

from dataclasses import dataclass

from ...compiler.ir.program import StageName
from .bindings import Slot


@dataclass(frozen=True, slots=True)
class MemberView:
    """A member of a struct or block."""

    typed: str
    comment: str = ""


@dataclass(frozen=True, slots=True)
class StructView:
    """A struct that members of blocks use."""

    name: str
    members: tuple[MemberView, ...]


@dataclass(frozen=True, slots=True)
class BlockView:
    """A uniform block."""

    name: str
    variable: str
    slot: Slot
    members: tuple[MemberView, ...]


@dataclass(frozen=True, slots=True)
class TextureView:
    """A texture and its sampler."""

    texture: str
    sampler: str
    texture_slot: Slot
    sampler_slot: Slot


@dataclass(frozen=True, slots=True)
class FieldView:
    """A stage's input or output."""

    name: str
    type: str
    typed: str
    location: int
    semantic: str
    flat: bool
    comment: str


@dataclass(frozen=True, slots=True)
class InputView:
    """A value from the pipeline that the text has to declare."""

    typed: str
    semantic: str


@dataclass(frozen=True, slots=True)
class FunctionView:
    """A function."""

    comments: list[str]
    type: str
    name: str
    parameters: str
    lines: list[str]
    value: str


@dataclass(frozen=True, slots=True)
class StoreView:
    """An output's final value."""

    name: str
    value: str


@dataclass(frozen=True, slots=True)
class EntryView:
    """One stage's entry point and what belongs to it alone."""

    stage: StageName
    name: str
    inputs: list[FieldView]
    pipeline_inputs: list[InputView]
    outputs: list[FieldView]
    functions: list[FunctionView]
    lines: list[str]
    stores: list[StoreView]
    position: str
    """Clip-space position, in the vertex stage."""
    discard: str
    """Condition; empty where nothing is discarded."""


@dataclass(frozen=True, slots=True)
class FileView:
    """One file."""

    header: list[str]
    structs: list[StructView]
    blocks: list[BlockView]
    textures: list[TextureView]
    host_uniforms: list[str]
    """Loose float uniforms."""
    entries: list[EntryView]
