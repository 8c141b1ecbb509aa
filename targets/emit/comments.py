"""Turns texts of the user into comments that cannot do harm.

Doc comments of a material, its parameters and functions come here on their way into a shader. A
comment that ends in a backslash swallows the next line in GLSL and HLSL. U+0085, U+2028 and other
line ends close a comment in WGSL, whose front ends then run the rest as code. Bidirectional
controls make a text look different from its meaning.
"""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache

_LINE_ENDS = re.compile("\r\n|[\n\r\v\f\x1c-\x1e\x85\u2028\u2029]")
_OPEN_END = re.compile(r"[\\\s]+$")
_INVISIBLE = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})


@lru_cache(maxsize=1024)
def comment_lines(text: str, mark: str = "///") -> tuple[str, ...]:
    """``text`` as line comments, one for each of its lines; nothing for a blank text."""
    if not text:
        return ()
    cleaned = [_clean(line) for line in _LINE_ENDS.split(text.strip())]
    return tuple([f"{mark} {line}".rstrip() for line in cleaned]) if any(cleaned) else ()


@lru_cache(maxsize=1024)
def comment_line(text: str, mark: str = "///") -> str:
    """``text`` as one comment, its lines joined; empty for a blank text."""
    if not text:
        return ""
    cleaned = " ".join(filter(None, map(_clean, _LINE_ENDS.split(text))))
    return f"{mark} {cleaned}" if cleaned else ""


def _clean(line: str) -> str:
    closed = _visible(line).replace("*/", "* /").replace("/*", "/ *").replace("??/", "?? /")
    return _OPEN_END.sub("", closed).strip()


def _visible(line: str) -> str:
    if line.isprintable():
        return line
    return "".join(
        " " if char == "\t" else char
        for char in line
        if char == "\t" or unicodedata.category(char) not in _INVISIBLE
    )
