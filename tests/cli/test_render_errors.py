"""``burnish render`` with bad input: what it says, how it ends, and that nothing is left behind."""

from __future__ import annotations

import os
import sys
from functools import partial
from pathlib import Path
from subprocess import CompletedProcess

import pytest
from PIL import Image

from burnish.targets.runner import routes
from burnish.targets.runner.runner import Runner

from ..suite.processes import at_once, run
from .kit import invoke, shell, tree

WHOLE = """\
import std.lights.{Directional, Point, Spot}
import std.terms.{lambert}

material Whole {
    param power : float in 1..8 = 2
    param steps : int in 0..3 = 1
    param tint  : rgb = #808080
    param shift : vec2 = vec2(0)
    param yes   : bool = false
    map   paint : texture2d

    color = lambert(tint) * power * float(steps) * paint(uv + shift).rgb * (if yes then 1 else 2)
}

rig Hall {
    sun   : Directional
    lamps : Point[<= 8]
    torch : Spot
}
"""
USAGE = "Usage: burnish render [OPTIONS] FILE\nTry 'burnish render --help' for help.\n\nError: "


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a material, some pictures, and nothing else."""
    monkeypatch.chdir(tmp_path)
    Path("m.burnish").write_text(WHOLE)
    Image.radial_gradient("L").save("whole.png")
    Path("cut.png").write_bytes(Path("whole.png").read_bytes()[:900])
    Path("text.png").write_text("no picture")
    Image.new("L", (8193, 1)).save("wide.png")
    return tmp_path


ALL_NAMES = (
    "object_to_world, view_projection, eye, ambient_light, power, steps, tint, shift, yes, sun, "
    "lamps, torch, paint"
)
VALUES = {
    "powr=3": "there is no parameter `powr`: did you mean `power`?",
    "mass=3": f"there is no parameter `mass`: there are {ALL_NAMES}",
    "power=abc": "`power` (float) cannot hold 'abc'",
    "power=nan": "`power` takes finite numbers, and nan is none",
    "power=-inf": "`power` takes finite numbers, and -inf is none",
    "power=9": "`power` is declared in 1..8: 9 is not",
    "power=1e40": "`power` is a float32, and 1e+40 is too large for it",
    "power=1,2": "`power` takes one number (float), and was given a list of 2",
    "steps=1.5": "`steps` (int) cannot hold '1.5'",
    "yes=maybe": "`yes` (bool) cannot hold 'maybe'",
    "shift=1": "`shift` takes 2 numbers (vec2), and was given 1",
    "tint=red": "`tint` (rgb) cannot hold 'red': a colour is written #f00",
    "tint=#12345": "`tint`: #12345 is no colour, which would be #b5651d",
    "tint=1,2,3,4": "`tint` takes 3 numbers (rgb), and was given a list of 4",
    "lamps.count=9": "`lamps.count` is declared in 0..8: 9 is not",
    "lamps[8].place=0,0,0": "there is no `lamps[8]`: the last element is `lamps[7]`",
    "lamps[0].plaice=0,0,0": "`lamps[0]` has no member `plaice`: did you mean `place`?",
    "lamps[0]=1": "`lamps[0]` (Point) is set by its parts, each by its name",
    "torch.axs=0,1,0": "there is no parameter `torch.axs`: did you mean `torch.axis`?",
    "torch.axis=0,2,0": (
        "`torch.axis` is a direction and has to be of length 1, not 2: that would be (0, 1, 0)"
    ),
    "torch.outer=40grad": "`torch.outer` (angle) cannot hold '40grad'",
    "paint=none.png": "cannot read none.png: No such file or directory",
    "paint=srgb:none.png": "cannot read none.png: No such file or directory",
    "paint=.": "cannot read .: it is not a file",
    "paint=cut.png": "cannot read cut.png: image file is truncated",
    "paint=text.png": (
        "text.png is not a picture of a known format: PNG, JPEG, WEBP, GIF, BMP, TGA or TIFF"
    ),
    "paint=wide.png": "wide.png has 8193 x 1 texels, and no side may have more than 8192",
    "paint=#12345": "'#12345' is no colour, which would be '#b5651d'",
}


@pytest.mark.parametrize(("value", "text"), VALUES.items(), ids=list(VALUES))
def test_values(value: str, text: str, folder: Path) -> None:
    before = tree(folder)
    result = invoke("render", "m.burnish", "-o", "x.png", "--size", 4, "--set", value)
    assert (result.exit_code, result.stdout) == (1, "")
    assert result.stderr == f"error: {text}\n"
    assert tree(folder) == before


OPTIONS = {
    "--set power": "Invalid value for '--set': 'power' is not NAME=VALUE",
    "--set =1": "Invalid value for '--set': '=1' is not NAME=VALUE",
    "--set power=": "Invalid value for '--set': 'power=' is not NAME=VALUE",
    "--size big": "Invalid value for '--size': 'big' is neither like 512 nor like 640x480",
    "--size 0x8": "Invalid value for '--size': a side has 1 to 4096 pixels",
    "--size 4097": "Invalid value for '--size': a side has 1 to 4096 pixels",
    "--background red": (
        "Invalid value for '--background': 'red' is no colour, which would be '#b5651d'"
    ),
    "--mesh teapot": (
        "Invalid value for '--mesh': 'teapot' is not one of 'sphere', 'plane', 'floor', 'cube', "
        "'torus', 'cylinder', 'capsule', 'knot'."
    ),
    "--on lavapip": "there is no route `lavapip`; did you mean `lavapipe`?",
    "--on ,": "--on names no route",
    "--on all --size 4096": (
        "a sheet of 14 pictures of 4096 x 4096 pixels is too large: "
        "choose a smaller --size, or fewer routes"
    ),
}


@pytest.mark.parametrize(("options", "text"), OPTIONS.items(), ids=list(OPTIONS))
def test_senseless_options(options: str, text: str, folder: Path) -> None:
    before = tree(folder)
    result = invoke("render", "m.burnish", "-o", "x.png", *options.split())
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr == f"{USAGE}{text}\n"
    assert tree(folder) == before


NAMES = {
    "--material Hole": ("unknown material `Hole`", "did you mean `Whole`?"),
    "--rig Hal": ("unknown rig `Hal`", "did you mean `Hall`?"),
}


@pytest.mark.parametrize(("options", "told"), NAMES.items(), ids=list(NAMES))
def test_unknown_names(options: str, told: tuple[str, str], folder: Path) -> None:
    message, hint = told
    result = invoke("render", "m.burnish", "-o", "x.png", *options.split())
    assert result.exit_code == 1
    assert result.stderr.startswith(f"error[B0201]: {message}\n --> m.burnish:1:1\n")
    assert result.stderr.endswith(f"\n  = help: {hint}\n\n1 error\n")
    assert not (folder / "x.png").exists()


@pytest.mark.parametrize(
    ("name", "hint"), [("colour", "did you mean `color`?"), ("depth", "there are color")]
)
def test_unknown_target(name: str, hint: str, folder: Path) -> None:
    result = invoke("render", "m.burnish", "-o", "x.png", "--target", name)
    assert result.exit_code == 1
    assert result.stderr == f"error: Whole has no render target `{name}`: {hint}\n"
    assert not (folder / "x.png").exists()


OUTPUTS = {
    "x": "a picture's name ends in .png, .jpg, .exr or another image format",
    "x.burnish": "a picture's name ends in .png, .jpg, .exr or another image format",
    "folder.png": "it is a folder",
    "whole.png/x.png": "`whole.png` is a file, not a folder",
    "whole.png/deep/x.png": "`{folder}/whole.png` is a file, not a folder",
    f"{'long' * 70}.png": "File name too long",
}


@pytest.mark.parametrize(("output", "reason"), OUTPUTS.items(), ids=[name[:20] for name in OUTPUTS])
def test_outputs(output: str, reason: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Known before anything is compiled or drawn."""
    monkeypatch.setattr(Runner, "__init__", None)
    Path("folder.png").mkdir()
    before = tree(folder)
    result = invoke("render", "m.burnish", "-o", output)
    assert result.exit_code == 1
    assert result.stderr == f"error: cannot write `{output}`: {reason.format(folder=folder)}\n"
    assert tree(folder) == before


