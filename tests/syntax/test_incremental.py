"""After any edit, a file that is parsed by its sections is as if it were parsed at once."""

from __future__ import annotations

import pickle
import random
import re
import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pytest

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.library import FOLDER
from burnish.compiler.syntax import ast, incremental, parser, stored
from burnish.compiler.syntax.incremental import KnownSections
from burnish.compiler.syntax.lalr_tables import load_tables
from burnish.compiler.syntax.outline import Chunk
from burnish.compiler.syntax.sections import Section, sections

from ..suite.processes import at_once

ROOT = Path(__file__).parent.parent.parent
PROGRAMS = [
    path.read_text(encoding="utf-8")
    for folder in (ROOT / "examples", FOLDER, Path(__file__).parent / "broken")
    for path in sorted(folder.rglob("*.burnish"))
]
PIECES = [
    *sorted(load_tables().literals), "a", "output", "1", "2%", "5.", "#fff", "#1", '"', '"x"', "'",
    "/*", "*/", "// note", "/// doc", "//! doc", "\n", "\r\n", "\r", " ", "\t", "\ufeff", "ä", "π",
    "\u2028", "\x0c", "\0", "<<<<<<< a", "=======", "\n=======", ">>>>>>> b", "#define X", "&&",
    "burnish 1", "\nabstract material A {", "\nfn f(", "\nfn", "\nterm t(x: float) per", "\nx = y",
    "\nspace output", "\nextern block", "\nmixin M for", "\nmaterial\n", "\nimport", "\nrig R : ",
    "\nstruct S <", "from", "\nfn f() = 1 as output\n", "\n/// doc\n/* note */\n",
    "sum i in 0..n : ", "::", "\n\u2028\n", "\n/*\n", "\n// */\n", "\n// */ a\n",
    "\n/// doc\n\n// note\n", "f(x, width = 2)", "(\n    width = 2,\n", "(x: float = 1)",
]  # fmt: skip
"""Texts that edits insert: all words and marks, broken ones, and beginnings of declarations."""


@pytest.fixture(autouse=True)
def known(monkeypatch: pytest.MonkeyPatch) -> KnownSections:
    """The memory of this test."""
    known = KnownSections()
    monkeypatch.setattr(incremental, "KNOWN_SECTIONS", known)
    return known


