"""What a skeleton sees: finished pieces of text in the order of the file, and nothing to decide."""

from __future__ import annotations

from typing import NamedTuple

from ...compiler.ir.program import StageName
from ..legalise.bindings import Slot


class MemberView(NamedTuple):
    """A member of a struct or block."""

    typed: str
    comment: str = ""


class StructView(NamedTuple):
    """A struct that members of blocks use."""

    name: str
    members: tuple[MemberView, ...]


class BlockView(NamedTuple):
    """A uniform block."""

    name: str
    variable: str
    slot: Slot
    members: tuple[MemberView, ...]


class TextureView(NamedTuple):
    """A texture or a sampler, or both in one."""

    name: str
    type: str
    slot: Slot
    is_sampler: bool = False


class FieldView(NamedTuple):
    """A stage's input or output."""

    name: str
    type: str
    typed: str
    location: int
    semantic: str
    flat: bool
    comment: str


class InputView(NamedTuple):
    """A value from the pipeline that the text has to declare."""

    typed: str
    semantic: str


class FunctionView(NamedTuple):
    """A function."""

    comments: list[str]
    type: str
    name: str
    parameters: str
    lines: list[str]
    value: str


class StoreView(NamedTuple):
    """An output's final value."""

    name: str
    value: str


class EntryView(NamedTuple):
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


class FileView(NamedTuple):
    """One file."""

    opening: list[str]
    """Lines that have to come before all others, besides those of the profile."""
    header: list[str]
    structs: list[StructView]
    blocks: list[BlockView]
    textures: list[TextureView]
    """Each followed by its sampler, if that is an object of its own."""
    helpers: list[str]
    """Functions of the language's own, texts of some lines."""
    host_uniforms: list[str]
    """Loose float uniforms."""
    entries: list[EntryView]
