"""The grouping of expressions, and the values of literals."""

from __future__ import annotations

import pytest

from .dump import expression


@pytest.mark.parametrize(
    ("text", "meaning"),
    [
        ("a + b * c", "(a + (b * c))"),
        ("a - b - c", "((a - b) - c)"),
        ("a / b mod c", "((a / b) mod c)"),
        ("(a + b) * c", "((a + b) * c)"),
        ("-a * b", "((- a) * b)"),
        ("- -a", "(- (- a))"),
        ("a & b == c", "((a & b) == c)"),
        ("a | b ^ c & d", "(a | (b ^ (c & d)))"),
        ("a & b + 1 << c", "(a & ((b + 1) << c))"),
        ("a >> 1 << 2", "((a >> 1) << 2)"),
        ("~a & -b", "((~ a) & (- b))"),
        ("a | b < c and d", "(((a | b) < c) and d)"),
        ("-a.x", "(- a.x)"),
        ("not a == b", "(not (a == b))"),
        ("a or b and not c", "(a or (b and (not c)))"),
        ("a < b and b >= c", "((a < b) and (b >= c))"),
        (
            "if a then b else if c then d else e + f",
            "(if a then b else (if c then d else (e + f)))",
        ),
        ("1 + (if a then b else c)", "(1 + (if a then b else c))"),
        ("@vertex normalize(n).x * 2", "((@vertex normalize(n).x) * 2)"),
        ("-@vertex -a", "(- (@vertex (- a)))"),
        ("sum i in 0..n - 1 : f(i) + 1", "(sum i in 0..(n - 1) : (f(i) + 1))"),
        ("product i in -1..2 : i", "(product i in (- 1)..2 : i)"),
        ("a[0].x[i](uv).rgb", "a[0].x[i](uv).rgb"),
        ("f(a, b,)", "f(a, b)"),
        ("f()", "f()"),
        ("a + f(b) with { n = c, m = d e = 1; }", "(a + (f(b) with {n = c, m = d, e = 1}))"),
        ("a with {} with { b = c }", "((a with {}) with {b = c})"),
    ],
)
def test_grouping(text: str, meaning: str) -> None:
    assert expression(text) == meaning


@pytest.mark.parametrize(
    ("text", "meaning"),
    [
        ("2", "2"),
        ("7u", "7u"),
        ("0x1F", "0x1F"),
        ("0XdeadBEEFu", "0XdeadBEEFu"),
        (".5", ".5"),
        ("1e-3", "1e-3"),
        ("1e400", "1e400"),
        ("30deg", "30deg"),
        ("0.5rad", "0.5rad"),
        ("#f80", "color(255, 136, 0)"),
        ("#b5651d", "color(181, 101, 29)"),
        ("#B5651D80", "color(181, 101, 29, 128)"),
        ("true", "true"),
        ("false", "false"),
    ],
)
def test_literals(text: str, meaning: str) -> None:
    assert expression(text) == meaning


@pytest.mark.parametrize("bounds", ["1..512", "1 .. 512", ".5...5", "0.5..1e3", "1e3..2"])
def test_a_range_is_no_decimal_point(bounds: str) -> None:
    start, end = (".5", ".5") if bounds == ".5...5" else bounds.split("..")
    shown = f"(sum i in {start.strip()}..{end.strip()} : i)"
    assert expression(f"sum i in {bounds} : i") == shown


@pytest.mark.parametrize(
    "word",
    [
        "light",
        "material",
        "pass",
        "param",
        "map",
        "target",
        "attribute",
        "discard",
        "when",
        "with",
        "blend",
        "per",
        "in",
        "sum",
        "product",
        "abstract",
        "rig",
        "struct",
        "space",
        "fn",
        "term",
        "import",
        "burnish",
        "base",
        "group",
        "filter",
        "vertex",
    ],
)
def test_words_of_the_grammar_are_names_in_expressions(word: str) -> None:
    assert expression(f"{word}.x * {word} + f({word})[{word}]") == (
        f"(({word}.x * {word}) + f({word})[{word}])"
    )
