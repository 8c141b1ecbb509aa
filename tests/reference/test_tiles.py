"""Pictures are drawn tile by tile, and are the same as if they were drawn at once."""

from __future__ import annotations

import tracemalloc
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.compiler.budget import BudgetError, raised
from burnish.compiler.ir.shader import Shader
from burnish.compiler.reference.live import most_live
from burnish.compiler.reference.picture import Expected, Geometry, RasterRules, tiles
from burnish.compiler.reference.picture.assembly import faces_of

from .kit import few_ulps, geometry, picture, shader

BLENDED = """
abstract material Base {{
    attribute place : vec4
    clip_position : vec4 = place
    value : vec4
}}
material M : Base {{
    value = vec4(frag_coord.xy / 32, ddx(sin(frag_coord.x)), 0.5)
}}
pass P {{
    raster {{ samples = {} }}
    target t : rgba16f = material.value blend alpha
}}
"""

SIDE = 8
"""Pixels of a side of a picture that is also drawn pixel by pixel."""


def _squares(count: int) -> Geometry:
    """Squares behind each other, each of which covers nearly all of the picture."""
    corners = np.array([(-0.9, -0.8), (0.95, -0.85), (0.9, 0.9), (-0.95, 0.7)])
    depths = np.repeat(np.linspace(0.9, 0.1, count), 4)[:, None]
    places = np.hstack([np.tile(corners, (count, 1)), depths, np.ones_like(depths)])
    first = 4 * np.arange(count)[:, None]
    triangles = np.hstack([first + np.array([0, 1, 2]), first + np.array([0, 2, 3])])
    return geometry(triangles, place=places)


def _drawn(given: Shader, count: int, side: int, errors: Any) -> Expected:
    return picture(given, _squares(count), RasterRules(side, side, 8), errors=errors)


@pytest.mark.parametrize("samples", [1, 4])
@pytest.mark.parametrize("errors", [None, few_ulps])
def test_tiles_do_not_show(samples: int, errors: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    given = shader(BLENDED.format(samples), "P")
    whole = _drawn(given, 5, SIDE, errors)
    assert whole.layers.max() == 5
    for most in (100, 1):
        monkeypatch.setattr(tiles, "MOST", most)
        found = _drawn(given, 5, SIDE, errors)
        for one, other in zip(_arrays(whole), _arrays(found), strict=True):
            assert np.array_equal(one, other, equal_nan=True)


def _arrays(picture: Expected) -> list[Any]:
    ends = (*picture.targets, *picture.low, *picture.high)
    return [*ends, picture.covered, picture.undecided, picture.layers]


def test_what_lies_behind_each_other_needs_no_more_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tiles, "MOST", 1 << 11)
    given, peaks = shader(BLENDED.format(1), "P"), []
    for count in (4, 16):
        tracemalloc.start()
        _drawn(given, count, 32, None)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 1.5 * peaks[0]


@pytest.mark.parametrize(
    ("value", "least", "most"),
    [
        ("1.0", 0, 1),
        ("float(index)", 1, 3),
        ("dot(vec3(float(index)), vec3(1, 2, float(index)))", 3, 12),
        ("(if index > 2 then b[0] else b[1]).a[index & 7]", 4096, 3 * 4096),
        ("sum i in 0..9 : (if index > i then b[0] else b[1]).a[index & 7]", 4096, 3 * 4096),
    ],
)
def test_how_many_numbers_there_are_of_an_invocation(value: str, least: int, most: int) -> None:
    text = (
        "struct A {{ a : float[4096] }}\nkernel K {{ buffer b : A[]\n result r : float[9] = {} }}"
    )
    kernel = burnish.compile(text.format(value), ())["K"].shader
    assert least <= most_live([result.value for result in kernel.results]) <= most


# --- many faces ----------------------------------------------------------------------------------

OPAQUE = BLENDED.replace(" blend alpha", "").format(1)


def _small(count: int) -> Geometry:
    """Triangles that lie in one pixel, each behind the one before."""
    corners = np.array([(-0.3, -0.3), (-0.1, -0.3), (-0.3, -0.1)])
    depths = np.repeat(np.linspace(0.1, 0.9, count), 3)[:, None]
    places = np.hstack([np.tile(corners, (count, 1)), depths, np.ones_like(depths)])
    return geometry(np.arange(3 * count).reshape(count, 3), place=places)


def test_tiles_look_only_at_the_faces_that_touch_them(monkeypatch: pytest.MonkeyPatch) -> None:
    """There may be as many tiles as faces; the faces looked at grow only with their logarithm."""
    monkeypatch.setattr(tiles, "MOST", 64)
    rules = RasterRules(64, 64, 8)
    looked: list[int] = []
    within = tiles._Around.within

    def counted(around: Any, tile: tiles.Tile) -> Any:
        looked[-1] += len(around.face)
        return within(around, tile)

    monkeypatch.setattr(tiles._Around, "within", counted)
    for side in (16, 32):
        looked.append(0)
        ends = np.linspace(-1, 1, side + 1)[:-1]
        x, y = (each.ravel()[:, None] for each in np.meshgrid(ends, ends))
        step = 1 / side
        corners = [np.hstack([x + a, y + b]) for a, b in ((0, 0), (step, 0), (0, step))]
        places = np.stack(corners, axis=1).reshape(-1, 2)
        places = np.hstack([places, np.full_like(places, 0.5)])
        places[:, 3] = 1
        faces = faces_of(places, np.arange(len(places)).reshape(-1, 3), rules)
        given = list(tiles.tiles(faces, tiles.Tile.of(rules), rules))
        assert len(given) > side
        assert sum(len(each) for _tile, each in given) < 8 * len(faces.area)
    assert looked[1] < 6 * looked[0], "four times as many faces"


def test_faces_are_counted_before_they_are_made() -> None:
    given = shader(OPAQUE, "P")
    tracemalloc.start()
    count = 10_000
    of_geometry = _small(count)
    tracemalloc.reset_peak()
    before = tracemalloc.get_traced_memory()[0]
    picture(given, of_geometry, RasterRules(4, 4, 8))
    needed = tracemalloc.get_traced_memory()[1] - before
    tracemalloc.stop()
    with (
        raised({"memory": 3 * needed // 4}),
        pytest.raises(BudgetError, match=r"^what `M` draws needs "),
    ):
        picture(given, of_geometry, RasterRules(4, 4, 8))


def test_what_nobody_waits_for_at_one_pixel_is_refused() -> None:
    given = shader(BLENDED.format(1), "P")
    with raised({"operations": 10**8}):
        picture(given, _small(100), RasterRules(4, 4, 8))
        picture(shader(OPAQUE, "P"), _small(1000), RasterRules(4, 4, 8))
        with pytest.raises(BudgetError, match=r"^what 101 faces draw over each other takes"):
            picture(given, _small(101), RasterRules(4, 4, 8))
