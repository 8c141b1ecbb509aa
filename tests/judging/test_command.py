"""``burnish judge``: what it prints, what it reads, and how it ends."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from burnish.commands.judge_picture import LANGUAGES
from burnish.targets.conformance.comparers import COMPARERS, comparer

from ..cli.kit import invoke
from .kit import CASE, bounds, flat, small_golden, write_case, write_golden


@pytest.fixture(autouse=True)
def _here(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.chdir(tmp_path)


def exr(path: str, pixels: NDArray[Any]) -> None:
    """Write a file of floats."""
    from burnish.targets.runner.pictures import encoded_numbers

    Path(path).write_bytes(encoded_numbers(pixels, Path(path), lanes=pixels.shape[2]))


def deep_png(path: str, pixels: NDArray[Any]) -> None:
    """Write a PNG file of 16 bits, by another program than the one under test."""
    import OpenImageIO

    height, width, lanes = pixels.shape
    sink = OpenImageIO.ImageOutput.create("png")
    spec = OpenImageIO.ImageSpec(width, height, lanes, "uint16")
    spec.attribute("oiio:UnassociatedAlpha", 1)
    assert sink is not None
    assert sink.open(path, spec)
    assert sink.write_image(np.ascontiguousarray(pixels, np.uint16))
    assert sink.close()


def code_of(picture: str, *words: str) -> int:
    """The exit code for a picture of the small golden folder."""
    small_golden(Path("g"))
    result = invoke("judge", "g", picture, *words)
    assert result.stderr == "", result.stderr
    return result.exit_code


def test_a_good_and_a_bad_picture() -> None:
    small_golden(Path("g"))
    np.save("p.npy", flat(0.3))
    result = invoke("judge", "g", "p.npy")
    assert result.exit_code == 0
    assert result.stdout == (
        f"agrees  {CASE}/color, p.npy: within its bounds: 6 pixels compared, 0 undecided\n"
    )
    np.save("p.npy", flat(0.75))
    result = invoke("judge", "g", "p.npy")
    assert result.exit_code == 1
    assert result.stdout == (
        f"differs  {CASE}/color, p.npy: outside of its bounds: 6 of 6 pixels compared, "
        "0 undecided\n"
        "  the worst is pixel 0,0, lane 0 (r): 0.75 is not within 0.25 and 0.5\n"
    )


@pytest.mark.parametrize("lanes", [1, 3, 4])
def test_pictures_of_eight_bits(lanes: int) -> None:
    mode = {1: "L", 3: "RGB", 4: "RGBA"}[lanes]
    for code, expected in ((63, 0), (128, 0), (62, 1), (129, 1)):
        Image.new(mode, (3, 2), (code,) * lanes if lanes > 1 else code).save("p.png")
        assert code_of("p.png") == expected


def test_colours_of_eight_bits_in_srgb() -> None:
    Image.new("RGB", (3, 2), (136, 160, 188)).save("p.png")
    assert (code_of("p.png", "--encoding", "srgb"), code_of("p.png")) == (0, 1)


@pytest.mark.parametrize("lanes", [1, 3, 4])
def test_pictures_of_sixteen_bits_keep_all_bits(lanes: int) -> None:
    """A reader that drops eight bits cannot tell the codes beside each end apart."""
    for code, expected in ((16383, 0), (32768, 0), (16382, 1), (32769, 1)):
        deep_png("p.png", flat(code, lanes))
        assert code_of("p.png") == expected


def test_alpha_does_not_darken_sixteen_bits() -> None:
    pixels = flat(20000)
    pixels[..., 3] = 16383
    deep_png("p.png", pixels)
    assert code_of("p.png") == 0


def test_pictures_of_floats() -> None:
    for value, expected in ((0.25, 0), (0.5, 0), (0.501, 1)):
        exr("p.exr", flat(value))
        assert code_of("p.exr") == expected
    exr("p.exr", flat(0.3, 3))
    assert code_of("p.exr") == 0


def test_the_bottom_row_may_come_first() -> None:
    low, high = bounds()
    low[0], high[0] = 0, 0
    write_golden(Path("g"), write_case(Path("g"), low, high))
    picture = flat(0.3)
    picture[1] = 0
    np.save("p.npy", picture)
    assert invoke("judge", "g", "p.npy").exit_code == 1
    assert invoke("judge", "g", "p.npy", "--flip").exit_code == 0


def test_a_picture_of_what_is_outside() -> None:
    undecided = np.array([[1, 0, 0], [0, 0, 0]], "u1")
    write_golden(Path("g"), write_case(Path("g"), *bounds(), undecided))
    picture = flat(0.3)
    picture[1, 2] = 0.7
    np.save("p.npy", picture)
    assert invoke("judge", "g", "p.npy", "--diff", "out.png").exit_code == 1
    shown = np.asarray(Image.open("out.png"))
    assert shown.shape == (2, 3, 3)
    assert tuple(shown[1, 2]) == (255, 0, 0)
    assert tuple(shown[0, 0]) == (60, 110, 220)
    assert len({tuple(each) for each in shown.reshape(-1, 3).tolist()}) == 3
    result = invoke("judge", "g", "p.npy", "--diff", "out.jpg")
    assert result.exit_code == 2
    assert "--diff writes a .png file: `out.jpg` has another ending" in result.stderr
    assert not Path("out.jpg").exists()


def test_a_folder_of_pictures() -> None:
    rows = [write_case(Path("g"), *bounds(), folder=each) for each in (CASE, "Plain/behind")]
    write_golden(Path("g"), *rows)
    for number, folder in enumerate((CASE, "Plain/behind")):
        (Path("mine") / folder).mkdir(parents=True)
        np.save(Path("mine") / folder / "color.npy", flat(0.3 + 0.5 * number))
    result = invoke("judge", "g", "mine")
    assert result.exit_code == 1
    words = [line.split()[:2] for line in result.stdout.splitlines()]
    assert words == [
        ["agrees", f"{CASE}/color,"], ["differs", "Plain/behind/color,"], ["the", "worst"],
        ["2", "pictures,"],
    ]  # fmt: skip
    assert invoke("judge", "g", "mine", "--case", "defaults").exit_code == 0
    result = invoke("judge", "g", "mine", "--diff", "o.png")
    assert result.exit_code == 2
    assert "--diff shows one picture: name the PICTURE, not a folder" in result.stderr


def test_codes_are_told_as_codes() -> None:
    small_golden(Path("g"))
    Image.fromarray(flat(130).astype("u1")).save("p.png")
    told = "the worst is pixel 0,0, lane 0 (r): 130 is not within 63 and 128\n"
    assert told in invoke("judge", "g", "p.png").stdout


def test_a_picture_that_cannot_be_judged_hides_no_other() -> None:
    rows = [write_case(Path("g"), *bounds(), folder=each) for each in (CASE, "Plain/behind")]
    write_golden(Path("g"), *rows)
    for folder, picture in ((CASE, flat(0.3)[:1]), ("Plain/behind", flat(0.3))):
        (Path("mine") / folder).mkdir(parents=True)
        np.save(Path("mine") / folder / "color.npy", picture)
    result = invoke("judge", "g", "mine")
    assert result.exit_code == 1
    assert result.stdout.split()[:2] == ["agrees", "Plain/behind/color,"]
    assert result.stderr == (
        "error: the picture is 3 x 1 pixels large, and Plain/defaults/color is 3 x 2\n"
    )


@pytest.mark.parametrize(
    ("diff", "told"),
    [
        ("o.jpg", "--diff writes a .png file: `o.jpg` has another ending"),
        ("./p.png", "--diff would replace the PICTURE: give it another name"),
    ],
)
def test_a_diff_is_a_file_of_its_own(diff: str, told: str) -> None:
    small_golden(Path("g"))
    Image.fromarray(flat(130).astype("u1")).save("p.png")
    before = Path("p.png").read_bytes()
    result = invoke("judge", "g", "p.png", "--diff", diff)
    assert result.exit_code == 2
    assert told in result.stderr
    assert Path("p.png").read_bytes() == before


def test_verdicts_as_json() -> None:
    small_golden(Path("g"))
    picture = flat(0.3)
    picture[0, 1, 2] = np.nan
    np.save("p.npy", picture)
    result = invoke("judge", "g", "p.npy", "--format", "json")
    assert result.exit_code == 1
    (row,) = json.loads(result.stdout)["result"]["pictures"]
    assert row == {
        "case": CASE, "output": "color", "picture": "p.npy", "good": False, "compared": 6,
        "undecided": 0, "outside": 1,
        "worst": {"x": 1, "y": 0, "lane": 2, "value": "nan", "lower": 0.25, "upper": 0.5},
    }  # fmt: skip


# --- in other languages ---------------------------------------------------------------------------


@pytest.mark.parametrize("language", sorted(COMPARERS))
def test_a_comparer_is_printed_as_it_stands(language: str) -> None:
    printed = invoke("judge", "--comparer", language)
    assert (printed.exit_code, printed.stderr) == (0, "")
    assert printed.stdout == comparer(language)


def test_there_is_a_comparer_for_each_language_that_can_be_named() -> None:
    assert set(LANGUAGES) == set(COMPARERS)
