"""Prints a program in one language: ``compiling.py`` calls ``emit`` after ``legalise``.

The rows of the ``Language`` and its skeleton have everything that is particular to a language. The
passes and ``legalise`` have decided where each value is computed.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from ...compiler.ir.node import Node
from ...compiler.ir.program import Stage, StageName
from ...support.frozen import EMPTY, frozen
from ..description.spellings import PipelineInput
from ..legalise.bindings import Bindings
from ..legalise.legal import Legal
from .comments import comment_line, comment_lines
from .context import Context
from .declarations import Declarations
from .names import Names, name_program
from .origins import Marks
from .stage import StagePrinter
from .templates import renderer
from .texture_declarations import helpers, image_lines, opening_lines
from .views import EntryView, FileView
from .wrapping import Breaks, moved, wrapped

ALL_STAGES = "all"
"""Replaces the name of a stage where one text holds all stages."""


@frozen
class EmitOptions:
    """Options of a caller that change the texts."""

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
    """The end of the file's name, behind the material's name: ``vert.glsl``."""
    stage: StageName
    """The stage of the text; ``all`` for a text that holds all stages."""
    entries: Mapping[StageName, str]
    """Entry points by stage."""
    text: str
    checkers: tuple[str, ...]
    """The checkers of the profile that know all that the text uses."""
    marks: Marks
    breaks: Breaks
    """The lines that were broken. The marks count lines as they were before."""
    owner: str = ""
    """The name for the file, if it is not the shader's: that of all shaders with this text."""
    added: int = 0
    """The number of lines above all statements that were added since; negative for fewer lines."""

    def origins(self) -> dict[int, Node]:
        """The value that each statement belongs to, by line of ``text``, counted from 1."""
        found = moved(self.marks.origins(), self.breaks)
        return {line + self.added: node for line, node in found.items()} if self.added else found


@frozen
class Emission:
    """All texts of a program for one profile, and the data about them that the reflection needs."""

    files: tuple[EmittedFile, ...]
    names: Names
    bindings: Bindings
    host_uniforms: tuple[str, ...]
    """Names of plain float uniforms that the host has to set, besides the blocks."""


def emit(legal: Legal, options: EmitOptions | None = None) -> Emission:
    """Print a program. Raises ``ValueError`` if it needs several files, and one is wanted."""
    options = options or EmitOptions()
    if options.single_file and not legal.profile.single_file:
        raise ValueError(f"{legal.language.name}:{legal.profile.name} has no single-file form")
    return _Emitter(legal, options).emission()


def header_lines(name: str, doc: str, stages: Collection[StageName]) -> list[str]:
    """The comments with which a text begins: whose it is, and what that is."""
    kinds, plural = " and ".join(stages), "s" if len(stages) > 1 else ""
    title = comment_line(f"{name}: {kinds} shader{plural}, by Burnish.", "//")
    return [title, *comment_lines(doc, "//")]


class _Emitter:
    """Prints one program in one profile."""

    def __init__(self, legal: Legal, options: EmitOptions) -> None:
        self._program = legal.program
        self._language = legal.language
        self._profile = legal.profile
        self._options = options
        self._names = name_program(legal.program, legal.language, legal.bindings.sampler_owners)
        self._bindings = legal.bindings
        self._context = Context(legal, self._names, options.flip_y)
        self._declarations = Declarations(self._context, legal.bindings)

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
        names = {stage.name: self._entry_point(stage, single) for stage in stages}
        marks = Marks(self._language.forms)
        entries = [
            StagePrinter(self._context, self._declarations, stage, marks).entry(names[stage.name])
            for stage in stages
        ]
        text, breaks = marks.taken_out(self._text(stages, entries)), EMPTY
        if not (self._options.line_directives and self._language.line_directive):
            # After a directive a statement stays in one line, as compilers count lines from there.
            text, breaks = wrapped(text)
        extension = self._language.extension
        first = stages[0].row
        return EmittedFile(
            suffix=extension if single else f"{first.suffix}.{extension}",
            stage=ALL_STAGES if single else first.name,
            entries=names,
            text=text,
            checkers=self._checkers(stages),
            marks=marks,
            breaks=breaks,
        )

    def _checkers(self, stages: tuple[Stage, ...]) -> tuple[str, ...]:
        inputs = (row for stage in stages for row in self._inputs(stage))
        unknowing = frozenset[str]().union(*(row.unknown_to for row in inputs))
        return tuple(each for each in self._profile.checkers if each not in unknowing)

    def _entry_point(self, stage: Stage, single: bool) -> str:
        entry = stage.row.entry
        return entry if single else self._language.entry_point.format(entry=entry)

    def _text(self, stages: tuple[Stage, ...], entries: list[EntryView]) -> str:
        view = self._view(stages, entries)
        fill_in = renderer(self._language.skeleton)
        return fill_in(view, self._language.forms, self._profile, self._options.flip_y)

    def _view(self, stages: tuple[Stage, ...], entries: list[EntryView]) -> FileView:
        uniforms = (name for stage in stages for name in self._host_uniforms(stage))
        inputs = [row for stage in stages for row in self._inputs(stage)]
        reads = [read for stage in stages for read in stage.reads]
        natives = [native for stage in stages for native in stage.natives]
        images = self._declarations.images(stages)
        return FileView(
            opening=[
                *opening_lines(self._profile, self._context.textures, natives, reads, inputs),
                *image_lines(self._profile, images),
            ],
            header=self._header(stages),
            structs=self._declarations.structs(stages),
            blocks=self._declarations.blocks(stages),
            buffers=self._declarations.buffers(stages),
            images=images,
            textures=self._declarations.textures(stages),
            helpers=helpers(self._language, self._context.textures, reads),
            host_uniforms=list(dict.fromkeys(uniforms)),
            entries=entries,
        )

    def _header(self, stages: tuple[Stage, ...]) -> list[str]:
        shader = self._program.shader
        return header_lines(shader.name, shader.doc, [stage.name for stage in stages])

    def _host_uniforms(self, stage: Stage) -> list[str]:
        return [row.host_uniform for row in self._inputs(stage) if row.host_uniform]

    def _inputs(self, stage: Stage) -> list[PipelineInput]:
        """The spellings of the values that the pipeline supplies to a stage."""
        return [self._context.dialect.inputs[name] for name in stage.builtin_inputs]
