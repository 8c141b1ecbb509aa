"""What the files of engines that take plain HLSL have in common."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from .surface import Surface


def heading(surface: Surface, engine: str, remark: str) -> str:
    """The comment at the beginning of a file."""
    lines = [f"// {surface.name}, for {engine}: by Burnish. {remark}"]
    lines += [f"// {line}".rstrip() for line in surface.document.doc.splitlines()]
    return "\n".join(lines)


def guard(macro: str, blocks: Iterable[str]) -> str:
    """A file that may be included several times."""
    first, *others = blocks
    inner = [first, f"#ifndef {macro}\n#define {macro}", *others, "#endif"]
    return "\n\n".join(inner) + "\n"


def usual(value: Any) -> str:
    """A default in a comment: ``true``, ``0.46``, ``(1, 0.5, 0)``."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (list, tuple)):
        return f"({', '.join(map(usual, value))})"
    return f"{value:.4g}" if isinstance(value, float) else str(value)