@pytest.fixture
def read(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The texts of sections that are parsed."""
    texts: list[str] = []
    real = parser.parse_section

    def noted(source: Source, section: Section) -> parser.Part | None:
        texts.append(source.text[section.start : section.end])
        return real(source, section)

    monkeypatch.setattr(incremental, "parse_section", noted)
    return texts


def differences(one: object, other: object) -> Iterator[tuple[object, object]]:
    """Parts in which two trees differ, spans included."""
    pending = [(one, other)]
    while pending:
        left, right = pending.pop()
        fields: tuple[str, ...] = getattr(type(left), "__match_args__", ())
        if type(left) is not type(right):
            yield left, right
        elif isinstance(left, tuple) and isinstance(right, tuple):
            if len(left) != len(right):
                yield left, right
            pending += zip(left, right, strict=False)
        elif fields and not isinstance(left, Source):
            pending += [(getattr(left, name), getattr(right, name)) for name in fields]
        elif left != right:
            yield left, right


def agree(text: str) -> bool:
    """Compares both ways to parse a text; returns whether it has no mistake."""
    source = Source("test.burnish", text)
    first, again = Report(), Report()
    expected, found = parser.parse(source, first), incremental.parse(source, again)
    assert next(differences(expected, found), None) is None, text
    assert render_all(again.diagnostics) == render_all(first.diagnostics), text
    assert again.diagnostics == first.diagnostics, text
    assert again.unread_names == first.unread_names, text
    return not first.diagnostics


def learn(text: str) -> None:
    """Has a text remembered: it is when it is read for the second time."""
    for _ in range(2):
        assert agree(text)


class Editor:
    """Edits a text at random, often where one of its sections begins."""

    def __init__(self, seed: int) -> None:
        self._chance = random.Random(seed)
        self._text = self._chance.choice(PROGRAMS)

    def edit(self) -> str:
        """The text after one more edit, or several; every now and then another text."""
        chance = self._chance
        if chance.random() < 0.08:
            self._text = chance.choice(PROGRAMS)
        edits = {
            self._insert: 4, self._delete: 3, self._replace: 3, self._move: 2, self._repeat: 2,
            self._endings: 1, self._number: 5, self._blank: 3,
        }  # fmt: skip
        before = self._text
        for _ in range(chance.choice((1, 1, 1, 2, 3))):
            chance.choices(list(edits), list(edits.values()))[0]()
        after = self._text
        if chance.random() < 0.85:  # Most mistakes are mended at once.
            self._text = before
        return after

    def _place(self) -> int:
        chance, text = self._chance, self._text
        if chance.random() < 0.4:
            borders = [place for each in sections(text) for place in (each.start, *each.ahead)]
            return min(max(chance.choice(borders) + chance.randint(-2, 2), 0), len(text))
        return chance.choice((0, len(text), *[chance.randint(0, len(text)) for _ in range(8)]))

    def _insert(self) -> None:
        place = self._place()
        self._text = self._text[:place] + self._chance.choice(PIECES) + self._text[place:]

    def _delete(self) -> None:
        place = self._place()
        length = self._chance.choice((1, 1, 2, 5, 20, 100))
        self._text = self._text[:place] + self._text[place + length :]

    def _replace(self) -> None:
        self._delete()
        self._insert()

    def _move(self) -> None:
        """Moves lines, such as those of a whole section."""
        lines = self._text.splitlines(keepends=True)
        start = self._chance.randint(0, len(lines))
        end = start + self._chance.randint(1, 8)
        moved, rest = lines[start:end], lines[:start] + lines[end:]
        place = self._chance.randint(0, len(rest))
        self._text = "".join([*rest[:place], *moved, *rest[place:]])

    def _repeat(self) -> None:
        cut = list(sections(self._text))
        one, other = self._chance.choice(cut), self._chance.choice(cut)
        text = self._text
        self._text = text[: other.start] + text[one.start : one.end] + text[other.start :]

    def _number(self) -> None:
        """Gives numbers another value, and often another length."""
        number = f" {self._chance.randint(0, 2000)}"
        self._text = re.sub(
            r"(?<=[=*+,(]) [1-9]\b", number, self._text, count=self._chance.randint(1, 3)
        )

    def _blank(self) -> None:
        """Inserts a line that means nothing."""
        place = self._text.find("\n", self._place()) + 1
        line = self._chance.choice(
            ("\n", "  // Note.\n", "// Note: fn f(\n", "/* x\n y */\n", "\r\n")
        )
        self._text = self._text[:place] + line + self._text[place:]

    def _endings(self) -> None:
        first, last = sorted((self._place(), self._place()))
        part = self._text[first:last].replace("\n", "\r\n")
        self._text = self._text[:first] + part + self._text[last:]


@pytest.mark.parametrize("seed", range(8))
def test_after_any_edits_all_is_as_parsed_at_once(seed: int, read: list[str]) -> None:
    editor = Editor(seed)
    right = 0
    for _ in range(60):
        right += agree(editor.edit())
    assert right > 3, "too few texts are right to say anything"
    assert read


def test_all_programs_are_as_parsed_at_once() -> None:
    for _ in range(2):
        assert sum(map(agree, PROGRAMS)) > 100


TEXT = """burnish 1
import std.terms.{lambert}

/// Rough.
material First : Surface {
    rough = 0.5
}

fn half(x: float) -> float = x / 2

// A note.
/// Shiny.
material Second : First { rough = half(1) }
"""


def test_only_changed_sections_are_parsed(read: list[str]) -> None:
    agree(TEXT)
    assert "".join(read) == TEXT
    assert [text.split("\n")[1] for text in read] == [
        "import std.terms.{lambert}",
        "/// Rough.",
        "fn half(x: float) -> float = x / 2",
        "// A note.",
    ]
    agree(TEXT)
    assert "".join(read) == 2 * TEXT, "most texts are read once, and are not worth remembering"
    read.clear()
    agree(TEXT)
    assert not read
    agree(TEXT.replace("0.5", "vec3(0.25,\n 1, 2).x"))
    assert [text.split("\n")[1] for text in read] == ["/// Rough."]
    read.clear()
    agree("// A license.\n" + TEXT)
    assert [text.split("\n")[0] for text in read] == ["// A license."]


def test_sections_may_change_places(read: list[str]) -> None:
    learn(TEXT)
    read.clear()
    head, first, half, second = (TEXT[each.start : each.end] for each in sections(TEXT))
    assert agree(head + first + half + first + half + second)
    assert read == [half], "one is followed by another header than before"


def test_a_mistake_costs_only_its_declaration(
    read: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """And what stands in front of the first header."""
    parsed: list[str] = []
    real = parser._Parser.parse

    def noted(self: parser._Parser, chunk: Chunk) -> object:
        parsed.append(self._tokens[chunk.start].text)
        return real(self, chunk)

    learn(TEXT)
    read.clear()
    broken = TEXT.replace("x / 2", "(x / 2")
    for _ in range(2):
        assert not agree(broken)
    assert len(read) == 2
    assert not agree(broken)
    assert len(read) == 2, "a section that was wrong is wrong"
    monkeypatch.setattr(parser._Parser, "parse", noted)
    incremental.parse(Source("a", broken), Report())
    assert parsed == ["burnish", "import", "fn"]
    assert agree(TEXT)
    assert len(read) == 2, "the others are still known"


@pytest.mark.parametrize("closing", ["", "// */\n", "// */ a\n", "/// */\n", ">>>>>>> b\n", "}\n"])
@pytest.mark.parametrize(
    "opening", ["", "/*\n", "/// a\n/* b */\n", "=======\n", "\u2028\n", "fn\n"]
)
def test_what_reaches_from_one_section_into_another(opening: str, closing: str) -> None:
    agree(TEXT)
    borders = sorted({place for each in sections(TEXT) for place in (each.start, each.ahead[0])})
    for number, first in enumerate(borders):
        for last in borders[number:]:
            agree(TEXT[:first] + opening + TEXT[first:last] + closing + TEXT[last:])


def test_trees_are_nobody_elses() -> None:
    """Two files never have a node in common: nodes are compared by identity."""
    files = [incremental.parse(Source("a", TEXT), Report()) for _ in range(3)]
    found = {id(each) for file in files for each in file.declarations}
    assert len(found) == sum(len(file.declarations) for file in files)
    assert all(each.span.source is file.source for file in files for each in file.declarations)


def function(text: str) -> ast.Function:
    """The function of ``TEXT``, of a section that is remembered."""
    agree(text)
    file = incremental.parse(Source("a", text), Report())
    (found,) = (each for each in file.declarations if isinstance(each, ast.Function))
    return found


def test_all_threads_get_the_same_body() -> None:
    made = function(TEXT)
    bodies = at_once([lambda: made.body] * 8)
    assert len(set(bodies)) == 1 and isinstance(made.body, ast.Binary)


def test_a_body_that_was_not_made_in_time_is_made_later(monkeypatch: pytest.MonkeyPatch) -> None:
    learn(TEXT)
    made = function(TEXT)
    with monkeypatch.context() as patch:
        patch.setattr(stored, "_Unpickler", Ended)
        with pytest.raises(KeyboardInterrupt):
            _ = made.body
    assert isinstance(made.body, ast.Binary)


class Ended:
    """Is interrupted at once."""

    def __init__(self, *_: object) -> None:
        raise KeyboardInterrupt


def test_what_a_declaration_does_not_have_is_not_made() -> None:
    assert not hasattr(function(TEXT), "members")


def test_declarations_that_were_not_looked_into_are_copied_whole() -> None:
    copied = pickle.loads(pickle.dumps(function(TEXT)))
    assert isinstance(copied.body, ast.Binary)


def test_deep_expressions_are_parsed_each_time(known: KnownSections) -> None:
    deep = f"fn f(x: float) = {'- ' * 20_000}x\n"
    report = Report()
    for _ in range(2):
        file = incremental.parse(Source("a", TEXT + deep), report)
        assert len(file.declarations) == 5
    assert not report.diagnostics
    assert known.find([(deep, "")]) == [None]


def test_raised_limits_of_recursion_do_not_exhaust_the_stack() -> None:
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(1_000_000)
    try:
        file = incremental.parse(Source("a", f"a = {'x + ' * 60_000}x\n"), Report())
    finally:
        sys.setrecursionlimit(limit)
    (constant,) = file.declarations
    assert isinstance(constant, ast.Constant)


def test_the_memory_has_a_limit(read: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(incremental, "KNOWN_SECTIONS", KnownSections(most=3_000))
    for number in range(20):
        learn(TEXT.replace("0.5", f"{number}"))
    read.clear()
    assert agree(TEXT.replace("0.5", "19"))
    assert not read, "what was used last is known"
    agree(TEXT.replace("0.5", "3"))
    assert len(read) == 1, "what was used long ago is not"


def test_threads_share_the_memory() -> None:
    def work(seed: int) -> int:
        editor = Editor(seed)
        return sum(agree(editor.edit()) for _ in range(15))

    assert sum(at_once([partial(work, seed) for seed in range(100, 104)])) > 0
