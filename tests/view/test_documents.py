"""The documents of ``burnish view``'s pages: by choices, scenes and values of the command line."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from burnish.commands.view.documents import Documents, choice_of
from burnish.commands.view.keeping import Keeping
from burnish.commands.view.pictures import Pictures
from burnish.commands.view.request import ViewRequest

from ..scenes.kit import triangle

EXAMPLES = Path(__file__).parents[2] / "examples"


def document(file: Path, query: dict[str, str] | None = None, **options: Any) -> dict[str, Any]:
    """The document of a page that asks for something of a file."""
    request = ViewRequest(
        file=file,
        mesh="cube",
        floor=options.get("floor", False),
        scene=options.get("scene"),
        variant=options.get("variant"),
        environment=options.get("environment", "studio"),
        eye=options.get("eye"),
        look_at=None,
        turn=(0.0, 0.0),
        instances=4,
        exposure=options.get("exposure", 0.0),
        tone=options.get("tone", "none"),
        values=options.get("values", ()),
        material=options.get("material"),
        rig=options.get("rig"),
        pass_=options.get("pass_"),
        search_path=(),
        hoist=True,
        plain=options.get("plain", False),
    )
    keeping = Keeping()
    documents = Documents(request, file.name, Pictures(keeping), Documents.shelf(keeping))
    found: dict[str, Any] = json.loads(documents.get(choice_of(query or {})))
    return found


def controls(found: dict[str, Any]) -> dict[str, Any]:
    return {row["name"]: row["value"] for row in found["controls"]}


FILE = """
material First { param size : float = 0.25  color = vec3(size) }
material Second { color = vec3(0.5) }
pass Plain { target paint : rgba8 = vec4(color, 1) }
rig Dark {}
rig Darker {}
"""


def test_choices(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(FILE)
    found = document(file)
    assert [row["name"] for row in found["subjects"]] == ["First", "Second"]
    assert (found["rigs"], found["passes"]) == (["Dark", "Darker"], ["Plain"])
    chosen = {"subject": "First", "rig": "Dark", "pass": "Plain", "mesh": "cube"}
    assert found["chosen"] == chosen
    assert [row["name"] for row in found["package"]["plan"]["outputs"]] == ["paint"]

    asked = {"subject": "Second", "rig": "Darker", "mesh": "torus", "profile": "glsl:es300"}
    other = document(file, asked)
    assert other["chosen"] == {**chosen, "subject": "Second", "rig": "Darker", "mesh": "torus"}
    assert list(other["package"]["shaders"][0]["texts"]) == ["glsl:es300"]

    by_line = document(file, {"subject": "Renamed"}, material="Second", rig="Darker")
    assert by_line["chosen"]["subject"] == "Second"
    assert by_line["chosen"]["rig"] == "Darker"


def test_values_of_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(FILE)
    # The material's own `size`, and not that of the picture.
    assert controls(document(file, values=(("size", "0.75"),)))["size"] == 0.75
    wrong = document(file, values=(("sise", "1"),))
    assert "there is no parameter `sise`: did you mean `size`?" in wrong["error"]
    assert wrong["subjects"]
    assert "error: there is no parameter `sise`" in capsys.readouterr().err


def test_a_scene(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(FILE)
    scene = triangle().save(tmp_path)
    found = document(file, scene=scene)
    assert (found["chosen"]["mesh"], found["meshes"]) == (None, [])
    (model,) = found["package"]["models"]
    assert model["material"] == "First"
    assert document(file, scene=tmp_path / "none.gltf")["error"].endswith(
        "none.gltf: No such file or directory"
    )


def test_materials_read_what_kernels_write() -> None:
    """Particles are counted, and the living ones shown as a chart."""
    found = document(EXAMPLES / "compaction.burnish")
    (shader,) = found["package"]["shaders"]
    read = [row["name"] for row in shader["reflection"]["buffers"] if row["stages"]]
    for name in read:
        elements = np.frombuffer(base64.b64decode(shader["buffers"][name]), "<u4")
        assert len(elements) > 1, name
        assert elements.any(), name
    assert read


def test_kernels_over_images_have_a_picture(capsys: pytest.CaptureFixture[str]) -> None:
    found = document(EXAMPLES / "edges.burnish")
    assert found["meshes"] == []
    assert found["chosen"]["mesh"] is None
    (shader,) = found["package"]["shaders"]
    picture = found["package"]["pictures"][shader["textures"]["source"]]
    assert (picture["width"], picture["height"]) == (512, 512)
    assert "is a test chart" in capsys.readouterr().err


def test_kernels_read_what_others_of_the_file_write() -> None:
    """`Cloth` gets its knots of `Hung`, which is run here; the page runs `Cloth`."""
    found = document(EXAMPLES / "cloth.burnish", {"subject": "Cloth"})
    (shader,) = found["package"]["shaders"]
    knots = np.frombuffer(base64.b64decode(shader["buffers"]["now"]), "<f4").reshape(-1, 4)
    assert len(knots) == 32 * 16
    assert knots[0, :3] == pytest.approx((-0.775, 0.8, -0.4), abs=1e-6)
    assert [row["name"] for row in found["package"]["plan"]["outputs"]] == ["after"]
    lacking = document(EXAMPLES / "cloth.burnish", {"subject": "Cloth", "profile": "glsl:es300"})
    assert "glsl:es300 has no compute stage" in lacking["error"]


@pytest.mark.parametrize(
    ("type_", "read"),
    [("texture_cube", "around(normal)"), ("texture_cube_array", "around(normal, 0)")],
)
def test_cube_maps_show_the_environment(type_: str, read: str, tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(f"material M {{ map around : {type_} = black  color = {read}.rgb }}")
    sides = {
        asked: [row["width"] for row in document(file, environment=asked)["package"]["pictures"]]
        for asked in ("studio", "none")
    }
    assert sides == {"studio": [64], "none": [1]}


def test_the_camera_begins_where_it_was_asked_to_be(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text("material M { color = 0.5 + 0.5 * normal }")
    assert document(file, eye=(0.0, 0.0, 7.0))["orbit"]["eye"] == [0, 0, 7]
    assert document(file, values=(("eye", "0,7,0"),))["orbit"]["eye"] == [0, 7, 0]


def test_the_comment_of_the_file_is_followed(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(
        "//!     burnish render m.burnish --mesh plane --set size=0.75 --set other=1\n"
        "material M { param size : float = 0.25  color = vec3(size) }\n"
    )
    found = document(file)
    assert (found["chosen"]["mesh"], controls(found)["size"]) == ("plane", 0.75)
    assert controls(document(file, values=(("size", "0.5"),)))["size"] == 0.5
    found = document(file, plain=True)
    assert (found["chosen"]["mesh"], controls(found)["size"]) == ("cube", 0.25)


def test_exposure_and_tone_mapping_are_controls(tmp_path: Path) -> None:
    """They begin as the command line or the comment says; what is no picture has none."""
    file = tmp_path / "m.burnish"
    file.write_text("//!     burnish render m.burnish --tone agx\nmaterial M { color = vec3(4) }\n")
    found = document(file, exposure=-1.5)
    assert controls(found)["--exposure"] == -1.5
    assert controls(found)["--tone"] == "agx"
    assert [row["section"] for row in found["controls"]][-2:] == ["Screen", "Screen"]
    assert "agx" in found["development"]["tones"]
    file.write_text("kernel K { result all : int[4] = int(index) }")
    assert controls(document(file)) == {}


def test_materials_are_drawn_in_floats_with_several_samples(tmp_path: Path) -> None:
    """But for passes that say so by themselves, draw layers, or write other numbers than light."""
    file = tmp_path / "m.burnish"
    passes = {
        "Light": ("target color : rgba8 = vec4(color, 1)", ("rgba16f", 4)),
        "Smooth": ("target color : rgba8 = vec4(color, 1)  raster { samples = 4 }", ("rgba8", 4)),
        "Far": ("target far : r32f = frag_coord.z", ("r32f", 1)),
    }  # fmt: skip
    for name, (members, (format_, samples)) in passes.items():
        file.write_text(
            f"material M {{ color = vec3(4) }}\npass {name} {{ {members} }}", encoding="utf-8"
        )
        textures = document(file)["package"]["plan"]["textures"]
        wanted = {"rgba16f": "rgba16float", "rgba8": "rgba8unorm", "r32f": "r32float"}[format_]
        assert {row["format"] for row in textures} - {"depth32float"} == {wanted}
        assert max(row["samples"] for row in textures) == samples


def test_a_material_on_a_floor(tmp_path: Path) -> None:
    """A frame draws it; what is none is drawn as ever."""
    file = tmp_path / "m.burnish"
    file.write_text(FILE)
    found = document(file, floor=True)
    assert (found["chosen"]["subject"], found["chosen"]["mesh"]) == ("First", "cube")
    assert [step["name"] for step in found["package"]["plan"]["steps"]] == ["seen", "lit", "drawn"]
    assert [row["material"] for row in found["package"]["models"]] == ["First", "Floor_"]
    assert controls(found)["size"] == 0.25
    kernel = document(EXAMPLES / "edges.burnish", floor=True)
    assert [step["kind"] for step in kernel["package"]["plan"]["steps"]] == ["run"]
