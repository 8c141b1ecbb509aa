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
from burnish.compiler.reference.picture import Expected, Geometry, RasterRules, drawing, tiles
from burnish.compiler.reference.picture.coverage import Coverage, coverage_of
from burnish.compiler.reference.picture.faces import Faces

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


def test_a_tile_has_the_faces_that_may_cover_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """So many small faces in a large picture take no longer than few for each tile."""
    monkeypatch.setattr(tiles, "MOST", 100)
    given, counts = shader(BLENDED.format(1), "P"), list[int]()

    def counted(faces: Faces, *rest: Any) -> Coverage:
        counts.append(len(faces.area))
        return coverage_of(faces, *rest)

    monkeypatch.setattr(drawing, "coverage_of", counted)
    places = np.linspace(-0.95, 0.95, 20)
    corners = np.array([(0.0, 0.0), (0.04, 0.0), (0.0, 0.04)])
    grid = np.stack(np.meshgrid(places, places), axis=-1).reshape(-1, 1, 2) + corners
    flat = grid.reshape(-1, 2)
    place = np.hstack([flat, np.full((len(flat), 1), 0.5), np.ones((len(flat), 1))])
    triangles = np.arange(len(flat)).reshape(-1, 3)
    picture(given, geometry(triangles, place=place), RasterRules(48, 48, 8))
    assert len(counts) > 16
    assert sum(counts) < 4 * len(triangles)


def test_very_many_faces_are_refused() -> None:
    with raised({"memory": 1000}), pytest.raises(BudgetError, match="what is drawn of `M` needs"):
        picture(shader(BLENDED.format(1), "P"), _squares(1), RasterRules(1, 1, 8))


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
