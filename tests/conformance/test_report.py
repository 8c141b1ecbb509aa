"""A run in words, as JSON and as a page."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from html.parser import HTMLParser
from itertools import pairwise
from xml.etree.ElementTree import fromstring

import numpy as np
import pytest

from burnish.compiler.reference.picture import Expected
from burnish.targets.conformance.compare import compare
from burnish.targets.conformance.junit import as_junit
from burnish.targets.conformance.pixel_maps import EDGES, bound_map, decision_map, histogram
from burnish.targets.conformance.report import as_json, page
from burnish.targets.conformance.rows import CaseResult, Row, Status
from burnish.targets.conformance.summary import (
    Unfinished,
    cells,
    counted,
    details,
    messages,
    outcome,
)
from burnish.targets.runner.drivers.device import Device
from burnish.targets.runner.routes import ROUTES

SIZE = (4, 6)
NAME = 'a<b> & "c".burnish: Odd'
DEVICE = Device("<llvm>", "1 & 2", 8, 8, 8)
VERSIONS = {"glslang": "12 <beta>"}
PROBLEM = "glslang rejects Odd.frag.glsl\n  3:7: '<' : syntax error & more"


def _result(
    case: str,
    value: float = 1.0,
    undecided: int = 0,
    wanted: float = 1.0,
    bound: float = 0.01,
    wide: int = 0,
    meant: float = 1.0,
) -> CaseResult:
    """A picture with some range against one with another value in one lane; some bounds are
    infinite."""
    values = np.ones((*SIZE, 4))
    values[..., 1] = np.linspace(0, 1, SIZE[0] * SIZE[1]).reshape(SIZE)
    values[1, 2, 1] = 1
    got, source = values.copy(), values.copy()
    got[1, 2, 0], values[1, 2, 0], source[1, 2, 0] = value, wanted, meant if meant != 1 else wanted
    unsure = np.zeros(SIZE, dtype=np.bool_)
    unsure.flat[:undecided] = True
    low, high = values - bound, values + bound
    low.reshape(-1, 4)[undecided : undecided + wide] = -np.inf
    ones = np.ones(SIZE, dtype=np.int64)
    expected = Expected((values,), ones > 0, unsure, (low,), (high,), ones)
    steps = [np.full((*SIZE, 4), 2.0**-10)]
    comparison = compare((got,), expected, (source,), steps, "guaranteed")
    return CaseResult(case, comparison, (got,), expected)


def _row(
    route: str,
    status: Status,
    *results: CaseResult,
    problem: str = "",
    reasons: tuple[str, ...] = (),
) -> Row:
    device = DEVICE if results else None
    return Row(NAME, ROUTES[route], status, problem, device, VERSIONS, results, reasons)


REASON = "`fract(x * 43758)` magnifies rounding 10^5 times (a<b>.burnish:12)"
ROWS = [
    _row("lavapipe:glsl", "agrees", _result("defaults", 1.005), _result("behind")),
    _row("lavapipe:hlsl-dxc", "differs", _result("defaults", 1.5), _result("behind", math.nan)),
    _row("lavapipe:hlsl-glslang", "differs", _result("defaults", meant=1.25)),
    _row("swiftshader:glsl", "overflows", _result("defaults", math.inf, wanted=1e39)),
    _row("lavapipe:wgsl-naga", "proves little", _result("defaults", undecided=3, wide=20),
         reasons=(REASON,)),
    _row("swiftshader:wgsl-naga", "proves little", _result("defaults", undecided=3, wide=19)),
    _row("llvmpipe:gl330", "failed", problem=PROBLEM),
    _row("chromium:webgpu", "not run", problem="chromium is not installed"),
]  # fmt: skip

TABLE = """\
lavapipe:glsl          agrees         5.0e-03  50%       10        0 of 48
lavapipe:hlsl-dxc      differs        inf      infinite  10        0 of 48
lavapipe:hlsl-glslang  differs        0.0e+00  0%        10        0 of 24
swiftshader:glsl       overflows      0.0e+00  0%        10        1 of 24
lavapipe:wgsl-naga     proves little  0.0e+00  0%        infinite  23 of 24
swiftshader:wgsl-naga  proves little  0.0e+00  0%        infinite  22 of 24
llvmpipe:gl330         failed
chromium:webgpu        not run
"""

DETAILS = """\
lavapipe:hlsl-dxc: defaults: 1 of 24 pixels are out of bounds; the worst, at (2, 1), is (1.5, \
1, 1, 1) and must be from (0.99, 0.99, 0.99, 0.99) to (1.01, 1.01, 1.01, 1.01)
lavapipe:hlsl-dxc: behind: 1 of 24 pixels are out of bounds; the worst, at (2, 1), is (nan, 1, \
1, 1) and must be from (0.99, 0.99, 0.99, 0.99) to (1.01, 1.01, 1.01, 1.01)
lavapipe:hlsl-glslang: defaults: the compiler has changed the meaning of 1 of 24 pixels: at (2, \
1) the material means (1.25, 1, 1, 1), but what was emitted gives a value from (0.99, 0.99, \
0.99, 0.99) to (1.01, 1.01, 1.01, 1.01)
swiftshader:glsl: defaults: in 1 of 24 pixels the value leaves what float32 holds, where \
nothing is promised; at (2, 1) it is (1e+39, 1, 1, 1)
lavapipe:wgsl-naga: defaults: 20 of 24 pixels may have nearly any value, and at 3 rounding \
decides what is drawn
lavapipe:wgsl-naga: `fract(x * 43758)` magnifies rounding 10^5 times (a<b>.burnish:12)
swiftshader:wgsl-naga: defaults: 19 of 24 pixels may have nearly any value, and at 3 rounding \
decides what is drawn
llvmpipe:gl330: glslang rejects Odd.frag.glsl
llvmpipe:gl330:   3:7: '<' : syntax error & more
chromium:webgpu: chromium is not installed
"""


def test_the_table() -> None:
    lines = [cells(row) for row in ROWS]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    shown = ("  ".join(map(str.ljust, line, widths)).rstrip() + "\n" for line in lines)
    assert "".join(shown) == TABLE
    every = "1 agrees, 2 differ, 2 prove little, 1 overflows, 1 failed, 1 not run"
    assert counted(ROWS) == every
    assert counted(ROWS[:1] * 3 + ROWS[1:2] * 2) == "3 agree, 2 differ"


def test_the_details() -> None:
    lines = (f"{row.route.name}: {line}\n" for row in ROWS for line in details(row))
    assert "".join(lines) == DETAILS


def test_what_proves_little_is_said_once() -> None:
    """The message is of the row that proves least; rows that were not run are told elsewhere."""
    said = [([row.route.name for row in rows], lines) for rows, lines in messages(ROWS)]
    names = [names for names, _ in said]
    assert names == [
        ["lavapipe:hlsl-dxc"], ["lavapipe:hlsl-glslang"], ["swiftshader:glsl"],
        ["lavapipe:wgsl-naga", "swiftshader:wgsl-naga"], ["llvmpipe:gl330"],
    ]  # fmt: skip
    assert said[3][1] == list(details(ROWS[4])) and said[3][1][-1] == REASON


def test_json_is_whole_and_plain() -> None:
    data = json.loads(json.dumps(as_json(ROWS), allow_nan=False))
    assert data["format"] == 2 and data["failures"] == 4
    assert as_json(ROWS, strict=True)["failures"] == 6
    assert data["statuses"] == {
        "agrees": 1, "differs": 2, "proves little": 2, "overflows": 1, "failed": 1, "not run": 1,
    }  # fmt: skip
    assert [row["status"] for row in data["rows"]] == [row.status for row in ROWS]
    assert all(row["material"] == NAME for row in data["rows"])
    agreed, differed, changed, overflowing, little, _, failed, missing = data["rows"]
    assert agreed["versions"] == VERSIONS and agreed["device"] == "<llvm> 1 & 2"
    assert math.isclose(agreed["bound_in_steps"], 0.01 * 2**10)
    share = agreed["cases"]["defaults"]["max_difference_in_bounds"]
    assert math.isclose(share, 0.5, rel_tol=1e-6)
    worst = differed["cases"]["defaults"]["worst"]
    assert worst["got"] == [1.5, 1, 1, 1] and worst["low"] == [0.99] * 4
    broken = differed["cases"]["behind"]
    assert broken["wrong"] == 1
    assert broken["max_difference"] is None and broken["worst"]["got"][0] is None
    assert changed["cases"]["defaults"]["changed"]["got"] == [1.25, 1, 1, 1]
    assert overflowing["cases"]["defaults"]["overflowing"] == 1
    assert little["cases"]["defaults"]["wide"] == 20 and little["reasons"] == [REASON]
    assert failed["problem"] == PROBLEM and failed["cases"] == {} and failed["device"] is None
    assert missing["problem"] == "chromium is not installed"


@pytest.mark.parametrize("strict", [False, True])
def test_junit(strict: bool) -> None:
    """A test case for each row; control characters, which XML has not, are replaced."""
    odd = replace(ROWS[6], material="bell\a", problem="a \x1b[31mred\x1b[0m message")
    root = fromstring(as_junit([*ROWS, odd], strict=strict))
    counts = {"tests": "9", "failures": "7" if strict else "5", "errors": "0", "skipped": "1"}
    assert root.attrib == {"name": "burnish conform", **counts}
    first, second = root
    assert (first.get("name"), second.get("name")) == (NAME, "bell\ufffd")
    kinds = [[child.tag for child in case] for case in first]
    little = ["failure"] if strict else ["system-out"]
    assert kinds == [
        [], ["failure"], ["failure"], ["failure"], little, little, ["failure"], ["skipped"],
    ]  # fmt: skip
    for case, row in zip(first, ROWS, strict=True):
        assert (case.get("classname"), case.get("name")) == (NAME, row.route.name)
    failure = first[1][0]
    assert failure.get("type") == "differs" and failure.text == "\n".join(details(ROWS[1]))
    assert first[7][0].get("message") == "chromium is not installed"
    assert REASON in (first[4][0].text or "")
    assert second[0][0].text == "a \ufffd[31mred\ufffd[0m message"


def test_an_unfinished_run() -> None:
    """Whatever is written of it says so; in JUnit's XML it is an error, as nothing has failed."""
    cut = Unfinished(known=1, of=3)
    assert as_json(ROWS[:1], cut)["unfinished"] == {"known": 1, "of": 3}
    assert "unfinished" not in as_json(ROWS[:1])
    root = fromstring(as_junit(ROWS[:1], cut, strict=False))
    counts = {"tests": "2", "failures": "0", "errors": "1", "skipped": "0"}
    assert root.attrib == {"name": "burnish conform", **counts}
    (error,) = root.iter("error")
    assert error.get("message") == "unfinished, 1 of 3 rows"
    said = outcome(ROWS[:1], cut)
    assert said == "unfinished, 1 of 3 rows: 1 agrees" and said in page(ROWS[:1], cut)
    assert outcome((), Unfinished(0, None)) == "unfinished, nothing was drawn yet"


