"""Names of files as nobody would choose them, for whatever lists, shows, links or opens files."""

from __future__ import annotations

import os
from collections.abc import Iterator
from random import Random

LONGEST = 200
"""The most bytes of a name; file systems allow 255, with an ending."""

PIECES = {
    "options": ("-", "--", "-o", "-rf", "--output=x", "--set", "@x"),
    "shells": ("'", '"', "`id`", "$(id)", ";", "&", "|", "*", "~", "!", "\\", "it's"),
    "lines": ("\n", "\r", "\r\n", "\t", "\v", "\x85", "\u2028"),
    "terminals": ("\x1b[2J", "\x1b]0;title\x07", "\x9b31m", "\b", "\x7f", "\x01"),
    "directions": ("\u202e", "\u2066", "\u200b", "\ufeff", "\U000e0041"),
    "schemes": ("javascript:alert(1)", "JaVaScRiPt:alert(1)", "data:,x", "file:", "C:", "x:y"),
    "addresses": ("#", "?", "%", "%2e%2e%2f", "%00", "&amp;", "a=b&c", "+", ";x"),
    "markup": ("<img src=x onerror=alert(1)>", "<script>alert(1)", '" onload="alert(1)', "]]>",
               "<!--", "{{ 7 * 7 }}", "{% raw %}", "[x](y)", "**x**", "`x`"),
    "bytes": ("\udcff", "\udce9", "caf\udce9", "\udced\udca0\udc80"),
    "places": ("..", "...", ". .", ".hidden", " ", "index", "con", "NUL", "a: b"),
    "letters": ("a", "A", "\u00e9", "e\u0301", "\u0131", "\u00df", "ss", "\u5927", "\U0001f600"),
    "length": ("x" * LONGEST, "\u5927" * 60),
}  # fmt: skip
"""Pieces of names by what they could upset. Bytes that are no UTF-8 are as Python has them."""


def hostile_names(random: Random) -> Iterator[str]:
    """Names without an ending, for ever: each of a few pieces, and one that a file can have."""
    kinds = list(PIECES.values())
    while True:
        pieces = (random.choice(random.choice(kinds)) for _ in range(random.randint(1, 4)))
        encoded = os.fsencode("".join(pieces))[:LONGEST]
        name = os.fsdecode(encoded)
        if name not in (".", ".."):
            yield name
