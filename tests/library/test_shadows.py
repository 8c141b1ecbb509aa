"""Shadow maps: which texels are compared, and which of several maps shows a point."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from burnish.compiler.documents.plan import DrawStep, ResultSource
from burnish.compiler.ir.stages import CLIP_POSITION, DISCARD, TARGET
from burnish.compiler.reference.namespace import Lanes

from ..frames.kit import inputs_of, of_text
from ..semantics.kit import at, shader
from .kit import (
    MESH,
    NORMAL_IN_WORLD,
    POSITION_IN_WORLD,
    Floats,
    close,
    columns,
    lanes,
    of,
    shown,
    unit,
)
from .truth import truth

SIZE = (64, 32)


@dataclass
class Compared:
    """A map of depths that notes what is compared, and finds everything left of a line lit."""

    line: float = 0.5
    asked: list[tuple[float, ...]] = field(default_factory=list)

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of a read."""
        if name == "texture_size":
            return SIZE
        assert name == "compare", name
        place, *others = operands
        self.asked.append((*map(float, place), *(float(each[0]) for each in others)))
        return (float(place[0] < self.line),)


def around(x: float, y: float, spread: float) -> Floats:
    """3 by 3 places, so many texels apart."""
    steps = spread * np.array([-1.0, 0.0, 1.0])
    across, down = np.meshgrid(x + steps / SIZE[0], y + steps / SIZE[1], indexing="ij")
    return np.stack([across.ravel(), down.ravel()], axis=1)


@truth("std.shadows.share_lit", "std.shadows.neighbour")
@pytest.mark.parametrize(
    ("kind", "layer", "others"),
    [("depth2d", "", (0.5,)), ("depth2d_array", "2, ", (2.0, 0.5))],
)
def test_nine_comparisons_around_a_place(kind: str, layer: str, others: tuple[float, ...]) -> None:
    shadow = Compared(line=0.4 + 0.7 / SIZE[0])
    text = (
        f"import std.shadows.{{share_lit}}\nmaterial M {{ map shadow : {kind}\n"
        f"color = vec3(share_lit(shadow, {layer}vec3(0.4, 0.7, 0.75), 0.25, 1.5)) }}"
    )
    found = shown(text, shadow=shadow)
    assert found == close([6 / 9] * 3)
    asked = np.array(sorted(set(shadow.asked)))
    assert asked[:, :2] == close(around(0.4, 0.7, 1.5))
    assert (asked[:, 2:] == others).all()
    assert shown(text, shadow=Compared(line=9.0)) == close([1] * 3)


@truth("std.shadows.neighbour")
def test_neighbours_are_counted_row_by_row() -> None:
    ways = [(x, y) for y in (-1, 0, 1) for x in (-1, 0, 1)]
    for number, way in enumerate(ways):
        found = of(f"neighbour({number}), 0", "M", "import std.shadows.{neighbour}")
        assert found == close((*way, 0))


@truth("std.shadows.ShadowedSpot")
def test_a_spot_is_lit_by_what_its_map_lets_through() -> None:
    """The point is on the lamp's axis: in the middle of the map, at the depth of a perspective.

    The bias moves it by its share of the way towards the lamp.
    """
    away, near, far = 1.5, 0.2, 9.0
    to_lamp = unit((0.3, 1.4, 0.8))
    shadow = Compared(line=0.5 + 0.5 * 2.0 / SIZE[0])  # Six of nine places are lit.
    text = (
        "import std.shadows.{ShadowedSpot}\nimport std.terms.{ambient, lambert}\n"
        "material M { color = ambient(#000) + lambert(vec3(1)) }\nrig R { lamp : ShadowedSpot }"
    )
    given: dict[str, Any] = {
        "lamp.place": lanes(POSITION_IN_WORLD + away * to_lamp), "lamp.axis": lanes(-to_lamp),
        "lamp.inner": math.radians(15), "lamp.outer": math.radians(30), "lamp.nearest": near,
        "lamp.farthest": far, "lamp.bias": 0.01, "lamp.spread": 2.0,
    }  # fmt: skip
    lit = shown(text, **given, **{"lamp.shadow": shadow})
    asked = np.array(sorted(set(shadow.asked)))
    assert asked[:, :2] == close(around(0.5, 0.5, 2.0))
    assert asked[:, 2] == close(np.full(9, far / (far - near) * (1 - near / (0.99 * away))))
    assert lit == close([6 / 9 * max(float(NORMAL_IN_WORLD @ to_lamp), 0.0)] * 3)
    dark = shown(text, **given, **{"lamp.shadow": Compared(line=-2.0)})
    assert dark == close((0, 0, 0))


