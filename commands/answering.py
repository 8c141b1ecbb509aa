"""Collects what a command says, and prints it as one document: ``--format json``, and ``sarif``.

Commands print by ``console.py`` and write by ``output.py`` in any case. Once a command line has
asked for a document, these hand everything over to the collector of this module, and ``group.py``
prints it at the end, with the exit code. So a command need not know of it, unless it has found
something that is more than lines for people: it gives that to ``find``.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from .. import __version__
from .terminal import print_output

if TYPE_CHECKING:
    from ..compiler.diagnostics.diagnostic import Diagnostic, Severity


class Collected:
    """What a command has said so far."""

    def __init__(self, command: str, form: str = "json") -> None:
        self._command = command
        self._form = form
        self._diagnostics: dict[Any, Diagnostic] = {}
        self._remarks: list[tuple[Severity, str]] = []
        self._lines: list[str] = []
        self._written: dict[str, None] = {}
        self._found: Any = None

    def diagnose(self, found: Iterable[Diagnostic]) -> None:
        """Take diagnostics; the same one counts once."""
        for each in found:
            self._diagnostics.setdefault((each.rule.code, each.message, str(each.span)), each)

    def remark(self, severity: Severity, text: str) -> None:
        """Take a message."""
        self._remarks.append((severity, text))

    def say(self, text: str) -> None:
        """Take lines for people."""
        self._lines += text.splitlines() or [""]

    def write(self, paths: Iterable[str]) -> None:
        """Take the paths of files that were written."""
        self._written.update(dict.fromkeys(paths))

    def find(self, found: Any) -> None:
        """Take the record of what the command has found."""
        self._found = found

    def text(self, exit_code: int) -> str:
        """The document."""
        if self._form == "sarif":
            from .sarif import sarif

            return sarif(tuple(self._diagnostics.values()), exit_code, self._remarks)
        from ..compiler.documents.answer import Answer, RemarkRow
        from ..compiler.documents.writing import to_text
        from .diagnostic_rows import diagnostic_row

        return to_text(
            Answer(
                answer=1,
                burnish=__version__,
                command=self._command,
                exit_code=exit_code,
                diagnostics=tuple(map(diagnostic_row, self._diagnostics.values())),
                remarks=tuple(RemarkRow(severity=s, text=t) for s, t in self._remarks),
                written=tuple(self._written),
                text=tuple(self._lines),
                result=self._found,
            )
        )


_collectors: list[Collected] = []
"""The collector of the running command, if it has been asked for a document."""


def collector() -> Collected | None:
    """What takes everything that is said, if a document is asked for."""
    return _collectors[-1] if _collectors else None


def begin(command: str, form: str = "json") -> None:
    """Collect all that is said from now on, for a document of this form."""
    _collectors.append(Collected(command, form))


def answer(exit_code: int) -> None:
    """Print what was collected, at the end of a command."""
    collected = _collectors.pop()
    print_output(collected.text(exit_code))


def drop() -> None:
    """Collect no more, and print nothing: the command was interrupted or misused."""
    _collectors.clear()
