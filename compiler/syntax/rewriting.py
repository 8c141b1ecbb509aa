"""Edits that messages about names and types offer."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ..diagnostics.fixes import Fix, FixIt, Hint, fix_it
from ..diagnostics.source import Source, Span
from .quoting import closed, operand, spanned

_HEAD = r"""(?x)
      (?P<kept> burnish[ \t]+[0-9]+ | //![^\n]*
              | import\s+ (?: "[^"\n]*" | [\w.]*\w ) (?: \s*\.\s*\{ [^}]* \} )? )
    | \ufeff | \s+ | [;,] | //(?!/)[^\n]* | /\*[\s\S]*?\*/
"""
"""The start of a file, in front of its own declarations.

Like the patterns of all hints, it is compiled when a first mistake needs it.
"""


def rewritten(span: Span, pattern: str, said: str = "write `{}`") -> FixIt:
    """A hint to write the expression at ``span`` in another way.

    ``{text}`` in the pattern is the expression as it stands; ``{operand}`` is the same in
    parentheses if something could not be written directly behind it otherwise.
    """
    shown = pattern.format(text=spanned(span), operand=operand(span))
    exact = pattern.format(text=span.text, operand=closed(span.text))
    return fix_it(said.format(shown), (span, exact))


def together(said: str, parts: Sequence[FixIt]) -> FixIt:
    """One hint of several that all have to be followed."""
    edits = tuple(edit for part in parts for fix in part.fixes for edit in fix.edits)
    return FixIt(said.format(" and ".join(part.text for part in parts)), (Fix(edits),))


def called_here(name: str, span: Span, here: str, why: str = "") -> Hint:
    """A hint that ``name`` at ``span`` is of another language, and is called ``here`` in this."""
    said = f"it is `{here}` here{f': {why}' if why else ''}"
    return fix_it(said, (span, here)) if span.text == name else said


def inserted_on_top(said: str, source: Source, declaration: str) -> FixIt:
    """A hint to add a declaration behind the imports of a file."""
    place = end = 0
    head = re.compile(_HEAD)
    while (found := head.match(source.text, end)) is not None:
        end = found.end()
        if found["kept"]:
            place = end
    text = f"\n{declaration}" if place else f"{declaration}\n"
    return fix_it(said, (Span(source, place, place), text))


def declared_space(name: str, span: Span) -> FixIt:
    """A hint to declare the space whose name stands at ``span``."""
    declaration = f"space {name}"
    return inserted_on_top(f"declare it: `{declaration}`", span.source, declaration)
