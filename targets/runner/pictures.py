"""Pictures for people: what a render target holds, as an image file or on a sheet of several."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from .srgb import encode_srgb
from .textures import PictureError

Floats = NDArray[np.float64]

MARGIN = 12
CAPTION = 40
"""Height of a caption: two lines."""
PAPER, INK, FAINT = (24, 26, 30), (230, 230, 230), (150, 150, 155)


@dataclass(frozen=True, eq=False, slots=True)
class Panel:
    """One picture on a sheet."""

    title: str
    note: str
    image: Image.Image | None
    """``None`` where there is none; the note says why."""


def to_image(pixels: Floats, *, linear: bool = True) -> Image.Image:
    """The colours of a target, (height, width, 4), as a screen shows them; alpha is left out.

    ``linear`` light is encoded as sRGB; other values are taken as they are. What is not finite is
    shown in magenta, which no picture has by chance.
    """
    rgb = pixels[..., :3]
    finite = np.isfinite(rgb).all(axis=2, keepdims=True)
    clipped = np.clip(np.where(finite, rgb, 0.0), 0.0, 1.0)
    shown = encode_srgb(clipped) if linear else clipped
    shown = np.where(finite, shown, [1.0, 0.0, 1.0])
    return Image.fromarray(np.rint(shown * 255).astype(np.uint8), "RGB")


def sheet(rows: Sequence[Sequence[Panel]], size: tuple[int, int]) -> Image.Image:
    """Panels in rows, each picture ``size`` large with its title and note below."""
    width, height = size
    columns = max(map(len, rows))
    full = (
        MARGIN + columns * (width + MARGIN),
        MARGIN + len(rows) * (height + CAPTION + MARGIN),
    )
    page = Image.new("RGB", full, PAPER)
    pen = ImageDraw.Draw(page)
    font = ImageFont.load_default(13)
    for i, row in enumerate(rows):
        for j, panel in enumerate(row):
            corner = (MARGIN + j * (width + MARGIN), MARGIN + i * (height + CAPTION + MARGIN))
            _put(page, pen, font, panel, corner, size)
    return page


def save(image: Image.Image, path: Path) -> None:
    """Writes an image, in the format that the name's ending says, whole or not at all.

    Raises ``PictureError``.
    """
    Image.init()
    form = Image.EXTENSION.get(path.suffix.lower())
    if form is None or form not in Image.SAVE:
        raise PictureError(
            f"cannot write '{path}': a picture's name ends in .png, .jpg or another image format"
        )
    staging = path.with_name(f".{path.name}-{os.getpid()}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            image.save(staging, format=form)
            staging.replace(path)
        finally:
            staging.unlink(missing_ok=True)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise PictureError(f"cannot write '{path}': {reason}") from error


def _put(
    page: Image.Image,
    pen: ImageDraw.ImageDraw,
    font: ImageFont.ImageFont | ImageFont.FreeTypeFont,
    panel: Panel,
    corner: tuple[int, int],
    size: tuple[int, int],
) -> None:
    x, y = corner
    width, height = size
    if panel.image is not None:
        page.paste(panel.image, corner)
    else:
        pen.rectangle((x, y, x + width - 1, y + height - 1), outline=FAINT)
        pen.text((x + 8, y + 8), "not run", INK, font)
    pen.text((x, y + height + 3), _cut(pen, font, panel.title, width), INK, font)
    pen.text((x, y + height + 20), _cut(pen, font, panel.note, width), FAINT, font)


def _cut(
    pen: ImageDraw.ImageDraw,
    font: ImageFont.ImageFont | ImageFont.FreeTypeFont,
    text: str,
    width: int,
) -> str:
    """The text, shortened to fit."""
    if pen.textlength(text, font) <= width:
        return text
    while text and pen.textlength(f"{text}…", font) > width:
        text = text[:-1]
    return f"{text}…"
