"""The camera, the scene and the surroundings that ``burnish render`` is asked for."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from burnish.commands import developing
from burnish.commands.developing import Development
from burnish.commands.options import TONES

from ..library.functions import values
from ..scenes.kit import triangle
from .kit import invoke, tree
from .test_render import draw, middle

FACING = "material Facing { color = 0.5 + 0.5 * normal }\n"
"""Shows where a ball is seen from: the colour in the middle is the direction to the eye."""
MIRROR = """\
material Mirror {
    map around : texture_cube = black
    color = around(normal).rgb
}
"""
EVERYWHERE = "import std.terms.{ambient}\nmaterial Matt { color = ambient(vec3(1)) }\n"


def seen_from(*options: object, folder: Path) -> list[float]:
    """The direction from the ball to the eye, each lane as -1, 0 or 1."""
    linear = (np.array(middle(draw(FACING, folder, *options, size=15))) / 255) ** 2.2
    return [float(lane) for lane in np.rint(2 * linear - 1) + 0.0]


@pytest.mark.parametrize(
    ("options", "direction"),
    [
        (("--eye", "0,0,4"), [0, 0, 1]),
        (("--eye", "-3,0,0"), [-1, 0, 0]),
        (("--eye", "0,50,0"), [0, 1, 0]),
        (("--set", "eye=0,-3,0"), [0, -1, 0]),
        (("--eye", "0,0,4", "--turn", "90"), [1, 0, 0]),
        (("--eye", "0,0,4", "--turn", "-90deg"), [-1, 0, 0]),
        (("--eye", "0,0,4", "--turn", "0,200"), [0, 1, 0]),
        (("--eye", "9,0,4", "--look-at", "9,0,0"), None),
    ],
)
def test_the_ball_is_seen_from_where_the_camera_is(
    options: tuple[str, ...], direction: list[float] | None, tmp_path: Path
) -> None:
    if direction is None:
        found = draw(FACING, tmp_path, *options, size=15)
        assert middle(found) == (0x1B, 0x1D, 0x21), "it looks past the ball"
    else:
        assert seen_from(*options, folder=tmp_path) == direction


@pytest.mark.parametrize(
    ("options", "code", "said"),
    [
        (("--eye", "1,2"), 2, "'1,2' is no point, which would be like 0,1.5,4"),
        (("--eye", "1,nan,2"), 2, "'1,nan,2' is no point"),
        (("--look-at", "0,0,1e30"), 2, "'0,0,1e30' is no point"),
        (("--exposure", "nan"), 2, "'nan' is no number of stops, which would be like 1.5"),
        (("--exposure", "inf"), 2, "inf is not in the range"),
        (("--tone", "nope"), 2, "'nope' is not one of 'none', 'reinhard'"),
        (("--turn", "1,2,3"), 2, "'1,2,3' is no angle in degrees, which would be like 30 or 30,10"),
        (("--turn", "much"), 2, "'much' is no angle"),
        (("--eye", "1,1,1", "--look-at", "1,1,1"), 1,
         "error: the camera is at the place that it looks at: move one of them"),
        (("--environment", "nowhere.hdr"), 1, "nowhere.hdr"),
    ],
)  # fmt: skip
def test_impossible_wishes(options: tuple[str, ...], code: int, said: str, tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text(FACING)
    result = invoke("render", tmp_path / "m.burnish", "-o", tmp_path / "m.png", *options)
    assert result.exit_code == code
    assert said in result.stderr
    assert tree(tmp_path) == {"m.burnish"}


def test_a_floor_lies_and_is_seen_from_above(tmp_path: Path) -> None:
    found = draw(FACING, tmp_path, "--mesh", "floor", size=15)
    assert middle(found) == (188, 255, 188)


def test_the_picture_is_called_like_the_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "glow.burnish").write_text(FACING)
    monkeypatch.chdir(tmp_path)
    result = invoke("render", "glow.burnish", "--size", 4)
    assert (result.exit_code, result.stdout) == (0, "Facing: glow.png\n")
    assert tree(tmp_path) == {"glow.burnish", "glow.png"}


def test_a_material_draws_the_objects_of_a_file(tmp_path: Path) -> None:
    scene = triangle().save(tmp_path)
    place = ("--eye", "0.3,0.3,3", "--look-at", "0.3,0.3,0")
    found = draw(FACING, tmp_path, "--scene", scene, *place, size=15)
    assert middle(found) == (188, 188, 255)


def test_cube_maps_show_a_studio_unless_they_are_set(tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text(MIRROR)
    words = ("render", tmp_path / "m.burnish", "-o", tmp_path / "m.png", "--size", 15)
    shown = {}
    for asked in ("studio", "sky", "none"):
        result = invoke(*words, "--environment", asked)
        assert result.exit_code == 0
        shown[asked] = (tmp_path / "m.png").read_bytes()
        assert ("`around` is a small studio" in result.stderr) == (asked == "studio")
    assert len(set(shown.values())) == 3
    result = invoke(*words, "--set", "around=#000000")
    assert result.stderr == ""
    assert (tmp_path / "m.png").read_bytes() == shown["none"]


def test_arrays_of_cube_maps_show_it_in_their_only_layer(tmp_path: Path) -> None:
    array = MIRROR.replace("texture_cube", "texture_cube_array")
    (tmp_path / "m.burnish").write_text(array.replace("around(normal)", "around(normal, 3)"))
    (tmp_path / "one.burnish").write_text(MIRROR)
    for name in ("m", "one"):
        words = ("render", tmp_path / f"{name}.burnish", "-o", tmp_path / f"{name}.png")
        assert "`around` is a small studio" in invoke(*words, "--size", 15).stderr
    assert (tmp_path / "m.png").read_bytes() == (tmp_path / "one.png").read_bytes()


def test_light_from_everywhere_is_the_mean_of_the_studio(tmp_path: Path) -> None:
    """And 0.1, as the library declares it, without one."""
    assert middle(draw(EVERYWHERE, tmp_path)) == (148, 147, 146)
    assert middle(draw(EVERYWHERE, tmp_path, "--environment", "none")) == (89, 89, 89)
    assert middle(draw(EVERYWHERE, tmp_path, "--set", "ambient_light=0,1,0")) == (0, 255, 0)


@pytest.mark.parametrize(
    ("color", "options", "shown"),
    [
        ("vec3(0.25)", ("--exposure", 1), 188),
        ("vec3(2)", ("--exposure", -2), 188),
        ("vec3(2)", (), 255),
        ("vec3(1)", ("--tone", "reinhard"), 188),
        ("vec3(1)", ("--tone", "aces_narkowicz"), 232),
        ("vec3(0.5)", ("--tone", "reinhard", "--exposure", 1), 188),
    ],
)
def test_exposure_and_tone_mapping(
    color: str, options: tuple[object, ...], shown: int, tmp_path: Path
) -> None:
    """188 is half of the light in sRGB; the short fit to ACES at 1 is 2.54 / 3.16."""
    found = draw(f"material Even {{ color = {color} }}", tmp_path, *options)
    assert middle(found) == (shown, shown, shown)


@pytest.mark.parametrize("tone", TONES)
def test_tone_mappings_are_those_of_the_library(tone: str) -> None:
    """Also of a picture that is developed in parts, and of more light than float32 holds."""
    light = np.array([[[0.18, 0.18, 0.18], [2, 1, 0.5]], [[0, 9, 40], [1e300, 3, -1]]])
    curve = "saturate(c)" if tone == "none" else f"{tone}(c)"
    for stops in (0, 1):
        found = Development(stops, tone).applied(light)
        bounded = np.clip(light * 2**stops, 0, 3e38).reshape(4, 3)
        assert found.reshape(4, 3) == pytest.approx(values("tone_mapping", curve, c=bounded))


def test_large_pictures_are_developed_in_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(developing, "_MOST_TEXELS", 4)
    light = np.arange(30.0).reshape(5, 2, 3) / 30
    assert Development(1, "reinhard").applied(light) == pytest.approx(2 * light / (1 + 2 * light))


def test_a_material_stands_on_a_floor(tmp_path: Path) -> None:
    """Lit at the left of the ball, and in its shadow at the right, by every route alike."""
    text = "material Even { param base : rgb = #ffffff  color = base }"
    reference, drawn = (
        draw(text, tmp_path, "--floor", "--on", route, "--set", "base=#00ff00", size=64)
        for route in ("reference", "lavapipe:glsl")
    )
    assert tuple(reference[32, 32]) == (0, 255, 0)
    lit, shadowed = reference[58, 10], reference[44, 55]
    assert tuple(lit) == (124, 124, 124)
    assert tuple(shadowed) == (63, 63, 63)
    assert (np.abs(reference - drawn).max(axis=2) > 1).mean() < 0.02  # Edges of faces.


def test_passes_of_a_file_are_not_used_on_a_floor(tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text(
        "material M { color = vec3(1) }\npass Cut : Forward { discard when true }"
    )
    result = invoke("render", tmp_path / "m.burnish", "-o", tmp_path / "m.png", "--floor",
                    "--size", 16)  # fmt: skip
    assert result.exit_code == 0
    assert result.stderr == "note: on a floor, materials are drawn by Forward, and not by Cut\n"


def test_kernels_of_a_file_do_not_run_on_a_floor(tmp_path: Path) -> None:
    """Its materials are drawn all the same, with buffers that have no elements."""
    text = """
        kernel Made { result lamps : vec3[2] = vec3(float(index)) }
        material M { buffer lamps : vec3[]  color = lamps[0] }
    """
    (tmp_path / "m.burnish").write_text(text)
    result = invoke("render", tmp_path / "m.burnish", "-o", tmp_path / "m.png", "--floor",
                    "--size", 8)  # fmt: skip
    said = "note: on a floor, no kernels run, so buffers have nothing of Made\n"
    assert (result.exit_code, result.stderr) == (0, said)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("kernel Made { result lamps : vec3[2] = vec3(float(index)) }",
         "--floor is for the mesh of a material: a frame, a kernel or a scene has none"),
        ("kernel K { map a : texture2d  result b : image2d<rgba8>[a.size()] = a.load(texel) }",
         "--floor is for the mesh of a material: a frame, a kernel or a scene has none"),
        ("fn share_lit(x: float) -> float = x\nmaterial M { color = vec3(share_lit(uv.x)) }",
         "M cannot stand on a floor, whose frame does not fit its file: "
         "`share_lit` takes 1 argument, found 5"),
    ],
    ids=["a kernel over buffers", "a kernel", "a name of the frame"],
)  # fmt: skip
def test_what_cannot_stand_on_a_floor(text: str, said: str, tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text(text)
    result = invoke("render", tmp_path / "m.burnish", "-o", tmp_path / "m.png", "--floor")
    assert (result.exit_code, result.stderr) == (1, f"error: {said}\n")
    assert not (tmp_path / "m.png").exists()
