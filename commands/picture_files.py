"""Writes the pictures of ``burnish render``: one, numbered ones, or one file that moves.

Several panels are put on a sheet. The gallery calls ``moving``, too.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from .failures import fail

if TYPE_CHECKING:
    from PIL.Image import Image

    from ..targets.runner.sheet import Panel

MOVING = frozenset((".gif", ".webp", ".apng"))
"""The endings of files that hold many pictures."""
DURATION = 40
"""The milliseconds for which such a file shows each of its pictures."""


class Page(NamedTuple):
    """All that is shown at one time: a single picture, or a sheet of several."""

    panels: Sequence[Panel]
    columns: int
    size: tuple[int, int]
    """The size of a place on a sheet that has no picture."""

    def image(self) -> Image:
        """The image for a screen."""
        from ..targets.runner.sheet import sheet

        first = self.panels[0]
        if len(self.panels) == 1 and first.image is not None:
            return first.image
        return sheet(self.panels, self.columns, self.size)

    def content(self, path: Path) -> bytes:
        """The file; one of numbers if its format is one for these, and there is one panel."""
        from ..targets.runner.pictures import encoded, encoded_numbers

        first = self.panels[0]
        if first.numbers is not None:
            return encoded_numbers(first.numbers, path, lanes=first.lanes)
        return encoded(self.image(), path)


def pages(
    drawn: Sequence[Sequence[Sequence[Panel]]], routes: int, size: tuple[int, int]
) -> Iterator[Page]:
    """A page for each time that something is drawn.

    ``drawn`` are the panels of each subject by each of some ``routes``: for each time, those of all
    outputs. If there are several outputs and several routes, the sheet is a table with a row for
    each output; otherwise it is nearly square.
    """
    for same_time in zip(*drawn, strict=True):
        of_subjects = (same_time[at : at + routes] for at in range(0, len(same_time), routes))
        panels = [
            panel
            for by_route in of_subjects
            for of_output in zip(*by_route, strict=True)
            for panel in of_output
        ]
        is_table = 1 < routes < len(panels)
        yield Page(panels, routes if is_table else math.ceil(math.sqrt(len(panels))), size)


def write_pages(pages: Sequence[Page], path: Path) -> list[Path]:
    """Write all pages: in one file, or in numbered ones, all of them or none."""
    if len(pages) == 1:
        return _write(path.parent, {path.name: pages[0].content(path)})
    if path.suffix.lower() in MOVING:
        return _write(path.parent, {path.name: moving([page.image() for page in pages], path)})
    digits = max(len(str(len(pages) - 1)), 3)
    names = [f"{path.stem}-{number:0{digits}}{path.suffix}" for number in range(len(pages))]
    files = {name: page.content(path) for name, page in zip(names, pages, strict=True)}
    return _write(path.parent, files)


def moving(images: Sequence[Image], path: Path) -> bytes:
    """One file that shows the pictures one after the other, in the format of its name."""
    from ..targets.runner.pictures import encoded

    first, *others = images
    further = {"save_all": True, "append_images": others, "duration": DURATION, "loop": 0}
    return encoded(first, path, **further)


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
        # Several files lie in a folder that may be the reason.
        path = folder / next(iter(files)) if len(files) == 1 else error.filename or folder
        fail(f"cannot write `{path}`: {error.strerror or error}")
    return [folder / name for name in files]
