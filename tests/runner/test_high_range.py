"""Pictures of floats, ``.exr`` and ``.hdr``: what is in them, byte by byte, and files that are
wrong."""

from __future__ import annotations

import random
import struct
from pathlib import Path

import numpy as np
import pytest

from burnish import PictureError, Texture
from burnish.targets.runner.pictures import encoded_numbers

FLOAT, HALF = 2, 1


def exr(size: tuple[int, int], channels: dict[str, list[float]], kind: int = FLOAT) -> bytes:
    """An OpenEXR file without compression, written after the specification of the format."""
    width, height = size
    names = sorted(channels)
    listed = b"".join(
        name.encode() + b"\0" + struct.pack("<iB3xii", kind, 0, 1, 1) for name in names
    )
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = b"".join(
        name + b"\0" + type_ + b"\0" + struct.pack("<i", len(value)) + value
        for name, type_, value in (
            (b"channels", b"chlist", listed + b"\0"),
            (b"compression", b"compression", b"\0"),
            (b"dataWindow", b"box2i", window),
            (b"displayWindow", b"box2i", window),
            (b"lineOrder", b"lineOrder", b"\0"),
            (b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
            (b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)),
            (b"screenWindowWidth", b"float", struct.pack("<f", 1)),
        )
    )
    start = b"\x76\x2f\x31\x01" + struct.pack("<i", 2) + header + b"\0"
    code = "f" if kind == FLOAT else "e"
    rows = []
    for y in range(height):
        lanes = b"".join(
            struct.pack(f"<{width}{code}", *channels[name][y * width : (y + 1) * width])
            for name in names
        )
        rows.append(struct.pack("<ii", y, len(lanes)) + lanes)
    at = len(start) + 8 * height
    places = [at + sum(map(len, rows[:y])) for y in range(height)]
    return start + struct.pack(f"<{height}Q", *places) + b"".join(rows)


def hdr(width: int, height: int, texels: bytes) -> bytes:
    """A Radiance file without compression."""
    head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n"
    return head.encode() + texels


def lanes(path: Path) -> list[list[list[float]]]:
    """The texels of a file, as a shader reads them."""
    texture = Texture.load(path)
    assert texture.format == "rgba32float"
    found: list[list[list[float]]] = texture.linear()[0].tolist()
    return found


def test_an_exr_has_the_floats_that_its_channels_have(tmp_path: Path) -> None:
    path = tmp_path / "a.EXR"
    path.write_bytes(exr((2, 1), {"R": [0.25, 7], "G": [1, -3], "B": [1e20, 0.1], "A": [0.5, 1]}))
    assert np.allclose(lanes(path), [[[0.25, 1, 1e20, 0.5], [7, -3, 0.1, 1]]], rtol=1e-7)
    path.write_bytes(exr((1, 2), {"R": [1.5, 2], "G": [3, 4], "B": [5, 65504]}, HALF))
    assert lanes(path) == [[[1.5, 3, 5, 1]], [[2, 4, 65504, 1]]]
    path.write_bytes(exr((2, 1), {"Y": [0.5, 12]}))
    assert lanes(path) == [[[0.5, 0.5, 0.5, 1], [12, 12, 12, 1]]]


def test_a_single_channel_may_be_a_depth(tmp_path: Path) -> None:
    path = tmp_path / "z.exr"
    path.write_bytes(exr((2, 1), {"Z": [0.5, 1]}))
    (depths,) = Texture.load(path, sample="depth").linear()
    assert depths.ravel().tolist() == [0.5, 1]


def test_an_hdr_has_mantissas_and_an_exponent(tmp_path: Path) -> None:
    path = tmp_path / "a.hdr"
    path.write_bytes(hdr(2, 1, bytes((128, 64, 32, 129, 255, 0, 1, 140))))
    assert lanes(path) == [[[1, 0.5, 0.25, 1], [4080, 0, 16, 1]]]


def test_what_is_written_is_read_again(tmp_path: Path) -> None:
    numbers = np.array([[[0.1, 5, -2, 0.5], [1e6, 0, np.inf, 1]]])
    path = tmp_path / "a.exr"
    path.write_bytes(encoded_numbers(numbers, path))
    assert encoded_numbers(numbers, path) == path.read_bytes()
    with pytest.raises(PictureError, match="finite"):
        Texture.load(path)
    numbers[0, 1, 2] = 7
    path.write_bytes(encoded_numbers(numbers, path))
    assert np.allclose(lanes(path), numbers, rtol=1e-7)
    path.write_bytes(encoded_numbers(numbers, path, lanes=1))
    assert np.allclose(lanes(path), [[[0.1, 0.1, 0.1, 1], [1e6, 1e6, 1e6, 1]]], rtol=1e-7)

    path = tmp_path / "a.hdr"
    path.write_bytes(encoded_numbers(numbers, path))
    assert np.allclose(lanes(path), [[[0.1, 5, 0, 1], [1e6, 0, 7, 1]]], rtol=0, atol=4e3)
    with pytest.raises(PictureError) as caught:
        encoded_numbers(np.full((1, 1, 4), np.nan), path)
    assert str(caught.value) == (
        f"cannot write `{path}`: some numbers are not finite, which only .exr can store"
    )


WRONG = {
    "empty.exr": (b"", "is no file of the format that its name says"),
    "text.hdr": (b"hello", "is no file of the format that its name says"),
    "other.exr": (hdr(1, 1, bytes(4)), "is no file of the format that its name says"),
    "begun.exr": (exr((2, 2), {"Y": [1] * 4})[:40], "is damaged: "),
    "cut.exr": (exr((2, 2), {"Y": [1] * 4})[:-8], "is damaged: "),
    "begun.hdr": (b"#?RADIANCE\n", "is damaged: "),
    "cut.hdr": (hdr(64, 64, bytes(99)), "is damaged: "),
    "wide.exr": (
        exr((9000, 1), {"Y": [1] * 9000}),
        "has 9000 x 1 texels, and no side may have more than 8192",
    ),
    "absurd.hdr": (hdr(2**31 - 1, 2**31 - 1, b""), ""),
    "two.exr": (
        exr((1, 1), {"U": [1], "V": [1]}),
        "has the channels U, V: a picture has R, G and B, or only one",
    ),
    "nan.exr": (exr((1, 1), {"Y": [float("nan")]}), "texels are finite float32 numbers"),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_files_that_are_no_texture(name: str, tmp_path: Path) -> None:
    content, message = WRONG[name]
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(PictureError) as caught:
        Texture.load(path)
    assert message in str(caught.value)


@pytest.mark.parametrize("name", ["a.exr", "a.hdr"])
def test_damage_is_reported_and_nothing_else_happens(name: str, tmp_path: Path) -> None:
    path, chance = tmp_path / name, random.Random(7)
    numbers = np.random.default_rng(0).random((8, 8, 4))
    whole = encoded_numbers(numbers, path)
    refused = 0
    for _ in range(200):
        content = bytearray(whole)
        for _ in range(chance.randint(1, 4)):
            content[chance.randrange(len(whole) // 2)] = chance.randrange(256)
        path.write_bytes(content)
        try:
            Texture.load(path)
        except PictureError:
            refused += 1
    assert refused > 50


def test_floats_are_never_srgb(tmp_path: Path) -> None:
    path = tmp_path / "a.hdr"
    path.write_bytes(hdr(1, 1, bytes((128, 64, 32, 129))))
    with pytest.raises(PictureError, match="texels that are floats are linear"):
        Texture.parse(f"srgb:{path}")
