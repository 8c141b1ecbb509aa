"""The tokens around a syntax error, as the modules that find hints look at them."""

from __future__ import annotations

from ..diagnostics.fixes import Hint, fix_it
from ..diagnostics.source import Source, Span
from .foreign_syntax import types
from .lalr_tables import END
from .outline import Outline
from .quoting import shortened
from .tokens import Token

_BRACKETS = {"(": ")", "[": "]"}
_NOT_HERE = frozenset(("{", "}", "FOREIGN", "?"))
"""Tokens that no expression contains here; a text with one of them is not quoted."""


class TokenView:
    """Tokens by their index, their texts, and edits that replace some of them."""

    def __init__(self, outline: Outline, source: Source) -> None:
        self.outline = outline
        self.source = source
        self.tokens = outline.tokens

    def token(self, index: int) -> Token:
        """The token at ``index``; outside of the file one for its end."""
        if 0 <= index < len(self.tokens):
            return self.tokens[index]
        return Token(END, "", 0, 0)

    def text(self, index: int) -> str:
        """The text of the token."""
        return self.token(index).text

    def kinds(self, first: int, count: int) -> list[str]:
        """The kinds of ``count`` tokens from ``first`` on."""
        return [self.token(index).kind for index in range(first, first + count)]

    def span(self, first: int, last: int) -> Span:
        """The span from the beginning of one token to the end of another."""
        return Span(self.source, self.token(first).start, self.token(last).end)

    def replace(self, said: str, first: int, last: int, text: str, *, sure: bool = False) -> Hint:
        """A hint to write ``text`` in place of the tokens from ``first`` to ``last``."""
        return fix_it(said, (self.span(first, last), text), sure=sure)

    def without(self, said: str, first: int, behind: int) -> Hint:
        """A hint to remove the tokens from ``first`` up to ``behind``."""
        return self.replace(said, first, min(behind, len(self.tokens)) - 1, "")

    def behind_brackets(self, index: int) -> int:
        """The token behind the brackets that open at ``index``; ``index`` itself if none do."""
        if self.token(index).kind not in _BRACKETS:
            return index
        return self.closing(index) + 1

    def closing(self, opening: int) -> int:
        """The bracket that closes the one at ``opening``, or the end of the file."""
        depth, end = self.outline.depths[opening], opening + 1
        while end < len(self.tokens) and self.outline.depths[end] > depth:
            end += 1
        return end

    def is_cast(self, index: int) -> bool:
        """True if a name in parentheses stands directly in front, as in ``(float)x``."""
        before = self.kinds(index - 3, 3)
        return before == ["(", "NAME", ")"] and self.token(index).kind in ("NUMBER", "NAME", "(")

    def value_end(self, first: int) -> int:
        """The token behind the expression that begins at ``first``."""
        depths = self.outline.depths
        for end in range(first, len(self.tokens)):
            if depths[end] < depths[first]:
                return end
            if depths[end] == depths[first] and self._ends_value(end):
                return end
        return len(self.tokens)

    def _ends_value(self, index: int) -> bool:
        """True if no expression goes on with this token, which stands in none of its brackets."""
        if self.token(index).kind in (";", ","):
            return True
        is_name = self.token(index).text.isidentifier()
        return is_name and self.outline.begins_line(index) and self.outline.can_end(index - 1)

    def written(self, first: int, behind: int) -> str:
        """Some tokens, with the types of other languages translated; empty if impossible."""
        parts = self.tokens[first:behind]
        if any(part.kind in _NOT_HERE for part in parts):
            return ""
        text, end = "", self.token(first).start
        for index, part in enumerate(parts, first):
            is_call = self.token(index + 1).kind == "("
            word = types().get(part.text, part.text) if is_call else part.text
            text, end = text + self.source.text[end : part.start] + word, part.end
        return text

    def quoted(self, first: int, behind: int) -> str:
        """Some tokens as a message shows them: ``…`` where that is long, or impossible."""
        return shortened(self.written(first, behind) or "…")
