"""Photometric files of lamps (IES LM-63): their candelas by degrees, and what is refused."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import numpy as np
import pytest

from burnish import PictureError, Texture
from burnish.targets.runner.textures.files import picture_given
from burnish.targets.runner.textures.photometric import read_candelas

HEADER = "IESNA:LM-63-2002\n[MANUFAC] someone\nTILT=NONE\n"


def lamp(
    vertical: str = "0 90 180", horizontal: str = "0", candelas: str = "100 50 0", *,
    factors: tuple[float, float] = (1, 1), kind: int = 1, header: str = HEADER,
) -> bytes:  # fmt: skip
    """A file of a lamp."""
    counts = f"{len(vertical.split())} {len(horizontal.split())}"
    return (
        f"{header}1 1000 {factors[0]} {counts} {kind} 2 0 0 0\n{factors[1]} 1 50\n{vertical}\n"
        f"{horizontal}\n{candelas}\n"
    ).encode()


def table(data: bytes) -> np.ndarray:
    found = read_candelas(BytesIO(data), "lamp.ies")
    assert found.shape == (181, 361)
    assert found.dtype == np.float32
    return found


def test_a_lamp_that_is_alike_all_around() -> None:
    found = table(lamp(factors=(2, 0.5)))
    assert (found == found[:, :1]).all()
    assert found[[0, 45, 90, 135, 180], 0] == pytest.approx([100, 75, 50, 25, 0])


def test_nothing_is_sent_where_nothing_was_measured() -> None:
    found = table(lamp("30 60 90", candelas="10, 20, 30"))
    assert found[[0, 29, 30, 45, 90, 91], 7] == pytest.approx([0, 0, 10, 15, 30, 0])


@pytest.mark.parametrize(
    ("horizontal", "by_turn"),
    [
        ("0 90", {0: 0, 45: 5, 90: 10, 135: 5, 180: 0, 225: 5, 270: 10, 315: 5, 360: 0}),
        ("0 180", {0: 0, 90: 5, 180: 10, 270: 5, 360: 0}),
        ("0 360", {0: 0, 90: 2.5, 180: 5, 359: 10 * 359 / 360}),
        ("90 270", {90: 0, 180: 5, 270: 10, 0: 5, 45: 2.5, 315: 7.5, 360: 5}),
        ("0 270", {0: 0, 135: 5, 270: 10, 315: 5, 360: 0}),
    ],
)
def test_angles_around_are_completed_by_symmetry(
    horizontal: str, by_turn: dict[int, float]
) -> None:
    """Quadrants, halves to both sides, whole turns, halves to the front, and turns that stop short
    of the first angle."""
    found = table(lamp("0 180", horizontal, "0 0\n10 10"))
    assert found[90, list(by_turn)] == pytest.approx(list(by_turn.values()))


def test_a_tilt_that_the_file_includes() -> None:
    header = HEADER.replace("NONE", "INCLUDE\n1\n3\n0 45 90\n1 .9 .8")
    assert table(lamp(header=header))[0, 0] == 100


def test_an_old_file_without_a_first_line() -> None:
    assert table(lamp(header="a lamp\r\nTILT = NONE\r\n"))[0, 0] == 100


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"", "it has no line TILT="),
        (b"\x89PNG\r\n\x1a\n\0\xff", "it has no line TILT="),
        (lamp(header="TILT=tilt.txt\n"), "its line TILT= names another file"),
        (lamp(kind=2), "its photometry is not of type C"),
        (HEADER.encode(), "it ends before all numbers of its header"),
        (lamp(candelas="100 50"), "it ends before all candelas"),
        (lamp(candelas="100 50 many"), "`many` stands where a number should"),
        (lamp(candelas="100 nan 1"), "not all of its numbers are finite"),
        (lamp(candelas="100 1e400 1"), "not all of its numbers are finite"),
        (lamp(candelas="100 -1 1"), "some candelas are negative, or larger than any lamp's"),
        (lamp(candelas="100 1e39 1"), "some candelas are negative, or larger than any lamp's"),
        (lamp("0 90 90"), "its vertical angles do not grow from 0 to 180"),
        (lamp("0 90 190"), "its vertical angles do not grow from 0 to 180"),
        (lamp("-1 90 180"), "its vertical angles do not grow from 0 to 180"),
        (lamp("0", "0 60", "1 1"), "its horizontal angles end at none of 0, 90, 180 and 360"),
        (lamp("0", "30 90", "1 1"),
         "its horizontal angles begin neither at 0 nor go from 90 to 270"),
        (lamp().replace(b"3 1 1 2", b"1e9 1 1 2"),
         "the number of vertical angles is 1e+09, not one of 1 to 1441"),
        (lamp().replace(b"3 1 1 2", b"3 0.5 1 2"),
         "the number of horizontal angles is 0.5, not one of 1 to 1441"),
    ],
)  # fmt: skip
def test_files_that_are_refused(data: bytes, told: str) -> None:
    with pytest.raises(PictureError) as refused:
        table(data)
    wanted = f"lamp.ies is no photometric file (IES LM-63) that can be read: {told}"
    assert str(refused.value) == wanted


def test_a_file_that_is_too_large() -> None:
    with pytest.raises(
        PictureError, match=r"^lamp.ies is too large: a photometric file has at most"
    ):
        table(b" " * (1 << 22) + b" ")


def test_textures_are_made_of_such_files(tmp_path: Path) -> None:
    path = tmp_path / "Lamp.IES"
    path.write_bytes(lamp())
    texture = Texture.load(path)
    assert (texture.width, texture.height) == (361, 181)
    first = np.frombuffer(texture.levels[0], np.float32)
    assert first.reshape(181, 361, -1)[:2, 0, 0] == pytest.approx([100, 100 - 50 / 90])


def test_bytes_that_a_page_sends_are_read_by_the_name_of_their_file() -> None:
    found = picture_given(lamp(), "lamp.ies", "2d", "float")
    assert (found == table(lamp())).all()
