"""``burnish compile --validate``: checks texts with the real compilers, and relays their messages.

Each message is reported at the place of the material that the emitted line came from, because the
user can change that place.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import Diagnostic, Label, Report
from ..compiler.diagnostics.source import Source, Span
from ..compiler.ir.stages import STAGES
from ..targets.emit.directives import plain
from ..targets.toolchain import Job, Message, Toolchain, Verdict
from .compiled import OutputFile


def validate(files: Iterable[OutputFile]) -> tuple[Diagnostic, ...]:
    """Run the compilers of the files' profiles in parallel; returns everything that they report."""
    asked = [(file, job) for file in files for job in _jobs(file)]
    with Toolchain() as toolchain:
        verdicts = toolchain.check([job for _, job in asked])
    report = Report()
    for (file, _), verdict in zip(asked, verdicts, strict=True):
        tell(file, verdict, report)
    return report.diagnostics


def _jobs(file: OutputFile) -> Iterator[Job]:
    for checker in file.checkers:
        for stage, entry in file.entry_points.items():
            yield Job(checker, STAGES[stage].suffix, file.text, entry, file.name)


def tell(file: OutputFile, verdict: Verdict, report: Report) -> None:
    """Report what a compiler has said of a text."""
    checker = verdict.job.checker
    if verdict.status == "missing":
        report.add(rules.TOOL_MISSING, None, checker=checker, problem=_line(verdict.log))
    elif verdict.status in ("crashed", "timeout"):
        reason = _line(verdict.log) or verdict.status
        report.add(rules.TOOL_BROKE, None, checker=checker, file=file.name, reason=reason)
    else:
        for message in verdict.messages:
            _relay(file, checker, message, report)


def _relay(file: OutputFile, checker: str, message: Message, report: Report) -> None:
    """Report a tool's message at the Burnish text that the emitted line came from."""
    rule = rules.REJECTED if message.severity == "error" else rules.DOUBTED
    directed = _directed(file, message)
    emitted = None if directed else _emitted(file, message)
    span = directed or (file.spans.get(message.line) if message.line else None)
    labels = [Label(emitted, "became this")] if span and emitted else []
    report.add(
        rule, span or emitted, labels=labels,
        checker=checker, file=file.name, text=_line(message.text),
    )  # fmt: skip


def _directed(file: OutputFile, message: Message) -> Span | None:
    """The place in Burnish text, if the tool's message names it because of line directives."""
    named = {plain(source.name_in_outputs): source for source in file.sources}
    named |= {str(number): source for number, source in enumerate(file.sources, start=1)}
    source, line = named.get(message.source), message.line
    if source is None or line is None or line > len(source.line_starts):
        return None
    for span in file.spans.values():
        if span.source is source and source.position(span.start)[0] == line:
            return span
    start = source.line_starts[line - 1]
    return Span(source, start, start + len(source.line(line)))


def _emitted(file: OutputFile, message: Message) -> Span | None:
    """The rest of the emitted line that a message is about; ``None`` if it names no line."""
    if message.line is None:
        return None
    source = Source(file.name, file.text)
    line = min(message.line, len(source.line_starts))
    start = source.line_starts[line - 1]
    text = source.line(line)
    indent = len(text) - len(text.lstrip())
    column = message.column - 1 if message.column else indent
    return Span(source, start + min(column, len(text)), start + len(text))


def _line(text: str) -> str:
    return " ".join(text.split())
