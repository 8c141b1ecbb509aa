"""What a command says with ``--format json``: one envelope for all of them, with a version.

``commands/answering.py`` makes it, and ``burnish schema answer`` prints its schema.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from ...support.frozen import frozen
from ..constraints import Count, Range

Place = Annotated[int, Range(least=1)]


@frozen(kw_only=True)
class PositionRow:
    """A place between two characters of a file."""

    line: Place
    """The line, from 1."""
    column: Place
    """The column, from 1."""
    offset: Count
    """The number of characters before it, from the beginning of the file."""


@frozen(kw_only=True)
class SpanRow:
    """A part of a file."""

    file: str
    """The file, as it was named; those of the library begin with ``std/``."""
    start: PositionRow
    """The place before its first character."""
    end: PositionRow
    """The place behind its last character."""


@frozen(kw_only=True)
class LabelRow:
    """A further place that matters."""

    span: SpanRow
    """The place."""
    text: str
    """A few words that say why it matters."""


@frozen(kw_only=True)
class EditRow:
    """A change to a file."""

    span: SpanRow
    """The part that is replaced; an empty one is where text is inserted."""
    text: str
    """The text that replaces it."""


@frozen(kw_only=True)
class FixRow:
    """One complete way to mend a case."""

    applicability: Literal["machine-applicable", "maybe-incorrect"]
    """Whether a tool may make the change without asking."""
    edits: tuple[EditRow, ...]
    """Changes that are made together; they do not overlap."""


@frozen(kw_only=True)
class DiagnosticRow:
    """An error or a warning."""

    code: str
    """The code, such as ``B0203``, which stays the same from one version to the next."""
    severity: Literal["error", "warning", "note"]
    """How bad it is."""
    message: str
    """The first line of what people see."""
    span: SpanRow | None
    """The place; null if it is about no text, such as a folder that cannot be written to."""
    caption: str
    """What is written next to the marked text; may be empty."""
    labels: tuple[LabelRow, ...]
    """Further places."""
    hint: str
    """How to mend this case, as a sentence; empty if that is not known."""
    fixes: tuple[FixRow, ...]
    """The changes that the hint describes; any one is enough."""
    help: str
    """What the rule means in general."""


@frozen(kw_only=True)
class RemarkRow:
    """A message that is about no diagnostic's rule, such as a missing tool."""

    severity: Literal["error", "warning", "note"]
    """How bad it is."""
    text: str
    """The message."""


@frozen(kw_only=True)
class CompiledFileRow:
    """A file that a compile writes."""

    path: str
    """The path."""
    kind: Literal["text", "module", "reflection", "functions", "plan"]
    """What it is; a ``module`` is SPIR-V or DXIL."""
    source: str
    """The source that becomes it."""


@frozen(kw_only=True)
class CompileAnswer:
    """The result of ``burnish compile``."""

    outputs: tuple[CompiledFileRow, ...]
    """The outputs, in the order in which they are put in place."""
    read: tuple[str, ...]
    """The files that were read."""
    missing: tuple[str, ...]
    """Places where a file was looked for in vain: one there would change the result."""
    lines: tuple[str, ...]
    """What people are told of each material and frame."""


@frozen(kw_only=True)
class BoundFileRow:
    """A file that ``burnish bind`` writes."""

    path: str
    """The path."""
    language: str
    """The language of the host."""


@frozen(kw_only=True)
class BindAnswer:
    """The result of ``burnish bind``."""

    outputs: tuple[BoundFileRow, ...]
    """The binding in each language."""
    read: tuple[str, ...]
    """The files that were read."""
    missing: tuple[str, ...]
    """Places where a file was looked for in vain: one there would change the result."""


@frozen(kw_only=True)
class BuiltRow:
    """An action that ``burnish build`` has run."""

    name: str
    """The action: the folder of its outputs, below that of the build."""
    outputs: tuple[str, ...]
    """The paths of its outputs."""


