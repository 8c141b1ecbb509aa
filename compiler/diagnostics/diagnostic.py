"""Diagnostics as data, and the report that collects them.

Every part of the compiler reports through a ``Report``. Rendered texts, JSON and exit codes are
derived from it.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

from ...support.frozen import changed, frozen
from .file_names import readable
from .fixes import Fix, Hint, sentence
from .source import Span

Severity = Literal["error", "warning", "note"]


@frozen
class Rule:
    """One row of ``rules``: the properties that all diagnostics of one kind share."""

    code: str
    severity: Severity
    message: str
    """``str.format`` template over the arguments given where the rule is reported."""
    help: str
    """The meaning of the rule and how to satisfy it; shown by ``burnish explain``."""
    of_absence: bool = False
    """True if it reports an undefined name, or one that nothing reads.

    It is suppressed for names that text declares which could not be parsed, or declares twice.
    """
    of_the_whole: bool = False
    """True if it is told only of programs without errors, since an error could be why."""


@frozen
class Label:
    """A further place that the reader should see, with a few words that say why."""

    span: Span
    text: str


@frozen
class Diagnostic:
    """One finding at one place."""

    rule: Rule
    message: str
    span: Span | None = None
    """``None`` for findings about no text at all, such as an unwritable folder."""
    caption: str = ""
    """Printed beside the carets."""
    labels: tuple[Label, ...] = ()
    hint: str = ""
    """A hint how to mend this very case, where that is known."""
    fixes: tuple[Fix, ...] = ()
    """The changes to the text that ``hint`` speaks of; each one alone is enough."""

    @property
    def severity(self) -> Severity:
        """The rule's severity."""
        return self.rule.severity


_Key = tuple[str, str, Span | None]


def _key(found: Diagnostic) -> _Key:
    return found.rule.code, found.message, found.span


class Report:
    """Collects diagnostics in the order found; the same finding at the same place counts once."""

    def __init__(self) -> None:
        self._found: dict[_Key, Diagnostic] = {}
        self.unread_names: set[str] = set()
        """Names in text that could not be parsed, which may be declared there, and names that are
        declared twice."""
        self._unreadable: set[Span | None] = set()

    def unread(self, names: Iterable[str]) -> None:
        """Suppress reports that these names are undefined.

        They stand in text that could not be parsed, which has been reported, and may be declared
        there.
        """
        self.unread_names.update(names)

    def unreadable(self, found: Iterable[Diagnostic]) -> None:
        """Suppress further diagnostics that touch these places: they would be consequences."""
        self._unreadable.update(each.span for each in found if each.severity == "error")

    def add(
        self,
        rule: Rule,
        span: Span | None,
        *,
        caption: str = "",
        labels: Iterable[Label] = (),
        hint: Hint = "",
        **arguments: object,
    ) -> None:
        """Record a finding; ``arguments`` fill the rule's message."""
        found = self.finding(rule, span, caption=caption, labels=labels, hint=hint, **arguments)
        if found is not None:
            self.extend((found,))

    def finding(
        self,
        rule: Rule,
        span: Span | None,
        *,
        caption: str = "",
        labels: Iterable[Label] = (),
        hint: Hint = "",
        **arguments: object,
    ) -> Diagnostic | None:
        """A finding that is not recorded yet; ``None`` if it has to be suppressed."""
        if rule.of_absence and arguments.get("name") in self.unread_names:
            return None
        labels = tuple(labels)
        if span is not None and not self._unreadable.isdisjoint(
            (span, *(label.span for label in labels))
        ):
            return None
        message = readable(rule.message.format(**arguments))
        fixes = () if isinstance(hint, str) else hint.fixes
        return Diagnostic(rule, message, span, caption, labels, sentence(hint), fixes)

    def extend(self, others: Iterable[Diagnostic]) -> None:
        """Record findings that were made before, such as those of another report."""
        for other in others:
            self._found.setdefault(_key(other), other)

    def lacks(self, others: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
        """The findings of another report that this one does not have yet."""
        return tuple(other for other in others if _key(other) not in self._found)

    def apart(self) -> Report:
        """An empty report about the same files, for an attempt whose findings may be dropped."""
        trial = Report()
        trial.unread_names = self.unread_names
        trial._unreadable = self._unreadable
        return trial

    def since(self, count: int) -> tuple[Diagnostic, ...]:
        """All but the first ``count`` findings, in the order found."""
        return tuple(self._found.values())[count:]

    @property
    def count(self) -> int:
        """The number of findings by now."""
        return len(self._found)

    def explain(self, since: int, label: Label) -> None:
        """Add a label to all findings after the first ``since`` ones."""
        for key in list(self._found)[since:]:
            found = self._found[key]
            self._found[key] = changed(found, labels=(*found.labels, label))

    def forget(self, since: int) -> None:
        """Drop all findings after the first ``since`` ones."""
        for key in list(self._found)[since:]:
            del self._found[key]

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """All findings so far in reading order: file by file, each from top to bottom.

        Findings without a place come first. Files are ordered by their first finding.
        """
        failed = self.failed
        found = [each for each in self._found.values() if not (failed and each.rule.of_the_whole)]
        sources = {id(f.span.source): None for f in found if f.span is not None}
        rank = {source: i for i, source in enumerate(sources)}

        def place(one: Diagnostic) -> tuple[int, int]:
            return (-1, 0) if one.span is None else (rank[id(one.span.source)], one.span.start)

        return tuple(sorted(found, key=place))

    @property
    def failed(self) -> bool:
        """True if any finding is an error."""
        return any(found.severity == "error" for found in self._found.values())


class CompileError(Exception):
    """Raised when a compile ends in errors; ``diagnostics`` carries all of them."""

    def __init__(self, diagnostics: Iterable[Diagnostic]) -> None:
        self.diagnostics = tuple(diagnostics)
        super().__init__("\n".join(str(d.message) for d in self.diagnostics))
