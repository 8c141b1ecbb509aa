"""``burnish render``: what is on the picture, and how its values are set."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from burnish import Texture
from burnish.commands.options import MESHES

from .kit import invoke, shell, tree

Pixels = NDArray[np.uint8]

FLAT = """\
struct Coat {
    tint  : rgb
    gloss : float
    on    : bool
}

material Flat {
    param number  : float in 0..8 = 0
    param whole   : int in 0..8 = 0
    param yes     : bool = false
    param turn    : angle = 0deg
    param tint    : rgb = #000000
    param glass   : rgba = #00000000
    param pair    : vec2 = vec2(0)
    param frame   : mat2 = mat2(0)
    param weights : float[2]
    param coats   : Coat[2]
    map   paint   : texture2d = black

    chosen = if coats[1].on then coats[1].tint * coats[1].gloss else vec3(0)
    color  = vec3(number, float(whole), if yes then 1 else 0) + vec3(turn, 0, 0) + tint + glass.rgb
        + vec3(pair, 0) + vec3(frame[0][1], frame[1][0], 0) + vec3(weights[0], 0, weights[1])
        + chosen + paint(uv).rgb
}
"""
NOTHING = ("weights=0,0", "coats[0].tint=0,0,0", "coats[0].gloss=0", "coats[0].on=false",
           "coats[1].tint=0,0,0", "coats[1].gloss=0", "coats[1].on=0")  # fmt: skip


def pixels(path: Path) -> Pixels:
    """(height, width, 3)."""
    return np.asarray(Image.open(path).convert("RGB"))


def draw(text: str, folder: Path, *arguments: object, size: object = 16) -> Pixels:
    """The picture of a file's text."""
    (folder / "m.burnish").write_text(text)
    picture = folder / "m.png"
    result = invoke("render", folder / "m.burnish", "-o", picture, "--size", size, *arguments)
    assert (result.exit_code, result.stderr) == (0, "")
    return pixels(picture)


