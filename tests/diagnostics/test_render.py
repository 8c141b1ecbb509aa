"""Rendered diagnostics, as a reader sees them."""

from __future__ import annotations

import re
from textwrap import dedent

import pytest

from burnish.compiler.diagnostics.diagnostic import Diagnostic, Label, Rule
from burnish.compiler.diagnostics.render import render, render_all
from burnish.compiler.diagnostics.source import Source, Span

RULE = Rule("B9999", "error", "{what}", "What the rule means.")


def finding(
    text: str, marked: str, *, hint: str = "mend it", labels: tuple[Label, ...] = ()
) -> Diagnostic:
    """A diagnostic about the first place where ``text`` has ``marked``."""
    start = text.index(marked)
    span = Span(Source("a.burnish", text), start, start + len(marked))
    return Diagnostic(RULE, "it is wrong", span, "here", labels, hint)


def is_rendered(diagnostic: Diagnostic, expected: str) -> bool:
    assert render(diagnostic) == dedent(expected).strip()
    return True


def test_one_line() -> None:
    assert is_rendered(
        finding("a = 1\nb = tnt * 2\n", "tnt"),
        """
        error[B9999]: it is wrong
         --> a.burnish:2:5
          |
        2 | b = tnt * 2
          |     ^^^ here
          = help: mend it
        """,
    )


def test_several_lines() -> None:
    text = "\n" * 8 + "a = f(1,\n      2,\n      3)\n"
    assert is_rendered(
        finding(text, text.strip()[4:]),
        """
        error[B9999]: it is wrong
          --> a.burnish:9:5
           |
         9 | a = f(1,
           |     ^^^^
        ...
        11 |       3)
           |       ^^ here
           = help: mend it
        """,
    )


def test_labels_here_and_in_another_file() -> None:
    text = "a = 1\n\n\na = 2\n"
    diagnostic = finding(text, "a = 2")
    assert diagnostic.span is not None
    other = Source("b.burnish", "x = 1\n")
    labels = (
        Label(Span(diagnostic.span.source, 0, 1), "first declared here"),
        Label(Span(other, 4, 5), "and this"),
    )
    assert is_rendered(
        finding_with(diagnostic, labels),
        """
        error[B9999]: it is wrong
         --> a.burnish:4:1
          |
        1 | a = 1
          | - first declared here
        ...
        4 | a = 2
          | ^^^^^ here
         ::: b.burnish:1:5
          |
        1 | x = 1
          |     - and this
          = help: mend it
        """,
    )


def finding_with(diagnostic: Diagnostic, labels: tuple[Label, ...]) -> Diagnostic:
    """The diagnostic with labels."""
    return Diagnostic(
        diagnostic.rule,
        diagnostic.message,
        diagnostic.span,
        diagnostic.caption,
        labels,
        diagnostic.hint,
    )


@pytest.mark.parametrize(
    ("line", "shown", "carets"),
    [
        ("\ta\t= tnt", "    a   = tnt", "          ^^^ here"),
        ("a = tnt\r", "a = tnt", "    ^^^ here"),
        ("/* 漢字 */ tnt", "/* 漢字 */ tnt", "           ^^^ here"),
        ("/*\u202e*/ tnt", "/*<U+202E>*/ tnt", "             ^^^ here"),
        ("/*\u2028*/ tnt", "/*<U+2028>*/ tnt", "             ^^^ here"),
        ("/*\x1b[2J*/ tnt", "/*<U+001B>[2J*/ tnt", "                ^^^ here"),
    ],
    ids=["tabs", "crlf", "wide", "bidi", "line separator", "escape"],
)
def test_carets_stand_under_what_they_mean(line: str, shown: str, carets: str) -> None:
    lines = render(finding(f"{line}\nb = 1", "tnt")).split("\n")
    assert lines[3:5] == [f"1 | {shown}", f"  | {carets}"]


def test_long_lines_are_cut_around_the_mark() -> None:
    text = "a = " + "b + " * 100 + "tnt" + " + c" * 100
    excerpt, carets = render(finding(text, "tnt")).split("\n")[3:5]
    assert excerpt.startswith("1 | …")
    assert excerpt.endswith("…")
    assert len(excerpt) < 110
    assert excerpt[carets.index("^") :].startswith("tnt")


def test_the_end_of_the_text_can_be_marked() -> None:
    source = Source("a.burnish", "a =")
    diagnostic = Diagnostic(RULE, "it is wrong", Span(source, 3, 3))
    assert render(diagnostic).split("\n")[4] == "  |    ^"


def test_a_finding_without_place() -> None:
    diagnostic = Diagnostic(RULE, "cannot write\nhere")
    assert render(diagnostic) == (
        "error[B9999]: cannot write<U+000A>here\n  = help: What the rule means."
    )


def test_a_rule_is_explained_once() -> None:
    first, second = Diagnostic(RULE, "one"), Diagnostic(RULE, "two")
    assert render_all([first, second]) == (
        "error[B9999]: one\n  = help: What the rule means.\n\nerror[B9999]: two"
    )


def test_color_adds_nothing_but_codes() -> None:
    diagnostic = finding("b = tnt", "tnt")
    colored = render(diagnostic, color=True)
    assert "\x1b[1;31m" in colored
    assert re.sub(r"\x1b\[[0-9;]*m", "", colored) == render(diagnostic)