@frozen(kw_only=True)
class BuildAnswer:
    """The result of ``burnish build``, where it compiles."""

    run: tuple[BuiltRow, ...]
    """The actions that were run without an error."""
    up_to_date: tuple[str, ...]
    """The names of those that had nothing to do."""
    failed: tuple[str, ...]
    """The names of those with errors, whose outputs are as they were."""
    removed: tuple[str, ...]
    """Former outputs of the build that nothing makes any more, which were deleted."""


@frozen(kw_only=True)
class TargetsAnswer:
    """The result of ``burnish targets``."""

    targets: tuple[Mapping[str, Any], ...]
    """A row for each target, with its profiles and what each can do."""
    engines: tuple[Mapping[str, Any], ...]
    """A row for each engine that takes functions, with the values that it lights surfaces by."""


@frozen(kw_only=True)
class ToolRow:
    """An external tool."""

    name: str
    """The tool."""
    purpose: str
    """What it is for."""
    version: str | None
    """The version that was found; null if there is none."""
    paths: tuple[str, ...]
    """Its files; none if it is missing."""
    problem: str | None
    """Why it cannot be used; null if it can."""
    install: str
    """The command that installs it."""


@frozen(kw_only=True)
class RouteRow:
    """A way to draw."""

    name: str
    """The route."""
    title: str
    """The route in words."""
    lacks: tuple[str, ...]
    """The tools that are missing; it draws if there are none."""


@frozen(kw_only=True)
class DoctorAnswer:
    """The result of ``burnish doctor``."""

    tools: tuple[ToolRow, ...]
    """The external tools."""
    routes: tuple[RouteRow, ...]
    """The routes that draw with them."""


@frozen(kw_only=True)
class JudgeAnswer:
    """The result of ``burnish judge``."""

    pictures: tuple[Mapping[str, Any], ...]
    """A verdict for each picture; docs/golden.md says what is in it."""


@frozen(kw_only=True)
class SameAnswer:
    """The result of ``burnish same``."""

    comparisons: tuple[Mapping[str, Any], ...]
    """A verdict for each pair of materials or frames; docs/same.md says what is in it."""


@frozen(kw_only=True)
class ConformAnswer:
    """The result of ``burnish conform``, where it compares."""

    report: Mapping[str, Any]
    """What report.json of ``--report`` has."""


@frozen(kw_only=True)
class ExplainAnswer:
    """The result of ``burnish explain``."""

    code: str
    """The code."""
    severity: Literal["error", "warning", "note"]
    """The severity of all diagnostics with this code."""
    message: str
    """The message; words in braces are placeholders."""
    help: str
    """What the rule means."""
    wrong: str | None
    """A program that shows it; null if none can."""
    right: str | None
    """The same program mended."""


@frozen(kw_only=True)
class ListAnswer:
    """The result of ``burnish docs`` and ``burnish example`` without a name."""

    pages: Mapping[str, str]
    """What each page or example is about, by its name."""


@frozen(kw_only=True)
class Answer:
    """All that a command has to say."""

    VERSION: ClassVar = "answer"

    answer: Literal[1]
    """Version of this document's format."""
    burnish: str
    """Version of Burnish."""
    command: str
    """The command."""
    exit_code: Count
    """The exit code of the process."""
    diagnostics: tuple[DiagnosticRow, ...]
    """Errors and warnings about sources, targets and outputs, in reading order."""
    remarks: tuple[RemarkRow, ...]
    """Other messages."""
    written: tuple[str, ...]
    """The paths of all files that were written, or have had the same content already."""
    text: tuple[str, ...]
    """Lines for people, as far as no other field has what they say."""
    result: (
        CompileAnswer | BindAnswer | BuildAnswer | TargetsAnswer | DoctorAnswer | JudgeAnswer
        | SameAnswer | ConformAnswer | ExplainAnswer | ListAnswer | None
    )  # fmt: skip
    """What the command has found; null where all is said above."""
