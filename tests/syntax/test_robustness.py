"""No text makes the parser raise, and none takes long."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.syntax.lalr_tables import load_tables
from burnish.compiler.syntax.parser import parse

from .dump import messages, parsed

WORDS = sorted(load_tables().literals)
OTHERS = [
    "a",
    "b",
    "1",
    "2.5",
    "#fff",
    '"x"',
    "/// doc\n",
    "//! doc\n",
    "\n",
    "&&",
    "1.0f",
    "ä",
    "\0",
]

FOREIGN = [
    "f", "main", "float", "vec3", "float3", "f32", "x", "M", "?", ":", "sum", "i", "in", "(",
    ")", "{", "}", "[", "]", "0", "..", "4", "-", "to", "if", "else", "return", "let", "var",
    "const", "inout", "out", "fn", "->", "=", ";", ",", "array", "<", ">", "layout", "uniform",
    "extends", "discard", "material", "@", "fragment", "group", "struct", "param", "term",
    "{1,", "float[](", "float[2](", "#version", "\n",
]  # fmt: skip
"""The words of functions, choices, loops and arrays in other languages."""


@given(
    st.lists(st.sampled_from(WORDS + OTHERS), max_size=40)
    | st.lists(st.sampled_from(FOREIGN), max_size=60)
)
def test_token_soup_is_reported_not_raised(words: list[str]) -> None:
    report = Report()
    text = " ".join(words)
    parse(Source("soup", text), report)
    assert isinstance(render_all(report.diagnostics), str)
    for edit in (e for found in report.diagnostics for fix in found.fixes for e in fix.edits):
        assert 0 <= edit.span.start <= edit.span.end <= len(text)


CHOICES = """
fn f(x: float) -> float = if x == 0 then (1 + [2, 3][0]) else if x == 1 { 2 } else 3
material M {
    color = if (uv.x < 0.5) #fff else #000
    a : float = if uv.x is 2 then g(if true then 1 else 2) else if x elif 3
}
rig R { sun : Directional { diffuse_color = if 1 then 2 else vec3(if 3) } }
"""
EXAMPLES = Path(__file__).parents[2] / "examples"
WHOLE = [
    CHOICES,
    *(
        (EXAMPLES / name).read_text("utf-8")
        for name in ("plastic.burnish", "cube_map.burnish", "frames/glow.burnish")
    ),
]


@pytest.mark.parametrize("whole", WHOLE, ids=["choices", "plastic", "cube_map", "glow"])
def test_a_text_that_ends_anywhere_is_reported_not_raised(whole: str) -> None:
    """So it is while somebody types it."""
    for end in range(len(whole)):
        if whole[end : end + 1].isspace():
            report = Report()
            parse(Source("begun", whole[:end]), report)
            assert isinstance(render_all(report.diagnostics), str)


@given(st.text(max_size=60))
def test_any_text_is_reported_not_raised(text: str) -> None:
    report = Report()
    parse(Source("any", text), report)
    assert isinstance(render_all(report.diagnostics), str)


@given(st.floats(0, allow_infinity=False), st.integers(0))
def test_numbers_come_through_as_written(number: float, integer: int) -> None:
    file = parsed(f"a = {number!r}\nb = {integer}u")
    texts = [declaration.value.text for declaration in file.declarations]  # type: ignore[union-attr]
    assert texts == [repr(number), str(integer)]


@pytest.mark.parametrize(
    "expression",
    [
        " + ".join(["x"] * 50_000),
        "- " * 10_000 + "1",
        "if a then b else " * 5_000 + "c",
        "@vertex " * 5_000 + "c",
        "(" * 200 + "1" + ")" * 200,
    ],
    ids=["sum", "minus", "if", "vertex", "parentheses"],
)
def test_long_texts_parse(expression: str) -> None:
    assert len(parsed(f"a = {expression}").declarations) == 1


@pytest.mark.parametrize("text", ["(" * 10_000 + "1" + ")" * 10_000, "[" * 100_000, "{(" * 5_000])
def test_deep_nesting_is_refused(text: str) -> None:
    assert messages(f"a = {text}") == ["brackets are nested too deeply: more than 200"]


def test_every_broken_member_is_reported_and_the_others_kept() -> None:
    report = Report()
    body = "\n".join(f"bad{i} = = 1\ngood{i} = 2" for i in range(50))
    file = parse(Source("x", f"material M {{\n{body}\n}}\nrig R {{}}"), report)
    assert len(report.diagnostics) == 50
    record, _ = file.declarations
    assert len(record.members) == 50  # type: ignore[union-attr]
