"""Shadows and distance impostors of the examples beside a ray tracer that was written by hand."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

import burnish
from burnish.api.entry_points import CompiledFrame
from burnish.targets.runner.frames.by_reference import ReferenceFrames
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row

from .kit import FOLDER, compiled
from .tracing import FLOOR, NOTHING, Floats, Row, linear, rays, seen, smoothstep

SIZE = 128
APART = 2.2
"""The distance between the centres of two neighbouring balls."""
AMBIENT = 0.1


def drawn(frame: CompiledFrame) -> tuple[Floats, FrameHost]:
    """The picture of a frame by the reference, and the frame's values."""
    tags = {row.name: row.materials for row in frame.plan.models}
    materials = list(dict.fromkeys(each for listed in tags.values() for each in listed))
    host = FrameHost(frame, in_a_row(materials, tags, "sphere"), (SIZE, SIZE))
    frames = ReferenceFrames(host)
    frames.draw()
    return frames.output("picture").levels[0][0, 0, :, :, :3], host


def unit(v: Floats) -> Floats:
    found: Floats = v / np.linalg.norm(v, axis=-1, keepdims=True)
    return found


def test_shadows_fall_where_rays_to_the_lamp_are_stopped() -> None:
    picture, host = drawn(compiled(FOLDER / "shadows.burnish"))
    row = Row((-APART / 2, APART / 2), APART / 2 + 3)
    place, what = seen(row, host.scenery.scene.camera, SIZE)
    lamp, axis = (np.array(host.values.get(f"lamp.{name}")) for name in ("place", "axis"))
    to_lamp = unit(lamp - place)
    passed = row.clearance(place, np.broadcast_to(lamp, place.shape), what)
    lambert = np.clip((row.normal(place, what) * to_lamp).sum(axis=-1), 0, None)
    cone = smoothstep(math.cos(math.radians(35)), math.cos(math.radians(25)), -(to_lamp @ axis))
    arrives = (lambert * cone * (passed > 0))[..., None] * host.values.get("lamp.diffuse_color")
    # The first ball is of clay; the other one and the floor are of slate.
    base = np.where((what == 0)[..., None], linear("#c8763c"), linear("#6f8ba4"))
    # A shadow's edge is as soft as the texels of the map are large.
    judged = (what != NOTHING) & (np.abs(passed) > 0.08)
    dark = judged & (passed < 0) & (lambert * cone > 0.1)
    assert judged.mean() > 0.5
    assert min(dark.sum(), (judged & (arrives[..., 0] > 0.1)).sum()) > 200
    wanted = base * (AMBIENT + arrives)
    assert picture[judged] == pytest.approx(wanted[judged], abs=0.02)


def share_that_is_right(steps: int) -> float:
    """The share of the judged pixels of balls that mirror the floor as traced rays find it.

    The shader's search takes as many ``steps`` for each of them.
    """
    text = (FOLDER / "impostors.burnish").read_text("utf-8")
    text = re.sub(r"steps = [148]", f"steps = {steps}", text)
    (frame,) = burnish.compile(text, ("wgsl",), search_path=[FOLDER]).frames
    picture, host = drawn(frame)
    middles = tuple(APART * (number - 1.5) for number in range(4))
    row, walls = Row(middles, 1.5 * APART + 3), Row(middles[:1], 1.5 * APART + 3)
    place, what = seen(row, host.scenery.scene.camera, SIZE)
    way, normal = rays(host.scenery.scene.camera, SIZE), row.normal(place, what)
    mirrored = way - 2 * (way * normal).sum(axis=-1, keepdims=True) * normal
    far, found = walls.hit(place, mirrored)
    there = place + np.where(np.isfinite(far), far, 0)[..., None] * mirrored
    # The cube map has to show the place, too, and not the edge of a tile.
    middle = np.broadcast_to(host.values.get("middle"), there.shape)
    tile = (there[..., [0, 2]] / walls.half + 1) * 6
    is_inside = np.abs(tile % 1 - 0.5).max(axis=-1) < 0.44
    is_shown = walls.clearance(middle, there, np.full(what.shape, NOTHING)) > 0.1
    judged = (what > 0) & (found == FLOOR) & is_inside & is_shown & (far < 6)
    assert judged.sum() > 200
    sun = {
        name: np.array(host.values.get(f"sun.{name}")) for name in ("diffuse_color", "direction")
    }
    light = 2 * AMBIENT - sun["direction"][1] * sun["diffuse_color"]
    is_even = np.floor(tile).astype(int).sum(axis=-1) % 2 == 0
    wanted = np.where(is_even[..., None], linear("#d8c9a0"), linear("#4d5a66")) * light
    off = np.abs(picture - wanted * linear("#e8f0ff")).max(axis=-1)
    return float((off < 0.06)[judged].mean())


def test_distance_impostors_find_what_mirrored_rays_hit() -> None:
    one, four, eight = map(share_that_is_right, (1, 4, 8))
    assert one < 0.85
    assert 0.9 < four <= eight
