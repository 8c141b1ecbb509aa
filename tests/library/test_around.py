"""Passes of the library in whole frames, drawn by the reference, against values from elsewhere."""

from __future__ import annotations

import numpy as np
import pytest

from burnish.targets.runner.frames.by_reference import ReferenceFrames
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row

from ..frames.kit import of_text
from .kit import Floats, facets, hammersley, mirrored_by, on_circle
from .truth import truth

AROUND = """
import std.environments.{FaceOfCube, GlossyLight, MattLight}
pass Slope : FaceOfCube {
    target light : rgba16f = vec4((1 + dot(toward, vec3(0.6, 0, 0.8))) * vec3(1, 0.5, 0.25), 1)
}
frame F {
    slope  = each face in cube : Slope(screen, 16) with { face = face }
    matt   = each face in cube : MattLight(screen, 2) with { around = slope.light, face = face }
    glossy = each face in cube : GlossyLight(screen, 2) with {
        around = slope.light, face = face, roughness = 0.7
    }
    smooth = each face in cube : GlossyLight(screen, 2) with {
        around = slope.light, face = face, roughness = 0.3
    }
    output arriving = matt.light
    output mirrored = glossy.light
    output smoothly = smooth.light
}
"""
"""Coloured light that grows along an axis."""
TINT = np.array([1.0, 0.5, 0.25])


def drawn() -> ReferenceFrames:
    drawing = ReferenceFrames(FrameHost(of_text(AROUND), in_a_row([], {}, "sphere"), (8, 8)))
    drawing.draw()
    return drawing


def faced() -> Floats:
    """The directions of 2 x 2 texels of +x and of -z, row by row."""
    at = np.array([-0.5, 0.5])
    across, down = (each.ravel() for each in np.meshgrid(at, at))
    right = np.stack([np.ones(4), -down, -across], axis=1)
    back = np.stack([-across, -down, -np.ones(4)], axis=1)
    both = np.concatenate([right, back])
    return np.asarray(both / np.linalg.norm(both, axis=1, keepdims=True), np.float64)


def heights() -> Floats:
    """The part of these along the axis of the light."""
    return np.asarray(faced() @ np.array([0.6, 0.0, 0.8]), np.float64)


def around(axis: Floats, arrows: Floats) -> Floats:
    """Directions around +z as they are around an axis, by the basis of Duff and others (2017)."""
    x, y, z = axis
    sign = np.copysign(1.0, z)
    a = -1.0 / (sign + z)
    first = np.array([1 + sign * x * x * a, sign * x * y * a, -sign * x])
    second = np.array([x * y * a, sign + y * y * a, -y])
    return np.asarray(arrows @ np.stack([first, second, axis]))


def sampled(arrows: Floats, weights: Floats) -> Floats:
    """The light from directions around each of those that are faced, weighted."""
    seen = [1 + around(axis, arrows) @ np.array([0.6, 0.0, 0.8]) for axis in faced()]
    return np.array([(weights * light).sum() / weights.sum() for light in seen])


@truth(
    "std.environments.FaceOfCube",
    "std.environments.MattLight",
    "std.environments.GlossyLight",
    "std.environments.mirrored_along",
    "std.environments.weight",
)
def test_each_sample_counts() -> None:
    """The same samples, by NumPy. The light is read from a cube of 16 texels in 16 bits."""
    x, y = hammersley(64).T
    matt = np.concatenate([np.sqrt(1 - y)[:, None] * on_circle(x), np.sqrt(y)[:, None]], axis=1)
    mirrored, smoothly = (mirrored_by(facets(32, width)) for width in (0.7**2, 0.3**2))
    drawing = drawn()
    for name, arrows, weights in (
        ("arriving", matt, np.ones(64)),
        ("mirrored", mirrored, np.maximum(mirrored[:, 2], 0)),
        ("smoothly", smoothly, np.maximum(smoothly[:, 2], 0)),
    ):
        (level,) = drawing.output(name).levels
        found = level[0, [0, 5]].reshape(-1, 4)
        wanted = sampled(arrows, weights)[:, None] * TINT
        assert found[:, :3] == pytest.approx(wanted, abs=4e-3)
        assert (found[:, 3] == 1).all()


def cosine_of_glossy(width: float) -> float:
    """The mean cosine of mirrored directions, weighted by their cosine."""
    half = np.cos((np.arange(20_000) + 0.5) * (np.pi / 40_000))
    density = width**2 / (half**2 * (width**2 - 1) + 1) ** 2 * half * np.sqrt(1 - half**2)
    light = 2 * half**2 - 1
    weight = np.where(light > 0, density * light, 0)
    return float((weight * light).sum() / weight.sum())


@truth(
    "std.environments.FaceOfCube",
    "std.environments.MattLight",
    "std.environments.GlossyLight",
    "std.environments.mirrored_along",
    "std.environments.weight",
)
def test_light_from_around_is_filtered_as_surfaces_do() -> None:
    """A surface sees light 1 + a·d as 1 + c a·n. For matt ones c is the mean of the squared cosine
    over that of the cosine, which is two thirds."""
    drawing = drawn()
    for name, share in (("arriving", 2 / 3), ("mirrored", cosine_of_glossy(0.49))):
        (level,) = drawing.output(name).levels
        found = level[0, [0, 5], ..., 0].ravel()
        assert found == pytest.approx(1 + share * heights(), abs=0.02)
