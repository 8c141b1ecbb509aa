"""``burnish graph``: formats, output whole or not at all, and what cannot be drawn."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from .kit import PLAIN, invoke, tree

SOURCE = """
material Plain {
    param gain : float
    param size : float in 1..4 = 2

    safe  = uv.x / exp(size)
    risky = uv.y / gain
    color = vec3(safe, risky, safe * risky)
}
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "plain.burnish"
    path.write_text(SOURCE)
    return path


def test_equations_are_printed(file: Path) -> None:
    result = invoke("graph", file)
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.startswith("Plain, pass Forward, rig Daylight\n\ninputs\n  gain ")
    assert "  color     rgb · equation · vec3 · " in result.stdout
    assert "    x: safe\n    y: risky\n    z: multiply\n" in result.stdout


def test_the_program_is_printed(file: Path) -> None:
    result = invoke("graph", file, "--program")
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.startswith("Plain, pass Forward, rig Daylight\n\nhost, once for")
    assert "= vertex_uv.x / " in result.stdout


def test_reasons_are_told(file: Path) -> None:
    result = invoke("graph", file, "--why")
    assert result.exit_code == 0
    assert "  uv.x / exp(size)   (" in result.stdout
    assert "- size is 1..4  [declared range]" in result.stdout
    assert "missing: `gain` has no declared range" in result.stdout


@pytest.mark.parametrize(
    ("name", "begin"), [("a.svg", "<svg "), ("a.dot", "digraph "), ("a.txt", "Plain,")]
)
def test_a_file_s_name_says_the_format(file: Path, name: str, begin: str) -> None:
    result = invoke("graph", file, "-o", file.parent / "new" / name)
    assert (result.exit_code, result.output) == (0, "")
    assert (file.parent / "new" / name).read_text("utf-8").startswith(begin)
    assert tree(file.parent / "new") == {name}


def test_an_unknown_ending_is_refused(file: Path) -> None:
    result = invoke("graph", file, "-o", file.parent / "a.png")
    assert result.exit_code == 2
    assert "ends in none of .svg, .dot, .txt; say which --format" in result.stderr
    assert tree(file.parent) == {"plain.burnish"}


def test_a_folder_is_no_file_to_write(file: Path) -> None:
    (file.parent / "a.svg").mkdir()
    result = invoke("graph", file, "-o", file.parent / "a.svg")
    assert result.exit_code == 1
    assert "error[B0009]" in result.stderr
    assert "it is a folder" in result.stderr


def test_errors_of_the_material_are_told_and_nothing_is_written(file: Path) -> None:
    file.write_text("material Plain { color = nonsense }")
    result = invoke("graph", file, "-o", file.parent / "a.svg")
    assert result.exit_code == 1
    assert "error[B0201]" in result.stderr
    assert tree(file.parent) == {"plain.burnish"}


def test_a_picture_shows_one_material(file: Path) -> None:
    file.write_text(PLAIN + PLAIN.replace("Plain", "Other"))
    refused = invoke("graph", file, "-o", file.parent / "a.svg")
    assert refused.exit_code == 2
    assert "a picture shows one material, and there are Plain, Other; choose one" in refused.stderr
    chosen = invoke("graph", file, "-o", file.parent / "a.svg", "--material", "Other")
    assert chosen.exit_code == 0
    assert invoke("graph", file).stdout.count("drawn by") == 2
    assert invoke("graph", file, "--program").stdout.count("vertex stage") == 2
    assert invoke("graph", file, "--all").stdout.count("vertex stage") == 2


def test_kernels_beside_materials_are_shown_as_programs(file: Path) -> None:
    file.write_text(PLAIN + "kernel Counted { result two : float[4] = 2 }")
    printed = invoke("graph", file).stdout
    assert printed.count("drawn by") == printed.count("compute stage") == 1


def test_reasons_are_no_picture(file: Path) -> None:
    result = invoke("graph", file, "--why", "--format", "svg")
    assert result.exit_code == 2
    assert "proofs are text" in result.stderr


def test_what_is_too_large_to_draw_is_said(file: Path) -> None:
    steps = "\n".join(f"x{i + 1} = sin(x{i}) * x{i}" for i in range(3000))
    file.write_text(f"material Long {{ x0 = uv.x\n{steps}\ncolor = vec3(x3000) }}")
    result = invoke("graph", file, "-o", file.parent / "a.svg")
    assert result.exit_code == 1
    assert "error[B0451]: Long has 6004 boxes to draw" in result.stderr
    assert tree(file.parent) == {"plain.burnish"}
    assert "x2999" in invoke("graph", file, "--format", "dot").stdout


ERROR = """
material Bands {
    wave  = fract(sin(uv.x * 40) * 700)
    color = vec3(wave, uv.y, 0)
}
"""