@truth("std.shadows.ShadowedSpot")
def test_a_cone_fades_whatever_its_map_lets_through() -> None:
    """Exactly between both angles, in the cosine, half of the light arrives."""
    inner, outer = math.radians(10), math.radians(50)
    cosine = (math.cos(inner) + math.cos(outer)) / 2
    to_lamp = unit((0.3, 1.4, 0.8))
    across = unit(np.cross(to_lamp, (1.0, 0.0, 0.0)))
    axis = -to_lamp * cosine + across * math.sqrt(1 - cosine**2)
    given: dict[str, Any] = {
        "lamp.place": lanes(POSITION_IN_WORLD + to_lamp), "lamp.axis": lanes(axis),
        "lamp.inner": inner, "lamp.outer": outer, "lamp.shadow": Compared(line=9.0),
    }  # fmt: skip
    found = shown(
        "import std.shadows.{ShadowedSpot}\nimport std.terms.{lambert}\n"
        "material M { color = lambert(vec3(1)) }\nrig R { lamp : ShadowedSpot }", **given,
    )  # fmt: skip
    assert found == close([0.5 * float(NORMAL_IN_WORLD @ to_lamp)] * 3)


@truth("std.shadows.DepthOnly")
@pytest.mark.parametrize("is_hidden", [True, False])
def test_a_map_has_nothing_of_what_is_hidden(is_hidden: bool) -> None:
    text = "import std.shadows.{DepthOnly}\nmaterial M { param gone : bool  is_hidden = gone }"
    whole = shader(text, pass_="DepthOnly")
    (discard,) = whole.results_of(DISCARD)
    assert at(whole, discard.value, {**MESH, "gone": (is_hidden,)}) == (is_hidden,)


@truth("std.shadows.DepthOnly")
def test_a_map_has_depths_alone() -> None:
    whole = shader("import std.shadows.{DepthOnly}\nmaterial M {}", pass_="DepthOnly")
    assert not whole.results_of(TARGET)
    (placed,) = whole.results_of(CLIP_POSITION)
    camera = seeing((0.25, -0.5, 0.125))
    given = {**MESH, "view_projection": columns(camera)}
    expected = camera @ (*POSITION_IN_WORLD, 1.0)
    assert at(whole, placed.value, given) == pytest.approx(tuple(expected))


def seeing(middle: tuple[float, float, float]) -> Floats:
    """A camera whose clip space is a cube of size 2, 2 and 1 around a place."""
    camera = np.eye(4)
    camera[:3, 3] = -np.array(middle)
    return camera


def deep(middle: tuple[float, float, float]) -> Floats:
    """The same camera, which sees four times as far in both directions."""
    camera = seeing(middle)
    camera[2] = (0, 0, 0.25, 0.375)
    return camera


@truth("std.shadows.first_to_show", "std.frames.shows", "std.frames.is_in_picture")
@pytest.mark.parametrize(
    ("place", "number"),
    [
        ((0.0, 0.0, 0.5), 0),  # all three show it
        ((0.9, 0.9, 0.9), 0),
        ((0.977, 0.0, 0.5), 0),
        ((0.982, 0.0, 0.5), 1),  # so near to the edge that a comparison beside it is outside
        ((2.0, 0.0, 0.5), 1),  # beside the first one
        ((0.0, -2.0, 0.5), 2),  # below all but the last one
        ((0.0, 9.0, 0.5), 2),  # nowhere
        ((0.7, 0.0, 1.25), 1),  # behind what the first one sees
        ((0.7, 0.0, -0.25), 1),  # before it
    ],
)
def test_the_first_map_that_shows_a_point(place: tuple[float, ...], number: int) -> None:
    cameras = (seeing((0, 0, 0)), deep((1.5, 0, 0)), seeing((0, -2.5, 0)))
    found = shown(
        "import std.shadows.{first_to_show}\n"
        "material M { param cameras : transform<world, clip>[3]  param at : point<world>\n"
        "color = vec3(float(first_to_show(cameras, at))) }",
        cameras=tuple(map(columns, cameras)), at=place,
    )  # fmt: skip
    assert found == close([number] * 3)


