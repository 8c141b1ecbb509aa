"""Splits the tokens of a file into its declarations, before the parser runs.

The parser then reads each declaration on its own, so that a mistake in one does not affect the
others. Brackets are matched here, too, and the depth of every token is known afterwards.
"""

from __future__ import annotations

from ...support.frozen import fresh, record
from .ast import MEMBERS
from .forms import DECLARATIONS
from .tokens import RESERVED, Token

NESTING_LIMIT = 200

TWO_WORDS = frozenset(("abstract", "extern"))
"""Words that a second word follows before the name: ``abstract material``, ``extern block``."""
_AWAITS_NAME = frozenset(("blend", "by", "for", "in", "per"))
_AWAITS_VALUE = frozenset(("from", "to", "while"))
"""Words of a loop's head; elsewhere they are names, and so may end an equation."""
HEADER_ENDS = frozenset((":", "{", "(", "<", "blend", "by", "for", "per", "at"))
_CLOSED_BY = {"(": ")", "[": "]", "{": "}"}
_CLOSERS = frozenset(_CLOSED_BY.values())
_CAN_END = frozenset(
    ("NAME", "NUMBER", "COLOR", "STRING", "true", "false", "FOREIGN", ")", "]", "}", ";", ",")
)


@record
class Chunk:
    """The tokens of one declaration, or of several that only the parser can tell apart."""

    start: int
    end: int = 0
    unclosed: list[int] = fresh(factory=list)
    """Opening brackets that nothing closes, in order."""
    too_deep: int | None = None
    """The bracket that goes beyond the limit, if any."""


