"""A few errors planted in the library are found, and the tool says which are not.

``python -m tests.library.mutants`` plants all of them.
"""

from __future__ import annotations

import sys
from collections import Counter
from pathlib import Path

import pytest

import burnish

from ..suite.processes import run
from .changes import Change, changes
from .equivalent import EQUIVALENT
from .mutants import all_changes, judged, table, text_of

pytestmark = pytest.mark.xdist_group("library_mutants")  # One process finds all changes.

FEW, SEED = 30, 5


def test_planted_errors_are_found() -> None:
    """In a process of its own, as one that has compiled something keeps parts of the library."""
    command = (
        sys.executable,
        "-m",
        "burnish.tests.library.mutants",
        "--count",
        FEW,
        "--seed",
        SEED,
    )
    done = run(list(map(str, command)), cwd=Path(burnish.__file__).parent.parent, limit=240)
    assert done.returncode == 0, done.stdout
    assert done.stdout.splitlines()[-1].startswith("all ")


@pytest.mark.parametrize(
    ("before", "after", "verdict"),
    [
        ("= vertex_uv2", "=  vertex_uv2", "survived"),
        ("vertex_color.rgb", "vertex_color.bgr", "caught"),
        ("vertex_color.rgb", "vertex_color.rg", "refused"),
    ],
)
def test_verdicts(before: str, after: str, verdict: str) -> None:
    text = text_of("vertices")
    start = text.index(before)
    change = Change(start, start + len(before), after, "vertices", "std.vertices.SecondUv")
    assert judged(change)["verdict"] == verdict


def test_a_default_is_known_by_the_list_of_parameters_only() -> None:
    text = text_of("morphing")
    start = text.index("per draw = 0") + len("per draw = ")
    change = Change(start, start + 1, "0.5", "morphing", "std.morphing.Morphed")
    assert judged(change)["verdict"] == "golden"


def test_the_table_counts_by_file() -> None:
    counts = {"all": Counter(caught=3, survived=1), "lights": Counter(caught=3, survived=1)}
    assert [line.split() for line in table(counts).splitlines()] == [
        ["caught", "refused", "golden", "equivalent", "survived"],
        ["lights", "3", "0", "0", "0", "1"],
        ["all", "3", "0", "0", "0", "1"],
    ]


def test_changes_without_an_effect_are_some_that_there_are() -> None:
    known = Counter(change.told for change in all_changes())
    assert [told for told, count in known.items() if count > 1] == []
    stale = sorted(EQUIVALENT.keys() - known.keys())
    assert not stale, f"the library has no such expressions any more: {'; '.join(stale)}"


TEXT = "fn f(x: float, y: float) -> float = if x < 2 and true then min(x, -y) else (x + y * 3).xy"
CHANGED = """\
if x > 2 and true then min(x, -y) else (x + y * 3).xy
if x <= 2 and true then min(x, -y) else (x + y * 3).xy
if x < 3 and true then min(x, -y) else (x + y * 3).xy
if x < 1 and true then min(x, -y) else (x + y * 3).xy
if x < 2 or true then min(x, -y) else (x + y * 3).xy
if x < 2 then min(x, -y) else (x + y * 3).xy
if true then min(x, -y) else (x + y * 3).xy
if x < 2 and false then min(x, -y) else (x + y * 3).xy
if x < 2 and true then (x + y * 3).xy else min(x, -y)
if x < 2 and true then max(x, -y) else (x + y * 3).xy
if x < 2 and true then (x) else (x + y * 3).xy
if x < 2 and true then (-y) else (x + y * 3).xy
if x < 2 and true then min(x, y) else (x + y * 3).xy
if x < 2 and true then min(x, -y) else (x - y * 3).xy
if x < 2 and true then min(x, -y) else (x + y / 3).xy
if x < 2 and true then min(x, -y) else (x).xy
if x < 2 and true then min(x, -y) else (y * 3).xy
if x < 2 and true then min(x, -y) else (x + y).xy
if x < 2 and true then min(x, -y) else (x + y * 3).yy
if x < 2 and true then min(x, -y) else (x + y * 3).yx
(min(x, -y))
((x + y * 3).xy)
"""


def test_each_expression_has_changes() -> None:
    found = {change.applied(TEXT).partition("= ")[2] for change in changes("some", TEXT)}
    assert set(CHANGED.splitlines()) - found == set()


LOOP = "fn f(v: vec3) -> float = sum i in 0..n from 1.0 : abs(dot(v, normalize(v))) + sin(v.x)"
LOOPED = """\
sum i in 0..n - 1 from 1.0 : abs(dot(v, normalize(v))) + sin(v.x)
sum i in 1..n from 1.0 : abs(dot(v, normalize(v))) + sin(v.x)
sum i in 0..n : abs(dot(v, normalize(v))) + sin(v.x)
max i in 0..n from 1.0 : abs(dot(v, normalize(v))) + sin(v.x)
sum i in 0..n from 1.25 : abs(dot(v, normalize(v))) + sin(v.x)
sum i in 0..n from 1.0 : (dot(v, normalize(v))) + sin(v.x)
sum i in 0..n from 1.0 : abs(abs(dot(v, normalize(v)))) + sin(v.x)
sum i in 0..n from 1.0 : abs(dot(v, (v))) + sin(v.x)
sum i in 0..n from 1.0 : abs(dot(v, normalize(v))) + cos(v.x)
"""


def test_loops_and_functions_have_changes() -> None:
    found = {change.applied(LOOP).partition("= ")[2] for change in changes("some", LOOP)}
    assert set(LOOPED.splitlines()) - found == set()