@truth("std.shadows.ShadowedSpot")
@pytest.mark.parametrize(
    ("outer", "seen", "off", "near", "far", "last"),
    [
        (60.0, 60.0, 40.0, 0.2, 9.0, 9.0),
        (88.0, 80.0, 79.0, 0.2, 9.0, 9.0),  # A map shows no wider cone than that.
        (0.5, 1.0, 0.4, 0.2, 9.0, 9.0),  # Nor a narrower one.
        (45.0, 45.0, 10.0, 2.0, 0.5, 2.002),  # Its depths end behind where they begin.
    ],
)
def test_a_point_lies_in_the_map_where_the_cone_says(
    outer: float, seen: float, off: float, near: float, far: float, last: float
) -> None:
    ahead, to_lamp = (near + last) / 2, unit((0.3, 1.4, 0.8))
    across = unit(np.cross(to_lamp, (1.0, 0.0, 0.0)))
    turn = math.radians(off)
    away = ahead / (0.999 * math.cos(turn))
    axis = -to_lamp * math.cos(turn) + across * math.sin(turn)
    shadow = Compared()
    given: dict[str, Any] = {
        "lamp.place": lanes(POSITION_IN_WORLD + away * to_lamp), "lamp.axis": lanes(axis),
        "lamp.inner": 0.0, "lamp.outer": math.radians(outer), "lamp.nearest": near,
        "lamp.farthest": far, "lamp.bias": 0.001, "lamp.spread": 0.0, "lamp.shadow": shadow,
    }  # fmt: skip
    shown(
        "import std.shadows.{ShadowedSpot}\nimport std.terms.{lambert}\n"
        "material M { color = lambert(vec3(1)) }\nrig R { lamp : ShadowedSpot }", **given,
    )  # fmt: skip
    x, y, depth = shadow.asked[0]
    assert math.hypot(2 * x - 1, 2 * y - 1) == pytest.approx(
        math.tan(turn) / math.tan(math.radians(seen))
    )
    assert depth == pytest.approx(last / (last - near) * (1 - near / ahead))


@truth("std.shadows.ShadowedSpot")
def test_a_lamp_draws_what_it_sees_into_its_map() -> None:
    frame = of_text(
        "import std.shadows.{ShadowedSpot}\nimport std.terms.{lambert}\n"
        "material M { color = lambert(vec3(1)) }\nrig R { lamp : ShadowedSpot }\n"
        "frame F { models scene : M  drawn = Forward(scene)  output shown = drawn.color }"
    )
    seen, drawn = frame.plan.steps
    assert isinstance(seen, DrawStep) and isinstance(drawn, DrawStep)
    assert (seen.pass_, drawn.pass_) == ("DepthOnly", "Forward")
    assert [row.name for row in inputs_of(seen)] == ["view_projection", "eye"]
    (read,) = inputs_of(drawn)
    assert isinstance(read.source, ResultSource)
    assert (read.name, read.source.result) == ("lamp.shadow", "lamp.seen.depth")
    assert seen.depth is not None and seen.depth.result == "lamp.seen.depth"


