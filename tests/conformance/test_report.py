"""A run in words, as JSON and as a page."""

from __future__ import annotations

import json
import math
from html.parser import HTMLParser

import numpy as np

from burnish.compiler.reference.picture import Expected
from burnish.targets.conformance.compare import compare
from burnish.targets.conformance.report import as_json, page
from burnish.targets.conformance.rows import CaseResult, Row
from burnish.targets.conformance.summary import cells, counted, details
from burnish.targets.conformance.tolerances import Tolerance
from burnish.targets.runner.drivers.draw import Device
from burnish.targets.runner.routes import ROUTES

SIZE = (4, 6)
NAME = 'a<b> & "c".burnish: Odd'
DEVICE = Device("<llvm>", "1 & 2", 8, 8, 8)
VERSIONS = {"glslang": "12 <beta>"}
PROBLEM = "glslang rejects Odd.frag.glsl\n  3:7: '<' : syntax error & more"


def _result(case: str, value: float = 1.0, undecided: int = 0, wanted_: float = 1.0) -> CaseResult:
    """A picture of ones against one with another value in one lane."""
    wanted, got = np.ones((*SIZE, 4)), np.ones((*SIZE, 4))
    got[1, 2, 0] = value
    wanted[1, 2, 0] = wanted_
    unsure = np.zeros(SIZE, dtype=np.bool_)
    unsure.flat[:undecided] = True
    covered = np.ones(SIZE, dtype=np.bool_)
    expected = Expected((wanted,), covered, unsure, (np.zeros_like(wanted),))
    comparison = compare((got,), expected, Tolerance(0.01, 0.0, "for tests"), [0.0])
    return CaseResult(case, comparison, (got,), expected)


def _row(route: str, status: str, *results: CaseResult, problem: str = "") -> Row:
    assert status in ("agrees", "differs", "overflows", "undecided", "failed", "not run")
    device = DEVICE if results else None
    return Row(NAME, ROUTES[route], status, problem, device, VERSIONS, results)  # type: ignore[arg-type]


ROWS = [
    _row("lavapipe:glsl", "agrees", _result("defaults", 1.005), _result("behind")),
    _row("lavapipe:hlsl-dxc", "differs", _result("defaults", 1.5), _result("behind", math.nan)),
    _row("swiftshader:glsl", "overflows", _result("defaults", math.inf, wanted_=1e39)),
    _row("lavapipe:wgsl-naga", "undecided", _result("defaults", undecided=3)),
    _row("llvmpipe:gl330", "failed", problem=PROBLEM),
    _row("chromium:webgpu", "not run", problem="chromium is not installed"),
]

TABLE = """\
lavapipe:glsl       agrees     5.0e-03  50%       0 of 48
lavapipe:hlsl-dxc   differs    inf      infinite  0 of 48
swiftshader:glsl    overflows  0.0e+00  0%        0 of 24
lavapipe:wgsl-naga  undecided  0.0e+00  0%        3 of 24
llvmpipe:gl330      failed
chromium:webgpu     not run
"""

DETAILS = """\
lavapipe:hlsl-dxc: defaults: 1 of 24 pixels; the worst, at (2, 1), is (1.5, 1, 1, 1) and should be \
(1, 1, 1, 1)
lavapipe:hlsl-dxc: behind: 1 of 24 pixels; the worst, at (2, 1), is (nan, 1, 1, 1) and should be \
(1, 1, 1, 1)
swiftshader:glsl: defaults: in 1 of 24 pixels the value leaves what float32 holds, where nothing \
is promised; at (2, 1) it is (1e+39, 1, 1, 1)
lavapipe:wgsl-naga: defaults: 3 of 24 pixels hang on rounding, which is too many to prove anything
llvmpipe:gl330: glslang rejects Odd.frag.glsl
llvmpipe:gl330:   3:7: '<' : syntax error & more
chromium:webgpu: chromium is not installed
"""


def test_the_table() -> None:
    lines = [cells(row) for row in ROWS]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    shown = ("  ".join(map(str.ljust, line, widths)).rstrip() + "\n" for line in lines)
    assert "".join(shown) == TABLE
    every = "1 agrees, 1 differs, 1 overflows, 1 undecided, 1 failed, 1 not run"
    assert counted(ROWS) == every
    assert counted(ROWS[:1] * 3 + ROWS[1:2] * 2) == "3 agree, 2 differ"


def test_the_details() -> None:
    lines = (f"{row.route.name}: {line}\n" for row in ROWS for line in details(row))
    assert "".join(lines) == DETAILS


def test_json_is_whole_and_plain() -> None:
    data = json.loads(json.dumps(as_json(ROWS), allow_nan=False))
    assert [row["status"] for row in data["rows"]] == [row.status for row in ROWS]
    assert all(row["material"] == NAME for row in data["rows"])
    agreed, differed, overflowing, _, failed, missing = data["rows"]
    assert agreed["versions"] == VERSIONS and agreed["device"] == "<llvm> 1 & 2"
    share = agreed["cases"]["defaults"]["max_difference_in_tolerances"]
    assert math.isclose(share, 0.5, rel_tol=1e-6)
    assert differed["cases"]["defaults"]["worst"]["got"] == [1.5, 1, 1, 1]
    broken = differed["cases"]["behind"]
    assert broken["wrong"] == 1
    assert broken["max_difference"] is None and broken["worst"]["got"][0] is None
    assert overflowing["cases"]["defaults"]["overflowing"] == 1
    assert failed["problem"] == PROBLEM and failed["cases"] == {} and failed["device"] is None
    assert missing["problem"] == "chromium is not installed"


class Reader(HTMLParser):
    """Sees whether elements are closed in order, and keeps text and pictures."""

    EMPTY = frozenset({"meta", "img", "br", "link", "hr"})

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.tags: set[str] = set()
        self.text: list[str] = []
        self.pictures: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        if tag == "img":
            self.pictures.append(dict(attrs)["src"] or "")
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open and self.open.pop() == tag, f"</{tag}> closes something else"

    def handle_data(self, data: str) -> None:
        self.text.append(data)


def test_the_page_is_whole_and_escaped() -> None:
    reader = Reader()
    reader.feed(page(ROWS))
    reader.close()
    assert reader.open == []
    assert not reader.tags & {"b", "llvm", "beta", "script"}
    text = "".join(reader.text)
    assert NAME in text and "<llvm>" in text and "12 <beta>" in text
    for row in ROWS:
        assert all(line.strip() in text for line in details(row))
    assert counted(ROWS) in text
    assert all(source.startswith("data:image/png;base64,") for source in reader.pictures)
    # The reference's two, and of each of four cases that do not agree what was drawn, what
    # should have been, and the difference.
    assert len(reader.pictures) == 2 + 4 * 3


def test_the_page_of_a_run_without_pictures() -> None:
    reader = Reader()
    reader.feed(page(ROWS[4:]))
    reader.close()
    assert reader.open == [] and reader.pictures == []
    assert "chromium is not installed" in "".join(reader.text)
