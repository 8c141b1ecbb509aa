"""The results of single steps of the examples, drawn by the reference, against other sources."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.compiler.documents.plan import DrawStep, PlanStep
from burnish.targets.runner.frames.by_reference import ReferenceFrames
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row

from .kit import FOLDER, compiled

Floats = NDArray[np.float64]


class Steps(ReferenceFrames):
    """A frame that keeps the first layer of each target as a step leaves it, before others draw
    over it."""

    def __init__(self, host: FrameHost) -> None:
        super().__init__(host)
        self.left: dict[str, Floats] = {}

    def _step(self, step: PlanStep, is_first: bool) -> None:
        super()._step(step, is_first)
        for row in step.targets if isinstance(step, DrawStep) else ():
            self.left[row.result] = self.textures[row.texture].levels[0][0, 0].copy()


class Drawn:
    """An example, drawn once."""

    def __init__(self, name: str, size: int = 16, **values: str) -> None:
        frame = compiled(FOLDER / f"{name}.burnish")
        tags = {row.name: row.materials for row in frame.plan.models}
        materials = list(dict.fromkeys(each for listed in tags.values() for each in listed))
        self.host = FrameHost(frame, in_a_row(materials, tags, "sphere"), (size, size))
        for each, text in values.items():
            self.host.set_text(each.replace("__", "."), text)
        steps = Steps(self.host)
        steps.draw()
        self._left = steps.left

    def left(self, result: str) -> Floats:
        """The texels that a step has drawn: (height, width, lanes)."""
        return self._left[result]


def test_photons_go_down_after_snell() -> None:
    """The part along the surface of a ray is divided by the refractive index."""
    drawn = Drawn("caustics", swell="1.5")
    photons = drawn.left("photons.photons")
    sun = np.array(drawn.host.values.get("sun.direction"))
    side = len(photons)
    at = 11 * ((np.arange(side) + 0.5) / side - 0.5)
    place = np.stack(np.meshgrid(at, at), axis=-1)
    ways = np.array([[2.1, 0.6], [-1.3, 2.6], [3.4, -2.2], [1.1, 4.9], [-5.2, -2.9]])
    heights = np.array([0.045, 0.04, 0.022, 0.016, 0.009])
    slope = 1.5 * (heights * np.cos(place @ ways.T)) @ ways
    normal = np.stack([-slope[..., 0], np.ones((side, side)), -slope[..., 1]], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    along = (sun - (normal @ sun)[..., None] * normal) / 1.33
    down = np.sqrt(1 - (along**2).sum(axis=-1, keepdims=True))
    ray = along - down * normal
    hit = place + 2.4 * ray[..., [0, 2]] / -ray[..., 1:2]
    assert photons[..., :2] == pytest.approx(0.5 + hit / 11, abs=1e-6)
    assert photons[..., 3] == pytest.approx(-sun[1])


def test_still_water_lights_the_ground_evenly() -> None:
    drawn = Drawn("caustics", swell="0")
    sun = np.array(drawn.host.values.get("sun.direction"))
    arrived = drawn.left("caustics.arrived")[48:112, 48:112, 0]
    assert arrived.mean() == pytest.approx(-sun[1], rel=5e-3)
    assert arrived == pytest.approx(np.full((64, 64), -sun[1]), rel=0.06)


def test_waves_move_light_and_lose_none() -> None:
    still, waves = (Drawn("caustics", swell=swell).left("caustics.arrived") for swell in ("0", "1"))
    assert waves[..., 0].sum() == pytest.approx(still[..., 0].sum(), rel=0.01)
    assert waves.max() > 3 * still.max()


def test_a_light_map_has_what_arrives_of_the_lamp() -> None:
    """On the floor, where no box stands between: the integral over the lamp, a square of 0.5 that
    sends 10 altogether, of the cosines over pi times the squared distance."""
    drawn = Drawn("light_map")
    at = np.linspace(-0.25, 0.25, 101)
    lamp = np.stack([*np.meshgrid(at, at), np.full((101, 101), 0.995)], axis=-1)
    for column, row in ((20, 10), (12, 2)):
        u, v = ((column - 0.5) / 22, (row - 0.5) / 18)
        place = np.array([2 * u - 1, 1 - 2 * v, -1.0])
        way = lamp - place
        square = (way**2).sum(axis=-1)
        wanted = (10 * way[..., 2] ** 2 / square / (np.pi * square)).mean()
        found = drawn.left("direct.arrived")[row, column, 0]
        assert found == pytest.approx(wanted, rel=0.02)


def test_virtual_lights_lie_where_light_of_others_arrives() -> None:
    """All are in the room, on a wall or a box, and none sends out more than it gets."""
    drawn = Drawn("light_map")
    for before, step in (("first", "second"), ("second", "third")):
        place = drawn.left(f"{step}.place")[0, :, :3]
        front = drawn.left(f"{step}.front")[0, :, :3]
        from_there = drawn.left(f"{before}.place")[0, :, :3] - place
        assert (np.abs(place) < 1 + 1e-6).all()
        assert np.linalg.norm(front, axis=-1) == pytest.approx(np.ones(len(front)))
        assert ((from_there * front).sum(axis=-1) > 0).all()
        light, sent = (drawn.left(f"{name}.light")[0, :, :3] for name in (step, before))
        assert (light < sent).all()


def is_hit(start: Floats, way: Floats, middle: Floats) -> NDArray[np.bool_]:
    """True where a ray from ``start`` along ``way`` hits a ball with radius 1."""
    unit = way / np.linalg.norm(way, axis=-1, keepdims=True)
    along = ((middle - start) * unit).sum(axis=-1)
    aside = np.linalg.norm(start + along[..., None] * unit - middle, axis=-1)
    return np.asarray((along > 0) & (aside < 1))


def mistaken(split: str) -> tuple[int, int]:
    """The number of the floor's pixels whose light differs from that of a ray to the lamp, and the
    number of its pixels in the shadow.
    """
    side = 128
    drawn = Drawn("silhouettes", side, split=split)
    camera = drawn.host.scenery.scene.camera
    at = (np.arange(side) + 0.5) / side * 2 - 1
    across, down = np.meshgrid(at, at)
    clip = np.stack([across, -down, np.ones_like(at * down), np.ones_like(at * down)], axis=-1)
    far = clip @ np.linalg.inv(camera.world_to_clip(1.0)).T
    eye = np.array(camera.eye)
    way = far[..., :3] / far[..., 3:] - eye
    place = eye + ((-1 - eye[1]) / way[..., 1])[..., None] * way
    balls = [np.array([x, 0.0, 0.0]) for x in (-1.1, 1.1)]
    lamp = np.array([-1.6, 6.5, -3.0])
    to_lamp = lamp - place
    axis = np.array([1.7, -7.0, 3.0])
    cosine = -(to_lamp @ axis) / np.linalg.norm(to_lamp, axis=-1) / np.linalg.norm(axis)
    seen = (way[..., 1] < 0) & (cosine > np.cos(np.radians(27)))
    for ball in balls:
        # Rounder than the mesh, so that no pixel of a ball is taken for one of the floor.
        seen &= ~is_hit(np.broadcast_to(eye, way.shape), way, ball)
    shadow = np.logical_or.reduce([is_hit(place, to_lamp, ball) for ball in balls])
    dark = np.array([0x9F, 0xB0, 0xBC]) / 255
    dark = np.where(dark <= 0.04045, dark / 12.92, ((dark + 0.055) / 1.055) ** 2.4)
    dark *= [0.28, 0.32, 0.38]
    is_dark = (np.abs(drawn.left("lit.color")[..., :3] - dark) < 0.01).all(axis=-1)
    return int((seen & (is_dark != shadow)).sum()), int((seen & shadow).sum())


def test_silhouettes_are_nearer_to_the_true_shadow_than_texels() -> None:
    plain, inside = mistaken("1")
    better, _ = mistaken("0")
    assert inside > 500
    assert plain > 0.03 * inside
    assert better < 0.4 * plain