@truth("std.frames.shows", "std.frames.is_in_picture")
@pytest.mark.parametrize(
    ("place", "margin", "is_shown"),
    [
        ((0.95, 0.0, 0.5), 0.0, 1), ((0.95, 0.0, 0.5), 0.1, 0), ((0.0, -0.85, 0.5), 0.1, 1),
        ((0.0, 0.0, 0.0), 0.0, 1), ((0.0, 0.0, 1.0), 0.0, 1), ((0.0, 0.0, 1.01), 0.0, 0),
        ((1.0, 0.0, 0.5), 0.0, 1), ((0.0, -1.0, 0.5), 0.0, 1),
        ((0.0, 0.0, -0.01), 0.0, 0), ((0.0, 1.01, 0.5), 0.0, 0), ((-1.01, 0.0, 0.5), 0.0, 0),
    ],
)  # fmt: skip
def test_what_a_camera_shows(place: tuple[float, ...], margin: float, is_shown: int) -> None:
    """Also where clip space is turned inside out: behind the camera w is negative."""
    for camera, wanted in ((np.eye(4), is_shown), (-np.eye(4), 0)):
        found = shown(
            "import std.frames.{shows}\n"
            "material M { param camera : transform<world, clip>  param at : point<world>\n"
            f"color = vec3(float(shows(camera, at, {margin}))) }}",
            camera=columns(camera), at=place,
        )  # fmt: skip
        assert found == close([wanted] * 3)


@truth("std.frames.shows")
@pytest.mark.parametrize(("x", "is_shown"), [(0.0, 1), (0.999, 1), (1.001, 0), (-1.001, 0)])
def test_a_camera_shows_all_of_its_picture(x: float, is_shown: int) -> None:
    found = shown(
        "import std.frames.{shows}\n"
        "material M { param camera : transform<world, clip>  param at : point<world>\n"
        "color = vec3(float(shows(camera, at))) }",
        camera=columns(seeing((2, 0, 0))), at=(2 + x, 0.0, 0.5),
    )  # fmt: skip
    assert found == close([is_shown] * 3)


@truth("std.frames.is_in_picture")
@pytest.mark.parametrize(("w", "is_in"), [(1e-9, 1), (0.0, 0), (-1.0, 0)])
def test_no_picture_has_a_place_beside_the_eye(w: float, is_in: int) -> None:
    found = shown(
        "import std.frames.{is_in_picture}\nmaterial M { param at : vec4\n"
        "color = vec3(float(is_in_picture(at, 0))) }", at=(0.0, 0.0, 0.0, w),
    )  # fmt: skip
    assert found == close([is_in] * 3)


@truth("std.shadows.share_lit", "std.frames.is_in_picture")
@pytest.mark.parametrize(
    ("place", "share"),
    [((2, 0, 0.5), 0), ((9.99, 0, 0.5), 0), ((10.05, 0, 0.5), 1), ((0, -15, 0.5), 1)],
)
def test_all_light_arrives_beside_a_map(place: tuple[float, ...], share: float) -> None:
    """The map shows ten units to each side."""
    found = shown(
        "import std.shadows.{share_lit}\n"
        "material M { map shadow : depth2d  map shadows : depth2d_array\n"
        "param camera : transform<world, clip>  param at : point<world>\n"
        "color = vec3(share_lit(shadow, camera, at, 0, 1),"
        " share_lit(shadows, 1, camera, at, 0, 1), 0) }",
        camera=columns(np.diag((0.1, 0.1, 1.0, 1.0))), at=place, shadow=Compared(-9.0),
        shadows=Compared(-9.0),
    )  # fmt: skip
    assert found == close((share, share, 0))


@truth("std.shadows.share_lit")
@pytest.mark.parametrize("kind", ["depth2d", "depth2d_array"])
def test_a_place_is_compared_where_the_camera_shows_it(kind: str) -> None:
    shadow, layer = Compared(0.59), "3, " if kind == "depth2d_array" else ""
    found = shown(
        f"import std.shadows.{{share_lit}}\nmaterial M {{ map shadow : {kind}\n"
        "param camera : transform<world, clip>  param at : point<world>\n"
        f"color = vec3(share_lit(shadow, {layer}camera, at, 0.25, 2)) }}",
        camera=columns(seeing((5, 0, 0))), at=(5.2, -0.4, 0.75), shadow=shadow,
    )  # fmt: skip
    asked = np.array(sorted(set(shadow.asked)))
    assert (asked[:, 0] < shadow.line).mean() == 1 / 3
    assert found == close([1 / 3] * 3)
    assert asked[:, :2] == close(around(0.6, 0.7, 2.0))
    assert asked[:, -1] == close(np.full(9, 0.5))