class Reader(HTMLParser):
    """Sees whether elements are closed in order, and keeps text and pictures."""

    EMPTY = frozenset({"meta", "img", "br", "link", "hr"})

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.tags: set[str] = set()
        self.text: list[str] = []
        self.pictures: list[str] = []
        self.alternatives: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.order: list[str] = []
        self.labels = 0

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.order.append(tag)
        found = dict(attrs)
        if tag == "img":
            self.pictures.append(found["src"] or "")
            self.alternatives.append(found["alt"] or "")
        if tag == "svg" and found["role"] == "img" and found["aria-label"]:
            self.labels += 1
        if tag == "th":
            assert found["scope"] in ("col", "row")
        if "id" in found:
            self.ids.append(found["id"] or "")
        if tag == "a":
            self.links.append((found["href"] or "").removeprefix("#"))
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open and self.open.pop() == tag, f"</{tag}> closes something else"

    def handle_data(self, data: str) -> None:
        self.text.append(data)


def read(rows: list[Row]) -> Reader:
    """The page of a run."""
    reader = Reader()
    reader.feed(page(rows))
    reader.close()
    assert reader.open == []
    return reader


def test_the_page_is_whole_and_escaped() -> None:
    reader = read(ROWS)
    assert not reader.tags & {"b", "llvm", "beta", "script"}
    text = "".join(reader.text)
    assert NAME in text and "<llvm>" in text and "12 <beta>" in text
    for _, lines in messages(ROWS):
        assert all(line.strip() in text for line in lines)
    assert counted(ROWS) in text
    assert all(source.startswith("data:image/png;base64,") for source in reader.pictures)
    # Five for each case of the row that is farthest out of bounds: reference, drawn, difference,
    # bound, and what is decided.
    assert len(reader.pictures) == 2 * 5
    assert len(set(reader.alternatives)) == 10
    assert f"{NAME}, behind: bound, black is 1e-8, white 1 or more" in reader.alternatives


