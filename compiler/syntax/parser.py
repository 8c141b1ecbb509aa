"""Parses a file, or a section of one, into its syntax tree.

``incremental.py`` and ``library_trees.py`` call ``parse`` for a file. It always returns a tree:
every mistake is reported, none is raised, and the tree lacks the parts that could not be read.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import accumulate, chain
from operator import attrgetter
from typing import TYPE_CHECKING, cast

from ...support.frozen import cached_property, frozen
from ..diagnostics import rules
from ..diagnostics.diagnostic import Diagnostic, Report
from ..diagnostics.source import Source, Span
from . import ast
from .ast import MEMBERS
from .builder import Builder
from .expectations import may_begin_member
from .forms import FOLDS, FOREIGN_FILES
from .lalr_tables import END, load_tables
from .lexer import lex
from .machine import Machine
from .outline import Chunk, Outline
from .sections import Section
from .tokens import Lexed, Token

if TYPE_CHECKING:
    from .syntax_errors import SyntaxErrors

_BODY_PARTS = ("slot", "entry", "field", "extern_member")
_FILE_PARTS = ("record",)
_OF_WORDS = (rules.FOREIGN_OPERATOR, rules.BAD_NUMBER)
"""Rules about single words. Where whole statements are foreign, there are many such words."""

_Content = tuple[int, tuple[ast.Declaration, ...]]
"""The edition that a chunk says, and its declarations."""
_Reused = dict[int, tuple[Section, int, Callable[[], "Part"]]]
"""By the number of the first chunk of a section: the section, the chunk behind it, its content."""


@frozen
class Part:
    """The content of a section in which there is no mistake."""

    edition: int
    doc: Sequence[str]
    """The lines of the file's doc comment that stand in the section."""
    declarations: tuple[ast.Declaration, ...]


@frozen
class Known:
    """A section of a text whose content is known, if it is read alone."""

    section: Section
    header: int
    """The place of its first token."""
    content: Callable[[], Part]


def parse(source: Source, report: Report, known: Iterable[Known] = ()) -> ast.File:
    """The declarations of ``source`` that could be read; ``report`` gets the mistakes.

    The declarations in ``known`` sections are not read again, as far as mistakes elsewhere in the
    text do not reach into them.
    """
    found = Report()
    lexed = lex(source, found)
    outline = Outline(source.text, lexed.tokens)
    if lexed.tokens and lexed.tokens[0].kind in FOREIGN_FILES:
        _syntax_errors(source, outline, report).foreign(lexed.tokens[0])
        return ast.File(source, 1, "", ())
    parser = _parser(source, lexed, outline, found)
    reused = _reused(known, lexed, outline)
    parts = list(_contents(outline.chunks, reused, parser))
    found = _without_skipped(found, parser.skipped)
    if not found.failed:
        sections = [section for section, _, _ in reused.values()]
        for line in _outside(sections, lexed.docs.unclaimed()):
            found.add(rules.STRAY_DOC, Span(source, line.start, line.end))
    report.extend(sorted(found.diagnostics, key=_place))
    report.unreadable(found.diagnostics)
    report.unread(found.unread_names | parser.unread)
    doc = "\n".join(lexed.docs.file)
    return ast.File(source, _edition(parts), doc, _declarations(parts))


def _reused(known: Iterable[Known], lexed: Lexed, outline: Outline) -> _Reused:
    """The known sections that are chunks of their own in the whole text, too, in order.

    Nothing is open where a chunk begins, so these chunks are read as they were alone, if the same
    tokens and comments belong to them.
    """
    chunks, tokens = outline.chunks, lexed.tokens
    numbers = {tokens[chunk.start].start: number for number, chunk in enumerate(chunks)}
    numbers[len(outline.text)] = len(chunks)
    reused: _Reused = {}
    for each in known:
        section = each.section
        first, behind = numbers.get(each.header), numbers.get(section.ahead[0])
        if first is None or behind is None:
            continue
        last = tokens[chunks[behind - 1].end - 1]
        is_whole = lexed.docs.above(each.header) >= section.start and last.end <= section.end
        if is_whole and lexed.is_read(section.start):
            reused[first] = section, behind, each.content
    return reused


def _contents(chunks: Sequence[Chunk], reused: _Reused, parser: _Parser) -> Iterator[_Content]:
    """The content of all chunks."""
    number = 0
    while number < len(chunks):
        if number in reused:
            _, number, content = reused[number]
            part = content()
            yield part.edition, part.declarations
        else:
            yield parser.parse(chunks[number])
            number += 1


