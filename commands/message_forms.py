"""The forms in which ``burnish check``, ``compile`` and ``build`` tell diagnostics: ``--format``.

People read texts, on standard error. Editors and other programs read one line for each, also there
(GitHub's runner in a form of its own), or a document on standard output: the answer in JSON
(``answering.py``), or a log (``sarif.py``).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from .console import distinct, print_rendered, rendered, show
from .terminal import FAILED, print_output

if TYPE_CHECKING:
    from ..compiler.diagnostics.diagnostic import Diagnostic

_IN_MESSAGES = "%\r\n"
_IN_PROPERTIES = f"{_IN_MESSAGES}:,"
"""Characters with a meaning of their own in commands of GitHub's workflows."""
DOCUMENTS = ("json", "sarif")
"""The forms that are documents."""


def messages(form: str, diagnostics: Iterable[Diagnostic]) -> str:
    """The text for standard error; empty for a form that is a document."""
    if form in _LINES:
        return "".join(f"{_LINES[form](each)}\n" for each in distinct(diagnostics))
    return "" if form in DOCUMENTS else rendered(diagnostics)


def document(
    form: str,
    command: str,
    diagnostics: Iterable[Diagnostic],
    *,
    exit_code: int,
    written: Sequence[str] = (),
    found: Any = None,
) -> str:
    """The text for standard output, if the form is a document; else empty.

    ``found`` is the record of what the command has found, besides the files that it has
    ``written``.
    """
    if form not in DOCUMENTS:
        return ""
    from .answering import Collected

    answer = Collected(command, form)
    answer.diagnose(diagnostics)
    answer.write(written)
    answer.find(found)
    return answer.text(exit_code)


def show_in(form: str, diagnostics: Iterable[Diagnostic]) -> None:
    """Print diagnostics in a form, or leave them to the collector of a form that is a document."""
    if form in DOCUMENTS:
        show(diagnostics)
    else:
        print_rendered(messages(form, diagnostics))


def tell(form: str, command: str, diagnostics: Sequence[Diagnostic]) -> bool:
    """Print diagnostics, where they are all that there is to say; True if none is an error."""
    failed = any(each.severity == "error" for each in diagnostics)
    print_rendered(messages(form, diagnostics))
    code = FAILED if failed else 0
    print_output(document(form, command, diagnostics, exit_code=code))
    return not failed


def _line(found: Diagnostic) -> str:
    """``file:line:column: error: B0201: message``, as compilers of C write it."""
    from ..compiler.diagnostics.display import harmless

    place = "burnish"
    if found.span is not None:
        line, column = found.span.source.position(found.span.start)
        place = f"{found.span.source.name}:{line}:{column}"
    return harmless(f"{place}: {found.severity}: {found.rule.code}: {_sentence(found)}")


def _annotation(found: Diagnostic) -> str:
    """A command by which a workflow of GitHub marks a place of a pull request.

    What could begin another property, or another command, is written as a percentage.
    """
    from ..compiler.diagnostics.display import harmless

    properties = {"title": found.rule.code}
    if (span := found.span) is not None:
        line, column = span.source.position(span.start)
        last, behind = span.source.position(span.end)
        ends = {"endLine": last, "endColumn": behind} if line == last else {"endLine": last}
        place = {"file": span.source.name, "line": line, "col": column, **ends}
        properties = {**{key: str(value) for key, value in place.items()}, **properties}
    listed = ",".join(
        f"{key}={_encoded(value, _IN_PROPERTIES)}" for key, value in properties.items()
    )
    text = harmless(_sentence(found))
    command = "notice" if found.severity == "note" else found.severity
    return f"::{command} {listed}::{_encoded(text, _IN_MESSAGES)}"


def _encoded(text: str, special: str) -> str:
    return "".join(f"%{ord(each):02X}" if each in special else each for each in text)


def _sentence(found: Diagnostic) -> str:
    """The message and the way out, without line breaks."""
    hint = f"; {found.hint}" if found.hint else ""
    return " ".join(f"{found.message}{hint}".split())


_LINES = {"line": _line, "github": _annotation}
"""The forms that have a line for each diagnostic."""
