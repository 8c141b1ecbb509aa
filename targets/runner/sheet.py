"""Makes contact sheets for ``burnish render``: several pictures in one, each above its caption."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

GAP = 16
"""The space between panels, and around all of them, in pixels."""
NARROWEST = 128
"""The least width of a caption, however small the picture is."""
NOTE_LINES = 3
"""The largest number of lines of a note; titles are never shortened."""
PAPER, BOX, INK, FAINT = (44, 47, 53), (54, 57, 64), (240, 240, 240), (165, 168, 175)

Font = ImageFont.ImageFont | ImageFont.FreeTypeFont


@dataclass(frozen=True, eq=False, slots=True)
class Panel:
    """One picture on a sheet, or an empty place for it."""

    titles: tuple[str, ...]
    """The lines below the picture that describe it."""
    note: str
    """The fainter text below them that names the device."""
    image: Image.Image | None
    """``None`` if there is no picture."""
    problem: str = ""
    """Two or three words that say why there is no picture; they are written in its place."""
    numbers: NDArray[np.float64] | None = None
    """The numbers instead of an image, for files that keep these: of shape (height, width, lanes or
    more), linear, and not limited to 0..1."""
    lanes: int = 4
    """The number of lanes that the render target has."""


def sheet(panels: Sequence[Panel], columns: int, size: tuple[int, int]) -> Image.Image:
    """A sheet of panels in rows of ``columns``; each picture has a caption below it.

    A place without a picture has this size. A picture may be larger: its layers lie one below
    another, and a kernel says how large its image is.
    """
    cell = max(NARROWEST, *(_extent(panel, size)[0] for panel in panels))
    font = ImageFont.load_default(max(13, min(cell // 32, 48)))
    line = round(1.3 * _height(font))
    captions = [_caption(panel, font, cell) for panel in panels]
    rows = [range(at, min(at + columns, len(panels))) for at in range(0, len(panels), columns)]
    pictures = [max(_extent(panels[i], size)[1] for i in row) for row in rows]
    texts = [line * max(len(captions[i]) for i in row) + line // 2 for row in rows]
    page = Image.new("RGB", (
        GAP + min(columns, len(panels)) * (cell + GAP),
        GAP + sum(pictures) + sum(texts) + GAP * len(rows),
    ), PAPER)  # fmt: skip
    pen = ImageDraw.Draw(page)
    top = GAP
    for row, height, below in zip(rows, pictures, texts, strict=True):
        for column, i in enumerate(row):
            left = GAP + column * (cell + GAP)
            _put_picture(page, pen, panels[i], (left, top), size, font)
            for number, (text, ink) in enumerate(captions[i]):
                pen.text((left, top + height + line // 3 + number * line), text, ink, font)
        top += height + below + GAP
    return page


def _extent(panel: Panel, size: tuple[int, int]) -> tuple[int, int]:
    """The width and the height of a panel's picture, or of its empty place."""
    return size if panel.image is None else panel.image.size


def _put_picture(
    page: Image.Image,
    pen: ImageDraw.ImageDraw,
    panel: Panel,
    corner: tuple[int, int],
    size: tuple[int, int],
    font: Font,
) -> None:
    if panel.image is not None:
        page.paste(panel.image, corner)
        return
    (x, y), (width, height) = corner, size
    pen.rectangle((x, y, x + width - 1, y + height - 1), fill=BOX, outline=FAINT)
    pen.text((x + width / 2, y + height / 2), panel.problem, INK, font, anchor="mm")


def _caption(panel: Panel, font: Font, width: int) -> list[tuple[str, tuple[int, int, int]]]:
    """The lines of a caption with their colours."""
    titles = [line for title in panel.titles for line in _wrapped(title, font, width)]
    note = _wrapped(panel.note, font, width)
    if len(note) > NOTE_LINES:
        last = note[NOTE_LINES - 1].rstrip()
        note = [*note[: NOTE_LINES - 1], _fitting(f"{last} ", font, width, end="…")]
    return [*((line, INK) for line in titles), *((line, FAINT) for line in note)]


def _wrapped(text: str, font: Font, width: int) -> list[str]:
    """Lines that are no wider than ``width``, broken after spaces and punctuation if possible."""
    lines, line = [], ""
    for part in re.findall(r"[^ :_-]*[ :_-]?", " ".join(text.split())):
        if font.getlength((line + part).rstrip()) > width and line:
            lines.append(line.rstrip())
            line = ""
        line += part
        while font.getlength(line.rstrip()) > width:
            head = _fitting(line, font, width)
            lines.append(head)
            line = line[len(head) :]
    return [*lines, line.rstrip()] if line.strip() else lines


def _fitting(text: str, font: Font, width: int, end: str = "") -> str:
    """The longest beginning of the text, at least one letter, that fits together with ``end``."""
    while len(text) > 1 and font.getlength(text + end) > width:
        text = text[:-1]
    return text + end


def _height(font: Font) -> float:
    _, top, _, bottom = font.getbbox("Ag")
    return bottom - top
