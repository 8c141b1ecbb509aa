"""Fix-its: hints with edits."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler.diagnostics.fixes import Edit, fix_it, write
from burnish.compiler.diagnostics.nearest import respelling
from burnish.compiler.diagnostics.source import Source, Span
from burnish.compiler.syntax.rewriting import inserted_on_top, rewritten

SOURCE = Source("m.burnish", "color = lenght(a + b)")
NAME = Span(SOURCE, 8, 14)
SUM = Span(SOURCE, 15, 20)


def test_a_fix_says_how_sure_it_is() -> None:
    (sure,) = write(NAME, "length", sure=True).fixes
    (unsure,) = fix_it("perhaps `length`", (NAME, "length")).fixes
    assert sure.edits == unsure.edits == (Edit(NAME, "length"),)
    assert (sure.applicability, unsure.applicability) == ("machine-applicable", "maybe-incorrect")


def test_a_name_is_respelt_where_it_stands() -> None:
    found = respelling("lenght", NAME, ["length"])
    assert found == fix_it("did you mean `length`?", (NAME, "length"))
    assert respelling("lenght", SUM, ["length"]) == "did you mean `length`?"
    assert respelling("lenght", NAME, ["width"]) == ""


def test_an_operand_gets_parentheses_where_something_follows_it() -> None:
    assert rewritten(SUM, "{operand}.x") == fix_it("write `(a + b).x`", (SUM, "(a + b).x"))
    assert rewritten(SUM, "f({text})") == fix_it("write `f(a + b)`", (SUM, "f(a + b)"))


def test_a_long_expression_is_abbreviated_in_the_sentence_only() -> None:
    long = Source("long", " + ".join(["x"] * 40))
    found = rewritten(Span(long, 0, len(long.text)), "f({text})")
    assert found.text == "write `f(…)`"
    assert found.fixes[0].edits[0].text == f"f({long.text})"


@pytest.mark.parametrize(
    ("head", "rest"),
    [
        ("", "material M {}"),
        ("", "/// Of this material\nmaterial M {}"),
        ("burnish 1", "\nmaterial M {}"),
        ("//! A file\n//! of mine", "\n\nmaterial M {}"),
        ("// Hello\nimport std.terms", " // what for\n/// Of it\nmaterial M {}"),
        ("import a.b.{c, d};\nimport \"e.burnish\"", ";\n/* two */ x = 1"),
        ("import std.terms.{\n    lambert,\n}", "\nmaterial M {}"),
    ],
)  # fmt: skip
def test_an_import_is_added_behind_the_others(head: str, rest: str) -> None:
    source = Source("m.burnish", head + rest)
    (fix,) = inserted_on_top("add it", source, "import x").fixes
    (edit,) = fix.edits
    text = source.text[: edit.span.start] + edit.text + source.text[edit.span.end :]
    assert text == (f"{head}\nimport x{rest}" if head else f"import x\n{rest}")


def test_a_library_name_is_imported_by_its_edit() -> None:
    text = "burnish 1\nmaterial M {\n    color = lambert(#fff)\n}\n"
    (found,) = burnish.check(text)
    (edit,) = found.fixes[0].edits
    mended = text[: edit.span.start] + edit.text + text[edit.span.end :]
    assert mended == f"burnish 1\nimport std.terms.{{lambert}}{text.removeprefix('burnish 1')}"
    assert burnish.check(mended) == ()