class Outline:
    """The brackets, depths and declarations of a file, found without the grammar."""

    def __init__(self, text: str, tokens: list[Token]) -> None:
        self.text = text
        self.tokens = tokens
        self.depths: list[int] = []
        """The number of brackets around each token, and none around the end of the file; brackets
        that are never closed do not count."""
        self.chunks: list[Chunk] = [Chunk(0)] if tokens else []
        self._open: list[int] = []
        self._split()

    def begins_member(self, index: int) -> bool:
        """True if ``index`` looks like the first token of a member or of a simple equation."""
        token, following = self.tokens[index], self._kind(index + 1)
        if self.is_member(index):
            return True
        if not self._may_follow(index) or self._is_in_head(index):
            return False
        if following in ("=", ":"):
            return token.kind == "NAME" or token.kind in RESERVED
        return token.text in MEMBERS and (following == "NAME" or following in RESERVED)

    def is_member(self, index: int) -> bool:
        """True if a line begins here that can only be a member, whatever stands above it."""
        kind = MEMBERS.get(self.tokens[index].text)
        if kind is None or not self.begins_line(index) or self.begins_line(index + 1):
            return False
        following = self.tokens[index + 1 : index + 1 + len(kind.opening)]
        return len(following) == len(kind.opening) and all(
            symbol in (token.kind, token.text)
            for symbol, token in zip(kind.opening, following, strict=True)
        )

    def begins_equation(self, index: int) -> bool:
        """True if a line begins with a name that is given something, even in an expression."""
        names = self.tokens[index].kind == "NAME" and self._kind(index + 1) in ("=", ":")
        return names and self.begins_line(index)

    def begins_property(self, index: int) -> bool:
        """True if a line begins with a property of another language: ``_Gloss ("Gloss"``."""
        kinds = [self._kind(index + step) for step in range(3)]
        return kinds == ["NAME", "(", "STRING"] and self.begins_line(index)

    def begins_line(self, index: int) -> bool:
        """True if a token is the first of its line."""
        if index == 0 or index >= len(self.tokens):
            return True
        before = self.tokens[index - 1].end
        return "\n" in self.text[before : self.tokens[index].start]

    def can_end(self, index: int) -> bool:
        """True if an expression or declaration can end with the token at ``index``."""
        token = self.tokens[index]
        return token.kind in _CAN_END and token.text not in _AWAITS_NAME

    def _is_in_head(self, index: int) -> bool:
        """True if a name ends the head of a loop, like ``m`` in ``sum i in 0..n up to m : i``."""
        before = self._text_of(index - 1) if index else ""
        ends = before in _AWAITS_VALUE and self._text_of(index + 1) == ":"
        return ends and not self.begins_line(index)

    def _may_follow(self, index: int) -> bool:
        return index == 0 or self.can_end(index - 1)

    def _kind(self, index: int) -> str:
        return self.tokens[index].kind if index < len(self.tokens) else ""

    def _split(self) -> None:
        named_until = 0
        for index, (kind, word, _, _) in enumerate(self.tokens):
            # Brackets count for the tokens between them: an opening one has the depth outside.
            if kind in _CLOSED_BY:
                self.depths.append(len(self._open))
                self._enter(index)
                continue
            if kind in _CLOSERS:
                self._leave(index, kind)
            elif kind == "NAME" and index >= named_until:
                # A member that begins within parentheses shows that these were never closed; a
                # declaration shows it for braces, too (``_begin``).
                header = self._header(index) if word in DECLARATIONS else 0
                if self._open and not header and self._ends_parentheses(index):
                    self._abandon_open(index, down_to="{")
                # The names of a header cannot begin another declaration.
                if header or (not self._open and self._begins_constant(index)):
                    self._begin(index)
                    named_until = index + max(header, 1)
            self.depths.append(len(self._open))
        # At the end of the file, brackets that are still open are errors of their chunks.
        self._abandon_open(len(self.tokens))
        self.depths.append(0)
        for chunk in self.chunks:
            chunk.end = chunk.end or len(self.tokens)
            chunk.unclosed.sort()

    def _begins_constant(self, index: int) -> bool:
        """True if an equation of the file begins here, and no further type parameter."""
        before = self._text_of(index - 1) if index else ""
        is_placed = self._text_of(index + 1) == ":" and self._text_of(index + 3) == "("
        begins = self.begins_member(index) and before not in (",", *MEMBERS)
        return begins and not is_placed  # `cbuffer Name : register(b0)`, as elsewhere.

    def _header(self, index: int) -> int:
        """The number of tokens of a declaration's word and name; 0 where the word is a name."""
        word = self.tokens[index].text
        if self._kind(index + 1) in ("=", ":"):
            return 0
        in_line = not self.begins_line(index)
        if word == "import" and in_line and self._text_of(self.chunks[-1].start) == "from":
            return 0  # `from file import name`, as elsewhere.
        length = 3 if word in TWO_WORDS else 2
        if not self._open and self._may_follow(index):
            return 1 if self._is_unfinished(index) else length
        complete = (
            self._kind(index + length - 1) == "NAME"
            and self._text_of(index + length - 1) != "in"
            and self._text_of(index + length) in HEADER_ENDS
        )
        fits = self._may_follow(index) or self._is_at_margin(index)
        return length if complete and fits else 0

    def _is_unfinished(self, index: int) -> bool:
        """True if a declaration's word is followed by another declaration instead of a name."""
        return (
            self._text_of(index + 1) in DECLARATIONS.keys() - TWO_WORDS
            and self._is_at_margin(index + 1)
            and self._kind(index + 2) == "NAME"
        )

    def _text_of(self, index: int) -> str:
        return self.tokens[index].text if index < len(self.tokens) else ""

    def _is_at_margin(self, index: int) -> bool:
        """True if the token is the first of an unindented line."""
        start = self.tokens[index].start
        return start == 0 or self.text[start - 1] == "\n"

    def _ends_parentheses(self, index: int) -> bool:
        """True if a member begins here, although parentheses are still open."""
        following = self._kind(index + 1)
        starts_member = following == "NAME" and self.tokens[index].text in MEMBERS
        if not (following == "=" or starts_member) or self.tokens[self._open[-1]].kind == "{":
            return False
        if self._text_of(index - 1) in ("(", ","):
            return False  # An argument that is given by its name.
        if self._is_in_formals() and not self.begins_line(index):
            return False  # The type of an argument with a default.
        if self._text_of(self._open[-1] - 1) == "for" and not self.begins_line(index):
            return False  # A loop's head, as elsewhere.
        return following == "=" or self._may_follow(index)

    def _is_in_formals(self) -> bool:
        """True in the parentheses behind the name of a function, or behind its type parameters."""
        start, opener = self.chunks[-1].start, self._open[-1]
        is_first = opener == start + 2 or self._text_of(opener - 1) == ">"
        return is_first and self._text_of(start) in ("fn", "term")

    def _begin(self, index: int) -> None:
        """Begin a declaration here, even if brackets are still open."""
        self._abandon_open(index)
        if index > self.chunks[-1].start:
            self.chunks[-1].end = index
            self.chunks.append(Chunk(index))

    def _enter(self, index: int) -> None:
        self._open.append(index)
        if len(self._open) > NESTING_LIMIT and self.chunks[-1].too_deep is None:
            self.chunks[-1].too_deep = index

    def _leave(self, index: int, closer: str) -> None:
        """Closes the innermost bracket of this kind; a brace also closes those inside it."""
        if self._open and _CLOSED_BY[self.tokens[self._open[-1]].kind] == closer:
            self._open.pop()
            return
        kinds = [self.tokens[opener].kind for opener in self._open[-NESTING_LIMIT:]]
        while kinds and _CLOSED_BY[kinds[-1]] != closer:
            if kinds[-1] == "{":
                return
            kinds.pop()
        if not kinds:
            return
        while _CLOSED_BY[self.tokens[self._open[-1]].kind] != closer:
            self._abandon(self._open.pop(), index)
        self._open.pop()

    def _abandon_open(self, index: int, down_to: str = "") -> None:
        """Give up the open brackets: all of them, or those inside of the innermost ``down_to``."""
        while self._open and self.tokens[self._open[-1]].kind != down_to:
            self._abandon(self._open.pop(), index)

    def _abandon(self, opener: int, index: int) -> None:
        """Record that ``opener`` is never closed: tokens up to ``index`` are not inside of it."""
        chunk = self.chunks[-1]
        chunk.unclosed.append(opener)
        if self.tokens[opener].kind != "{" and chunk.too_deep is None:
            for inner in range(opener + 1, min(index, len(self.depths))):
                self.depths[inner] -= 1
