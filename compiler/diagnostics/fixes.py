"""Hints that change the text: edits that an editor, or a tool, can make by itself.

Whoever reports a finding may give a ``FixIt`` in place of a sentence. The sentence is shown to
people; the edits are part of the JSON that ``burnish check --format json`` writes.
"""

from __future__ import annotations

from typing import Literal

from ...support.frozen import frozen
from .source import Span

Applicability = Literal["machine-applicable", "maybe-incorrect"]
"""The confidence in a change: may a tool make it without asking?

``machine-applicable`` means that the change is certainly what was meant: another spelling of the
same thing. ``maybe-incorrect`` means that the finding is gone after the change, but that a person
has to say whether the text then means what was intended.
"""


@frozen
class Edit:
    """``text`` replaces that of ``span``; an empty span inserts, an empty text removes."""

    span: Span
    text: str


@frozen
class Fix:
    """One way to mend a finding: edits that are made together and do not overlap."""

    edits: tuple[Edit, ...]
    applicability: Applicability = "maybe-incorrect"


@frozen
class FixIt:
    """A hint that says how to write it, with the edits that do so."""

    text: str
    """The sentence, in which a long edit may be abbreviated."""
    fixes: tuple[Fix, ...]
    """The changes it speaks of; where there are several, each one alone is enough."""


Hint = str | FixIt
"""A hint how to mend one finding: a sentence, empty for none, or a sentence with edits."""


def fix_it(text: str, *edits: tuple[Span, str], sure: bool = False) -> FixIt:
    """A hint whose edits belong together; ``sure`` means that a tool may make them unasked."""
    applicability: Applicability = "machine-applicable" if sure else "maybe-incorrect"
    return FixIt(text, (Fix(tuple(Edit(*edit) for edit in edits), applicability),))


def write(span: Span, text: str, *, sure: bool = False) -> FixIt:
    """The hint ``write …``, in place of the text at ``span``."""
    return fix_it(f"write `{text}`", (span, text), sure=sure)


def write_color(span: Span, digits: str) -> FixIt:
    """The hint for a colour without its mark, in place of its digits at ``span``."""
    return fix_it(f"a colour is written `#{digits}`", (span, f"#{digits}"), sure=True)


def either(text: str, span: Span, *instead: str) -> FixIt:
    """A hint with several texts that may stand at ``span``."""
    return FixIt(text, tuple(Fix((Edit(span, one),)) for one in instead))


def sentence(hint: Hint) -> str:
    """The sentence of a hint, for people."""
    return hint if isinstance(hint, str) else hint.text
