"""Hints for loops and ranges that are written as in other languages."""

from __future__ import annotations

import re

from ..diagnostics.fixes import Edit, Fix, FixIt, Hint, fix_it
from ..diagnostics.source import Span
from .forms import FOLDS
from .token_view import TokenView

_NUMBER = r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:deg|rad)?"
_RANGE = re.compile(rf"\s*([\[(]?)\s*({_NUMBER})\s*(?:-|–|,|:|;|to\b)\s*({_NUMBER})(?:\s*([\])]))?")
"""Two numbers with something else than ``..`` between them."""
_FAR = 12
"""The number of tokens before a mistake among which its range may begin."""


def fold_form(word: str) -> str:
    """The form of the fold that begins with ``word``."""
    return f"`{word} i in a..b : e` repeats, or `{word} i in a..b up to 16 : e`"


def range_hint(view: TokenView, index: int) -> Hint:
    """About a range before ``index`` that is not written ``low..high``: ``0-1``, ``[0, 1]``."""
    for before in range(index - 1, index - _FAR, -1):
        if view.text(before) == "in":
            found = _RANGE.match(view.source.text, view.token(before).end)
            if found is None or bool(found[1]) != bool(found[4]):
                break
            start = found.start(1) if found[1] else found.start(2)
            written = f"{found[2]}..{found[3]}"
            span = Span(view.source, start, found.end())
            return fix_it(f"a range is written with two dots: `{written}`", (span, written))
    return "a range is written `low..high`"


def called_fold(view: TokenView, index: int) -> Hint:
    """About ``sum(i in 0..4) e`` and ``sum(i in 0..4 : e)``, of which ``index`` is the ``0``."""
    fold, opening = index - 4, index - 3
    if view.kinds(opening, 3) != ["(", "NAME", "NAME"] or FOLDS.get(view.text(fold)) != "in":
        return ""
    closing = view.closing(opening)
    if view.token(closing).kind != ")":
        return ""
    head = view.quoted(opening + 1, closing)
    open_, close = view.span(opening, opening), view.span(closing, closing)
    if ":" in view.kinds(opening, closing - opening):
        said = f"parentheses belong around the whole loop: `({view.text(fold)} {head})`"
        before = Span(view.source, view.token(fold).start, view.token(fold).start)
        return fix_it(said, (before, "("), (open_, " "))
    edits = [Edit(open_, " ")]
    body = closing + 1
    end = view.value_end(body)
    if view.token(body).kind == ":":
        edits.append(Edit(close, ""))
        body += 1
    elif view.token(body).kind == "{":
        end = view.closing(body)
        if view.token(end).kind != "}":
            return ""
        edits += [Edit(close, " :"), Edit(view.span(body, body), ""), Edit(view.span(end, end), "")]
        body += 1
    else:
        edits.append(Edit(close, " :"))
    shown = f"{view.text(fold)} {head} : {view.quoted(body, end)}"
    return FixIt(f"the head of a loop has no parentheses: `{shown}`", (Fix(tuple(edits)),))