def _outside(sections: Sequence[Section], comments: Iterable[Token]) -> Iterator[Token]:
    """The comments that stand in none of some sections, which are in order."""
    starts = [section.start for section in sections]
    for comment in comments:
        before = bisect_right(starts, comment.start)
        if before == 0 or comment.start >= sections[before - 1].end:
            yield comment


def parse_section(source: Source, section: Section) -> Part | None:
    """The content of a section; None if it can only be read together with what is around it.

    So it is if anything in it has to be reported. Sections before it have to be without mistakes.
    """
    found = Report()
    lexed = lex(source, found, section.start, section.end)
    ahead = lex(source, found, *section.ahead).tokens
    outline = Outline(source.text, lexed.tokens + ahead)
    chunks = outline.chunks
    if ahead and chunks.pop().start != len(lexed.tokens):
        return None  # Something of the section reaches over the next header.
    parser = _parser(source, lexed, outline, found)
    parts = [parser.parse(chunk) for chunk in chunks]
    if found.diagnostics or lexed.docs.unclaimed():
        return None
    return Part(_edition(parts), lexed.docs.file, _declarations(parts))


def _parser(source: Source, lexed: Lexed, outline: Outline, report: Report) -> _Parser:
    machine = Machine(load_tables(), Builder(lexed.docs, report), source)
    return _Parser(source, outline, machine, report)


def _edition(chunks: Iterable[_Content]) -> int:
    return max((edition for edition, _ in chunks), default=1)


def _declarations(chunks: Iterable[_Content]) -> tuple[ast.Declaration, ...]:
    return tuple(chain.from_iterable(declarations for _, declarations in chunks))


def _without_skipped(found: Report, skipped: list[range]) -> Report:
    """The findings that do not follow from others.

    Two kinds are left out: foreign words inside text that was skipped because of them, and brackets
    that look unclosed only because an unfinished comment contains their end.
    """
    kept = Report()
    kept.unread(found.unread_names)
    rules_found = {each.rule for each in found.diagnostics}
    skipped = sorted(skipped, key=attrgetter("start"))
    starts = [part.start for part in skipped]
    # Of all parts that begin up to each one, the furthest end.
    ends = [0, *accumulate((part.stop for part in skipped), max)]
    for each in found.diagnostics:
        place = _place(each)
        within = each.rule in _OF_WORDS and place < ends[bisect_right(starts, place)]
        swallowed = each.rule is rules.UNCLOSED and rules.UNFINISHED_COMMENT in rules_found
        if not within and not swallowed:
            kept.extend((each,))
    return kept


def _place(diagnostic: Diagnostic) -> int:
    return diagnostic.span.start if diagnostic.span else 0


def _syntax_errors(source: Source, outline: Outline, report: Report) -> SyntaxErrors:
    from .syntax_errors import SyntaxErrors

    return SyntaxErrors(source, outline, report)


