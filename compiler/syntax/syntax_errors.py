"""Reports syntax errors.

The parser calls ``SyntaxErrors.report`` when the grammar has no place for a token. It decides which
rule is broken, which token is to blame, and where parsing can go on.
"""

from __future__ import annotations

from bisect import bisect_left

from ..diagnostics import rules
from ..diagnostics.diagnostic import Label, Report
from ..diagnostics.fixes import Hint, fix_it
from ..diagnostics.source import Source, Span
from .advice import Advice
from .ast import MEMBERS, RECORD_KINDS
from .expectations import describe_expected, describe_found, may_begin_member
from .foreign_choices import STATEMENTS, statement_hint
from .foreign_syntax import types
from .forms import DECLARATIONS, FOLDS, FOREIGN_FILES
from .lalr_tables import END
from .outline import NESTING_LIMIT, Chunk, Outline
from .tokens import RESERVED, Token

_COMPARISONS = frozenset(("==", "!=", "<", "<=", ">", ">="))
_CLOSED_BY = {"(": ")", "[": "]", "{": "}"}


class SyntaxErrors:
    """Reports one syntax error at a time."""

    def __init__(self, source: Source, outline: Outline, report: Report) -> None:
        self._source = source
        self._outline = outline
        self._tokens = outline.tokens
        self._report = report
        self._advice = Advice(outline, source)

    def too_deep(self, index: int) -> None:
        """Report brackets that are nested more deeply than the limit."""
        self._report.add(rules.TOO_NESTED, self._span(self._tokens[index]), limit=NESTING_LIMIT)

    def foreign(self, first: Token) -> None:
        """Report a file of another kind, such as JSON, of which nothing can be read."""
        hint = f"{FOREIGN_FILES[first.kind]}: a Burnish file consists of declarations, such as "
        self._unexpected(first, {"material"}, f"{hint}`material Name {{ … }}`")

    def report(self, index: int, chunk: Chunk, expected: set[str], start: int) -> int:
        """Reports the error at ``index``; returns where the next member may begin.

        ``start`` is the first token of the part that cannot be read.
        """
        found = self._token(index)
        if found.kind == "FOREIGN":
            return index
        opener = self._unclosed_before(index, chunk)
        interrupted = self._equation_interrupts(index, chunk)
        if opener is not None:
            before = index - (interrupted or self._next_has_begun(index))
            self._unclosed(opener, self._token(before))
            return before
        if interrupted:
            return self._interrupted(index, chunk)
        if self._special(index, found, expected):
            return index
        if word := self._advice.misspelt(index, expected, start, chunk.start):
            words = set(DECLARATIONS if start == chunk.start else MEMBERS)
            slip = self._tokens[index - 1]
            hint = fix_it(f"did you mean `{word}`?", (self._span(slip), word))
            self._unexpected(slip, words, hint)
            return index
        self._unexpected(found, expected, self._advice.at(index, expected, start, chunk.start))
        return self._end_of_line(index) if found.kind in ("@", "[") else index

    def _end_of_line(self, index: int) -> int:
        """The last token of a line: a foreign attribute is skipped together with its line."""
        while index + 1 < len(self._tokens) and not self._outline.begins_line(index + 1):
            index += 1
        return index

    def _interrupted(self, index: int, chunk: Chunk) -> int:
        """Reports an equation that begins in an unfinished value, or after a header without `{`.

        Returns where the next member may begin.
        """
        name, before = self._tokens[index - 1], self._tokens[index - 2]
        if (behind := self._advice.behind_comparison(index)) is not None:
            self._unexpected(self._tokens[index], {"then", "+"}, self._advice.of_comparison(index))
            return behind
        if before.kind == ":" and chunk.start + 3 == index - 1 and self._is_record(chunk.start):
            header = " ".join(token.text for token in self._tokens[chunk.start : index - 2])
            self._unexpected(name, {"{"}, f"the members need braces: `{header} {{ … }}`")
            return index - 1
        if before.text == "blend":
            self._unexpected(name, {"{"}, self._advice.of_blending(index - 1))
            return self._advice.behind_settings(index - 1)
        over = self._token(index - 3).kind == "NAME" and before.text == "in"
        hint = "a fold counts numbers, `sum i in a..b : e`; a `term … per light` sums over lights"
        self._unexpected(name, {"NUMBER", "NAME"}, hint if over else "")
        return index - 1

    def _is_record(self, index: int) -> bool:
        return self._tokens[index].text in (*RECORD_KINDS, "mixin")

    def _special(self, index: int, found: Token, expected: set[str]) -> bool:
        """Report a mistake that has a rule of its own; returns whether there was one."""
        span = self._span(found)
        if self._names_types(index) and "and" in expected:
            self._unexpected(found, expected, self._without_types(index))
        elif found.kind in _COMPARISONS and "and" in expected and found.kind not in expected:
            self._report.add(rules.CHAINED_COMPARISON, span)
        elif self._begins_statement(index, expected):
            self._reserved(index, expected)
        elif found.kind == "if" and "NUMBER" in expected:
            self._report.add(rules.UNPARENTHESISED, span, word=found.text)
        elif self._fold_before(index) and (fold := self._tokens[index - 1]):
            self._report.add(rules.UNPARENTHESISED, self._span(fold), word=fold.text)
        elif found.text == "in" and self._fold_before(index - 1):
            fold = self._tokens[index - 2]
            self._report.add(rules.UNPARENTHESISED, self._span(fold), word=fold.text)
        else:
            return False
        return True

    def _reserved(self, index: int, expected: set[str]) -> None:
        """Report a reserved word as the name of something, or as the beginning of a statement."""
        word = self._tokens[index]
        hint: Hint = ""
        if self._token(index + 1).kind in ("=", ":"):
            other = f"{word.text}_"
            hint = fix_it(f"give it another name, such as `{other}`", (self._span(word), other))
        elif word.kind in STATEMENTS and may_begin_member(expected):
            self._unexpected(word, expected, statement_hint(self._advice, index))
            return
        self._report.add(rules.RESERVED_WORD, self._span(word), word=word.text, hint=hint)

    def _begins_statement(self, index: int, expected: set[str]) -> bool:
        """True if a reserved word stands where only a name or a member can."""
        if self._token(index).kind not in RESERVED or "NAME" not in expected:
            return False
        begins = may_begin_member(expected) and self._outline.begins_line(index)
        return begins or not expected & {"NUMBER", "+"}

    def _names_types(self, index: int) -> bool:
        """True if a call that names types, as in ``vec3<f32>(x)``, was read as a comparison."""
        called, opening, _, closing, call = (self._token(index + step) for step in range(-3, 2))
        kinds = [called.kind, opening.kind, closing.kind, call.kind]
        return kinds == ["NAME", "<", ">", "("] and called.end == opening.start

    def _without_types(self, index: int) -> Hint:
        """The call without the types that it names."""
        called, type_ = self._token(index - 3).text, self._token(index - 1).text
        name = types().get(f"{called}{type_[:1]}", called)
        span = self._span(self._token(index - 3)).to(self._span(self._token(index)))
        return fix_it(f"a call does not name types: write `{name}(…)`", (span, name))

    def _unexpected(self, found: Token, expected: set[str], hint: Hint = "") -> None:
        words = describe_expected(expected)
        self._report.add(
            rules.UNEXPECTED,
            self._span(found),
            expected=words,
            found=describe_found(found),
            caption=f"expected {words}",
            hint=hint,
        )

    def _unclosed(self, opener: int, found: Token) -> None:
        bracket = self._tokens[opener].kind
        where = "here" if found.kind == END else "before this"
        label = Label(self._span(found), f"expected `{_CLOSED_BY[bracket]}` {where}")
        span = self._span(self._tokens[opener])
        self._report.add(rules.UNCLOSED, span, labels=[label], opening=bracket)

    def _unclosed_before(self, index: int, chunk: Chunk) -> int | None:
        """The open bracket to blame for an error at ``index``, if any.

        Parentheses are to blame for errors in their own member, braces for a missing end.
        """
        position = bisect_left(chunk.unclosed, index) - 1
        if index == chunk.end:
            while position >= 0 and self._tokens[chunk.unclosed[position]].kind != "{":
                position -= 1
        if position < 0:
            return None
        opener = chunk.unclosed[position]
        if index < chunk.end and not self._same_member(opener, index):
            return None
        return chunk.unclosed.pop(position)

    def _same_member(self, opener: int, index: int) -> bool:
        """True if no other member begins between a parenthesis and an error.

        What stands behind a comma may also be an argument that is given by name.
        """
        begins = self._outline.begins_member
        return self._tokens[opener].kind != "{" and not any(
            begins(between) and self._tokens[between - 1].kind != ","
            for between in range(opener + 1, index - 1)
        )

    def _fold_before(self, index: int) -> bool:
        """True if the name at ``index`` is the variable of a fold that begins before it."""
        if index < 1 or self._token(index).kind != "NAME":
            return False
        word, follows = self._tokens[index - 1].text, self._token(index + 1).text
        before = self._tokens[index - 2].text if index > 1 else ""
        is_fold = FOLDS.get(word) == follows
        return is_fold and before not in ("=", "(", ",", ":", "then", "else", "[")

    def _equation_interrupts(self, index: int, chunk: Chunk) -> bool:
        """True if an unfinished expression ran into the next equation: ``a = 1 +  b = 2``."""
        if not self._next_has_begun(index) or self._outline.can_end(index - 2):
            return False
        before = self._tokens[index - 2].text
        if before == "{" and self._opens_body(index - 2, chunk):
            return False
        return before not in ("(", ",", ":", "{") or self._outline.begins_line(index - 1)

    def _opens_body(self, index: int, chunk: Chunk) -> bool:
        """True if a brace is the first one of its declaration, behind which members stand."""
        return all(token.kind != "{" for token in self._tokens[chunk.start : index])

    def _next_has_begun(self, index: int) -> bool:
        """True if the token before ``index`` is the name in front of an equation."""
        if index < 2 or self._token(index).kind not in ("=", ":"):
            return False
        return self._tokens[index - 1].kind == "NAME"

    def _token(self, index: int) -> Token:
        """The token at ``index``; outside of the file one for its end."""
        if 0 <= index < len(self._tokens):
            return self._tokens[index]
        last = self._tokens[-1].end
        return Token(END, "", last, last)

    def _span(self, token: Token) -> Span:
        return Span(self._source, token.start, token.end)
