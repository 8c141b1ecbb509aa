"""Writes the graph as text: one line for each value, in the order of computation."""

from __future__ import annotations

from collections.abc import Iterator

from .model import Box, Picture


def written(picture: Picture) -> str:
    """All clusters, one after the other."""
    lines = [picture.title]
    for cluster in picture.clusters:
        lines += ["", cluster.title]
        width = max((len(box.name) for box in cluster.boxes), default=0)
        for box in cluster.boxes:
            lines.append(f"  {box.name:<{min(width, 32)}}  {' · '.join(_details(box))}")
    return "\n".join(lines) + "\n"


def _details(box: Box) -> Iterator[str]:
    yield box.type
    if box.formula:
        yield f"= {box.formula}"
    if box.note:
        yield box.note
    if box.guarded:
        yield "guarded"
    if box.part:
        yield f"{box.part:.1%} of the error"
    if box.place:
        yield box.place
