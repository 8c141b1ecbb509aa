"""``burnish render`` of frames that evolve: numbered pictures, pictures that move, and what is left
where one of them cannot be written."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageSequence

from burnish.commands.picture_files import Page, write_pages
from burnish.targets.runner.sheet import Panel

from .kit import invoke, tree

COUNTED = """\
import std.frames.{FullScreen}

pass Grey : FullScreen {
    param bright : float in 0..1 = 0
    target color : rgba8 = vec4(vec3(bright), 1)
}

pass Faded : FullScreen {
    map now    : texture2d with { filter = nearest, mip = none }
    map before : texture2d with { filter = nearest, mip = none }
    target color : rgba8 = max(now(uv), before(uv) - 0.2)
}

/// White first, and black later: what is left of the white fades.
frame Fading {
    grey  = Grey(screen) with { bright = if number == 0 then 1 else 0 }
    faded = Faded(screen) with { now = grey.color, before = previous(faded.color) }
    output picture = faded.color
}
"""
LEFT = (1.0, 0.8, 0.6, 0.4)
"""The linear brightness of the frames."""


def bytes_of(linear: float) -> int:
    """The byte of a linear brightness in sRGB."""
    stored: float = 255 * (1.055 * linear ** (1 / 2.4) - 0.055)
    return round(stored)


def render(folder: Path, name: str, count: int) -> str:
    """The output of the command that draws some frames of ``COUNTED``."""
    (folder / "f.burnish").write_text(COUNTED)
    result = invoke(
        "render", folder / "f.burnish", "-o", folder / "out" / name, "--size", "4x2",
        "--frames", count,
    )  # fmt: skip
    assert (result.exit_code, result.stderr) == (0, "")
    return result.stdout


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with an empty folder for pictures."""
    (tmp_path / "out").mkdir()
    return tmp_path


def greys(path: Path) -> Iterator[tuple[int, float]]:
    """The brightness of each picture of a file, and its duration in milliseconds."""
    with Image.open(path) as image:
        for shown in ImageSequence.Iterator(image):
            values = np.asarray(shown.convert("RGB"))
            assert values.shape == (2, 4, 3)
            assert np.ptp(values) <= 1
            yield int(values[0, 0, 0]), shown.info["duration"]


def test_numbered_pictures(folder: Path) -> None:
    printed = render(folder, "f.png", len(LEFT))
    assert printed == f"Fading: {folder}/out/f-000.png to f-003.png\n"
    assert tree(folder / "out") == {f"f-{number:03}.png" for number in range(len(LEFT))}
    for number, left in enumerate(LEFT):
        with Image.open(folder / "out" / f"f-{number:03}.png") as image:
            assert image.convert("RGB").getpixel((0, 0)) == pytest.approx(
                (bytes_of(left),) * 3, abs=1
            )


def test_one_frame_is_one_picture(folder: Path) -> None:
    render(folder, "f.png", 1)
    assert tree(folder / "out") == {"f.png"}


def test_there_are_enough_digits(folder: Path) -> None:
    output = folder / "out" / "f.png"
    page = Page([Panel((), "", Image.new("RGB", (1, 1)))], 1, (1, 1))
    write_pages([page] * 1001, output)
    assert min(tree(folder / "out")) == "f-0000.png"
    assert max(tree(folder / "out")) == "f-1000.png"


@pytest.mark.parametrize("ending", ["gif", "webp", "apng"])
def test_a_picture_that_moves(folder: Path, ending: str) -> None:
    render(folder, f"f.{ending}", len(LEFT))
    assert tree(folder / "out") == {f"f.{ending}"}
    found = list(greys(folder / "out" / f"f.{ending}"))
    assert [grey for grey, _ in found] == pytest.approx([bytes_of(left) for left in LEFT], abs=4)
    assert [duration for _, duration in found] == [40] * len(LEFT)


def test_frames_that_stay_the_same_are_shown_as_long(folder: Path) -> None:
    """Some formats store equal pictures once; they must not be over sooner for it."""
    render(folder, "f.gif", 12)
    assert sum(duration for _, duration in greys(folder / "out" / "f.gif")) == 12 * 40


def test_nothing_is_left_where_one_picture_cannot_be_written(folder: Path) -> None:
    (folder / "out" / "f-002.png").mkdir()
    (folder / "f.burnish").write_text(COUNTED)
    result = invoke(
        "render", folder / "f.burnish", "-o", folder / "out" / "f.png", "--size", "4x2",
        "--frames", 4,
    )  # fmt: skip
    assert result.exit_code == 1
    assert result.stderr == f"error: cannot write `{folder}/out/f-002.png`: it is a folder\n"
    assert tree(folder / "out") == {"f-002.png"}


UNLIKE = """
material Clay { color = #a08060 }
pass Both : Forward {
    target color : rgba16f = vec4(color, 1) blend add
    target other : rgba8   = vec4(color, 1) blend multiply
}
frame Shown { models scene  both = Both(scene)  output picture = both.color }
"""


