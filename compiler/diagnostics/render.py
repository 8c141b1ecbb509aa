"""Diagnostics as text for people: message, place, excerpt with carets, and how to mend it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from .diagnostic import Diagnostic
from .display import harmless
from .excerpt import Mark, excerpt
from .style import Style


def render(diagnostic: Diagnostic, *, color: bool = False, explain: bool = True) -> str:
    """One diagnostic as a paragraph of text, without a final line end.

    Without ``explain`` it lacks the help of its rule, which a reader has seen before.
    """
    return "\n".join(_lines(diagnostic, Style(color), explain=explain))


def render_all(diagnostics: Iterable[Diagnostic], *, color: bool = False) -> str:
    """Several diagnostics, separated by empty lines; the help of each rule is shown only once."""
    style = Style(color)
    explained: set[str] = set()
    paragraphs = []
    for diagnostic in diagnostics:
        explain = diagnostic.rule.code not in explained
        paragraphs.append("\n".join(_lines(diagnostic, style, explain=explain)))
        explained.add(diagnostic.rule.code)
    return "\n\n".join(paragraphs)


def _lines(diagnostic: Diagnostic, style: Style, *, explain: bool) -> Iterator[str]:
    severity = diagnostic.severity
    title = style.severity(severity, f"{severity}[{diagnostic.rule.code}]")
    yield f"{title}{style.strong(': ' + harmless(diagnostic.message))}"
    margin, lines = excerpt(_marks(diagnostic), severity, style)
    yield from lines
    advice = diagnostic.hint or (diagnostic.rule.help if explain else "")
    if advice:
        yield f"{margin} {style.gutter('=')} {style.strong('help')}: {harmless(advice)}"


def _marks(diagnostic: Diagnostic) -> list[Mark]:
    """The places to show, the primary one first."""
    marks = [Mark(label.span, harmless(label.text), False) for label in diagnostic.labels]
    if diagnostic.span:
        marks.insert(0, Mark(diagnostic.span, harmless(diagnostic.caption), True))
    return marks
