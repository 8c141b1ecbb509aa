"""Cubes that are made of panoramas."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from burnish import PictureError, Texture
from burnish.targets.runner.pictures import encoded_numbers
from burnish.targets.runner.textures.kinds import FACES

HEIGHT = 64
AXES = {"+x": (1, 0, 0), "-x": (-1, 0, 0), "+y": (0, 1, 0), "-y": (0, -1, 0),
        "+z": (0, 0, 1), "-z": (0, 0, -1)}  # fmt: skip


@pytest.fixture(name="panorama")
def _panorama(tmp_path: Path) -> Path:
    """A picture whose texels are the directions in which they lie, worked out by latitude and
    longitude."""
    longitude = ((np.arange(2 * HEIGHT) + 0.5) / HEIGHT - 1) * np.pi
    latitude = (0.5 - (np.arange(HEIGHT) + 0.5) / HEIGHT) * np.pi
    across, up = np.meshgrid(longitude, latitude)
    lanes = (np.cos(up) * np.sin(across), np.sin(up), -np.cos(up) * np.cos(across), 0 * up + 1)
    path = tmp_path / "sky.exr"
    path.write_bytes(encoded_numbers(np.stack(lanes, axis=2), path))
    return path


def test_each_face_shows_what_lies_in_its_direction(panorama: Path) -> None:
    cube = Texture.parse(str(panorama), dimension="cube")
    assert (cube.width, cube.height, cube.depth) == (HEIGHT // 2, HEIGHT // 2, 6)
    faces = cube.linear()[0]
    middle = faces[:, 15:17, 15:17, :3].mean(axis=(1, 2))
    assert np.allclose(middle, [AXES[face] for face in FACES], atol=0.01)


@pytest.mark.parametrize(
    ("face", "corner"),
    [("+x", (1, 1, 1)), ("-x", (-1, 1, -1)), ("+y", (-1, 1, -1)), ("-y", (-1, -1, 1)),
     ("+z", (-1, 1, 1)), ("-z", (1, 1, -1))],
)  # fmt: skip
def test_the_first_texel_lies_in_a_corner(
    face: str, corner: tuple[int, int, int], panorama: Path
) -> None:
    """The corners as the specifications of cube maps have them: OpenGL 4.6, table 8.19."""
    faces = Texture.load(panorama, dimension="cube").linear()[0]
    found = faces[FACES.index(face), 0, 0, :3]
    assert np.allclose(found / np.abs(found).max(), corner, atol=0.08)


def test_nothing_is_lost_between_faces(panorama: Path) -> None:
    """All texels have length one: also where the picture's sides and poles are."""
    faces = Texture.load(panorama, dimension="cube").linear()[0]
    assert np.allclose(np.linalg.norm(faces[..., :3], axis=3), 1, atol=0.01)


def test_what_is_no_panorama(tmp_path: Path) -> None:
    square = tmp_path / "a.exr"
    square.write_bytes(encoded_numbers(np.ones((4, 4, 4)), square))
    with pytest.raises(PictureError) as caught:
        Texture.load(square, dimension="cube")
    assert str(caught.value) == (
        f"a panorama is twice as wide as high, and {square} has 4 x 4 texels"
    )
    bytes_ = tmp_path / "a.png"
    Image.new("RGB", (8, 4)).save(bytes_)
    with pytest.raises(PictureError) as caught:
        Texture.load(bytes_, dimension="cube")
    assert str(caught.value) == (
        f"a cube takes six pictures, or a panorama of floats, and not {bytes_}"
    )
