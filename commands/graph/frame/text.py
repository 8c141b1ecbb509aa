"""Writes the graph of a frame as text: its steps in order, then a table of its textures."""

from __future__ import annotations

from collections.abc import Iterator

from .model import KINDS, LETTERS, MARKS, STEPS, Arrow, Box, FramePicture, Row


def written(picture: FramePicture) -> str:
    """The whole text."""
    lines = [picture.title, *picture.doc.splitlines()]
    lines += ["", "from the host", *_host(picture)]
    lines += ["", "steps"]
    for box in picture.boxes:
        if box.kind in STEPS:
            lines += _step(box, picture)
    lines += ["", "outputs", *_outputs(picture)]
    lines += ["", f"from step to step: {picture.shared}", *_table(picture)]
    return "\n".join(line.rstrip() for line in lines) + "\n"


def _host(picture: FramePicture) -> Iterator[str]:
    boxes = [box for box in picture.boxes if box.kind not in STEPS and box.kind != "output"]
    width = max((len(box.name) for box in boxes), default=0)
    for box in boxes:
        details = (KINDS[box.kind], *box.lines, *box.notes)
        yield f"  {box.name:<{width}}  {' · '.join(details)}"


def _outputs(picture: FramePicture) -> Iterator[str]:
    for box in picture.boxes:
        if box.kind == "output":
            (arrow,) = _into(box, picture)
            yield f"  {box.name} = {arrow.port}  {' · '.join([*box.lines, *box.notes])}"


def _step(box: Box, picture: FramePicture) -> Iterator[str]:
    """A step, or several: how it is done, its inputs, and its results."""
    often = f" × {box.repeated}" if box.repeated else ""
    first = ", in the first frame only" if box.only_first else ""
    place, *given = box.notes or [""]
    details = " · ".join(filter(None, [*box.lines, place]))
    yield f"  {box.name}{often}{first}  {KINDS[box.kind]} {details}"
    yield from (f"    {note}" for note in given)
    names = {each.key: each.name for each in picture.boxes}
    for arrow in _into(box, picture):
        what = arrow.port or names[arrow.source]
        if arrow.kind == "given":
            yield f"    <- {what}"
        elif arrow.source.startswith("previous "):
            yield f"    <- {what} of the last frame"
        else:
            words = {"over": ", drawn over", "initial": ", in the first frame"}.get(arrow.kind, "")
            yield f"    <- {what}{words}"
    for port in box.ports:
        kept = "" if port.texture is None else f" in #{port.texture}"
        yield f"    -> {port.name}: {port.what}{kept}, {MARKS[port.mark]}"


def _into(box: Box, picture: FramePicture) -> list[Arrow]:
    return [arrow for arrow in picture.arrows if arrow.target == box.key]


def _table(picture: FramePicture) -> Iterator[str]:
    """A row for each texture, with a letter for each step's use of it."""
    heads = [row.title for row in picture.rows]
    width = max(map(len, [*heads, ""])) + 2
    whats = max((len(row.what) for row in picture.rows), default=0) + 2
    for column in picture.columns:
        first = "  (first frame only)" if column.only_first else ""
        bars = " " * (width + whats) + "".join("| " for _ in picture.columns[: column.number])
        yield f"  {bars}{column.name}{first}"
    for row in picture.rows:
        cells = " ".join(_cell(row, column.number) for column in picture.columns)
        yield f"  {row.title:<{width}}{row.what:<{whats}}{cells}  {row.holds}"
    yield ""
    used = {mark for row in picture.rows for mark in row.marks.values()}
    yield "  " + "; ".join(f"{LETTERS[m]} {words}" for m, words in MARKS.items() if m in used)
    yield "  - needed by a later step, by the host or by the next frame"


def _cell(row: Row, number: int) -> str:
    if number in row.marks:
        return LETTERS[row.marks[number]]
    alive = any(
        (life.before or life.first <= number) and (life.after or number <= life.last)
        for life in row.lives
        if not (life.after and number < life.first)
    )
    return "-" if alive else "."