@pytest.mark.usefixtures("folder")
def test_a_place_that_may_not_be_written_to(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.access", lambda _, mode: not mode & os.W_OK)
    result = invoke("render", "m.burnish", "-o", "x.png")
    assert result.stderr == (
        "error: cannot write `x.png`: nobody but its owner may write into `.`\n"
    )
    assert result.exit_code == 1


def test_folders_are_made(folder: Path) -> None:
    assert invoke("render", "m.burnish", "-o", "new/deep/x.PNG", "--size", 4).exit_code == 0
    assert {"new/deep", "new/deep/x.PNG"} <= tree(folder)


def test_a_full_disk_leaves_the_old_picture_alone(folder: Path) -> None:
    Path("x.png").write_text("old")
    before = tree(folder)
    limited = 'ulimit -f 1; exec "$0" -m burnish render m.burnish -o x.png --size 64'
    ended = run(["sh", "-c", limited, sys.executable])
    assert (ended.returncode, ended.stderr) == (1, "error: cannot write `x.png`: File too large\n")
    assert tree(folder) == before
    assert Path("x.png").read_text() == "old"


@pytest.mark.usefixtures("folder")
def test_missing_values() -> None:
    """All are named at once, and how to set them."""
    Path("m.burnish").write_text(
        "struct Coat { tint : rgb }\n"
        "material Wave { param time : float per frame /// Seconds\nparam coats : Coat[2]\n"
        "color = coats[1].tint * time }\n"
        "material Sea { param water : rgb color = water }\n"
    )
    result = invoke("render", "m.burnish", "-o", "x.png", "--set", "coats[0].tint=0,0,0")
    assert result.exit_code == 1
    assert result.stderr == (
        "error: Wave needs values for\n"
        "  `time` : float   Seconds\n"
        "  `coats[1].tint` : rgb\n"
        "  Sea needs values for\n"
        "    `water` : rgb\n"
        "  = help: set each of them: --set 'time=…'\n"
    )
    assert not Path("x.png").exists()


@pytest.mark.usefixtures("folder")
def test_a_value_that_only_one_material_has() -> None:
    Path("m.burnish").write_text(
        "material A { param warm : float = 0 color = vec3(warm) }\nmaterial B { }"
    )
    assert (
        invoke("render", "m.burnish", "-o", "x.png", "--size", 4, "--set", "warm=1").exit_code == 0
    )
    result = invoke("render", "m.burnish", "-o", "x.png", "--set", "wrm=1")
    assert result.stderr == "error: there is no parameter `wrm`: did you mean `warm`?\n"


def test_a_pass_that_captures_has_no_picture(folder: Path) -> None:
    Path("c.burnish").write_text(
        "material A { }\npass Moved { capture position : vec3 = position }"
    )
    before = tree(folder)
    result = invoke("render", "c.burnish", "--pass", "Moved", "-o", "x.png", "--size", 4)
    assert (result.exit_code, result.stderr) == (
        1, "error: A captures vertices, so its pass draws nothing: `burnish conform` runs it\n",
    )  # fmt: skip
    assert tree(folder) == before


LACKING = (
    "nothing is drawn by llvmpipe:gl330, llvmpipe:gl450, llvmpipe:es310: "
    "llvmpipe is missing; to install it: apt-get install -y --no-install-recommends "
    "libegl1 libegl-mesa0 libgl1-mesa-dri; "
    "moderngl, numpy, pillow are missing; to install them: "
    f"{sys.executable} -m pip install 'burnish[run]'\n"
)


@pytest.mark.usefixtures("no_tools")
def test_a_route_without_its_tools(folder: Path) -> None:
    before = tree(folder)
    result = invoke("render", "m.burnish", "-o", "x.png", "--on", "reference,llvmpipe")
    assert (result.exit_code, result.stderr) == (1, f"error: {LACKING}")
    assert tree(folder) == before


@pytest.mark.usefixtures("no_tools", "folder")
def test_all_routes_without_their_tools() -> None:
    """The reference still draws, and the others are told of."""
    result = invoke("render", "m.burnish", "-o", "x.png", "--on", "all", "--size", 4)
    assert result.exit_code == 0
    assert f"note: {LACKING}" in result.stderr
    for route in routes.ROUTES:
        assert route in result.stderr
    assert Image.open("x.png").width == 4 * (128 + 16) + 16


CRASHES = {
    "import os; os.kill(os.getpid(), 9)": "crashed: killed by signal 9 (Killed)",
    "import sys; sys.exit('out of luck')": ("crashed: out of luck\n  ended with exit code 1"),
    "import time; time.sleep(100)": "timeout: no answer within 0.5 s",
}


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(("deed", "said"), CRASHES.items(), ids=["killed", "ended", "hanging"])
def test_a_driver_that_breaks_down(deed: str, said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Ends a command for one picture, and is a panel of a sheet of several."""
    assert Runner.__init__.__kwdefaults__ is not None
    monkeypatch.setitem(Runner.__init__.__kwdefaults__, "time_limit", 0.5)
    worker = [sys.executable, "-c", deed]
    monkeypatch.setattr(routes.DriverRow, "command", lambda *_: worker)
    result = invoke("render", "m.burnish", "-o", "x.png", "--on", "llvmpipe:gl330")
    assert result.exit_code == 1
    assert result.stderr == f"error: llvmpipe {said}\n"
    assert not Path("x.png").exists()

    sheet = ("-o", "sheet.png", "--on", "reference,llvmpipe:gl330", "--size", 4)
    result = invoke("render", "m.burnish", *sheet)
    assert result.exit_code == 1
    assert result.stderr == f"error: Whole, llvmpipe:gl330: llvmpipe {said}\n"
    assert Path("sheet.png").exists()


FLOATS = ".exr and .hdr files need OpenImageIO"


@pytest.mark.parametrize(
    ("module", "lack", "command"),
    [
        ("numpy", "drawing and the corpus need NumPy", "render m.burnish -o x.png"),
        ("numpy", "drawing and the corpus need NumPy", "conform m.burnish"),
        ("numpy", "drawing and the corpus need NumPy", "corpus -o x"),
        ("PIL", "drawing needs Pillow", "render m.burnish -o x.png"),
        ("OpenImageIO", FLOATS, "render m.burnish -o x.exr"),
        ("OpenImageIO", FLOATS, "render m.burnish -o x.png --set paint=light.hdr"),
    ],
)
def test_missing_packages(module: str, lack: str, command: str, folder: Path) -> None:
    """Pillow only where a picture is read or written, OpenImageIO only for those of floats."""
    Path("light.hdr").write_bytes(b"#?RADIANCE\n")
    before = tree(folder)
    run = without(module, *command.split())
    assert (run.returncode, run.stdout) == (1, "")
    extra = "scenes" if lack == FLOATS else "run" if command.startswith("conform") else "render"
    assert run.stderr == (
        f"error: {lack}, which is not installed: "
        f"{sys.executable} -m pip install 'burnish[{extra}]'\n"
    )
    assert tree(folder) == before
    assert without(module, "compile", "m.burnish", "-o", "out").returncode == 0


def without(module: str, *arguments: str) -> CompletedProcess[str]:
    """A command where a package is not installed."""
    code = (
        f"import sys; sys.modules[{module!r}] = None; from burnish.commands.cli import main; main()"
    )
    return run([sys.executable, "-c", code, *arguments])


def test_two_at_once(folder: Path) -> None:
    """The picture in the end is one of the two, and nothing else lies there."""
    before = tree(folder)
    command = [sys.executable, "-m", "burnish", "render", "m.burnish", "-o", "x.png", "--size"]
    done = at_once([partial(run, [*command, size]) for size in ("8", "9")])
    assert [each.returncode for each in done] == [0, 0]
    assert tree(folder) == before | {"x.png"}
    assert Image.open("x.png").size in {(8, 8), (9, 9)}


def test_a_process_says_the_same(folder: Path) -> None:
    run = shell("render", "m.burnish", "-o", "x.png", "--set", "powr=1", folder=folder)
    assert (run.returncode, run.stdout) == (1, "")
    assert run.stderr == "error: there is no parameter `powr`: did you mean `power`?\n"


@pytest.mark.usefixtures("folder")
def test_too_little_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr("burnish.targets.runner.frames.by_reference.ReferenceFrames.draw", fail)
    result = invoke("render", "m.burnish", "-o", "x.png")
    assert result.exit_code == 1
    assert result.stderr == (
        "error: there is not enough memory to draw this: a smaller picture may do\n"
    )