def test_the_pages_links_headings_and_tables() -> None:
    """Links lead somewhere, no two elements share an id, headings come in order, and each table's
    cells have headings."""
    reader = read(ROWS)
    assert len(set(reader.ids)) == len(reader.ids) and set(reader.links) <= set(reader.ids)
    levels = [int(tag[1]) for tag in reader.order if re.fullmatch("h[1-6]", tag)]
    assert levels[0] == 1 and all(b <= a + 1 for a, b in pairwise(levels))
    assert reader.order.count("svg") == reader.labels == 6


def test_the_page_needs_nothing_else() -> None:
    """No address in it leads to another file."""
    assert not re.search(r"(?:src|href)=\"(?!data:|#)|url\(|@import|https?:", page(ROWS))


def test_the_page_of_a_run_without_pictures() -> None:
    reader = read(ROWS[6:])
    assert reader.pictures == []
    assert "chromium is not installed" in "".join(reader.text)


def test_histograms_count_lanes_by_their_share_of_the_bound() -> None:
    counts = histogram((_result("defaults", 1.002), _result("behind", 1.5)))
    assert sum(counts) == 2 * SIZE[0] * SIZE[1] * 4
    assert counts[0] == sum(counts) - 2 and counts[EDGES.index(0.25)] == 1 and counts[-1] == 1


def test_maps_of_pixels() -> None:
    """Bounds on a logarithmic scale, and a colour for whatever is said of a pixel."""
    result = _result("defaults", 1.5, undecided=2, wide=3)
    grey = bound_map(result, 0)
    assert grey[0, 2, 0] == 1.0  # Nothing is known there.
    assert math.isclose(grey[1, 2, 0], (1 - 2 / 8) ** 2.2)
    shown = decision_map(result)
    assert len({tuple(pixel) for pixel in shown.reshape(-1, 4).tolist()}) == 4
    assert shown[1, 2, 0] > 0.5 and shown[1, 2, 1] == 0  # Red: out of bounds.
