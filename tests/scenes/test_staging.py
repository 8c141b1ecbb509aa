"""The pictures of a glTF file by ``burnish render --scene``, with its materials and lights."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import burnish
from burnish import Texture
from burnish.targets.runner.lamps import Lamp
from burnish.targets.runner.scene import Scene

from ..cli.kit import invoke
from .kit import Builder, triangle

FRAME = """\
import std.gltf.{MetallicRoughness, PunctualPoint}
import std.lights.{Directional}

/// Shows a colour as it is.
material Flat : MetallicRoughness {
    color = base.rgb
}
material Inverted : MetallicRoughness {
    color = 1 - base.rgb
}

frame Shown {
    models scene
    shown = Forward(scene)
    output picture = shown.color
}
"""
ONE = FRAME.replace("material Inverted : MetallicRoughness {\n    color = 1 - base.rgb\n}\n", "")


def squares(*looks: dict[str, object], camera: bool = True) -> Builder:
    """A row of squares of side 1, from left to right, each with a material of its own; seen by a
    camera that sees 4 units across and up."""
    made = Builder()
    place = made.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    for number, look in enumerate(looks):
        made.add("materials", **look)
        made.add("meshes", primitives=[
            {"attributes": {"POSITION": place}, "mode": 6, "material": number}
        ])  # fmt: skip
        made.add("nodes", mesh=number, translation=[number - 1, 0, 0])
    if camera:
        flat = {"xmag": 2, "ymag": 2, "znear": 0, "zfar": 10}
        made.add("cameras", type="orthographic", orthographic=flat)
        made.add("nodes", camera=0, translation=[0, 0, 5])
    made.whole["scenes"] = [{"nodes": list(range(len(made.whole["nodes"])))}]
    return made


def drawn(text: str, scene: Builder, folder: Path, *options: str) -> NDArray[np.float64]:
    """The picture of 16 x 16 pixels: a unit is four of them."""
    (folder / "m.burnish").write_text(text)
    picture = folder / "m.exr"
    result = invoke("render", folder / "m.burnish", "--scene", scene.save(folder), "-o", picture,
                    "--size", 16, *options)  # fmt: skip
    assert (result.exit_code, result.stderr) == (0, "")
    return Texture.load(picture).linear()[0].astype(np.float64)


def base(red: float, green: float, blue: float, name: str = "") -> dict[str, object]:
    """A material of a file."""
    look: dict[str, object] = {"baseColorFactor": [red, green, blue, 1]}
    return {"pbrMetallicRoughness": look, "name": name}


def test_each_object_has_its_own_numbers(tmp_path: Path) -> None:
    """Seen by the file's camera; a material's name does not matter if the frame has only one."""
    pixels = drawn(ONE, squares(base(1, 0.5, 0), base(0, 0.25, 1, "Any")), tmp_path)
    assert pixels[6, 5].tolist() == [1, 0.5, 0, 1]
    assert pixels[6, 9].tolist() == [0, 0.25, 1, 1]
    assert not pixels[6, 13].any()
    assert pixels[4:8, 4:12, 3].all()
    assert np.count_nonzero(pixels[..., 3]) == 32


def test_materials_are_found_by_their_names(tmp_path: Path) -> None:
    scene = squares(base(1, 0.5, 0, "Inverted"), base(0, 0.25, 1, "Flat"))
    pixels = drawn(FRAME, scene, tmp_path)
    assert pixels[6, 5].tolist() == [0, 0.5, 1, 1]
    assert pixels[6, 9].tolist() == [0, 0.25, 1, 1]


def test_what_the_command_line_sets_stays(tmp_path: Path) -> None:
    pixels = drawn(ONE, squares(base(1, 0.5, 0)), tmp_path, "--set", "base_color=0,0,1,1")
    assert pixels[6, 5].tolist() == [0, 0, 1, 1]


def test_tags_choose_what_is_drawn(tmp_path: Path) -> None:
    scene = squares(base(1, 1, 1), base(1, 1, 1))
    scene.whole["nodes"][1]["extras"] = {"tags": ["shiny"]}
    text = ONE.replace("models scene", "models shiny").replace("(scene)", "(shiny)")
    pixels = drawn(text, scene, tmp_path)
    assert not pixels[6, 5].any()
    assert pixels[6, 9].tolist() == [1, 1, 1, 1]


def test_without_a_camera_all_is_seen(tmp_path: Path) -> None:
    scene = squares(base(1, 0, 0), base(0, 1, 0), camera=False)
    for node in scene.whole["nodes"]:
        node["translation"][1] = 1000
    pixels = drawn(ONE, scene, tmp_path)
    assert (pixels[..., 0] == 1).any()
    assert (pixels[..., 1] == 1).any()
    edges = (pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1])
    assert not any(edge.any() for edge in edges)


MOVED = """\
import std.{module}
material Moved : Surface + {mixin} {{ color = #ffffff }}
frame Shown {{
    models scene
    shown = Forward(scene)
    output picture = shown.color
}}
"""


def test_bones_move_what_they_hold(tmp_path: Path) -> None:
    """The bones move the points to the joint, wherever the node of the mesh is."""
    scene = squares(base(1, 1, 1))
    primitive = scene.whole["meshes"][0]["primitives"][0]
    primitive["attributes"] |= {
        "JOINTS_0": scene.array([(0, 0, 0, 0)] * 4, "u1"),
        "WEIGHTS_0": scene.array([(1, 0, 0, 0)] * 4),
    }
    scene.whole["skins"] = [{"joints": [2]}]
    scene.whole["nodes"][0]["skin"] = 0
    scene.add("nodes", translation=[1, -2, 0])
    scene.whole["scenes"][0]["nodes"].append(2)
    text = MOVED.format(module="skinning.{Skinned}", mixin="Skinned")
    shown = drawn(text, scene, tmp_path)[..., 3] > 0
    assert np.argwhere(shown).min(axis=0).tolist() == [12, 12]
    assert np.count_nonzero(shown) == 16


def with_joints(count: int) -> Builder:
    """A square of which the last one of many joints moves all vertices."""
    scene = squares(base(1, 1, 1))
    primitive = scene.whole["meshes"][0]["primitives"][0]
    primitive["attributes"] |= {
        "JOINTS_0": scene.array([(count - 1, 0, 0, 0)] * 4, "u1"),
        "WEIGHTS_0": scene.array([(1, 0, 0, 0)] * 4),
    }
    first = len(scene.whole["nodes"])
    joints = [*range(first, first + count)]
    scene.whole["skins"] = [{"joints": joints}]
    scene.whole["nodes"][0]["skin"] = 0
    for joint in joints:
        scene.add("nodes", translation=[1, -2, 0] if joint == joints[-1] else [9, 9, 9])
    scene.whole["scenes"][0]["nodes"] += joints
    return scene


SKINNED = MOVED.format(module="skinning.{Skinned}", mixin="Skinned")
LONGER = SKINNED.replace("{ color", "{ param bones : mat4[150] per draw  color")


@pytest.mark.parametrize(("joints", "text"), [(100, SKINNED), (150, LONGER), (2, LONGER)])
def test_a_skin_may_have_many_joints(joints: int, text: str, tmp_path: Path) -> None:
    shown = drawn(text, with_joints(joints), tmp_path)[..., 3] > 0
    assert np.argwhere(shown).min(axis=0).tolist() == [12, 12]


def test_morph_targets_move_vertices(tmp_path: Path) -> None:
    scene = squares(base(1, 1, 1))
    mesh = scene.whole["meshes"][0]
    mesh["primitives"][0]["targets"] = [{"POSITION": scene.array([(4, 2, 0)] * 4)}]
    mesh["weights"] = [0.5]
    text = MOVED.format(module="morphing.{Morphed}", mixin="Morphed")
    shown = drawn(text, scene, tmp_path)[..., 3] > 0
    assert np.argwhere(shown).min(axis=0).tolist() == [0, 12]
    assert np.count_nonzero(shown) == 16


REFUSED = {
    "no such material": (
        FRAME, squares(base(1, 1, 1, "Brass")),
        "'node 0' has the material 'Brass' in the scene, and the frame draws Flat, Inverted: call "
        "one of them like it, or let there be only one",
    ),
    "no material": (
        FRAME, triangle(),
        "'node 0' has no material in the scene, and the frame draws Flat, Inverted: call one of "
        "them like it, or let there be only one",
    ),
    "no such tag": (
        ONE.replace("models scene", "models shiny").replace("(scene)", "(shiny)"), triangle(),
        "the frame draws `shiny`, and nothing has this tag: there are no tags",
    ),
    "more joints than bones": (
        SKINNED, with_joints(150),
        "`bones` has space for 128 bones, and the skin has 150: the material makes space by `param "
        "bones : mat4[150] per draw`",
    ),
    "nothing": (ONE, triangle(mode=1), "the scene has nothing to draw"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_scenes_that_do_not_fit(name: str, tmp_path: Path) -> None:
    text, scene, message = REFUSED[name]
    (tmp_path / "m.burnish").write_text(text)
    result = invoke("render", tmp_path / "m.burnish", "--scene", scene.save(tmp_path), "-o",
                    tmp_path / "x.png", "--size", 4)  # fmt: skip
    assert result.exit_code == 1
    assert result.stderr.splitlines()[-1] == f"error: {message}"
    assert not (tmp_path / "x.png").exists()


def test_broken_scenes(tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text(ONE)
    (tmp_path / "broken.glb").write_bytes(b"glTF")
    words = ("render", tmp_path / "m.burnish", "--scene", tmp_path / "broken.glb", "-o",
             tmp_path / "x.png", "--size", 4)  # fmt: skip
    result = invoke(*words)
    assert (result.exit_code, result.stderr) == (
        1, f"error: {tmp_path / 'broken.glb'} is cut off: a .glb has a header of 12 bytes\n"
    )  # fmt: skip
    assert not (tmp_path / "x.png").exists()


# --- lights -------------------------------------------------------------------------------------

RIG = """
import std.gltf.{PunctualPoint, PunctualSpot}
import std.lights.{Directional}
import std.terms.{lambert}
material Wall { color = lambert(vec3(1)) }
rig Hall { sun : Directional  first : PunctualPoint  others : PunctualPoint[<= 3]
           torch : PunctualSpot }
"""


def lamp(kind: str, number: float) -> Lamp:
    """A lamp with a number, by which its place differs from others."""
    place = (number, 0.0, 0.0)
    return Lamp(f"{kind} {number}", kind, place, place, (0.0, -1.0, 0.0), 0.25, 0.5)  # type: ignore[arg-type]


def test_lights_go_to_those_of_the_rig_that_are_of_their_kind() -> None:
    (material,) = burnish.compile(RIG).materials
    instance = material.instance()
    lamps = (
        lamp("point", 1), lamp("spot", 2), lamp("point", 3), lamp("point", 4), lamp("spot", 5)
    )  # fmt: skip
    scene = Scene(lamps=lamps)
    scene.apply(instance, 1.0)
    assert instance.missing == ()
    assert instance.get("sun.diffuse_color") == (0, 0, 0), "the file has none"
    assert instance.get("first.place") == (1, 0, 0)
    assert instance.get("others.count") == 2
    assert [each["diffuse_color"] for each in instance.get("others")[:2]] == [(3, 0, 0), (4, 0, 0)]
    assert instance.get("torch.place") == (2, 0, 0)
    assert math.isclose(instance.get("torch.outer"), 0.5)
    assert instance.get("torch.reach") == 0
    assert scene.unused_lamps(instance) == [lamps[4]]
