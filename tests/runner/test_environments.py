"""Environments: the studio and the sky that formulas compute, and panoramas of files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from burnish import PictureError
from burnish.compiler.budget import BudgetError, raised
from burnish.targets.runner.lamps import _direction
from burnish.targets.runner.pictures import encoded_numbers
from burnish.targets.runner.textures.environments import (
    FORMULAS,
    SIDE,
    environment,
    mean,
    sky,
    studio,
)
from burnish.targets.runner.textures.panorama import face_directions

Floats = NDArray[np.float64]

COMPUTED = pytest.mark.parametrize("name", list(FORMULAS))


def _faces(name: str) -> Floats:
    found = environment(name)
    assert found is not None
    return np.array(found.texture.linear()[0])


@COMPUTED
def test_radiance_is_light(name: str) -> None:
    """Finite and positive, brighter than a screen somewhere, and the same each time."""
    faces = _faces(name)
    assert faces.shape == (6, SIDE, SIDE, 4)
    assert np.isfinite(faces).all()
    assert faces.min() > 0
    assert faces[..., :3].max() > 1.5
    computed = np.stack([FORMULAS[name](towards) for towards in face_directions(SIDE)])
    assert np.array_equal(faces[..., :3], computed.astype(np.float32))


@COMPUTED
def test_only_the_direction_counts(name: str) -> None:
    directions = np.random.default_rng(1).standard_normal((500, 3))
    assert np.allclose(FORMULAS[name](directions), FORMULAS[name](7 * directions))


@COMPUTED
def test_an_object_sees_more_light_from_above_than_from_below(name: str) -> None:
    faces = _faces(name)[..., :3]
    upper = [faces[side, : SIDE // 2].mean() for side in (0, 1, 4, 5)]
    lower = [faces[side, SIDE // 2 :].mean() for side in (0, 1, 4, 5)]
    assert sum(upper) > 2 * sum(lower)


def test_the_key_light_stands_where_the_first_lamp_of_a_rig_does() -> None:
    """The highlight of that lamp lies within what a mirror shows of the soft box."""
    brightest = studio(np.array([_direction(0)]))
    assert np.allclose(brightest, [[3.0, 2.85, 2.65]])


def test_the_sky_is_the_same_on_both_sides_of_the_sun() -> None:
    """Directions are mirrored at the plane through the sun and the zenith."""
    sun = np.array([-0.45, 0.0, 0.64])
    across = np.cross(sun / np.linalg.norm(sun), [0, 1, 0])
    directions = np.random.default_rng(2).standard_normal((500, 3))
    mirrored = directions - 2 * (directions @ across)[:, None] * across
    assert np.allclose(sky(directions), sky(mirrored))


def test_the_sky_is_darkest_opposite_to_the_sun_and_blue() -> None:
    """ISO 15469, type 12: dark at a right angle to the sun, bright at the horizon."""
    zenith, dark, horizon = sky(np.array([[0.0, 1, 0], [0.45, 0.78, -0.64], [0.45, 0.02, -0.64]]))
    assert dark.sum() < zenith.sum() < horizon.sum()
    assert zenith[2] > 2 * zenith[0]


def test_the_mean_counts_texels_by_solid_angle() -> None:
    """Over all directions, the mean of y² is 1/3, and so is that of x² and z²."""
    towards = np.stack(list(face_directions(32)))
    unit = towards / np.linalg.norm(towards, axis=-1, keepdims=True)
    assert np.allclose(mean(unit**2), [1 / 3] * 3, atol=1e-3)
    assert np.allclose(mean(np.full((6, 4, 4, 1), 0.7)), [0.7] * 3)


def test_panoramas(tmp_path: Path) -> None:
    """Of floats, and of colours, which are sRGB."""
    floats = tmp_path / "bright.exr"
    floats.write_bytes(encoded_numbers(np.full((8, 16, 4), 3.5), floats))
    found = environment(str(floats))
    assert found is not None
    assert np.allclose(found.mean, [3.5] * 3)
    colors = tmp_path / "grey.png"
    Image.new("RGB", (16, 8), "#bcbcbc").save(colors)
    found = environment(str(colors))
    assert found is not None
    assert np.allclose(found.mean, [0.5] * 3, atol=0.01)


def test_there_may_be_none() -> None:
    assert environment("none") is None


def test_what_is_no_panorama(tmp_path: Path) -> None:
    square = tmp_path / "square.png"
    Image.new("RGB", (8, 8)).save(square)
    broken = tmp_path / "broken.hdr"
    broken.write_bytes(b"#?RADIANCE\n")
    numbers = np.ones((8, 16, 4))
    numbers[3, 5, 1] = np.nan
    dark = tmp_path / "nan.exr"
    dark.write_bytes(encoded_numbers(numbers, dark))
    for path, said in (
        (square, f"a panorama is twice as wide as high, and {square} has 8 x 8 texels"),
        (dark, f"{dark} has numbers that are not finite, which no light is"),
    ):
        with pytest.raises(PictureError) as caught:
            environment(str(path))
        assert str(caught.value) == said
    with pytest.raises(PictureError, match="damaged"):
        environment(str(broken))


def test_a_huge_panorama_is_refused_by_its_header(tmp_path: Path) -> None:
    """A billion pixels in a file of a few bytes."""
    huge = tmp_path / "huge.hdr"
    huge.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 22360 +X 44720\n")
    with pytest.raises(PictureError, match="damaged"):
        environment(str(huge))
    large = tmp_path / "large.hdr"
    large.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4096 +X 8192\n")
    with raised({"memory": 2**20}), pytest.raises(BudgetError):
        environment(str(large))
