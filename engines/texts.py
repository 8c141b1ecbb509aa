"""What the files of engines that take plain HLSL have in common."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from .surface import Given, Surface


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


def argument_lines(
    surface: Surface, given: Given, nodes: Mapping[tuple[str, str], str]
) -> Iterator[str]:
    """A comment for each argument: where the engine has it, or what a user sets.

    ``nodes`` has what the engine has itself: values of surfaces, and parameters by their role.
    """
    for argument in given.signature.arguments:
        if argument.kind == "value":
            row = surface.arguments[argument.given]
            known = nodes.get(("role", row.role or ""))
            if known is not None:
                place = known
            elif row.source == "parameter":
                said = "" if row.default is None else f", usually {usual(row.default)}"
                place = f"a property of the type {row.type}{said}"
            elif row.source == "varying":
                place = f"what `{row.given}` is at the vertices, interpolated"
            else:
                place = nodes.get((row.source, row.given), f"`{row.given}` of the mesh")
            doc = (
                f" ({row.doc.strip()})"
                if row.doc and row.source == "parameter" and known is None
                else ""
            )
            yield f"//   {argument.name}: {place}{doc}".replace("\n", " ")
        elif argument.kind == "texture":
            texture = surface.textures[argument.given]
            encoding = "sRGB" if texture.intent == "color" else "no sRGB"
            yield f"//   {argument.name}: a texture, usually {texture.default}, {encoding}"