def middle(picture: Pixels) -> tuple[int, ...]:
    """The colour in the middle."""
    height, width, _ = picture.shape
    return tuple(picture[height // 2, width // 2].tolist())


def test_a_picture(tmp_path: Path) -> None:
    picture = draw("material Plain { color = #ff8000 }", tmp_path)
    assert picture.shape == (16, 16, 3)
    assert middle(picture) == (255, 128, 0)
    assert tuple(picture[0, 0]) == (0x1B, 0x1D, 0x21)
    assert tree(tmp_path) == {"m.burnish", "m.png"}


@pytest.mark.parametrize(("size", "shape"), [("1", (1, 1)), ("24x10", (10, 24))])
def test_size_and_background(size: str, shape: tuple[int, int], tmp_path: Path) -> None:
    text = "material Far { position = vec3(9) color = #ffffff }"
    picture = draw(text, tmp_path, "--background", "#0a6", size=size)
    assert picture.shape == (*shape, 3)
    assert (picture == (0x00, 0xAA, 0x66)).all()


@pytest.mark.parametrize("mesh", MESHES)
def test_meshes(mesh: str, tmp_path: Path) -> None:
    text = "material Ghost { color = if front_facing then #ffffff else #ff0000 }"
    picture = draw(text, tmp_path, "--mesh", mesh, "--background", "#000")
    covered = (picture == 255).all(axis=2).mean()
    assert 0.15 < covered < 0.85
    assert not (picture == (255, 0, 0)).all(axis=2).any(), "what is seen is the outside"


@pytest.mark.parametrize(
    ("values", "wanted"),
    [
        ("number=1", (255, 0, 0)),
        ("number= 0.5 ", (188, 0, 0)),
        ("whole=1", (0, 255, 0)),
        ("yes=true", (0, 0, 255)),
        ("turn=30deg", (191, 0, 0)),
        ("turn=0.5rad", (188, 0, 0)),
        ("tint=#ff8000", (255, 128, 0)),
        ("tint=#f80", (255, 136, 0)),
        ("tint=1,0.5,0", (255, 188, 0)),
        ("tint=(1, 0.5, 0)", (255, 188, 0)),
        ("glass=#ff800080", (255, 128, 0)),
        ("pair=0 1", (0, 255, 0)),
        ("frame=0,1,0.5,0", (255, 188, 0)),
        ("weights=1,0.5", (255, 0, 188)),
        ("weights[1]=0.5", (0, 0, 188)),
        ("coats[1].tint=#ff8000 coats[1].gloss=1 coats[1].on=true", (255, 128, 0)),
        ("paint=#ff8000", (255, 128, 0)),
        ("paint=half.png", (128, 0, 0)),
        ("paint=linear:half.png", (188, 0, 0)),
        ("paint=srgb:half.png", (128, 0, 0)),
    ],
)
def test_values(
    values: str, wanted: tuple[int, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Image.new("RGB", (4, 4), (128, 0, 0)).save("half.png")
    given = [values] if "=" not in values.partition(" ")[2] else values.split()
    names = {value.partition("=")[0] for value in given}
    others = [value for value in NOTHING if value.partition("=")[0] not in names]
    options = [word for value in (*others, *given) for word in ("--set", value)]
    assert middle(draw(FLAT, tmp_path, *options)) == pytest.approx(wanted, abs=1)


LAMPS = """\
import std.lights.{Point}
import std.terms.{lambert}
material Wall { color = lambert(vec3(1)) }
rig Street { lamps : Point[<= 4] }
"""


def test_lights(tmp_path: Path) -> None:
    """More of them than the scene lets shine have their places, too."""
    dark = draw(LAMPS, tmp_path, "--set", "lamps.count=0")
    some = draw(LAMPS, tmp_path)
    every = draw(LAMPS, tmp_path, "--set", "lamps.count=4")
    assert middle(dark) == (0, 0, 0)
    assert (every >= some).all()
    assert (every > some).any()
    red = draw(LAMPS, tmp_path, "--set", "lamps.count=1", "--set", "lamps[0].diffuse_color=1,0,0")
    assert middle(red)[0] > 0 == middle(red)[1]


SEVERAL = (
    "material Red { param k : float = 1 color = vec3(k, 0, 0) }\nmaterial Blue { color = #0000ff }"
)


def test_several_materials_make_a_sheet(tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text(SEVERAL)
    result = invoke(
        "render", tmp_path / "m.burnish", "-o", tmp_path / "m.png", "--size", 128, "--set", "k=0.5"
    )
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout == f"Red; Blue: {tmp_path / 'm.png'}\n"
    sheet = pixels(tmp_path / "m.png")
    assert tuple(sheet[16 + 64, 16 + 64]) == (188, 0, 0)
    assert tuple(sheet[16 + 64, 16 + 128 + 16 + 64]) == (0, 0, 255)
    picture = draw(SEVERAL, tmp_path, "--material", "Blue")
    assert middle(picture) == (0, 0, 255)


RIGS = """\
import std.lights.{Directional}
import std.terms.{lambert}
material Wall { color = lambert(vec3(1)) }
rig Day { sun : Directional { direction = vec3(0, 0, -1) } }
rig Dusk { sun : Directional { direction = vec3(0, 0, 1) } }
"""


def test_several_rigs_make_a_sheet(tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text(RIGS)
    result = invoke("render", tmp_path / "m.burnish", "-o", tmp_path / "m.png", "--size", 128)
    assert result.stdout == f"Wall, rig Day; Wall, rig Dusk: {tmp_path / 'm.png'}\n"
    sheet = pixels(tmp_path / "m.png")
    assert sheet[16 + 64, 16 + 64].min() > 200
    assert sheet[16 + 64, 16 + 128 + 16 + 64].max() == 0
    assert draw(RIGS, tmp_path, "--rig", "Dusk").shape == (16, 16, 3)


PASSES = """\
material Half { color = #ffffff alpha = 0.5 }
pass Mist : Forward blend alpha { }
pass Holes : Forward { discard when frag_coord.x < 8 }
pass Buffers {
    clip_position = view_projection * vec4(position, 1)
    target shown : rgba8 = vec4(material.color, 1)
    target depth : r32f = 0.5
}
"""


def test_blending_is_from_back_to_front(tmp_path: Path) -> None:
    """Front and back of the sphere are seen everywhere, as they are where nothing hides them."""
    picture = draw(PASSES, tmp_path, "--pass", "Mist", "--background", "#000", size=48)
    inside = picture[(picture > 0).all(axis=2)]
    assert len(inside) > 1000
    assert set(inside[:, 0].tolist()) == {225}, "0.75 of white light"


def test_discard(tmp_path: Path) -> None:
    picture = draw(PASSES, tmp_path, "--pass", "Holes")
    assert (picture[:, :8] == (0x1B, 0x1D, 0x21)).all()
    assert middle(picture) == (255, 255, 255)


def test_a_target_of_one_lane_is_grey(tmp_path: Path) -> None:
    first = draw(PASSES, tmp_path, "--pass", "Buffers")
    assert middle(first) == (255, 255, 255)
    depth = draw(PASSES, tmp_path, "--pass", "Buffers", "--target", "depth")
    assert middle(depth) == (188, 188, 188)


def test_what_no_mesh_has_is_made_up_and_told(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text("material Brushed { attribute groove : float color = vec3(groove, 0.5, 0) }")
    result = invoke("render", file, "-o", tmp_path / "m.png", "--size", 16)
    assert result.exit_code == 0
    assert result.stderr == (
        "note: no mesh here has `groove`: Brushed is drawn with smooth waves in place of them\n"
    )
    assert middle(pixels(tmp_path / "m.png"))[1:] == (188, 0)


UP = "material Up { color = 0.5 + 0.5 * normal }"


def test_routes_side_by_side(tmp_path: Path) -> None:
    sheet = draw(UP, tmp_path, "--on", "llvmpipe:gl330,reference", size=128).astype(int)
    reference, drawn = sheet[16:144, 16:144], sheet[16:144, 160:288]
    assert np.abs(drawn - reference).max() <= 1
    assert reference[20, 64, 1] > reference[108, 64, 1], "the normal points up at the top"


def test_routes_whose_profile_lacks_something(tmp_path: Path) -> None:
    """With ``all``, the routes that can draw do so; a route that is named must be able to."""
    file = tmp_path / "m.burnish"
    file.write_text("material Four { map t : texture2d  color = t.gather(uv, 0).rgb }")
    result = invoke("render", file, "-o", tmp_path / "m.png", "--size", 8, "--on", "all")
    assert result.exit_code == 0
    told = "note: Four is not drawn by llvmpipe:gl330: glsl:gl330 has no gathering of texels\n"
    assert told in result.stderr and (tmp_path / "m.png").exists()
    result = invoke("render", file, "-o", tmp_path / "n.png", "--on", "llvmpipe:gl330")
    assert result.exit_code == 1 and result.stderr.startswith("error[B0701]: glsl:gl330 has no")


@pytest.mark.parametrize("route", ["lavapipe:glsl", "llvmpipe:gl330", "chromium:webgl2"])
def test_one_route(route: str, tmp_path: Path) -> None:
    reference = draw(UP, tmp_path, size=32).astype(int)
    assert np.abs(draw(UP, tmp_path, "--on", route, size=32) - reference).max() <= 1


def test_instances(tmp_path: Path) -> None:
    """There are as many instances as are asked for, each in a place of its own."""
    text = (
        "import std.instancing.{Instanced}\n"
        "material Stones : Surface + Instanced { color = vec3(1)  view_projection = look }\n"
        "look = mat4(vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, 0.4, 0), vec4(0, 0, 0.5, 1))\n"
    )
    covered = [
        int((draw(text, tmp_path, "--instances", count, "--background", "#000", size=64) > 0).sum())
        for count in (1, 2, 3)
    ]
    assert covered[0] < covered[1] < covered[2]


PLACES = """\
kernel Places {
    param width : int in 0..5000 = 6
    map   given : texture2d
    blue = given.load(texel).b
    result places : image2d<rgba8>[ivec2(width, 4)]   = vec4(vec2(texel) / 10, blue, 1)
    result fives  : image2d<rgba16f>[ivec2(width, 4)] = vec4(0.5)
}
"""
CHART = "note: `given` of Places is a test chart: --set given=PICTURE sets another\n"


def test_the_first_image_of_a_kernel_is_shown_in_its_own_size(tmp_path: Path) -> None:
    seen = draw(PLACES, tmp_path, "--set", "given=#0000ff", "--set", "width=8", size=64)
    assert seen.shape == (4, 8, 3)
    assert (seen[0, 0] == (0, 0, 255)).all()
    assert (np.diff(seen[:, :, 0].astype(int), axis=1) > 0).all()
    assert (np.diff(seen[:, :, 1].astype(int), axis=0) > 0).all()


def test_another_image_of_a_kernel_is_named(tmp_path: Path) -> None:
    seen = draw(PLACES, tmp_path, "--set", "given=#0000ff", "--target", "fives")
    assert (seen == seen[0, 0]).all() and 0 < seen[0, 0, 0] < 255


SHADOWED = """\
import std.shadows.{ShadowedSpot}
import std.terms.{lambert}
material Clay { color = lambert(#b5651d) }
rig Street { left : ShadowedSpot, right : ShadowedSpot }
"""
UNMADE = (
    "note: `left.shadow` is made by steps of its light, which only a frame draws; here it is "
    "`far`: --set left.shadow=PICTURE sets another\n"
)


def test_a_shadow_map_that_nobody_makes_is_told(tmp_path: Path) -> None:
    """A user who compiles for a host gets no note, as the host binds the map."""
    (tmp_path / "m.burnish").write_text(SHADOWED)
    render = ("render", tmp_path / "m.burnish", "-o", tmp_path / "m.png", "--size", "8")
    result = invoke(*render)
    assert (result.exit_code, result.stderr) == (0, UNMADE + UNMADE.replace("left", "right"))
    Image.new("L", (2, 2), 64).save(tmp_path / "near.png")
    given = (f"--set={name}.shadow={tmp_path / 'near.png'}" for name in ("left", "right"))
    assert invoke(*render, *given).stderr == ""
    compiled = invoke("compile", tmp_path / "m.burnish", "-o", tmp_path / "out")
    assert (compiled.exit_code, compiled.stderr) == (0, "")


def test_a_kernel_that_needs_a_picture_gets_a_chart(tmp_path: Path) -> None:
    image = "result i : image2d<rgba8>[given.size()] = given.load(texel)"
    (tmp_path / "k.burnish").write_text(f"kernel K {{ map given : texture2d  {image} }}")
    result = invoke("render", tmp_path / "k.burnish", "-o", tmp_path / "k.png", "--size", "48x32")
    assert (result.exit_code, result.stderr) == (0, CHART.replace("Places", "K"))
    seen = pixels(tmp_path / "k.png")
    assert seen.shape == (32, 48, 3)
    assert len(np.unique(seen.reshape(-1, 3), axis=0)) > 50


@pytest.mark.parametrize(
    ("width", "told"),
    [
        (0, "the images of Places have 0 x 4 texels: set what tells their size"),
        (5000, "the images of Places have 5000 x 4 texels: a side has 4096 at most"),
    ],
)
def test_images_without_texels_or_with_too_many_are_refused(
    tmp_path: Path, width: int, told: str
) -> None:
    (tmp_path / "k.burnish").write_text(PLACES)
    result = invoke(
        "render", tmp_path / "k.burnish", "-o", tmp_path / "k.png", "--set", f"width={width}"
    )
    assert (result.exit_code, result.stderr) == (1, f"{CHART}error: {told}\n")


def test_native_stages(tmp_path: Path) -> None:
    """Routes draw with a geometry stage what they draw without one."""
    source = tmp_path / "s.burnish"
    source.write_text("""
        material Sprites {
            expand point {
                strip of 4 as i {
                    position = corner[0].position + 0.1 * vec3(float(i mod 2), float(i / 2), 0)
                }
            }
        }
    """)
    pictures = []
    for options in (["--native-stages"], []):
        output = tmp_path / f"{len(options)}.png"
        invoke(
            "render", str(source), "-o", str(output), "--on", "lavapipe:glsl", "--size", "48",
            *options,
        )  # fmt: skip
        pictures.append(output.read_bytes())
    assert pictures[0] == pictures[1]
    refused = invoke("render", str(source), "-o", str(tmp_path / "r.png"), "--native-stages")
    assert refused.exit_code == 2
    assert "--native-stages is for routes" in refused.stderr


def test_numbers_instead_of_colours(tmp_path: Path) -> None:
    """Lights brighter than white, and numbers below zero, as the material computed them."""
    (tmp_path / "m.burnish").write_text("material Bright { color = vec3(12, 0.25, -1) }")
    whole = tmp_path / "m.exr"
    result = invoke("render", tmp_path / "m.burnish", "-o", whole, "--size", 16)
    assert (result.exit_code, result.stderr) == (0, "")
    assert Texture.load(whole).linear()[0][8, 8].tolist() == [12, 0.25, -1, 1]

    given = f"paint={whole}"
    picture = draw("material M { map paint : texture2d color = paint(vec2(0.5)).rgb / 12 }",
                   tmp_path, "--set", given)  # fmt: skip
    assert middle(picture) == (255, 40, 0)


def test_nothing_is_said_at_the_end_of_a_process_that_has_written_numbers(tmp_path: Path) -> None:
    """OpenImageIO lists what is left of its objects then, if there are any."""
    (tmp_path / "m.burnish").write_text("material Bright { color = vec3(12, 0.25, -1) }")
    result = shell("render", "m.burnish", "-o", "m.exr", "--size", 4, folder=tmp_path)
    assert (result.returncode, result.stderr) == (0, "")


def test_a_sheet_has_no_numbers(tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text("material A { }\nmaterial B { }")
    result = invoke("render", tmp_path / "m.burnish", "-o", "sheet.exr", "--size", 4)
    assert result.exit_code == 2
    assert "`sheet.exr` keeps the numbers of one picture, and there are 2" in result.stderr


def test_native_stages_that_reach_all_layers(tmp_path: Path) -> None:
    """One draw with a geometry stage, or one for each face of a cube: six faces of 16 pixels."""
    cube = Path(__file__).parents[2] / "examples" / "cube_map.burnish"
    words = ("render", cube, "--on", "lavapipe:glsl", "--size", 16, "-o")
    assert invoke(*words, tmp_path / "one.png", "--native-stages").exit_code == 0
    assert invoke(*words, tmp_path / "six.png").exit_code == 0
    one, six = (pixels(tmp_path / f"{name}.png") for name in ("one", "six"))
    assert one.shape == (6 * 16, 16, 3)
    assert (one == six).all()
    assert len(np.unique(six)) > 10
