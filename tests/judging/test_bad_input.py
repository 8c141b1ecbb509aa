"""Golden folders and pictures that are damaged or hostile: a message by name, never a traceback."""

from __future__ import annotations

import json
import os
import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from ..cli.kit import invoke
from .kit import CASE, bounds, flat, small_golden, write_case, write_golden


@pytest.fixture(autouse=True)
def _here(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Paths in messages are short."""
    monkeypatch.chdir(tmp_path)
    small_golden(Path("g"))
    np.save("good.npy", flat(0.3))


def refused(*words: object) -> str:
    """The message of a command line that is refused."""
    result = invoke("judge", *words)
    assert (result.exit_code, result.stdout) == (1, ""), result.output
    return result.stderr


def array(name: str, content: object, kind: str = "<f8") -> None:
    """Write an array into the case of the folder."""
    np.save(Path("g") / CASE / name, np.asarray(content).astype(kind))


def document(**changes: object) -> None:
    """Change the document."""
    small_golden(Path("g"), **changes)


def case(**changes: object) -> None:
    """Change the only case of the document."""
    write_golden(Path("g"), write_case(Path("g"), *bounds()) | changes)


def odd_bounds() -> None:
    low, high = bounds()
    low[1, 2, 3] = 0.75
    write_case(Path("g"), low, high)


def a_folder_in_its_place() -> None:
    path = Path("g") / CASE / "undecided.npy"
    path.unlink()
    path.mkdir()


FOLDERS: dict[str, tuple[Callable[[], object], str]] = {
    "no document": (
        lambda: Path("g/golden.json").unlink(),
        "g is no golden folder: it has no file golden.json",
    ),
    "no JSON": (
        lambda: Path("g/golden.json").write_text("{"),
        "g/golden.json is no JSON: Expecting property name enclosed in double quotes: "
        "line 1 column 2 (char 1)",
    ),
    "nested without end": (
        lambda: Path("g/golden.json").write_text("[" * 100_000),
        "g/golden.json is no document: it is nested too deeply",
    ),
    "no bytes of a text": (
        lambda: Path("g/golden.json").write_bytes(b"\xff\xfe\x00"),
        "g/golden.json is no JSON: 'utf-8' codec can't decode byte 0xff in position 0: "
        "invalid start byte",
    ),
    "another document": (
        lambda: document(format="gltf"),
        "g/golden.json is not the document of a golden folder",
    ),
    "a list": (
        lambda: Path("g/golden.json").write_text("[]"),
        "g/golden.json is not the document of a golden folder",
    ),
    "another version": (
        lambda: document(version=2),
        "g/golden.json is of version 2, and 1 is read here: a newer Burnish reads it",
    ),
    "an older version": (
        lambda: document(version=0),
        "g/golden.json is of version 0, and 1 is read here: write the golden folder again",
    ),
    "an output that is listed twice": (
        lambda: document(cases=[write_case(Path("g"), *bounds())] * 2),
        "golden.json, case 'Plain/defaults': the output 'color' is listed twice",
    ),
    "true as a version": (
        lambda: document(version=True),
        "g/golden.json is of version true, and 1 is read here: write the golden folder again",
    ),
    "no cases": (lambda: write_golden(Path("g")), "g/golden.json has no cases"),
    "cases that are no list": (
        lambda: document(cases={}),
        "golden.json: `cases` is missing, or has a wrong type",
    ),
    "a case that is no object": (
        lambda: document(cases=[3]),
        "golden.json: `cases` has something that is no object",
    ),
    "a folder elsewhere": (
        lambda: case(folder="../secret"),
        "golden.json, case '../secret': its folder is not below that of the document",
    ),
    "an absolute folder": (
        lambda: case(folder="/etc"),
        "golden.json, case '/etc': its folder is not below that of the document",
    ),
    "an output elsewhere": (
        lambda: case(outputs=[{"name": "../x", "lanes": 4}]),
        f"golden.json, case '{CASE}': `../x` is no name of a file",
    ),
    "no width": (
        lambda: case(width=None),
        f"golden.json, case '{CASE}': `width` is missing, or has a wrong type",
    ),
    "no pixels": (
        lambda: case(height=0),
        f"golden.json, case '{CASE}': `height` is 0, which is not from 1 to 1048576",
    ),
    "five lanes": (
        lambda: case(outputs=[{"name": "color", "lanes": 5}]),
        f"golden.json, case '{CASE}': `lanes` is 5, which is not from 1 to 4",
    ),
    "a missing file": (
        lambda: Path(f"g/{CASE}/color.upper.npy").unlink(),
        f"there is no file g/{CASE}/color.upper.npy",
    ),
    "a folder as a file": (
        a_folder_in_its_place,
        f"there is no file g/{CASE}/undecided.npy",
    ),
    "no array": (
        lambda: Path(f"g/{CASE}/color.lower.npy").write_text("0.25"),
        f"g/{CASE}/color.lower.npy is no .npy file",
    ),
    "half an array": (
        lambda: os.truncate(f"g/{CASE}/color.lower.npy", 200),
        f"g/{CASE}/color.lower.npy is damaged: mmap length is greater than file size",
    ),
    "another size": (
        lambda: array("color.lower.npy", np.zeros((3, 2, 4))),
        f"g/{CASE}/color.lower.npy has the shape (3, 2, 4), and not (2, 3, 4)",
    ),
    "bounds in short floats": (
        lambda: array("color.lower.npy", np.zeros((2, 3, 4)), "<f4"),
        f"g/{CASE}/color.lower.npy has numbers of the type float32, and not float64",
    ),
    "NaN": (
        lambda: array("color.upper.npy", flat(np.nan)),
        f"g/{CASE}/color.upper.npy is damaged: it has NaN",
    ),
    "lower above upper": (
        odd_bounds,
        f"{CASE}/color is damaged: the lower bound of pixel 2,1, lane 3, is above the upper one",
    ),
    "odd undecided pixels": (
        lambda: array("undecided.npy", [[0, 1, 2], [0, 0, 0]], "u1"),
        f"g/{CASE}/undecided.npy is damaged: it has numbers above 1",
    ),
    "nothing to compare": (
        lambda: array("undecided.npy", np.ones((2, 3)), "u1"),
        f"nothing is compared: all pixels of {CASE}/color are undecided",
    ),
}


@pytest.mark.parametrize("name", FOLDERS)
def test_a_damaged_folder(name: str) -> None:
    damage, message = FOLDERS[name]
    damage()
    assert refused("g", "good.npy") == f"error: {message}\n"


def of_pickles() -> None:
    np.save("p.npy", np.array([print], object), allow_pickle=True)


def huge() -> None:
    """A header that announces a picture of a terabyte."""
    head = b"{'descr': '<f8', 'fortran_order': False, 'shape': (500000, 500000, 4), }\n"
    Path("p.npy").write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head)


def png(mode: str, size: tuple[int, int]) -> None:
    Image.new(mode, size).save("p.png")


def half_a_png() -> None:
    png("RGBA", (3, 2))
    os.truncate("p.png", 40)


PICTURES: dict[str, tuple[Callable[[], object], str, str]] = {
    "missing": (lambda: None, "p.npy", "there is no file p.npy"),
    "a pipe": (lambda: os.mkfifo("p.npy"), "p.npy", "there is no file p.npy"),
    "empty": (lambda: Path("p.npy").touch(), "p.npy", "p.npy is no .npy file"),
    "a text": (lambda: Path("p.png").write_text("picture"), "p.png", "p.png is no PNG file"),
    "half a PNG": (
        half_a_png,
        "p.png",
        "p.png is damaged: cannot identify image file 'p.png'",
    ),
    "no EXR": (
        lambda: Path("p.exr").write_text("picture"),
        "p.exr",
        "p.exr is no file of the format that its name says",
    ),
    "a JPEG": (
        lambda: Image.new("RGB", (3, 2)).save("p.jpg"),
        "p.jpg",
        "cannot judge p.jpg: pictures are .npy, .png, .exr, as others do not keep numbers exactly",
    ),
    "without an ending": (
        lambda: Path("p").touch(), "p", "cannot judge p: pictures are .npy, .png, .exr",
    ),
    "pickles": (
        of_pickles, "p.npy",
        "p.npy is damaged: Array can't be memory-mapped: Python objects in dtype.",
    ),
    "a terabyte": (huge, "p.npy", "p.npy is damaged: mmap length is greater than file size"),
    "another size": (
        lambda: np.save("p.npy", np.zeros((3, 2, 4))),
        "p.npy",
        f"the picture is 2 x 3 pixels large, and {CASE}/color is 3 x 2",
    ),
    "a PNG of another size": (
        lambda: png("RGB", (30, 20)),
        "p.png",
        f"p.png is 30 x 20 pixels large, and {CASE}/color is 3 x 2",
    ),
    "more lanes": (
        lambda: np.save("p.npy", flat(0.3, 5)),
        "p.npy",
        f"the picture has 5 lanes, and {CASE}/color has 4: leave out the others",
    ),
    "signed numbers": (
        lambda: np.save("p.npy", flat(0).astype("i1")),
        "p.npy",
        "the picture has numbers of the type int8: it takes floats of 16, 32 or 64 bits, or whole "
        "numbers of 8 or 16 bits without a sign",
    ),
    "complex numbers": (
        lambda: np.save("p.npy", flat(0).astype("c16")),
        "p.npy",
        "the picture has numbers of the type complex128: it takes floats of 16, 32 or 64 bits, or "
        "whole numbers of 8 or 16 bits without a sign",
    ),
    "one number": (
        lambda: np.save("p.npy", np.float64(3)),
        "p.npy",
        "the picture has the shape (), and not (height, width, lanes)",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", PICTURES)
def test_what_is_no_picture(name: str) -> None:
    make, path, message = PICTURES[name]
    make()
    assert refused("g", path) == f"error: {message}\n"


def test_floats_have_no_encoding() -> None:
    assert refused("g", "good.npy", "--encoding", "srgb") == (
        "error: the picture has floats, which are linear: only integers are encoded\n"
    )


def test_cases_and_outputs_are_named() -> None:
    rows = [write_case(Path("g"), *bounds(), folder=each) for each in (CASE, "Plain/behind")]
    rows.append(write_case(Path("g"), *bounds(), folder="Other/behind"))
    rows[0]["outputs"].append({"name": "depth", "lanes": 1})
    write_golden(Path("g"), *rows)
    there = f"{CASE}, Plain/behind, Other/behind"
    said = {
        (): f"name one of the cases: {there}",
        ("--case", "inside"): f"there is no case `inside`: there are {there}",
        ("--case", "behind"): "several cases are called `behind`: Other/behind, Plain/behind",
        ("--case", "defaults"): f"{CASE} has several outputs, name one of them: color, depth",
        ("--case", CASE, "--output", "normal"): (
            "there is no output `normal`: there is color, depth"
        ),
    }
    for words, message in said.items():
        assert refused("g", "good.npy", *words) == f"error: {message}\n"


def test_a_folder_of_pictures_lacks_one() -> None:
    Path("mine").mkdir()
    assert refused("g", "mine") == (
        f"error: there is no picture mine/{CASE}/color with .npy, .png, .exr\n"
    )


def test_names_cannot_control_the_terminal() -> None:
    case(folder="a\x1b[2J")
    assert refused("g", "good.npy", "--case", "\x1b[2J").count("\x1b") == 0


def test_a_long_document_is_not_read() -> None:
    with Path("g/golden.json").open("wb") as file:
        file.truncate(1 << 34)
    assert (
        refused("g", "good.npy")
        == "error: g/golden.json is too large: it has over 67108864 bytes\n"
    )


def test_more_fields_are_ignored() -> None:
    document(extra=json.loads('{"a": [1]}'))
    assert invoke("judge", "g", "good.npy").exit_code == 0
