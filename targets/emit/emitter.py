"""From a program to the texts of one target: the only door into the backends."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Literal

from ...compiler.ir.leaves import Resource
from ...compiler.ir.node import Node
from ...compiler.ir.program import Block, Stage, StageName, StoredMember
from ...compiler.ir.types import Struct
from ...frozen import frozen
from ..legalise.bindings import Bindings
from ..legalise.legal import Legal
from . import templates
from .comments import comment_line, comment_lines
from .context import Context
from .names import Names, name_program
from .origins import Marks
from .stage import StagePrinter
from .textures import helpers, opening_lines
from .views import BlockView, EntryView, FileView, MemberView, StructView, TextureView
from .wrapping import wrapped

_SUFFIXES: Mapping[StageName, str] = {"vertex": "vert", "fragment": "frag"}
_SINGLE_ENTRIES: Mapping[StageName, str] = {"vertex": "vs_main", "fragment": "fs_main"}


@frozen
class EmitOptions:
    """What a caller may choose about the text."""

    flip_y: bool = False
    """Negate clip-space y: for passes that draw into textures where row 0 is the bottom one."""
    single_file: bool = False
    """One text with ``vs_main`` and ``fs_main``; see ``Profile.single_file``."""
    line_directives: bool = False
    """``#line`` directives, where the language has them."""


@frozen
class EmittedFile:
    """A finished text."""

    suffix: str
    """What follows the material's name: ``vert.glsl``."""
    stage: StageName | Literal["both"]
    entries: Mapping[StageName, str]
    """Entry points by stage."""
    text: str
    origins: Mapping[int, Node]
    """By 1-based line of ``text``, what the statement in it computes or is for."""


@frozen
class Emission:
    """All texts of a program for one profile, and what a host needs to know of them."""

    files: tuple[EmittedFile, ...]
    names: Names
    bindings: Bindings
    host_uniforms: tuple[str, ...]
    """Loose float uniforms that the host has to set besides the blocks."""


def emit(legal: Legal, options: EmitOptions | None = None) -> Emission:
    """Print a program; ``ValueError`` for one file where the profile cannot have that."""
    options = options or EmitOptions()
    if options.single_file and not legal.profile.single_file:
        raise ValueError(f"{legal.target.name}:{legal.profile.name} has no single-file form")
    return _Emitter(legal, options).emission()


class _Emitter:
    """Prints one program for one profile."""

    def __init__(self, legal: Legal, options: EmitOptions) -> None:
        self._program = legal.program
        self._target = legal.target
        self._profile = legal.profile
        self._options = options
        self._names = name_program(legal.program, legal.target)
        self._bindings = legal.bindings
        self._context = Context(legal, self._names, options.flip_y)
        self._types = self._context.types

    def emission(self) -> Emission:
        stages = self._program.stages
        groups = [stages] if self._options.single_file else [(stage,) for stage in stages]
        used = dict.fromkeys(name for stage in stages for name in self._host_uniforms(stage))
        return Emission(
            tuple(self._file(group) for group in groups),
            self._names,
            self._bindings,
            tuple(used),
        )

    def _file(self, stages: tuple[Stage, ...]) -> EmittedFile:
        single = len(stages) > 1
        names = {stage.name: _SINGLE_ENTRIES[stage.name] if single else "main" for stage in stages}
        marks = Marks()
        entries = [
            StagePrinter(self._context, stage, marks).entry(names[stage.name]) for stage in stages
        ]
        text, origins = marks.read(self._text(stages, entries))
        if not (self._options.line_directives and self._target.line_directive):
            # Behind a directive a statement stays in its one line, as compilers count on from it.
            text, origins = wrapped(text, origins)
        extension = self._target.extension
        first = stages[0].name
        return EmittedFile(
            suffix=extension if single else f"{_SUFFIXES[first]}.{extension}",
            stage="both" if single else first,
            entries=names,
            text=text,
            origins=origins,
        )

    def _text(self, stages: tuple[Stage, ...], entries: list[EntryView]) -> str:
        view = self._view(stages, entries)
        return templates.render(
            self._target.folder / self._target.template,
            {"file": view, "profile": self._profile, "flip_y": self._options.flip_y},
        )

    def _view(self, stages: tuple[Stage, ...], entries: list[EntryView]) -> FileView:
        blocks = [
            block
            for block in self._program.blocks
            if any(block in stage.blocks for stage in stages)
        ]
        structs = dict.fromkeys(struct for block in blocks for struct in block.structs)
        resources = [
            resource
            for resource in self._program.resources
            if any(resource in stage.resources for stage in stages)
        ]
        uniforms = (name for stage in stages for name in self._host_uniforms(stage))
        reads = [read for stage in stages for read in stage.reads]
        return FileView(
            opening=opening_lines(self._profile, self._context.textures, reads),
            header=self._header(stages),
            structs=[self._struct(struct) for struct in structs],
            blocks=[self._block(block) for block in blocks],
            textures=[view for resource in resources for view in self._textures(resource)],
            helpers=helpers(self._target, self._context.textures, reads),
            host_uniforms=list(dict.fromkeys(uniforms)),
            entries=entries,
        )

    def _header(self, stages: tuple[Stage, ...]) -> list[str]:
        program = self._program
        kinds = " and ".join(stage.name for stage in stages)
        plural = "s" if len(stages) > 1 else ""
        title = comment_line(f"{program.name}: {kinds} shader{plural}, by Burnish.", "//")
        return [title, *comment_lines(program.doc, "//")]

    def _host_uniforms(self, stage: Stage) -> list[str]:
        rows = (self._context.inputs[name] for name in stage.builtin_inputs)
        return [row.host_uniform for row in rows if row.host_uniform]

    def _struct(self, struct: Struct) -> StructView:
        members = tuple(
            MemberView(self._types.declare_stored(self._names.member(struct.name, name), type_))
            for name, type_ in struct.members
        )
        return StructView(self._names.structs[struct.name], members)

    def _block(self, block: Block) -> BlockView:
        return BlockView(
            name=self._names.blocks[block.name],
            variable=self._names.variables.get(block.name, ""),
            slot=self._bindings.blocks[block.name],
            members=tuple(self._member(block, member) for member in block.members),
        )

    def _member(self, block: Block, member: StoredMember) -> MemberView:
        name = self._names.member(block.name, member.name)
        return MemberView(self._types.declare_stored(name, member.type), comment_line(member.doc))

    def _textures(self, resource: Resource) -> Iterator[TextureView]:
        """The declarations of a texture and its sampler."""
        names, types, slots = self._names, self._context.textures, self._bindings
        name, slot = names.textures[resource.name], slots.textures[resource.name]
        if self._profile.samplers.combined:
            yield TextureView(name, types.combined(resource), slot)
            return
        yield TextureView(name, types.texture(resource), slot)
        if resource.name in names.samplers:
            sampler = names.samplers[resource.name]
            yield TextureView(
                sampler, types.sampler(resource), slots.samplers[resource.name], is_sampler=True
            )
