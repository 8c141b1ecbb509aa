"""Writes a picture as text: a line for each box, in the order of computation, and below a step
those for its inputs and results. A table of textures ends the text of a frame."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from .kinds import Kind
from .model import Arrow, Box, Picture, Row, TimeLine

WIDEST = 32
"""The width to which names are filled up at most; those of steps, which have lines below, never."""


def written(picture: Picture) -> str:
    """All clusters, one after the other, and the time line."""
    lines = [picture.title, *picture.doc.splitlines()]
    boxes = {box.key: box for box in picture.boxes}
    into: dict[str, list[Arrow]] = {key: [] for key in boxes}
    for arrow in picture.arrows:
        into[arrow.target].append(arrow)
    for cluster in picture.clusters:
        lines += ["", cluster.title]
        names = (len(box.name) for box in cluster.boxes if not box.ports)
        width = min(max(names, default=0), WIDEST)
        for box in cluster.boxes:
            details = " · ".join(filter(None, _details(box)))
            lines.append(f"  {_name(box).ljust(0 if box.ports else width)}  {details}")
            lines += (f"    {line}" for line in _below(box, into[box.key], boxes))
    if picture.time_line is not None:
        lines += ["", f"from step to step: {picture.time_line.shared}", *_table(picture.time_line)]
    return "\n".join(line.rstrip() for line in lines) + "\n"


def _name(box: Box) -> str:
    often = f" × {box.repeated}" if box.repeated else ""
    return f"{box.name}{often}{', in the first frame only' * box.only_first}"


def _details(box: Box) -> Iterator[str]:
    yield box.type
    yield f"= {box.formula}" if box.formula else ""
    yield box.what
    yield from box.lines
    yield "guarded" if box.guarded else ""
    yield box.error
    yield box.place


def _below(box: Box, into: list[Arrow], boxes: Mapping[str, Box]) -> Iterator[str]:
    """The inputs and results of a step; for other boxes, a formula names the inputs."""
    yield from box.settings
    yield from (each.text for each in box.inputs)
    for arrow in into:
        if arrow.kind.told is not None and not box.formula and not box.inputs:
            source = boxes[arrow.source]
            before = " of the last frame" if source.kind is Kind.PREVIOUS else ""
            yield f"<- {arrow.port or source.name}{before}{arrow.kind.told}"
    for port in box.ports:
        kept = "" if port.texture is None else f" in #{port.texture}"
        yield f"-> {port.name}: {port.what}{kept}, {port.mark.words}"


def _table(line: TimeLine) -> Iterator[str]:
    """A row for each texture, with a letter for each step's use of it."""
    width = max((len(row.title) for row in line.rows), default=0) + 2
    whats = max((len(row.what) for row in line.rows), default=0) + 2
    for column in line.columns:
        first = "  (first frame only)" if column.only_first else ""
        yield f"  {' ' * (width + whats)}{'| ' * column.number}{column.name}{first}"
    for row in line.rows:
        cells = " ".join(_cell(row, column.number) for column in line.columns)
        yield f"  {row.title:<{width}}{row.what:<{whats}}{cells}  {row.holds}"
    yield ""
    yield "  " + "; ".join(f"{mark.letter} {mark.words}" for mark in line.used)
    yield "  - needed by a later step, by the host or by the next frame"


def _cell(row: Row, number: int) -> str:
    if number in row.marks:
        return row.marks[number].letter
    alive = any(
        (life.before or life.first <= number) and (life.after or number <= life.last)
        for life in row.lives
        if not (life.after and number < life.first)
    )
    return "-" if alive else "."