class _Parser:
    """Feeds tokens to the machine. After a mistake it finds a place from which it can go on."""

    def __init__(self, source: Source, outline: Outline, machine: Machine, report: Report) -> None:
        self._source = source
        self._tokens = outline.tokens
        self._outline = outline
        self._machine = machine
        self._report = report
        self.skipped: list[range] = []
        """Parts of the text that were skipped after a mistake."""
        self._given_up = 0
        """Tokens before this one have already been searched for names by ``_give_up``."""
        self.unread: set[str] = set()
        """Names that the unreadable parts may declare, so that nobody reports them as unknown."""

    def parse(self, chunk: Chunk) -> _Content:
        """The edition and the declarations of ``chunk``, without its broken parts."""
        if chunk.too_deep is not None:
            self._errors.too_deep(chunk.too_deep)
            self._give_up(chunk.start, chunk.start + 1, chunk.end)
            return 1, ()
        self._machine.reset()
        index, failed = chunk.start, -1
        while True:
            index = self._machine.run(self._tokens, index, chunk.end, self._symbol)
            if index == chunk.end:
                break
            if self._is_second_word(index):
                self._errors.report(index, chunk, self._machine.expected(), chunk.start)
                self.unread.update(self._words_of_name(index))
                index += 1
            else:
                start = self._start(index)
                begin = self._errors.report(index, chunk, self._machine.expected(), start)
                if start < index == begin and self._tokens[start].text in MEMBERS:
                    begin += not self._outline.begins_line(index)
                failed, index = index, self._next_start(max(begin, failed + 1), chunk)
                self._give_up(start, failed, index)
                if failed < index:
                    self.skipped.append(range(self._tokens[failed].end, self._place(index)))
        self._finish(chunk)
        return cast(_Content, self._machine.result)

    @cached_property
    def _errors(self) -> SyntaxErrors:
        return _syntax_errors(self._source, self._outline, self._report)

    def _is_second_word(self, index: int) -> bool:
        """True if the only mistake in a header is a name of two words; then parsing goes on."""
        is_name = self._tokens[index].kind == "NAME" == self._tokens[index - 1].kind
        follows = index + 1 < len(self._tokens) and self._tokens[index + 1].kind in ("{", ":")
        return is_name and follows and "blend" in self._machine.expected()

    def _words_of_name(self, index: int) -> tuple[str, ...]:
        """Ways in which the rest of the file may spell a name that was written as two words."""
        first, second = self._tokens[index - 1].text, self._tokens[index].text
        return second, first + second, f"{first}_{second}"

    def _symbol(self, index: int) -> str:
        """The grammar's symbol for a name that is a word elsewhere."""
        token = self._tokens[index]
        if self._outline.is_member(index):
            return token.text
        machine = self._machine
        if not machine.knows(token.text) or self._names_something(index):
            return token.kind
        is_operand = not machine.accepts(token.text) and machine.accepts("NUMBER")
        return token.kind if is_operand else token.text

    def _names_something(self, index: int) -> bool:
        """True if the tokens after a word show it to be a name."""
        following = self._tokens[index + 1 : index + 3]
        second = FOLDS.get(self._tokens[index].text)
        if second is not None:
            if self._machine.accepts(self._tokens[index].text) > self._machine.accepts("NAME"):
                return False  # where no expression begins, as behind `scatter bins : uint[256]`
            return [t.kind for t in following[:1]] != ["NAME"] or following[-1].text != second
        return bool(following) and following[0].kind in ("=", ":", ".")

    def _start(self, index: int) -> int:
        """The first token of the member or declaration that cannot be read on at ``index``."""
        start = self._machine.begun(_BODY_PARTS)
        if start is None and not may_begin_member(self._machine.expected()):
            start = self._machine.begun(_FILE_PARTS)
        if start is None:
            return index
        return bisect_left(self._tokens, start, key=attrgetter("start"))

    def _give_up(self, start: int, failed: int, end: int) -> None:
        """Remember the names that the tokens from ``start`` to ``end`` may declare.

        Names before them on the same line count, too.
        """
        while (
            start > self._given_up
            and self._tokens[start - 1].kind == "NAME"
            and self._same_line(start)
        ):
            start -= 1
        self._given_up = min(end, len(self._tokens))
        for index in range(start, min(end + 1, len(self._tokens))):
            if self._tokens[index].kind == "NAME" and (index < end or index <= failed + 1):
                self.unread.add(self._tokens[index].text)

    def _place(self, index: int) -> int:
        """The start of a token, or the end of the file."""
        return self._tokens[index].start if index < len(self._tokens) else self._tokens[-1].end

    def _same_line(self, index: int) -> bool:
        """True if a token stands on the line of the one before it."""
        return not self._outline.begins_line(index)

    def _next_start(self, begin: int, chunk: Chunk) -> int:
        """Drops a broken part, and returns the next token from ``begin`` on that can be read."""
        if not self._machine.unwind(_BODY_PARTS):
            self._machine.unwind(_FILE_PARTS)
            return next(filter(self._follows_statement, range(begin, chunk.end)), chunk.end)
        for index in range(begin, chunk.end):
            depth = self._outline.depths[index]
            begins = self._outline.begins_member(index)
            begins = begins or (index == begin and self._outline.begins_equation(index))
            begins = begins or self._outline.begins_property(index)
            if depth == 0 or (depth == 1 and begins):
                return index
        return chunk.end

    def _follows_statement(self, index: int) -> bool:
        """True if a line begins here, outside of all brackets, after a foreign `;` or a `}`."""
        if self._outline.depths[index] or not self._outline.begins_line(index):
            return False
        if self._tokens[index].kind != "NAME":
            return False
        return self._tokens[index - 1].kind in (";", "}")

    def _finish(self, chunk: Chunk) -> None:
        """End the chunk: a body that was left open is closed as if its brace were there."""
        last = self._tokens[chunk.end - 1].end
        end, brace = Token(END, "", last, last), Token("}", "}", last, last)
        if self._machine.feed(end):
            return
        start = self._start(chunk.end)
        self._errors.report(chunk.end, chunk, self._machine.expected(), start)
        self._give_up(start, chunk.end, chunk.end)
        if not self._machine.feed(brace):
            origins = _BODY_PARTS if self._machine.unwind(_BODY_PARTS) else _FILE_PARTS
            self._machine.unwind(origins)
            self._machine.feed(brace)
        if not self._machine.feed(end):
            self._machine.unwind(_FILE_PARTS)
            self._machine.feed(end)