def test_of_all_routes_those_are_left_out_that_lack_something(folder: Path) -> None:
    """They are told, and have an empty place on the sheet beside the pictures of all outputs."""
    (folder / "f.burnish").write_text(UNLIKE)
    result = invoke(
        "render", folder / "f.burnish", "-o", folder / "f.png", "--size", "4",
        "--on", "all",
    )  # fmt: skip
    assert result.exit_code == 0
    assert (
        "note: Shown is not drawn by llvmpipe:es310: glsl:es310 has no blending of its own for "
        "each target\n"
    ) in result.stderr
    with Image.open(folder / "f.png") as sheet:
        assert sheet.width == 4 * (128 + 16) + 16


SHEET = """
import std.lights.{Directional}
import std.terms.{lambert}
material Clay { color = lambert(vec3(1)) }
rig Day  { sun : Directional { direction = vec3(0, 0, -1) } }
rig Dusk { sun : Directional { direction = vec3(0, 0, 1) } }
frame One { models scene  b = Forward(scene)  output picture = b.color  output depth = b.depth }
frame Two { models scene  b = Forward(scene)  output picture = b.color }
"""


def sheet_of(folder: Path, *options: object) -> tuple[str, tuple[int, int]]:
    """The output of the command that draws ``SHEET``, without its path, and the picture's size."""
    (folder / "f.burnish").write_text(SHEET)
    picture = folder / "f.png"
    result = invoke("render", folder / "f.burnish", "-o", picture, "--size", 128, *options)
    assert (result.exit_code, result.stderr) == (0, "")
    with Image.open(picture) as image:
        return result.stdout.replace(f": {picture}\n", ""), image.size


def test_frames_outputs_and_rigs_make_a_sheet(folder: Path) -> None:
    """Two outputs and one, with two rigs each."""
    said, (width, height) = sheet_of(folder)
    assert said == "One, rig Day; One, rig Dusk; Two, rig Day; Two, rig Dusk"
    assert width == 3 * (128 + 16) + 16
    assert height > 2 * 128
    said, size = sheet_of(folder, "--material", "Two", "--rig", "Dusk")
    assert (said, size) == ("Two", (128, 128))


def test_one_output_of_a_frame_and_one_that_it_has_not(folder: Path) -> None:
    of_one = ("--material", "One", "--rig", "Day")
    assert sheet_of(folder, *of_one, "--target", "depth") == ("One", (128, 128))
    result = invoke("render", folder / "f.burnish", "-o", "x.png", *of_one, "--target", "dept")
    assert (result.exit_code, result.stderr) == (
        1, "error: One has no output `dept`: did you mean `depth`?\n",
    )  # fmt: skip


def refused(folder: Path, text: str, *options: object) -> str:
    """The last words of the command about a frame that cannot be drawn."""
    (folder / "f.burnish").write_text(text)
    result = invoke("render", folder / "f.burnish", "-o", folder / "x.png", "--size", 4, *options)
    assert result.exit_code == 1
    assert not (folder / "x.png").exists()
    return result.stderr


def test_values_that_a_frame_lacks(folder: Path) -> None:
    text = """
        material Clay { param tint : rgb  color = tint }
        frame Shown { models scene  b = Forward(scene)  output picture = b.color }
    """
    assert refused(folder, text) == (
        "error: Shown.Forward.Clay needs values for\n  `tint` : rgb\n"
        "  = help: set each of them: --set 'tint=…'\n"
    )


@pytest.mark.parametrize(
    ("value", "told"),
    [
        (
            "sun=1",
            "`sun` is a light, whose parameters are `sun.diffuse_color`, `sun.specular_color`",
        ),
        ("sun.diffuse=1", "there is no parameter `sun.diffuse`: did you mean `sun.diffuse_color`?"),
    ],
)
def test_parts_of_lights_of_a_frame(folder: Path, value: str, told: str) -> None:
    of_two = ("--rig", "Day", "--material", "Two")
    assert refused(folder, SHEET, *of_two, "--set", value) == f"error: {told}\n"


def test_promises_that_a_frame_breaks(folder: Path) -> None:
    (folder / "f.burnish").write_text("""
        material Clay { color = normalize(nonzero(vec3(uv.x - uv.x, 0, 0))) }
        frame Shown { models scene  b = Forward(scene)  output picture = b.color }
    """)
    result = invoke("render", folder / "f.burnish", "-o", folder / "f.png", "--size", 8)
    assert result.exit_code == 0
    assert "is promised not to be zero, and is: the pixels that use it are not defined" in (
        result.stderr
    )


def test_a_target_of_a_frame_with_one_lane_is_grey(folder: Path) -> None:
    text = """
        import std.frames.{FullScreen}
        pass Half : FullScreen { target half : r8 = 0.5 }
        frame Shown { b = Half(screen)  output picture = b.half }
    """
    (folder / "f.burnish").write_text(text)
    for route in ("reference", "lavapipe:glsl"):
        words = ("-o", folder / "f.png", "--size", 4, "--on", route)
        assert invoke("render", folder / "f.burnish", *words).exit_code == 0
        with Image.open(folder / "f.png") as image:
            assert image.convert("RGB").getpixel((0, 0)) == (188,) * 3
