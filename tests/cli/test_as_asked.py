"""Files that are drawn as the command in their own comment draws them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from .kit import invoke
from .test_render import middle, pixels

FILE = """\
//!     burnish render m.burnish -o m.png --set paint=own.png --set base=#00ff00 --mesh plane

material Painted {
    param base  : rgb = #000000
    map   paint : texture2d = black
    color = base + paint(uv).rgb
}

material Other {
    param base : rgb = #0000ff
    color = base
}
"""
ASKED = "note: drawn as the comment of {} asks; --plain does not\n"


@pytest.fixture(name="file")
def _file(tmp_path: Path) -> Path:
    Image.new("RGB", (2, 2), "#ff0000").save(tmp_path / "own.png")
    (tmp_path / "m.burnish").write_text(FILE)
    return tmp_path / "m.burnish"


def drawn(file: Path, *options: object) -> tuple[tuple[int, ...], tuple[int, ...], str]:
    """The colours in the middle and near a corner, and what was said."""
    picture = file.with_name("out.png")
    result = invoke("render", file, "-o", picture, "--size", 24, "--material", "Painted", *options)
    assert result.exit_code == 0, result.stderr
    found = pixels(picture)
    return middle(found), tuple(found[3, 3].tolist()), result.stderr.replace(str(file), "{}")


def test_a_file_shows_its_subject_without_options(file: Path) -> None:
    """The picture lies beside the file, wherever the command is run."""
    on_plane = drawn(file)
    assert on_plane == ((255, 255, 0), (255, 255, 0), ASKED)


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (("--plain",), ((0, 0, 0), (27, 29, 33), "")),
        (("--mesh", "sphere"), ((255, 255, 0), (27, 29, 33), ASKED)),
        (("--set", "base=#0000ff"), ((255, 0, 255), (255, 0, 255), ASKED)),
        (("--set", "base=#0000ff", "--set", "paint=#000000", "--mesh", "plane"),
         ((0, 0, 255), (0, 0, 255), "")),
    ],
)  # fmt: skip
def test_the_command_line_wins(
    options: tuple[str, ...], expected: tuple[Any, ...], file: Path
) -> None:
    assert drawn(file, *options) == expected


def test_a_command_may_continue_on_the_next_line(file: Path) -> None:
    asked_before = drawn(file)
    file.write_text(FILE.replace(" --mesh plane", " \\\n//!         --mesh plane"))
    assert drawn(file) == asked_before


def test_the_camera_may_be_asked_for(file: Path) -> None:
    """From its edge, a plane is not seen, but the background is."""
    file.write_text(FILE.replace("--mesh plane", "--mesh plane --eye 9,0,0 --look-at 0,0,0"))
    assert drawn(file) == ((27, 29, 33), (27, 29, 33), ASKED)


def test_another_material_takes_the_values_that_it_has(file: Path) -> None:
    picture = file.with_name("out.png")
    result = invoke("render", file, "-o", picture, "--size", 8, "--material", "Other")
    assert (result.exit_code, middle(pixels(picture))) == (0, (0, 255, 0))


def test_a_missing_picture_is_told(file: Path) -> None:
    file.with_name("own.png").unlink()
    found, _, said = drawn(file)
    assert found == (0, 255, 0)
    assert (
        "note: the comment of the file sets `paint`, and that failed: cannot read own.png" in said
    )


def test_a_comment_that_draws_another_file_is_told(file: Path) -> None:
    """A copy keeps the name that the comment has for the first one."""
    copy = file.with_name("copy.burnish")
    copy.write_text(FILE)
    found, _, said = drawn(copy)
    assert found == (0, 0, 0)
    draws = "the comment of the file draws `m.burnish`, and the file is `copy.burnish`"
    assert said == f"note: {draws}; it is drawn without that\n"


def test_what_is_not_followed_is_told(file: Path) -> None:
    file.write_text(FILE.replace("--mesh plane", "--scene x.glb"))
    found, _, said = drawn(file)
    assert found == (0, 0, 0)
    assert "asks for `--scene`, which is not followed; it is drawn without that" in said
