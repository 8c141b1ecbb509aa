"""Textures from files: pictures of every mode, layers, and files that are no pictures."""

from __future__ import annotations

import os
import random
import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from burnish import PictureError, Texture

from .texture_kit import first


def saved(path: Path, picture: Image.Image, **options: Any) -> Path:
    picture.save(path, **options)
    return path


def test_pictures_of_every_mode(tmp_path: Path) -> None:
    color = Image.new("RGB", (2, 1), (10, 20, 30))
    palette = color.quantize(4)
    transparent = Image.new("P", (1, 1), 0)
    transparent.putpalette([200, 100, 50])
    sixteen = Image.fromarray(np.array([[257 * 77]], np.uint16))
    modes = {
        "rgb": (saved(tmp_path / "rgb.png", color), (10, 20, 30, 255)),
        "rgba": (
            saved(tmp_path / "rgba.png", Image.new("RGBA", (1, 1), (1, 2, 3, 4))),
            (1, 2, 3, 4),
        ),
        "palette": (saved(tmp_path / "palette.png", palette), (10, 20, 30, 255)),
        "keyed": (saved(tmp_path / "keyed.png", transparent, transparency=0), (200, 100, 50, 0)),
        "grey": (saved(tmp_path / "grey.png", Image.new("L", (1, 1), 77)), (77, 77, 77, 255)),
        "grey alpha": (saved(tmp_path / "la.png", Image.new("LA", (1, 1), (7, 9))), (7, 7, 7, 9)),
        "bits": (saved(tmp_path / "one.png", Image.new("1", (1, 1), 1)), (255,) * 4),
        "sixteen": (saved(tmp_path / "sixteen.png", sixteen), (77, 77, 77, 255)),
        "bmp": (saved(tmp_path / "rgb.bmp", color), (10, 20, 30, 255)),
    }
    for name, (path, expected) in modes.items():
        texture = Texture.load(path)
        assert texture.format == "rgba8unorm"
        assert tuple(first(texture)[0, 0]) == expected, name


def test_a_picture_of_floats_keeps_them(tmp_path: Path) -> None:
    picture = Image.fromarray(np.array([[0.1, 7.5]], np.float32))
    texture = Texture.load(saved(tmp_path / "floats.tiff", picture))
    assert texture.format == "rgba32float"
    assert texture.linear()[0][0, 1].tolist() == [7.5, 7.5, 7.5, 1.0]


def test_the_first_row_is_on_top_and_cameras_may_lie(tmp_path: Path) -> None:
    array = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [9, 9, 9]]], np.uint8)
    picture = Image.fromarray(array)
    assert (first(Texture.load(saved(tmp_path / "a.png", picture)))[..., :3] == array).all()
    exif = picture.getexif()
    exif[0x0112] = 3
    turned = Texture.load(saved(tmp_path / "b.png", picture, exif=exif))
    assert (first(turned)[..., :3] == array[::-1, ::-1]).all()


def test_a_text_says_whether_colours_are_srgb(tmp_path: Path) -> None:
    path = saved(tmp_path / "a.png", Image.new("RGB", (1, 1), (10, 20, 30)))
    assert Texture.parse(str(path)).format == "rgba8unorm"
    assert Texture.parse(f"srgb:{path}").format == "rgba8unorm-srgb"
    assert Texture.parse(f"srgb:{path}") == Texture.load(path, srgb=True)
    assert Texture.parse("#0a141e") == Texture.solid("#0a141e")


def test_a_text_without_a_word_about_it_is_taken_as_the_texture_is_meant(tmp_path: Path) -> None:
    path = saved(tmp_path / "a.png", Image.new("RGB", (1, 1), (10, 20, 30)))
    floats = saved(tmp_path / "a.tiff", Image.new("F", (1, 1), 0.25))
    assert Texture.parse(str(path), intent="color") == Texture.load(path, srgb=True)
    assert Texture.parse(f"linear:{path}", intent="color") == Texture.load(path)
    assert Texture.parse(f"linear:{path}") == Texture.load(path)
    assert Texture.parse(str(floats), intent="color") == Texture.load(floats)


def test_pictures_for_each_layer(tmp_path: Path) -> None:
    paths = [saved(tmp_path / f"{n}.png", Image.new("RGB", (2, 2), (n, 20, 30))) for n in range(6)]
    listed = ", ".join(map(str, paths))
    cube = Texture.parse(listed, dimension="cube")
    assert cube == Texture.load(paths, dimension="cube")
    assert (255 * cube.linear()[0][:, 0, 0, 0]).round().tolist() == [0, 1, 2, 3, 4, 5]
    assert Texture.parse(f"srgb:{listed}", dimension="3d").format == "rgba8unorm-srgb"
    assert Texture.parse(str(paths[0]), dimension="2d_array").depth == 1
    blue = Texture.parse("#0000ff", dimension="cube")
    assert blue.linear()[0][:, 0, 0].tolist() == [[0, 0, 1, 1]] * 6


