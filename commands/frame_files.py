"""Writes the pictures of frames: one, numbered ones, or one file that moves.

``frames.py`` calls ``write_pictures``, and the gallery ``moving``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ..compiler.budget import check
from .failures import fail

if TYPE_CHECKING:
    from PIL.Image import Image

    from ..targets.runner.render import Floats

MOVING = frozenset((".gif", ".webp", ".apng"))
"""The endings of files that hold many pictures."""
DURATION = 40
"""The milliseconds for which such a file shows each of its pictures."""
_OF_A_PIXEL = 4
"""Bytes of an image in memory."""


class Shown(NamedTuple):
    """The part of a picture that is kept until files are written: its image, or its numbers."""

    image: Image | None
    """The image as a screen shows it."""
    numbers: Floats | None
    """The numbers, of shape (height, width, lanes), for formats that keep them."""

    @classmethod
    def of(cls, layers: Floats, path: Path) -> Shown:
        """The kept part of a texture's first level, of shape (layers, height, width, lanes)."""
        from ..targets.runner.pictures import keeps_numbers

        if keeps_numbers(path):
            return cls(None, _in_a_row(layers))
        return cls(image_of(layers), None)

    @property
    def size(self) -> int:
        """The number of bytes, with a copy of them in a file."""
        kept = 0 if self.image is None else self.image.width * self.image.height * _OF_A_PIXEL
        return 2 * (kept + (0 if self.numbers is None else self.numbers.nbytes))


def check_kept(pictures: Sequence[Shown], times: int) -> None:
    """Raise ``BudgetError`` if there is no room for the pictures of all frames.

    They are kept until all files are written together.
    """
    size = times * sum(picture.size for picture in pictures)
    check("memory", size, f"{times * len(pictures)} pictures need")


def write_pictures(rows: Sequence[Sequence[Shown]], path: Path) -> list[Path]:
    """Write the pictures of each frame, side by side; all files or none."""
    if len(rows) == 1:
        return _write(path.parent, {path.name: _still(rows[0], path)})
    if path.suffix.lower() in MOVING:
        images = [_beside([picture.image for picture in row if picture.image]) for row in rows]
        return _write(path.parent, {path.name: moving(images, path)})
    digits = max(len(str(len(rows) - 1)), 3)
    names = [f"{path.stem}-{number:0{digits}}{path.suffix}" for number in range(len(rows))]
    files = {name: _still(row, path) for name, row in zip(names, rows, strict=True)}
    return _write(path.parent, files)


def _in_a_row(layers: Floats) -> Floats:
    """The first level of a texture: its layers, or faces, side by side."""
    import numpy as np

    return np.concatenate(list(layers), axis=1)


def image_of(layers: Floats) -> Image:
    """The image that a screen shows of a texture's first level."""
    from ..targets.runner.pictures import to_image

    return to_image(_in_a_row(layers), lanes=layers.shape[-1])


def _beside(images: Sequence[Image]) -> Image:
    """Pictures next to each other."""
    from PIL import Image as Pictures

    whole = Pictures.new("RGB", (sum(i.width for i in images), max(i.height for i in images)))
    left = 0
    for image in images:
        whole.paste(image, (left, 0))
        left += image.width
    return whole


def moving(images: Sequence[Image], path: Path) -> bytes:
    """One file that shows the pictures one after the other, in the format of its name."""
    from ..targets.runner.pictures import encoded

    first, *others = images
    further = {"save_all": True, "append_images": others, "duration": DURATION, "loop": 0}
    return encoded(first, path, **further)


def _still(row: Sequence[Shown], path: Path) -> bytes:
    """One picture; or the numbers of one, if the format is one for numbers."""
    from ..targets.runner.pictures import encoded, encoded_numbers, keeps_numbers

    if not keeps_numbers(path):
        return encoded(_beside([picture.image for picture in row if picture.image]), path)
    ((_image, pixels),) = row
    assert pixels is not None
    return encoded_numbers(pixels, path, lanes=pixels.shape[-1])


def _write(folder: Path, files: Mapping[str, bytes]) -> list[Path]:
    from .output import write_file
    from .replacing import replace_all

    try:
        if len(files) == 1:
            ((name, content),) = files.items()
            write_file(folder / name, content)
        else:
            replace_all(str(folder), files)
    except OSError as error:
        fail(f"cannot write `{error.filename or folder}`: {error.strerror or error}")
    return [folder / name for name in files]
