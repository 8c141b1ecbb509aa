"""Contact sheets: every picture in its place, and captions that can be read."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageFont

from burnish.targets.runner import sheet
from burnish.targets.runner.sheet import GAP, NARROWEST, PAPER, Panel

FONT = ImageFont.load_default(13)
RED, GREEN, BLUE = (255, 0, 0), (0, 255, 0), (0, 0, 255)


def panel(color: tuple[int, int, int], size: tuple[int, int], *titles: str) -> Panel:
    return Panel(titles or ("Title",), "a note", Image.new("RGB", size, color))


def made(panels: list[Panel], columns: int, size: tuple[int, int]) -> NDArray[np.uint8]:
    return np.asarray(sheet.sheet(panels, columns, size))


def places(page: NDArray[np.uint8], color: tuple[int, int, int]) -> tuple[int, int, int, int]:
    """Left, top, width and height of what has a colour, which is all of a rectangle."""
    ys, xs = np.nonzero((page == color).all(axis=2))
    width, height = int(np.ptp(xs)) + 1, int(np.ptp(ys)) + 1
    assert len(xs) == width * height
    return int(xs.min()), int(ys.min()), width, height


def test_pictures_stand_in_rows() -> None:
    size = (140, 90)
    page = made([panel(RED, size), panel(GREEN, size), panel(BLUE, size)], 2, size)
    assert places(page, RED) == (GAP, GAP, *size)
    assert places(page, GREEN) == (GAP + size[0] + GAP, GAP, *size)
    left, top, *_ = places(page, BLUE)
    assert (left, places(page, BLUE)[2:]) == (GAP, size)
    caption = page[GAP + size[1] : top, : GAP + size[0]]
    assert (caption != PAPER).any(), "there is a caption between them"
    assert page.shape[1] == GAP + 2 * (size[0] + GAP)


def test_pictures_of_other_sizes_have_room() -> None:
    """A picture with layers is higher than was asked for, and a kernel says itself how large its
    image is."""
    size = (140, 90)
    page = made([panel(RED, (140, 270)), panel(GREEN, (200, 50)), panel(BLUE, size)], 2, size)
    assert places(page, RED) == (GAP, GAP, 140, 270)
    assert places(page, GREEN) == (GAP + 200 + GAP, GAP, 200, 50)
    left, top, *_ = places(page, BLUE)
    assert (left, places(page, BLUE)[2:]) == (GAP, size)
    caption = page[GAP + 270 : top, : GAP + 200]
    assert (caption != PAPER).any(), "there is a caption between them"
    assert (page[:, -GAP:] == PAPER).all()


def test_small_pictures_leave_their_captions_room() -> None:
    page = made([panel(RED, (4, 4)), panel(GREEN, (4, 4))], 2, (4, 4))
    assert places(page, GREEN) == (GAP + NARROWEST + GAP, GAP, 4, 4)


def test_no_ink_outside() -> None:
    """This holds for titles of any length."""
    size = (40, 30)
    titles = ("A_material_with_a_truly_long_name_that_goes_on_and_on", "W" * 99)
    for columns in (1, 2):
        page = made([panel(RED, size, *titles), panel(BLUE, size, *titles)], columns, size)
        edges = (page[:GAP], page[-GAP // 2 :], page[:, : GAP - 2], page[:, -GAP + 2 :])
        assert all((edge == PAPER).all() for edge in edges)


@pytest.mark.parametrize("text", ["short", "swiftshader:hlsl-glslang by SwiftShader", "W" * 99])
def test_lines_fit_and_leave_nothing_out(text: str) -> None:
    lines = sheet._wrapped(text, FONT, 100)
    assert "".join(lines).replace(" ", "") == text.replace(" ", "")
    assert all(0 < FONT.getlength(line) <= 100 for line in lines)


def test_lines_break_where_words_end() -> None:
    assert sheet._wrapped("lavapipe:hlsl-glslang", FONT, 100) == ["lavapipe:hlsl-", "glslang"]
    assert sheet._wrapped("two\n words", FONT, 100) == ["two words"]


def test_long_notes_are_cut() -> None:
    many = Panel(("Title",), "word " * 100, None, "not run")
    lines = [line for line, _ in sheet._caption(many, FONT, NARROWEST)]
    assert lines[0] == "Title"
    assert len(lines) == 1 + sheet.NOTE_LINES
    assert lines[-1].endswith("…")
    assert FONT.getlength(lines[-1]) <= NARROWEST


def test_a_place_without_a_picture() -> None:
    size = (120, 60)
    page = made([panel(RED, size), Panel(("Title",), "why", None, "not run")], 2, size)
    box = page[GAP : GAP + size[1], GAP + NARROWEST + GAP :][: size[1], : size[0]]
    assert (box[1:-1, 1] == sheet.BOX).all()
    assert (box == sheet.INK).all(axis=2).any(), "the words are inside"