def test_pictures_for_each_face_of_several_cubes(tmp_path: Path) -> None:
    paths = [saved(tmp_path / f"{n}.png", Image.new("RGB", (2, 2), (n, 0, 0))) for n in range(12)]
    cubes = Texture.parse(", ".join(map(str, paths)), dimension="cube_array")
    assert (255 * cubes.linear()[0][:, 0, 0, 0]).round().tolist() == list(range(12))
    panoramas = [saved(tmp_path / f"{n}.tiff", Image.new("F", (4, 2), n / 4)) for n in range(3)]
    whole = Texture.load(panoramas, dimension="cube_array")
    assert whole.linear()[0][:, 0, 0, 0].tolist() == [n / 4 for n in range(3) for _face in range(6)]
    assert Texture.load(panoramas[0], dimension="cube").as_array() == Texture.load(
        panoramas[:1], dimension="cube_array"
    )


def test_pictures_of_depths_and_integers(tmp_path: Path) -> None:
    indexed = Image.fromarray(np.array([[0, 3]], np.uint8), "P")
    indexed.putpalette([200, 100, 50] * 4)
    numbers = Texture.load(saved(tmp_path / "p.png", indexed), sample="uint")
    assert numbers.linear()[0][0, :, 0].tolist() == [0, 3]
    sixteen = Image.fromarray(np.array([[300]], np.uint16))
    wide = Texture.load(saved(tmp_path / "i.png", sixteen), sample="int")
    assert wide.linear()[0][0, 0].tolist() == [300, 0, 0, 1]
    grey = saved(tmp_path / "l.png", Image.new("RGB", (1, 1), (51, 51, 51)))
    (depths,) = Texture.parse(str(grey), sample="depth").linear()
    assert depths.ravel().tolist() == pytest.approx([0.2])


def test_lists_of_files_that_do_not_fit(tmp_path: Path) -> None:
    small, large = (saved(tmp_path / f"{n}.png", Image.new("RGB", (n, n))) for n in (1, 2))
    for text, about, message in [
        (f"{small},{small}", {"dimension": "cube"},
         "a cube takes six pictures, +x, -x, +y, -y, +z, -z, or a panorama; there are 2"),
        (f"{small},{small}", {"dimension": "cube_array"},
         "each cube of an array takes six pictures, +x, -x, +y, -y, +z, -z, or a panorama; there "
         "are 2"),
        (f"{small},{large}", {"dimension": "3d"},
         f"the pictures of one texture are alike, and {large} is 2 x 2 uint8 of 4 lanes where "
         f"{small} is 1 x 1 uint8 of 4 lanes"),
        ("#102030", {"sample": "uint"}, "#102030 is a colour, and the texture holds unsigned "
         "integers"),
        (f"srgb:{small}", {"sample": "depth"}, "depths are never sRGB: leave out `srgb:`"),
    ]:  # fmt: skip
        kind: dict[str, Any] = about
        with pytest.raises(PictureError) as caught:
            Texture.parse(text, **kind)
        assert str(caught.value) == message


def noise(path: Path) -> bytes:
    array = np.random.default_rng(0).integers(0, 256, (64, 64, 3)).astype(np.uint8)
    return saved(path, Image.fromarray(array)).read_bytes()


def header(width: int, height: int) -> bytes:
    """A PNG that says that it is large, and holds next to nothing."""
    size = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunks = b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in ((b"IHDR", size), (b"IDAT", zlib.compress(b"")), (b"IEND", b""))
    )
    return b"\x89PNG\r\n\x1a\n" + chunks


def test_files_that_are_no_texture(tmp_path: Path, recwarn: pytest.WarningsRecorder) -> None:
    path = tmp_path / "a.png"
    whole = noise(path)
    bad: dict[bytes, str] = {
        b"": f"{path} is not a picture of a known format",
        b"hello": f"{path} is not a picture of a known format",
        whole[:20]: f"cannot read {path}: Truncated File Read",
        whole[: len(whole) // 2]: f"cannot read {path}: image file is truncated",
        whole.replace(b"IDAT", b"IDAX"): f"{path}",
        header(10_000, 9_000): f"{path} has 10000 x 9000 texels, and no side may have more than "
        "8192",
        header(60_000, 60_000): f"{path} is too large: no side may have over 8192",
    }
    for content, message in bad.items():
        path.write_bytes(content)
        with pytest.raises(PictureError) as caught:
            Texture.load(path)
        assert message in str(caught.value)
    assert not recwarn.list


def test_files_that_cannot_be_opened(tmp_path: Path) -> None:
    with pytest.raises(PictureError) as caught:
        Texture.load(tmp_path / "none.png")
    assert str(caught.value) == f"cannot read {tmp_path / 'none.png'}: No such file or directory"
    with pytest.raises(PictureError) as caught:
        Texture.load(tmp_path)
    assert str(caught.value) == f"cannot read {tmp_path}: it is not a file"


def test_damage_is_reported_and_nothing_else_happens(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    whole, chance = noise(path), random.Random(7)
    refused = 0
    for _ in range(200):
        content = bytearray(whole)
        for _ in range(chance.randint(1, 4)):
            content[chance.randrange(60)] = chance.randrange(256)
        path.write_bytes(content)
        try:
            Texture.load(path)
        except PictureError as error:
            assert str(path) in str(error)
            refused += 1
    assert refused > 100


def test_a_pipe_is_no_picture(tmp_path: Path) -> None:
    """Nobody waits for what may never come out of it."""
    os.mkfifo(tmp_path / "pipe.png")
    with pytest.raises(PictureError, match=r"pipe\.png: it is not a file$"):
        Texture.load(tmp_path / "pipe.png")
