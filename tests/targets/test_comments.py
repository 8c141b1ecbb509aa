"""Comments cannot reach the text that follows them."""

from __future__ import annotations

import unicodedata

import pytest
from hypothesis import given
from hypothesis import strategies as st

from burnish.targets.emit.comments import comment_line, comment_lines

NASTY = [
    "ends in a backslash \\",
    "ends in two \\\\  ", "odd space \\\u00a0", "a\nb", "a\r\nb", "a\u2028b",
    "a\u2029b", "a\x85b", "a\x0bb", "a\x0cb", "a\x00b", "rtl \u202e evil", "isolate \u2066x",
    "*/ code",
    "/* code", "trigraph ??/", "{{ template }} {% if %}",
]  # fmt: skip
ENDS = "\n\r\v\f\x1c\x1d\x1e\x85\u2028\u2029"


def harmless(line: str) -> bool:
    return (
        line.startswith("//")
        and not line.endswith("\\")
        and "*/" not in line
        and "/*" not in line
        and not any(end in line for end in ENDS)
        and not any(unicodedata.category(char) in ("Cc", "Cf") for char in line)
    )


@pytest.mark.parametrize("text", NASTY)
def test_nasty(text: str) -> None:
    assert all(map(harmless, comment_lines(text)))
    assert harmless(comment_line(text))


@given(st.text(st.characters(codec="utf-8") | st.sampled_from("\\*/?" + ENDS)))
def test_any(text: str) -> None:
    assert all(map(harmless, comment_lines(text)))
    line = comment_line(text)
    assert not line or harmless(line)


def test_lines_are_kept() -> None:
    assert comment_lines("one\ntwo\n") == ("/// one", "/// two")
    assert comment_line("one\ntwo\n") == "/// one two"
    assert comment_lines("  \n ") == ()
    assert comment_line("") == ""
