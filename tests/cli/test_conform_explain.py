"""``burnish conform --explain``: the way of the error at one pixel, of materials and of frames."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import pytest

from .kit import invoke
from .test_conform import FAR_AWAY, HASH, UP


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder with a material."""
    monkeypatch.chdir(tmp_path)
    Path("m.burnish").write_text(UP)


def test_explaining_a_pixel() -> None:
    """The explanation has the pixel's value and bounds, each route's value, and the error's way."""
    Path("m.burnish").write_text(HASH)
    result = invoke(
        "conform", "m.burnish", "--routes", "llvmpipe:gl330,lavapipe:glsl", "--explain", "36,28",
        "--case", "defaults",
    )  # fmt: skip
    assert (result.exit_code, result.stderr) == (0, "")
    text = result.stdout
    assert text.startswith(
        "m.burnish: Hash\n  pixel 36,28 of `defaults`, by the rules of lavapipe:glsl\n\n  value "
    )
    assert re.search(r"^  llvmpipe:gl330  \(0\.\d+, 0\.\d+, 0\.\d+, 1\)$", text, re.MULTILINE)
    assert re.search(r"^    from  +\(.*\)\n    to  +\(.*\)$", text, re.MULTILINE)
    headings = re.findall(r"^  (\w.*):$", text, re.MULTILINE)
    assert headings == [
        "where precision is lost", "what contributes", "the way of the largest contribution",
    ]  # fmt: skip
    expression = "`fract(sin(dot(uv, vec2(12.9898, 78.233))) * 43758.5453)` (m.burnish:1)"
    assert text.count(expression) >= 2
    # Without a case, one is chosen.
    result = invoke("conform", "m.burnish", "--routes", "llvmpipe:gl330", "--explain", "36,28")
    assert re.search(r"pixel 36,28 of `(stretched|behind|inside)`", result.stdout)


FRAME = """
import std.frames.{FullScreen}
pass Rough : FullScreen { target value : rgba32f = vec4(sin(uv.x)) }
pass Scaled : FullScreen {
    map source : texture2d with { filter = nearest, mip = none }
    target value : rgba32f = source.load(ivec2(frag_coord.xy)) * 1000
}
frame F {
    rough  = Rough(screen)
    scaled = Scaled(screen) with { source = rough.value }
    output value = scaled.value
}
"""


def test_explaining_a_pixel_of_a_frame() -> None:
    Path("f.burnish").write_text(FRAME)
    command = "conform", "f.burnish", "--routes", "llvmpipe:gl330", "--explain"
    result = invoke(*command, "36,28")
    assert (result.exit_code, result.stderr) == (0, "")
    text = result.stdout
    assert text.startswith(
        "f.burnish: F\n  pixel 36,28 of `value`, by the rules of llvmpipe:gl330\n"
    )
    assert re.search(
        r"^  the step `scaled` has made it, and its bounds are \S+ apart\n\n"
        r"  how far apart they would be without the error of:\n"
        r"    \S+  `source`, which is `rough\.value`\n\n"
        r"  what `scaled` makes of what it reads:\n  rounding may change r = \S+ by ",
        text, re.MULTILINE,
    )  # fmt: skip
    assert "`source.load(ivec2(frag_coord.xy))` (f.burnish:6)" in text
    result = invoke(*command, "72,0")
    assert (result.exit_code, result.stderr) == (1, "error: no output has a pixel 72,0\n")


def test_why_a_frame_proves_little() -> None:
    """The step that loses precision; or the input that has lost it before."""
    rough = "fract(sin(uv.x * 913) * 43758.5453)"
    text = FRAME.replace("sin(uv.x)", rough)
    alone = "frame Alone { rough = Rough(screen)  output value = rough.value }"
    Path("f.burnish").write_text(text + alone)
    result = invoke("conform", "f.burnish", "--routes", "llvmpipe:gl330")
    assert result.stderr.count(" proves little\n") == 2
    assert (
        "\n  `scaled` has most of the error from `source`, which is `rough.value`\n"
        in result.stderr
    )
    assert (
        f"\n  `rough`: `{rough}` magnifies rounding 4·10^4 times (f.burnish:3)\n" in result.stderr
    )


NOT_EXPLAINED = {
    "72,0": (2, "there is no pixel 72,0: pictures have 72 columns and 56 rows, counted"),
    "3": (2, "'3' is no pixel, which would be like 36,28"),
    "0,0 --case defaults": (
        1, "error: nothing is drawn at 0,0 of `defaults`; the nearest pixel that shows the mesh is",
    ),
    "9,9 --case default": (1, "error: there is no case `default`; did you mean `defaults`?"),
    "9,9 --case x": (
        1, "error: there is no case `x`; its cases are `defaults`, `stretched`, `behind`, `inside`",
    ),
}  # fmt: skip


@pytest.mark.parametrize("words", NOT_EXPLAINED)
def test_pixels_that_cannot_be_explained(words: str) -> None:
    code, message = NOT_EXPLAINED[words]
    result = invoke(
        "conform", "m.burnish", "--routes", "llvmpipe:gl330", "--explain", *words.split()
    )
    assert result.exit_code == code
    assert message in result.stderr


@pytest.mark.parametrize(
    ("text", "options"),
    [
        ("kernel Counted { result two : float[4] = 2 }", ()),
        ("material Counted {}  pass P { capture place : vec3 = position }", ("--pass", "P")),
    ],
)
def test_what_draws_no_picture_has_no_pixels(text: str, options: Sequence[str]) -> None:
    Path("k.burnish").write_text(text)
    result = invoke(
        "conform", "k.burnish", "--routes", "lavapipe:glsl", "--explain", "3,0", *options
    )
    assert (result.exit_code, result.stderr) == (
        1, "error: Counted draws no picture, so that it has no pixel to explain\n"
    )  # fmt: skip


def test_a_material_that_does_not_show_the_pixel_does_not_hide_the_others() -> None:
    Path("m.burnish").write_text(HASH + FAR_AWAY)
    result = invoke(
        "conform",
        "m.burnish",
        "--routes",
        "llvmpipe:gl330",
        "--explain",
        "36,28",
        "--case",
        "defaults",
    )
    assert result.exit_code == 1
    assert re.search("^m.burnish: Hash$", result.stdout, re.MULTILINE)
    assert "Far" not in result.stdout
    assert result.stderr == (
        "error: m.burnish: Afar: nothing is drawn at 36,28 of `defaults`, nor elsewhere\n"
    )


def test_a_case_without_a_pixel() -> None:
    result = invoke("conform", "m.burnish", "--case", "defaults")
    assert result.exit_code == 2
    assert "--case names the scene of a pixel: it goes with --explain" in result.stderr


@pytest.mark.parametrize("option", ["--strict", "--report=somewhere"])
def test_what_explaining_a_pixel_has_no_use_for(option: str) -> None:
    result = invoke("conform", "m.burnish", "--explain", "36,28", option)
    assert result.exit_code == 2
    name = option.partition("=")[0]
    assert f"{name} is about verdicts, which --explain does not give: leave out" in result.stderr
