"""Graphs of frames: what is shown of the steps and textures, and that pictures are well made."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from functools import cache
from itertools import combinations
from pathlib import Path

import pytest

import burnish
from burnish.commands.graph import dot, svg, text
from burnish.commands.graph.frame import frame_picture
from burnish.commands.graph.kinds import ArrowKind, Kind
from burnish.commands.graph.model import Picture, TimeLine
from tests.golden import assert_golden

EVERYTHING = Path(__file__).parent / "everything.burnish"
EXAMPLES = Path(__file__).parents[2] / "examples" / "frames"
SHOWN = ("deferred", "glow", "reaction")
GOLDEN = Path(__file__).parent / "golden"
SVG = "{http://www.w3.org/2000/svg}"
LETTER = 0.61
"""The width of a letter of the widest usual font, relative to its size."""


@cache
def picture(name: str) -> Picture:
    path = EVERYTHING if name == "everything" else EXAMPLES / f"{name}.burnish"
    (frame,) = burnish.compile(path, ()).frames
    return frame_picture(frame)


def time_line(name: str) -> TimeLine:
    line = picture(name).time_line
    assert line is not None
    return line


def test_a_frame_as_text() -> None:
    assert_golden(text.written(picture("everything")), GOLDEN / "everything.txt")


def test_a_frame_in_graphviz_s_language() -> None:
    assert_golden(dot.written(picture("everything")), GOLDEN / "everything.dot")


@pytest.mark.parametrize("name", ["everything", *SHOWN])
def test_arrows_join_boxes_that_there_are(name: str) -> None:
    found = picture(name)
    boxes = {box.key: box for box in found.boxes}
    assert len(boxes) == len(found.boxes)
    for arrow in found.arrows:
        ports = {port.key for port in boxes[arrow.source].ports}
        assert arrow.target in boxes
        assert arrow.port in ports or (arrow.port == "" and not ports)
    read = {arrow.source for arrow in found.arrows}
    assert all(box.key in read or box.kind is Kind.OUTPUT for box in found.boxes)


def test_steps_that_an_equation_repeats_are_one_box() -> None:
    repeated = {box.name: box.repeated for box in picture("everything").boxes if box.repeated}
    assert repeated == {"soft": "12 turns", "small": "4 mip levels", "seen": "6 faces"}
    (blurred,) = (box for box in picture("glow").boxes if box.repeated)
    assert [port.name for port in blurred.ports] == ["source.color", "color"]
    assert (blurred.repeated, len(time_line("glow").columns)) == ("3 turns", 9)


def test_what_the_last_frame_left_comes_back_by_an_arrow() -> None:
    found = picture("reaction")
    (back,) = (arrow for arrow in found.arrows if arrow.kind is ArrowKind.BACK)
    assert (back.source, back.port, back.target) == (
        "step steps", "steps.both", "previous steps.both",
    )  # fmt: skip
    assert [box.name for box in found.boxes if box.only_first] == ["first"]


def test_the_time_line_says_what_happens_to_each_texture() -> None:
    rows = time_line("deferred").rows
    marks = [
        [row.marks[step].name if step in row.marks else "" for step in range(3)] for row in rows
    ]
    assert marks == [
        ["CLEARED", "READ", ""],
        ["CLEARED", "READ", "CLEARED"],
        ["DROPPED", "", ""],
        ["", "CLEARED", "READ"],
    ]
    assert rows[1].holds == "seen.surface, toned.color"
    assert time_line("deferred").shared == "5 results in 4 textures"


def rectangles(group: ET.Element) -> tuple[float, float, float, float]:
    box = group.find(f"{SVG}rect")
    assert box is not None
    return tuple(float(box.attrib[key]) for key in ("x", "y", "width", "height"))  # type: ignore[return-value]


@pytest.mark.parametrize("name", ["everything", *SHOWN])
def test_boxes_do_not_overlap_and_letters_fit_in(name: str) -> None:
    found = picture(name)
    root = ET.fromstring(svg.drawn(found))
    width, height = float(root.attrib["width"]), float(root.attrib["height"])
    groups = [g for g in root.iter(f"{SVG}g") if g.find(f"{SVG}rect") is not None]
    boxes = [
        g for g in groups if g.find(f"{SVG}title") is not None and g.find(f"{SVG}text") is not None
    ]
    assert len(boxes) == len(found.boxes)
    for group in boxes:
        left, _top, across, _down = rectangles(group)
        for line in group.iter(f"{SVG}text"):
            letters = len(line.text or "") * float(line.attrib["font-size"]) * LETTER
            assert float(line.attrib["x"]) + letters < left + across
    for one, other in combinations(map(rectangles, boxes), 2):
        apart = (one[0] + one[2] <= other[0] or other[0] + other[2] <= one[0]
                 or one[1] + one[3] <= other[1] or other[1] + other[3] <= one[1])  # fmt: skip
        assert apart
    assert all(x + w < width and y + h < height for x, y, w, h in map(rectangles, boxes))


def test_long_rows_of_turns_are_shortened() -> None:
    drawn = svg.drawn(picture("everything"))
    assert re.findall(r">(soft(?:\.\d+)?)<", drawn).count("soft.10") == 1
    assert ">soft.7<" not in drawn
    assert ">…<" in drawn
    assert len(time_line("everything").columns) == 29


def test_the_legend_names_what_is_shown() -> None:
    deferred, everything = (svg.drawn(picture(name)) for name in ("deferred", "everything"))
    for words in ("copy", "read in the next frame", "drawn over", "kernel"):
        assert f">{words}<" in everything
        assert f">{words}<" not in deferred


def test_a_picture_is_the_same_every_time() -> None:
    assert svg.drawn(picture("glow")) == svg.drawn(picture("glow"))
    kinds = {box.kind for box in picture("everything").boxes}
    assert kinds >= {Kind.DRAW, Kind.RUN, Kind.COPY}