def test_values_are_coloured_by_their_part_in_the_error_of_a_pixel(tmp_path: Path) -> None:
    path = tmp_path / "bands.burnish"
    path.write_text(ERROR)
    result = invoke("graph", path, "--error", "36,28")
    assert (result.exit_code, result.stderr) == (0, "")
    wave, crossing = (
        re.search(rf"^  {name} +\w+ · .*?([\d.]+)% of the error", result.stdout, re.MULTILINE)
        for name in ("wave", "vertex_uv")
    )
    assert wave is not None and float(wave[1]) > 50
    assert crossing is not None and float(crossing[1]) < 50
    assert "% of the error" not in invoke("graph", path).stdout
    drawn = tmp_path / "bands.svg"
    assert invoke("graph", path, "--error", "36,28", "-o", drawn).exit_code == 0
    root = ET.fromstring(drawn.read_text())
    texts = [text.text for text in root.iter("{http://www.w3.org/2000/svg}text")]
    assert texts[-3:] == ["1% of the error", "25%", "all of it"]


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        (("0,0",), 1, "error: nothing is drawn at 0,0 of `defaults`\n"),
        (("0,60",), 1, "error: there is no pixel 0,60: pictures have 72 columns and 56 rows"),
        (("9,9", "--case", "behin"), 1, "there is no case `behin`; did you mean `behind`?\n"),
        (("36,28", "--why"), 2, "proofs have no pixel: --why goes without --error\n"),
        (("36",), 2, "'36' is no pixel, which would be like 36,28\n"),
    ],
)
def test_pixels_without_an_error(
    file: Path, words: tuple[str, ...], code: int, message: str
) -> None:
    result = invoke("graph", file, "--error", *words)
    assert result.exit_code == code and message in result.stderr


def test_kernels_over_buffers_have_no_pixels(tmp_path: Path) -> None:
    path = tmp_path / "counted.burnish"
    path.write_text("kernel Counted { result two : float[4] = 2 }")
    assert invoke("graph", path, "--error", "3,0").stderr == (
        "error: Counted draws no picture, so that it has no pixel to explain\n"
    )


FRAMES = """
import std.frames.{FullScreen}

material Clay { color = #b5651d }

pass Shown : FullScreen {
    map drawn : texture2d
    target color : rgba8 = drawn(uv)
}

frame One {
    models scene
    lit    = Forward(scene)
    shown  = Shown(screen) with { drawn = lit.color }
    output picture = shown.color
}

frame Two : One { output raw = lit.color }
"""


@pytest.fixture
def frames(tmp_path: Path) -> Path:
    path = tmp_path / "frames.burnish"
    path.write_text(FRAMES)
    return path


def test_frames_show_their_steps(frames: Path) -> None:
    result = invoke("graph", frames)
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.count("\nsteps\n") == 2
    one = invoke("graph", frames, "--material", "One", "-o", frames.parent / "one.svg")
    assert (one.exit_code, one.output) == (0, "")
    assert "<title>One, rig Daylight</title>" in (frames.parent / "one.svg").read_text("utf-8")


def test_a_picture_shows_one_frame(frames: Path) -> None:
    result = invoke("graph", frames, "-o", frames.parent / "a.svg")
    assert result.exit_code == 2
    assert "a picture shows one frame, and there are One, Two; choose one" in result.stderr
    assert tree(frames.parent) == {"frames.burnish"}


def test_one_shader_of_a_frame_is_shown_like_a_material(frames: Path) -> None:
    result = invoke("graph", frames, "--shader", "One.Shown")
    assert result.exit_code == 0
    assert result.stdout.startswith("One.Shown, pass Shown, rig Daylight\n\nvertex stage\n")
    misspelt = invoke("graph", frames, "--shader", "One.Show")
    assert misspelt.exit_code == 2
    assert "there is no shader `One.Show`: did you mean `One.Shown`?" in misspelt.stderr


def test_options_for_one_shader_are_refused_for_frames(frames: Path, file: Path) -> None:
    for option in (["--all"], ["--error", "3,4"], ["--program"]):
        result = invoke("graph", frames, *option)
        assert result.exit_code == 2
        assert f"{option[0]} is about one shader of a frame: name it by --shader" in result.stderr
    result = invoke("graph", file, "--shader", "Plain")
    assert result.exit_code == 2
    assert "--shader is for frames, and there is none in the file" in result.stderr


def test_proofs_of_frames_are_those_of_their_shaders(frames: Path) -> None:
    result = invoke("graph", frames, "--material", "One", "--why")
    assert result.exit_code == 0
    assert "One.Forward.Clay, pass Forward, rig Daylight" in result.stdout
